# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the extension adds to Blender, what it takes away again, and how much work that is."""

import bpy
import pytest

from tests import pace
from tests.integration.support import ROOT, rgb_material


def test_register_brings_no_heavy_module_and_little_work(blender):
    found = blender(f"""
        sys.path.append({str(ROOT)!r})
        from tests import pace
        extension = load_extension()
        before = set(sys.modules)
        extension.register()
        added = sorted(set(sys.modules) - before)
        extension.unregister()
        again = pace.calls(extension.register)
        extension.unregister()
        print(json.dumps({{"added": added, "again": again}}))
    """)
    tops = {name.partition(".")[0] for name in found["added"]}
    for heavy in ("numpy", "colour", "scipy", "matplotlib", "pandas", "OpenImageIO"):
        assert heavy not in tops
    ours = [name for name in found["added"] if name.startswith("rough_spectra.")]
    parts = {name.removeprefix("rough_spectra.") for name in ours}
    computing = {"core.cycles", "core.reading", "core.oren_nayar", "addon.colorimetry.tristimulus"}
    assert not computing & parts
    drawing = {"addon.interface.panels.redraw", "addon.preview.icons", "addon.preview.theme"}
    assert not drawing & parts
    # What Blender's start waits for: a tenth of the code to read, 3,400 calls.
    shipped = [path for name in ("core", "addon") for path in (ROOT / name).rglob("*.py")]
    assert brought(parts) < 0.15 * sum(path.stat().st_size for path in shipped)
    assert found["again"] < 10_000


def brought(modules):
    """Bytes of source of modules that are named from the extension's package on."""
    files = [ROOT / f"{name.replace('.', '/')}.py" for name in modules]
    found = [path if path.is_file() else path.with_suffix("") / "__init__.py" for path in files]
    assert len(found) > 10
    return sum(path.stat().st_size for path in found)


def test_use_leaves_no_stand_ins_in_sys_modules(blender):
    found = blender("""
        from unittest import mock
        extension = load_extension()
        extension.register()
        from rough_spectra.addon.colorimetry import tristimulus
        from rough_spectra.addon.matching.request import Request
        from rough_spectra.addon.material import derive
        from rough_spectra.addon.samples import presets
        material = bpy.data.materials.new("A")
        material.use_nodes = True
        material.node_tree.nodes.clear()
        derive.assign([(material, Request(presets.load("14"), 0.3))])
        usual = "colour" in sys.modules
        # Its tables are in a file, of unusual grids, too.
        tristimulus.weights(range(400, 701, 20))
        usual = usual or "colour" in sys.modules
        from rough_spectra.addon.support import colour_science
        colour_science.colour()
        fakes = [name for name in sys.modules if isinstance(sys.modules[name], mock.Mock)]
        bpy.ops.wm.read_factory_settings(use_empty=True)
        extension.unregister()
        print(json.dumps({"fakes": fakes, "usual": usual, "colour": "colour" in sys.modules}))
    """)
    assert found == {"fakes": [], "usual": False, "colour": True}


def test_needs_none_of_blenders_own_add_ons(blender):
    """Of Blender 4.5, the Asset Browser's menu Asset belongs to the Pose Library."""
    found = blender("""
        import addon_utils
        for name in list(bpy.context.preferences.addons.keys()):
            addon_utils.disable(name)
        extension = load_extension()
        extension.register()
        kept = ("ASSETBROWSER_MT_library", "ASSETBROWSER_MT_catalog")
        menus = [getattr(bpy.types, name) for name in kept if hasattr(bpy.types, name)]
        drawn = [f.__module__ for m in menus for f in getattr(m.draw, "_draw_funcs", [])]
        extension.unregister()
        print(json.dumps(drawn))
    """)
    assert "rough_spectra.addon.interface.operators.build_assets" in found


def test_unregister_leaves_nothing_and_register_works_again(blender):
    found = blender("""
        extension = load_extension()

        def ours():
            types = [name for name in dir(bpy.types) if name.lower().startswith("rough")]
            operators = list(dir(bpy.ops.rough_spectra))
            return {
                "types": types,
                "operators": operators,
                "property": hasattr(bpy.types.Material, "rough_spectra"),
                "commands": len(command_line._handles),
            }

        command_line = importlib.import_module("rough_spectra.addon.commands.command_line")
        states = [ours()]
        for _ in range(2):
            extension.register()
            states.append(ours())
            extension.unregister()
            states.append(ours())
        print(json.dumps(states))
    """)
    before, first, gone, second, gone_again = found
    assert first == second
    assert before == gone == gone_again
    assert first["property"]
    assert first["commands"] == 1
    assert {"assign_preset", "assign_file", "renew", "bake"} <= set(first["operators"])
    assert not before["property"]
    assert not before["types"]


def test_unregister_ends_jobs_under_way(blender):
    found = blender("""
        extension = load_extension()
        extension.register()
        from rough_spectra.addon.instrument import measure
        material = bpy.data.materials.new("A")
        job = measure.Measurement([material], [measure.RING_45_0] * 500)
        states = []
        for act in (lambda: None, extension.unregister, job.close):
            act()
            states.append([job._process.poll() is None, job._folder.exists()])
        print(json.dumps(states))
    """)
    assert found == [[True, True], [False, False], [False, False]]


def operators():
    from rough_spectra.addon.interface import registration

    return [cls for cls in registration.classes if issubclass(cls, bpy.types.Operator)]


@pytest.mark.parametrize("cls", operators(), ids=lambda cls: cls.bl_idname)
def test_operator_has_tooltips_and_undo_where_it_changes_data(cls):
    assert not cls.__doc__.endswith(".")
    assert cls.bl_label
    assert "REGISTER" in cls.bl_options
    only_files = {"bake", "rename_sample", "remove_sample", "open_library", "build_assets"}
    only_files.add("show_presets")
    only_window = {"show_rendered", "judge_picture", "pick_pixel", "show_picture"}
    only_window |= {"change_lamp", "reset_lamps"}
    only_files |= {"export_materials", "submit_to_flamenco"}
    name = cls.bl_idname.partition(".")[2]
    assert ("UNDO" in cls.bl_options) == (name not in only_files | only_window)
    module, name = cls.bl_idname.split(".")
    rna = getattr(getattr(bpy.ops, module), name).get_rna_type()
    assert rna.description == cls.__doc__
    for prop in rna.properties:
        if prop.identifier != "rna_type":
            assert prop.name
            assert prop.description, prop.identifier
            assert not prop.description.endswith(".")


def test_stored_properties_have_tooltips_and_identifiers_that_files_hold():
    group = rgb_material("A").rough_spectra
    found = {}
    for prop in group.bl_rna.properties:
        if prop.identifier in ("rna_type", "name"):
            continue
        assert prop.description, prop.identifier
        if prop.type == "ENUM":
            found[prop.identifier] = {item.value: item.identifier for item in prop.enum_items}
            assert all(item.name and item.description for item in prop.enum_items)
    # Blender stores an item's number: never give one to another item.
    assert found["kind"] == dict(enumerate(["reading", "albedo"]))
    assert found["instrument"][0] == "45a:0"
    models = ["two-bounce", "first-order", "closure", "auto", "lambert", "reference", "surface"]
    assert found["model"] == dict(enumerate(models))
    assert found["shader"] == dict(enumerate(["AUTO", "DIFFUSE", "PRINCIPLED"]))
    assert found["observer"] == {0: "2", 1: "10"}
    lights = ["D65", "A", "D50", "D55", "D75", "E", "F2", "F7", "F11", "LED-B3"]
    assert found["illuminant"] == dict(enumerate(lights))


def test_presets_are_offered_by_ids_that_scripts_can_rely_on():
    from rough_spectra.addon.interface.operators import assign_preset
    from rough_spectra.addon.samples import presets

    items = assign_preset.preset_items(None, None)
    assert [item[0] for item in items] == presets.names()
    assert all(name and title and about for name, title, about in items)
    assert assign_preset.preset_items(None, None) is items  # Blender keeps only pointers to it


def test_panel_computes_nothing_that_takes_time():
    """What `draw` calls, with 500 materials in the file as with 5."""
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.matching.solve import Request
    from rough_spectra.addon.material import (
        derivation,
        derive,
        snapshot,
        state,
    )
    from rough_spectra.addon.samples import presets

    request = Request(presets.load("14"), 0.3)
    materials, spent = [], []
    for count in (5, 500):
        more = [rgb_material(f"{number}") for number in range(len(materials), count)]
        derive.assign([(material, request) for material in more])
        materials += more

        def draw(material=materials[3]):
            assert snapshot.has_spectrum(material)
            assert not state.stale_reasons(material, working_space.working_space_name())
            assert derivation.get_stamp(material) is not None

        draw()  # what is looked up the next time
        spent.append(pace.calls(draw))
    assert all(not state.stale_reasons(m, working_space.working_space_name()) for m in materials)
    assert spent[0] == spent[1]
    # Seen: 65 against 1,900.
    assert spent[1] < pace.calls(lambda: derive.renew(materials[3:4])) / 10
