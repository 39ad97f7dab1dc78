# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From measurement files to library and materials: operators and verbs."""

import json
import math
import os
import shutil
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import texture_colors, texture_scale
from rough_spectra.addon.interface.operators import import_review, import_samples
from rough_spectra.addon.material import preferences
from rough_spectra.addon.samples import importing, library, readers

from tests.integration.support import ROOT, contents, rgb_material, spectrum_csv
from tests.integration.test_operators import mesh_object, refusal

OPS = bpy.ops.rough_spectra
BRICK = ROOT / "tests" / "fixtures" / "nix" / "brick.csv"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The user's library, which must not be that of whoever runs the tests."""
    path = tmp_path / "library"
    monkeypatch.setattr(preferences, "user_folder", lambda: path)
    return path


@pytest.fixture
def two(tmp_path):
    return spectrum_csv(tmp_path / "two.csv", "plaster", "chalk")


@pytest.fixture
def noisy(tmp_path):
    path = spectrum_csv(tmp_path / "noisy.csv", "dark")
    text = path.read_text(encoding="utf-8").replace("400,0.200000", "400,-0.001")
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def broken(tmp_path):
    path = tmp_path / "broken.csv"
    path.write_text("wavelength,x\n400,0.5\n410,oops\n", encoding="utf-8")
    return path


def own(folder):
    return [entry.id for entry in library.entries(folder) if not entry.is_preset]


def test_operator_adds_several_files_at_once(folder, two):
    shutil.copy(BRICK, two.parent)
    files = [{"name": "two.csv"}, {"name": "brick.csv"}]
    done = OPS.import_samples("EXEC_DEFAULT", directory=str(two.parent), files=files)
    assert done == {"FINISHED"}
    assert own(folder) == ["brick/brick", "two/plaster", "two/chalk"]
    done = OPS.import_samples("EXEC_DEFAULT", filepath=str(two), collection="Walls, white")
    assert own(folder)[:2] == ["Walls, white/plaster", "Walls, white/chalk"]
    assert not bpy.data.materials


def test_many_files_make_one_collection_if_wished(folder, two, tmp_path):
    place = tmp_path / "Site 7"
    place.mkdir()
    shutil.copy(BRICK, place)
    shutil.copy(two, place)
    files = [{"name": "two.csv"}, {"name": "brick.csv"}]
    OPS.import_samples("EXEC_DEFAULT", directory=str(place), files=files, together=True)
    assert own(folder) == ["Site 7/plaster", "Site 7/chalk", "Site 7/brick"]
    batch = importing.read([two, BRICK])
    review(batch, [True, False, True], together=True, collection="named")
    assert [name for name in own(folder) if name.startswith("named")] == [
        "named/plaster",
        "named/brick",
    ]


def test_operator_refuses_all_for_one_broken_file_unless_told_otherwise(folder, two, broken):
    files = [{"name": two.name}, {"name": broken.name}]
    options = {"directory": str(two.parent), "files": files}
    assert "broken.csv, line 3" in refusal(OPS.import_samples, **options, materials="CREATE")
    assert own(folder) == []
    assert not bpy.data.materials
    assert OPS.import_samples("EXEC_DEFAULT", **options, keep_going=True) == {"FINISHED"}
    assert own(folder) == ["two/plaster", "two/chalk"]
    with pytest.raises(RuntimeError, match="choose a measurement file"):
        OPS.import_samples("EXEC_DEFAULT")


def test_operator_assigns_the_first_or_makes_materials_of_all(folder, two):
    wall = mesh_object("Wall", rgb_material("Wall"))
    options = {"filepath": str(two), "add_to_library": False, "sigma": math.radians(20)}
    OPS.import_samples("EXEC_DEFAULT", **options, materials="ASSIGN")
    group = wall.active_material.rough_spectra
    assert group.sample_name == "plaster"
    assert math.degrees(group.sigma) == pytest.approx(20, abs=1e-5)
    OPS.import_samples("EXEC_DEFAULT", **options, materials="CREATE")
    assert {"plaster", "chalk"} <= set(bpy.data.materials.keys())
    assert bpy.data.materials["chalk"].rough_spectra.sample_name == "chalk"
    assert bpy.data.materials["chalk"].use_fake_user
    assert not folder.exists()


def test_what_is_imported_onto_a_texture_is_looked_at_in_the_background(folder, two, monkeypatch):
    """The window stood still meanwhile; and the material keeps the light that the user chose."""

    def seen(_sockets):
        raise AssertionError("somebody waits for the second Blender")

    monkeypatch.setattr(texture_colors, "seen", seen)
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    tree, options = material.node_tree, {"filepath": str(two), "materials": "ASSIGN"}
    OPS.import_samples("EXEC_DEFAULT", **options, sigma=math.radians(20))
    material.rough_spectra.illuminant = "A"
    shader = next(node for node in tree.nodes if node.type.startswith("BSDF"))
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], shader.inputs[0])
    assert OPS.import_samples("EXEC_DEFAULT", **options, sigma=math.radians(30)) == {"FINISHED"}
    assert texture_scale.node_of(shader.inputs[0]) is not None
    assert material.rough_spectra.illuminant == "A"
    assert math.degrees(material.rough_spectra.sigma) == pytest.approx(30, abs=1e-5)
    assert own(folder) == ["two/plaster", "two/chalk"]


def test_a_spectrum_without_a_color_makes_no_material_and_leaves_none(folder, tmp_path):
    path = tmp_path / "short.csv"
    path.write_text("wavelength,short\n400,0.3\n410,0.3\n", encoding="utf-8")
    assert "short" in refusal(OPS.import_samples, filepath=str(path), materials="CREATE")
    assert not bpy.data.materials
    assert own(folder) == ["short/short"]  # a library may hold what Cycles cannot show


WARM = ROOT / "tests" / "fixtures" / "ecostress" / "emissivity.spectrum.txt"


def test_what_has_no_color_goes_to_the_library_and_others_become_materials(folder, two):
    batch = importing.read([two, WARM])
    assert not batch.refused
    assert any("has no color" in sentence for sentence in batch.found[2].warnings)
    review(batch, [True, True, True], collection="mine", materials="CREATE")
    assert own(folder) == ["mine/plaster", "mine/chalk", "mine/test-sand"]
    assert "chalk" in bpy.data.materials
    assert "Test Sand" not in bpy.data.materials


@pytest.mark.parametrize("materials", ["CREATE", "ASSIGN"])
def test_no_color_is_refused_where_one_is_asked_for(folder, materials):
    wall = mesh_object("Wall", rgb_material("Wall"))
    sentence = refusal(OPS.import_samples, filepath=str(WARM), materials=materials)
    assert "it holds emissivity, 8000 to 14000 nm, so it has no color for a material" in sentence
    assert not wall.active_material.rough_spectra.sample_name
    assert own(folder) == ["emissivity.spectrum/test-sand"]
    sentence = refusal(OPS.assign_file, filepath=str(WARM), kind="reading")
    assert "holds emissivity, and cannot be taken as a reading" in sentence


def review(batch, chosen, **options):
    """Press OK in the dialog, with the samples checked that `chosen` says."""
    import_review._batch[:] = [batch]
    empty = {"swatch": (0, 0, 0), "has_color": False, "about": "", "warnings": "", "notes": ""}
    items = [{"name": "", "chosen": is_chosen, **empty} for is_chosen in chosen]
    return OPS.import_review("EXEC_DEFAULT", items=items, **options)


def test_review_imports_what_is_checked_and_assigns_what_is_highlighted(folder, two):
    wall = mesh_object("Wall", rgb_material("Wall"))
    batch = importing.read([two, BRICK])
    with pytest.raises(RuntimeError, match="No sample is checked"):
        review(batch, [False] * 3)
    with pytest.raises(RuntimeError, match="import them again"):
        review(batch, [True])
    assert own(folder) == []
    review(batch, [True, False, True], index=2, collection="mine", materials="ASSIGN")
    assert own(folder) == ["mine/plaster", "mine/brick"]
    assert wall.active_material.rough_spectra.sample_name == "Brick"
    review(batch, [True, False, True], index=1, collection="mine", materials="ASSIGN")
    assert wall.active_material.rough_spectra.sample_name == "plaster"
    assert own(folder) == ["mine/plaster", "mine/brick"]


def test_drop_takes_every_ending_of_the_files_that_tests_read():
    handler = import_samples.ROUGHSPECTRA_FH_import
    endings = set(handler.bl_file_extensions.split(";"))
    assert all(ending.startswith(".") and ending == ending.lower() for ending in endings)
    fixtures = ROOT / "tests" / "fixtures"
    refused = {"fuzz", "known_by_name"}
    folders = [folder for folder in fixtures.iterdir() if folder.name not in refused]
    read = {path.suffix.lower() for folder in folders for path in folder.iterdir()} - {".md"}
    assert read - endings == {".exr"}
    assert ".exr" not in endings  # images are dropped more often than spectral ones
    assert not handler.poll_drop(bpy.context)  # no area under the mouse
    assert hasattr(bpy.ops.rough_spectra, handler.bl_import_operator.partition(".")[2])


def test_library_operators_assign_rename_and_remove(folder, two):
    wall = mesh_object("Wall", rgb_material("Wall"))
    OPS.import_samples("EXEC_DEFAULT", filepath=str(two))
    assert OPS.assign_sample("EXEC_DEFAULT", sample="two/chalk") == {"FINISHED"}
    assert wall.active_material.rough_spectra.sample_name == "chalk"
    assert OPS.assign_sample("EXEC_DEFAULT", sample="colorchecker/14-green", sigma=0.5)
    assert wall.active_material.rough_spectra.sample_name == "ColorChecker 14 Green"
    assert wall.active_material.rough_spectra.sigma == pytest.approx(0.5)
    OPS.rename_sample("EXEC_DEFAULT", sample="two/chalk", new_name="Tafelkreide")
    assert own(folder) == ["two/plaster", "two/tafelkreide"]
    assert "another sample" in refusal(
        OPS.rename_sample, sample="two/plaster", new_name="Tafelkreide"
    )
    OPS.remove_sample("EXEC_DEFAULT", sample="two/plaster")
    assert own(folder) == ["two/tafelkreide"]
    assert "14-green" in refusal(OPS.remove_sample, sample="colorchecker/14-green")
    assert "'none'" in refusal(OPS.assign_sample, sample="none")


def test_a_stated_sigma_is_taken_unless_another_is_given(folder, two):
    wall = mesh_object("Wall", rgb_material("Wall"))
    fields = json.loads((ROOT / "presets" / "colorchecker" / "14-green.json").read_bytes())
    folder.mkdir()
    text = json.dumps(fields | {"sigma_degrees": 25, "sigma_source": "profilometer"})
    (folder / "loose.json").write_text(text, encoding="utf-8")
    name = "loose/colorchecker-14-green"
    OPS.assign_sample("EXEC_DEFAULT", sample=name)
    assert math.degrees(wall.active_material.rough_spectra.sigma) == pytest.approx(25, abs=1e-5)
    OPS.assign_sample("EXEC_DEFAULT", sample=name, sigma=0.1)
    assert wall.active_material.rough_spectra.sigma == pytest.approx(0.1)


def test_nearest_color_is_assigned(folder, two):
    wall = mesh_object("Wall", rgb_material("Wall"))
    OPS.import_samples("EXEC_DEFAULT", filepath=str(two))
    entry = next(e for e in library.entries(folder) if e.id == "two/chalk")
    assert OPS.find_nearest("EXEC_DEFAULT", color=entry.swatch) == {"FINISHED"}
    assert wall.active_material.rough_spectra.sample_name == "chalk"
    (_, (second, _)) = library.nearest(entry.lab, 2, folder)
    assert OPS.find_nearest("EXEC_DEFAULT", color=entry.swatch, index=1) == {"FINISHED"}
    assert wall.active_material.rough_spectra.sample_name == second.name
    assert "only 3 matches" in refusal(OPS.find_nearest, count=3, index=3)


def test_nearest_to_typed_colors_and_rows_of_a_palette_is_assigned(folder, tmp_path):
    wall = mesh_object("Wall", rgb_material("Wall"))
    entries = {entry.id: entry for entry in library.entries(folder)}
    moss, sand = entries["colorchecker/11-yellow-green"], entries["everyday/sand"]
    assigned = wall.active_material.rough_spectra
    OPS.find_nearest("EXEC_DEFAULT", by="LAB", lab=moss.lab)
    assert assigned.sample_name == moss.name
    lab = library.contents(folder).lab("D50", 10)[list(entries).index(sand.id)]
    OPS.find_nearest("EXEC_DEFAULT", by="LAB", lab=lab, illuminant="D50", observer="10")
    assert assigned.sample_name == sand.name
    assert math.degrees(assigned.sigma) == pytest.approx(sand.sigma_degrees)
    own = tmp_path / "own.csv"
    rows = [f"{name},{','.join(map(repr, e.lab))}\n" for name, e in (("a", sand), ("b", moss))]
    own.write_text("".join(rows), encoding="utf-8")
    OPS.find_nearest("EXEC_DEFAULT", by="PALETTE", palette=str(own), row="b")
    assert assigned.sample_name == moss.name
    OPS.find_nearest("EXEC_DEFAULT", by="PALETTE", palette=str(own))
    assert assigned.sample_name == sand.name
    sentence = refusal(OPS.find_nearest, by="PALETTE", palette=str(own), row="c")
    assert "no row 'c'" in sentence
    assert "none.csv" in refusal(OPS.find_nearest, by="PALETTE", palette=str(tmp_path / "none.csv"))
    assert assigned.sample_name == sand.name


def test_search_begins_at_the_materials_color(folder):
    from rough_spectra.addon.interface.operators import find_nearest

    wall = rgb_material("Wall")
    mesh_object("Wall", wall)
    node = next(node for node in wall.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    node.inputs["Color"].default_value = (0.2140411, 0.0512695, 1.0, 1.0)
    # IEC 61966-2-1: 0.5, 0.25 and 1 of a screen.
    assert find_nearest.color_of(wall) == pytest.approx((0.5, 0.25, 1.0), abs=2e-3)
    OPS.choose_sample("EXEC_DEFAULT", sample="everyday/brick")
    entry = next(e for e in library.entries(folder) if e.id == "everyday/brick")
    assert find_nearest.color_of(wall) == pytest.approx(entry.swatch, abs=1e-6)


def test_import_verb_prints_ids_and_warns(main, folder, two, noisy, tmp_path):
    result = main("import", two, noisy, "--folder", tmp_path / "other")
    assert result.status == 0
    assert result.out.splitlines() == ["two/plaster", "two/chalk", "noisy/dark"]
    unsaid = "The file does not say the geometry; 45°a:0° is assumed."
    *assumed, warning, summary = result.err.splitlines()
    assert assumed == [f"warning: {path}: {unsaid}" for path in (two, noisy)], "once a file"
    assert warning.startswith(f"warning: {noisy}: 'dark' is below 0 in one band")
    assert summary.startswith("3 samples added to the library")
    assert set(contents(tmp_path / "other")) == {"two.json", "noisy.json", ".lock"}
    assert not folder.exists()
    again = main("import", two, "--folder", tmp_path / "other")
    assert again.status == 0
    assert again.out.splitlines() == ["two/plaster", "two/chalk"]
    assert "0 samples added to the library; 2 already there" in again.err


def test_import_verb_adds_nothing_when_a_file_is_unusable(main, folder, two, broken):
    result = main("import", two, broken, "--collection", "mine")
    assert result.status == 2
    assert f"{broken}, line 3" in result.sentence
    assert not folder.exists()
    result = main("import", two, broken, "--collection", "mine", "--keep-going")
    assert result.status == 2
    assert result.out.splitlines() == ["mine/plaster", "mine/chalk"]
    assert own(folder) == ["mine/plaster", "mine/chalk"]
    result = main("import", two, "--collection", "a/b")
    assert result.status == 2
    assert "'a-b'" in result.err.splitlines()[-1]


def test_a_shared_library_file_is_imported_as_any_other(main, folder, two, tmp_path):
    assert main("import", two, "--folder", tmp_path / "hers").status == 0
    assert main("import", tmp_path / "hers" / "two.json", "--collection", "from her").status == 0
    assert own(folder) == ["from her/plaster", "from her/chalk"]
    (first, _) = readers.read(folder / "from her.json")
    assert first.source == str(two)


def test_search_verb_by_words_and_by_color(main, folder, two):
    assert main("import", two).status == 0
    assert main("search", "TWO", "chalk").out == "two/chalk\tchalk\n"
    assert main("search", "nowhere").out == ""
    lab = ",".join(f"{x:.4f}" for x in next(e for e in library.entries(folder)).lab)
    first, second = main("search", "--near", lab, "--count", "2").out.splitlines()
    assert first == "colorchecker/01-dark-skin\tColorChecker 01 Dark skin\t0.00"
    assert float(second.split("\t")[2]) > 0
    assert len(main("search", "--near", "#735244").out.splitlines()) == 10
    for words in (
        ["search"],
        ["search", "x", "--near", "#000000"],
        ["search", "--near", "red"],
        ["search", "--near", "1,2"],
        ["search", "--near", "50,nan,0"],
        ["search", "--near", "#000000", "--count", "0"],
    ):
        result = main(*words)
        assert result.status == 2
        assert result.sentence.startswith("rough_spectra search: ")
    (folder / "bad.json").write_text("{", encoding="utf-8")
    assert "bad.json" in main("search", "chalk").err


def test_search_verb_takes_a_palette_and_compares_in_other_lights(main, folder, tmp_path):
    entry = library.entries(folder)[0]
    exact = ",".join(map(repr, entry.lab))
    own = tmp_path / "own.csv"
    own.write_text(f"name,L,a,b\nmine,{exact}\nother,50,0,0\n", encoding="utf-8")
    rows = main("search", "--palette", own, "--count", 2).out.splitlines()
    assert [row.split("\t")[0] for row in rows] == ["mine", "mine", "other", "other"]
    assert rows[0] == f"mine\t{entry.id}\t{entry.name}\t0.00"
    (row,) = main("search", "--palette", own, "--row", "mine", "--count", 1).out.splitlines()
    assert row == rows[0]
    # Of another observer everything has another color.
    (row,) = main("search", "--near", exact, "--observer", 10, "--count", 1).out.splitlines()
    assert float(row.split("\t")[2]) > 0.1
    first, second = main(
        *("search", "--like", entry.id, "--lights", "A", "F11", "--count", 2)
    ).out.splitlines()
    assert first.split("\t")[2:] == ["0.00", "0.00", "0.00"]
    one, other = library.load(entry.id, folder), library.load(second.split("\t")[0], folder)
    expected = [f"{light.index:.2f}" for light in api.metamerism(one, other, ["A", "F11"])[1:]]
    assert second.split("\t")[3:] == expected
    for words, said in (
        (["--palette", own, "--lights", "A"], "compare spectra, and 'mine' has none"),
        (["--like", entry.id, "--lights", "B"], "'B'"),
        (["--near", "1,2,3", "--illuminant", "B"], "'B' is not known"),
        (["x", "--row", "mine"], "--palette FILE"),
    ):
        result = main("search", *words)
        assert result.status == 2
        assert said in result.sentence


def test_mapping_and_assign_take_library_ids(main, folder, two, tmp_path):
    assert main("import", two).status == 0
    for name in ("Wall", "Floor"):
        rgb_material(name)
    blend = tmp_path / "plain.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    mapping = tmp_path / "mapping.csv"
    mapping.write_text("material,sample\nWall,two/chalk\nFloor,green\n", encoding="utf-8")
    assert main("assign", "--blend", blend, "--mapping", mapping).status == 0
    assert bpy.data.materials["Wall"].rough_spectra.sample_name == "chalk"
    assert bpy.data.materials["Floor"].rough_spectra.sample_name == "ColorChecker 14 Green"
    assert main("assign", "--preset", "two/plaster", "--material", "Floor").status == 0
    mapping.write_text("material,sample\nWall,two/none\n", encoding="utf-8")
    result = main("assign", "--blend", blend, "--mapping", mapping)
    assert result.status == 2
    assert "row 1" in result.sentence
    assert "nor has the library" in result.sentence


def test_library_of_an_installed_extension_is_outside_of_it(blender):
    found = blender("""
        extension = load_extension()
        extension.register()
        from rough_spectra.addon.material import preferences
        clone = str(preferences.user_folder())
        preferences.PACKAGE = "bl_ext.user_default.rough_spectra"
        installed = str(preferences.user_folder())
        extension.unregister()
        user = bpy.utils.resource_path("USER")
        print(json.dumps([clone, installed, bpy.utils.user_resource("EXTENSIONS"), user]))
    """)
    clone, installed, extensions, user = found
    assert clone.startswith(user)
    assert installed.startswith(f"{extensions}/.user/user_default/rough_spectra")


def test_the_list_of_a_files_samples_has_their_balls(folder, tmp_path, monkeypatch):
    from rough_spectra.addon.interface.operators import assign_file
    from rough_spectra.addon.preview import list_icons
    from rough_spectra.addon.samples import readers, swatches

    path = tmp_path / "chart.csv"
    rows = [f"{nm},{0.1 + (nm > 580) / 2},0.3,0.3,0.05" for nm in range(400, 701, 20)]
    path.write_text("nm,1,2,3,4\n" + "\n".join(rows), encoding="utf-8")
    samples = readers.read(str(path))
    list_icons.clear()
    drawn, real = [], list_icons.icon_ids
    monkeypatch.setattr(list_icons, "icon_ids", lambda found: drawn.extend(found) or real(found))
    listed = assign_file._listed(samples)
    assert [(name, label) for name, label, *_ in listed] == [(n, n) for n in "1234"]
    rgb, _ = swatches.of_samples(samples)
    assert [tuple(each.color) for each in drawn] == [tuple(color) for color in rgb.tolist()]
    assert drawn[0].color[0] > drawn[0].color[2]
    # Without a window no ball has a number, but each was made; what looks alike shares one.
    assert len(list_icons._kept) == 3
    wall = mesh_object("Wall", rgb_material("Wall"))
    assign_file._items[:] = listed
    OPS.assign_file_sample("EXEC_DEFAULT", filepath=str(path), sample="4")
    assert wall.active_material.rough_spectra.sample_name == "4"
    list_icons.clear()


def test_the_dialog_for_a_file_to_read_does_not_begin_with_the_scenes_name(tmp_path):
    from rough_spectra.addon.interface.operators import common

    asked = []
    manager = SimpleNamespace(fileselect_add=lambda operator: asked.append(operator.filepath))
    context = SimpleNamespace(window_manager=manager)
    common.open_file(SimpleNamespace(filepath=""), context)  # of a file that was never saved
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    common.open_file(SimpleNamespace(filepath=""), context)
    common.open_file(SimpleNamespace(filepath="/as/last.csv"), context)
    assert asked == ["", f"{tmp_path}{os.sep}", "/as/last.csv"]
    mesh_object("Wall", rgb_material("Wall"))
    assert "folder" in refusal(OPS.assign_file, filepath=f"{tmp_path}{os.sep}")
    operators = Path(common.__file__).parent.glob("*.py")
    own = {path.stem for path in operators if "fileselect_add" in path.read_text("utf-8")}
    assert own == {"common", "build_assets"}  # a folder


class Recorder:
    """A layout that keeps what is read in it, and whether that is red."""

    def __init__(self, page):
        vars(self).update(page=page, alert=False, alignment="")

    def row(self, **_options):
        return Recorder(self.page)

    column = split = row

    def label(self, *, text="", **_options):
        self.page.append((text, self.alert))

    def prop(self, *_words, **_options):
        pass

    template_list = template_icon = prop


def drawn_search(**found):
    """What the dialog of *Find Sample by Color* shows, as (text, whether red)."""
    from rough_spectra.addon.interface.operators import find_nearest

    page = []
    told = {"fault": "", "picture": 0, "apart": "", "palette": "", "matches": [], "index": 0}
    unset = SimpleNamespace(is_property_set=lambda _name: False)
    operator = SimpleNamespace(layout=Recorder(page), properties=unset, by="COLOR", **told)
    vars(operator).update(found)
    find_nearest.ROUGHSPECTRA_OT_find_nearest.draw(operator, None)
    return page


def test_the_search_says_in_words_whether_one_sees_the_difference():
    near, side, far = (SimpleNamespace(difference=delta) for delta in (0.3, 1.5, 2.4))
    assert ("not visible", False) in drawn_search(matches=[near, far])
    assert ("visible", False) in drawn_search(matches=[near, far], index=1)
    assert ("visible beside the sample", False) in drawn_search(matches=[side])
    assert ("visible, and no sample comes nearer", False) in drawn_search(matches=[far, far])


def test_a_palette_that_is_yet_to_be_chosen_is_no_fault():
    assert ("Give it.", False) in drawn_search(by="PALETTE", fault="Give it.")
    assert ("Bad.", True) in drawn_search(by="PALETTE", palette="/a/b.csv", fault="Bad.")
    assert ("Bad.", True) in drawn_search(by="LAB", fault="Bad.")
