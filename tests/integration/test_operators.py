# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators as a script or a button calls them, without a window."""

import math
import types

import bpy
import pytest
from rough_spectra.addon.interface.operators import giving

from tests.integration.support import checkered_and_glowing, contents, rgb_material, spectrum_csv

OPS = bpy.ops.rough_spectra
GREEN = "colorchecker/14-green"


def mesh_object(name, *materials):
    """Make a selected, active object with these materials."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    for material in materials:
        mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    return thing


def color(material):
    node = next(node for node in material.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    return tuple(node.inputs["Color"].default_value)


def refusal(operator, **options):
    """The sentence of the RuntimeError that Blender makes of an operator's error report."""
    with pytest.raises(RuntimeError) as caught:
        operator("EXEC_DEFAULT", **options)
    text = str(caught.value).strip()
    assert text.startswith("Error: ")
    assert text.endswith(".")
    assert "Traceback" not in text
    return text.removeprefix("Error: ")


def test_preset_goes_to_the_active_material_with_sigma():
    wall = mesh_object("Wall", rgb_material("Wall"))
    other = rgb_material("Other")
    before = color(other)
    assert OPS.assign_preset("EXEC_DEFAULT", preset=GREEN, sigma=math.radians(30)) == {"FINISHED"}
    group = wall.active_material.rough_spectra
    assert group.sample_name == "ColorChecker 14 Green"
    assert math.degrees(group.sigma) == pytest.approx(30, abs=1e-5)
    assert color(wall.active_material) != before
    assert not other.rough_spectra.spectrum
    assert color(other) == before


def test_object_without_a_material_gets_one():
    wall = mesh_object("Wall")
    assert OPS.assign_preset("EXEC_DEFAULT", preset=GREEN) == {"FINISHED"}
    assert wall.active_material.name == "ColorChecker 14 Green"
    assert wall.active_material.rough_spectra.spectrum


def test_object_with_an_empty_slot_gets_a_material_in_it():
    wall = mesh_object("Wall", rgb_material("Old"))
    wall.material_slots[0].material = None
    assert OPS.assign_preset("EXEC_DEFAULT", preset=GREEN) == {"FINISHED"}
    assert [slot.material.name for slot in wall.material_slots] == ["ColorChecker 14 Green"]


def test_failed_assignment_leaves_the_object_without_a_material(tmp_path):
    wall = mesh_object("Wall")
    source = tmp_path / "short.csv"
    source.write_text("wavelength,short\n400,0.3\n410,0.3\n", encoding="utf-8")
    assert "'short'" in refusal(OPS.assign_file, filepath=str(source))
    assert not bpy.data.materials
    assert not wall.material_slots


def test_selected_objects_all_get_it_and_each_material_once():
    shared, own, left_out = (rgb_material(name) for name in ("Shared", "Own", "Left out"))
    mesh_object("Away", left_out).select_set(False)
    mesh_object("One", shared)
    mesh_object("Two", own, shared)
    assert OPS.assign_preset("EXEC_DEFAULT", preset=GREEN, scope="SELECTED") == {"FINISHED"}
    assert color(shared) == color(own)
    assert shared.rough_spectra.spectrum
    assert not left_out.rough_spectra.spectrum


def test_one_material_that_cannot_be_set_leaves_all_as_they_were():
    good, bad = rgb_material("Good"), checkered_and_glowing("Bad")
    mesh_object("Both", good, bad)
    before = color(good)
    sentence = refusal(OPS.assign_preset, preset=GREEN, scope="SELECTED")
    assert "'Bad'" in sentence
    assert color(good) == before
    assert not good.rough_spectra.spectrum


def test_selection_without_materials_is_refused():
    mesh_object("Wall")
    assert "select" in refusal(OPS.assign_preset, preset=GREEN, scope="SELECTED")
    assert not bpy.data.materials


def test_without_an_object_poll_says_what_to_select():
    for operator in (OPS.assign_preset, OPS.assign_file):
        assert not operator.poll()
        with pytest.raises(RuntimeError, match="Select an object that can carry a material"):
            operator("EXEC_DEFAULT")
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    bpy.context.collection.objects.link(camera)
    bpy.context.view_layer.objects.active = camera
    assert not OPS.assign_preset.poll()


def test_polls_of_renew_and_bake_say_what_is_missing():
    with pytest.raises(RuntimeError, match="No material has a measured spectrum; assign one first"):
        OPS.renew("EXEC_DEFAULT")
    with pytest.raises(RuntimeError, match="There is no material to measure"):
        OPS.bake("EXEC_DEFAULT")


def test_dialogs_begin_with_the_roughness_that_the_user_gave_the_material():
    dialog = types.SimpleNamespace(sigma=0.1)
    mesh_object("Wall", rgb_material("Wall"))
    giving.begin(dialog, bpy.context)
    assert dialog.sigma == 0.1
    OPS.choose_sample("EXEC_DEFAULT", sample="everyday/brick")
    giving.begin(dialog, bpy.context)
    assert dialog.sigma == 0.1
    OPS.assign_preset("EXEC_DEFAULT", preset=GREEN, sigma=math.radians(30))
    giving.begin(dialog, bpy.context)
    assert dialog.sigma == math.radians(30)


def test_file_with_one_sample_needs_no_name(tmp_path):
    wall = mesh_object("Wall", rgb_material("Wall"))
    source = spectrum_csv(tmp_path / "one.csv", "plaster")
    assert OPS.assign_file("EXEC_DEFAULT", filepath=str(source)) == {"FINISHED"}
    group = wall.active_material.rough_spectra
    assert (group.sample_name, group.kind) == ("plaster", "reading")


def test_file_with_several_samples_asks_for_the_name(tmp_path):
    wall = mesh_object("Wall", rgb_material("Wall"))
    source = str(spectrum_csv(tmp_path / "two.csv", "plaster", "brick"))
    sentence = refusal(OPS.assign_file, filepath=source)
    assert "plaster, brick" in sentence
    assert "sample=" in sentence
    assert "'stone'" in refusal(OPS.assign_file, filepath=source, sample="stone")
    assert not wall.active_material.rough_spectra.spectrum
    assert OPS.assign_file("EXEC_DEFAULT", filepath=source, sample="brick") == {"FINISHED"}
    assert wall.active_material.rough_spectra.sample_name == "brick"


def test_kind_is_what_the_file_says_unless_chosen(tmp_path):
    wall = mesh_object("Wall", rgb_material("Wall"))
    source = spectrum_csv(tmp_path / "albedo.csv", "facet")
    source.write_text("# kind: albedo\n" + source.read_text("utf-8"), encoding="utf-8")
    assert OPS.assign_file("EXEC_DEFAULT", filepath=str(source)) == {"FINISHED"}
    assert wall.active_material.rough_spectra.kind == "albedo"
    assert OPS.assign_file("EXEC_DEFAULT", filepath=str(source), kind="reading") == {"FINISHED"}
    assert wall.active_material.rough_spectra.kind == "reading"


def test_missing_file_is_refused_by_name(tmp_path):
    mesh_object("Wall", rgb_material("Wall"))
    assert "none.csv" in refusal(OPS.assign_file, filepath=str(tmp_path / "none.csv"))


def test_renew_brings_back_an_edited_color_and_takes_a_new_sigma():
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset=GREEN)
    smooth = color(material)
    node = next(node for node in material.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    node.inputs["Color"].default_value = (1, 0, 0, 1)
    assert OPS.renew("EXEC_DEFAULT") == {"FINISHED"}
    assert color(material) == pytest.approx(smooth, abs=1e-7)
    material.rough_spectra.sigma = math.radians(40)
    assert OPS.renew("EXEC_DEFAULT") == {"FINISHED"}
    assert color(material) != pytest.approx(smooth, abs=1e-4)


def test_renew_of_a_selection_without_spectra_is_refused():
    mesh_object("Plain", rgb_material("Plain"))
    mesh_object("Wall", rgb_material("Wall")).select_set(False)
    OPS.assign_preset("EXEC_DEFAULT", preset=GREEN)
    assert "assign one first" in refusal(OPS.renew, scope="SELECTED")


def test_linked_object_is_not_given_a_material(scene_file):
    with bpy.data.libraries.load(str(scene_file), link=True) as (_, wanted):
        wanted.objects = ["Bare"]
    (thing,) = wanted.objects
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    assert "'Bare'" in refusal(OPS.assign_preset, preset=GREEN)
    assert not thing.material_slots


def snapshot():
    """Names and users of all datablocks, selection, active object, settings, dirtiness."""
    blocks = {
        collection.identifier: [
            (block.name, block.users, block.use_fake_user)
            for block in getattr(bpy.data, collection.identifier)
        ]
        for collection in bpy.data.bl_rna.properties
        if collection.type == "COLLECTION"
    }
    scene = bpy.context.scene
    settings = {
        f"{where}.{prop.identifier}": repr(getattr(data, prop.identifier))
        for where, data in (("render", scene.render), ("cycles", scene.cycles), ("scene", scene))
        for prop in data.bl_rna.properties
        if prop.type not in ("COLLECTION", "POINTER")
        and prop.identifier != "use_nodes"  # deprecated: reading it warns
    }
    return (
        blocks,
        settings,
        [thing.name for thing in bpy.context.selected_objects],
        getattr(bpy.context.view_layer.objects.active, "name", None),
        bpy.data.is_dirty,
        bpy.data.filepath,
    )


def test_bake_writes_all_files_and_leaves_blender_as_it_was(scene, tmp_path):
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    panel = bpy.data.objects["Panel"]
    panel.select_set(True)
    bpy.context.view_layer.objects.active = panel
    before = snapshot()
    base = tmp_path / "out" / "chart"
    assert OPS.bake("EXEC_DEFAULT", filepath=str(base), scope="ALL") == {"FINISHED"}
    assert snapshot() == before
    assert len(contents(base.parent)) == 8


def test_bake_verb_leaves_blender_as_it_was(scene, main, tmp_path):
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    bpy.data.objects["Panel"].select_set(True)
    before = snapshot()
    assert main("bake", "--object", "Panel", "--output", tmp_path / "out" / "x").status == 0
    assert main("check", "--material", "Alpha").status == 0
    assert snapshot() == before


def test_bake_refuses_a_target_that_no_file_can_have(scene, tmp_path):
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    before = snapshot()
    assert "folder" in refusal(OPS.bake, filepath="", scope="ALL")
    assert "scene.blend is a file" in refusal(OPS.bake, filepath=str(scene / "x"), scope="ALL")
    assert snapshot() == before


def test_bake_of_an_object_without_a_material_makes_none(tmp_path):
    rgb_material("Elsewhere")
    mesh_object("Wall")
    assert "no material" in refusal(OPS.bake, filepath=str(tmp_path / "x"))
    assert len(bpy.data.materials) == 1
    assert not contents(tmp_path)


def test_bake_on_a_full_temporary_disk_is_refused_in_a_sentence(blender):
    """In a Blender of its own, since a limit on the size of files cannot be raised again."""
    found = blender("""
        import resource, signal
        extension = load_extension()
        extension.register()
        material = bpy.data.materials.new("A")
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        try:
            bpy.context.object.active_material = material
            bpy.ops.rough_spectra.bake(filepath="no folder/x")
            text = "baked"
        except RuntimeError as error:
            text = str(error)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        extension.unregister()
        print(json.dumps(text))
    """)
    assert found.startswith("Error: Temporary files cannot be written")
    assert "Traceback" not in found


def test_another_sample_keeps_the_settings_of_the_material(tmp_path):
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset=GREEN, sigma=0.3)
    group = material.rough_spectra
    group.illuminant, group.model, group.tolerance = "A", "closure", 2.0
    source = spectrum_csv(tmp_path / "plaster.csv", "plaster")
    OPS.assign_file("EXEC_DEFAULT", filepath=str(source), sigma=0.4)
    OPS.choose_sample("EXEC_DEFAULT", sample="everyday/brick")
    assert (group.sample_name, group.illuminant, group.model) == ("Brick", "A", "closure")
    assert (group.tolerance, group.sigma) == pytest.approx((2.0, 0.4))


def test_a_damaged_spectrum_is_mended_by_assigning_again():
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset=GREEN)
    material.rough_spectra.spectrum = "{damaged"
    assert OPS.choose_sample("EXEC_DEFAULT", sample="everyday/brick") == {"FINISHED"}
    assert material.rough_spectra.sample_name == "Brick"
    OPS.renew("EXEC_DEFAULT")
