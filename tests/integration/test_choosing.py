# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Choosing a sample: what is loaded before it is needed, and what then becomes of materials."""

import math
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
from rough_spectra.addon.interface.operators import giving
from rough_spectra.addon.material import roughness_origin
from rough_spectra.addon.samples import library, preset_index

from tests.integration.support import rgb_material
from tests.integration.test_operators import mesh_object

OPS = bpy.ops.rough_spectra
BRICK, GREEN = "everyday/brick", "colorchecker/14-green"
LARGEST_STEP = 50_000  # bytes of source: some 30 ms to compile


def test_index_says_of_the_presets_what_reading_them_does():
    read = [entry for file in library.read_presets() for entry in file.entries]
    # Else: .venv/bpy-5.2/bin/python -m tools.tables.make_preset_index
    indexed = preset_index.entries()
    assert indexed is not None
    for one, other in zip(indexed, read, strict=True):
        one, other = asdict(one), asdict(other)
        for colors in ("swatch", "lab"):
            assert one.pop(colors) == pytest.approx(other.pop(colors), abs=1e-9)
        assert one == other


def test_presets_that_the_index_does_not_know_are_read(tmp_path, monkeypatch):
    known = preset_index.FILE.read_text(encoding="utf-8")
    other = tmp_path / "index.json"
    monkeypatch.setattr(preset_index, "FILE", other)
    assert preset_index.entries() is None
    for text in ("[]", "{", known.replace('"bytes": 1', '"bytes": 2', 1)):
        other.write_text(text, encoding="utf-8")
        assert preset_index.entries() is None
    other.write_text(known, encoding="utf-8")
    assert preset_index.entries()


def test_after_loading_ahead_an_assignment_brings_no_module(blender):
    found = blender("""
        extension = load_extension()
        extension.register()
        from rough_spectra.addon.interface.operators import ahead
        def ours():
            return {
                name: module.__file__ for name, module in sys.modules.items()
                if name.startswith("rough_spectra.") and module.__file__
            }
        import os
        steps, before = [], ours()
        for name in ahead.STEPS:
            importlib.import_module(f"rough_spectra.{name}")
            new = {n: os.path.getsize(f) for n, f in ours().items() if n not in before}
            steps.append([name, sum(new.values()) - new.get("rough_spectra.core.surface.data", 0)])
            before = ours()
        for work in ahead._WORK:
            work()
        before = set(sys.modules)
        mesh = bpy.data.meshes.new("Wall")
        thing = bpy.data.objects.new("Wall", mesh)
        bpy.context.collection.objects.link(thing)
        bpy.context.view_layer.objects.active = thing
        bpy.ops.rough_spectra.choose_sample("EXEC_DEFAULT", sample="everyday/brick")
        from rough_spectra.addon.preview import icons
        made = thing.active_material
        icons._make(made, [icons._Wish(made.session_uid, "sheet", 300)])
        new = [name for name in sys.modules if name not in before]
        left = [name for name in new if name.startswith(("rough_spectra.", "numpy."))]
        bpy.ops.wm.read_factory_settings(use_empty=True)
        extension.unregister()
        print(json.dumps([steps, left]))
    """)
    steps, left = found
    assert [step for step in steps if step[1] > LARGEST_STEP] == []
    assert left == []


def degrees(material):
    return round(math.degrees(material.rough_spectra.sigma), 3)


def choose(sample, **options):
    assert OPS.choose_sample("EXEC_DEFAULT", sample=sample, **options) == {"FINISHED"}


def test_a_sample_brings_its_own_roughness_until_the_user_sets_one():
    wall = rgb_material("Wall")
    mesh_object("Wall", wall)
    choose(BRICK)
    assert degrees(wall) == 20  # as presets/everyday/brick.json says
    choose(GREEN)
    assert degrees(wall) == 0
    choose("everyday/blackboard")
    own = degrees(wall)
    assert own not in (0, 12)
    wall.rough_spectra.sigma = math.radians(12)
    for sample in (BRICK, GREEN):
        choose(sample)
        assert degrees(wall) == 12
    choose(BRICK, sigma=math.radians(5))
    assert degrees(wall) == 5


def by_color(sample, **options):
    entry = next(entry for entry in preset_index.entries() if entry.id == sample)
    assert OPS.find_nearest("EXEC_DEFAULT", color=entry.swatch, **options) == {"FINISHED"}


def from_file(_sample, **options):
    path = Path(bpy.app.tempdir, "fresh.csv")
    path.write_text("nm,Fresh\n" + "\n".join(f"{nm},0.4" for nm in range(400, 701, 20)))
    assert OPS.assign_file("EXEC_DEFAULT", filepath=str(path), **options) == {"FINISHED"}


@pytest.mark.parametrize(("way", "own"), [(choose, 10), (by_color, 10), (from_file, 0)])
def test_all_ways_to_choose_mean_the_same_roughness(way, own):
    """A dialog shows what the active material has; the others have their own all the same."""
    other, wall = rgb_material("Other"), rgb_material("Wall")
    for material in (other, wall):
        mesh_object(material.name, material)
        choose(BRICK, scope="ACTIVE")
    coarse = wall.rough_spectra.sigma = math.radians(45)
    began = {} if way is choose else {"sigma": coarse, "began_sigma": coarse}
    way("everyday/nylon-green", scope="EACH", **began)
    assert (degrees(wall), degrees(other)) == (45, own)
    assert roughness_origin.told(wall).startswith("you; the sample")
    assert roughness_origin.is_guess(other) == (way is from_file)
    way("everyday/nylon-green", scope="EACH", sigma=math.radians(5))
    assert (degrees(wall), degrees(other)) == (5, 5)


def test_where_the_roughness_comes_from_is_told_at_once():
    wall = rgb_material("Wall")
    mesh_object("Wall", wall)
    operator = SimpleNamespace(properties=SimpleNamespace(is_property_set=lambda _name: False))
    from_file(None)
    assert roughness_origin.told(wall) == "a guess, as the sample states none"
    assert giving.told_roughness(operator, [(wall, None)]).endswith("smooth is a guess")
    wall.rough_spectra.sigma = math.radians(45)
    from_file(None)
    assert roughness_origin.told(wall) == "you; the sample states none"
    assert "45° stays" in giving.told_roughness(operator, [(wall, None)])
    choose(BRICK)
    assert roughness_origin.told(wall).startswith("you; the sample's own is 20° (")
    wall.rough_spectra.sigma = wall.rough_spectra.own_sigma
    assert roughness_origin.told(wall) == wall.rough_spectra.sigma_source
    assert giving.told_roughness(operator, [(wall, None)]) == ""


def test_a_material_of_which_nobody_knows_keeps_its_roughness():
    wall = rgb_material("Wall")
    mesh_object("Wall", wall)
    choose(BRICK)
    wall.rough_spectra.property_unset("own_sigma")  # as in a file of an earlier version
    choose(GREEN)
    assert degrees(wall) == 20


def test_several_objects_are_as_one_and_keep_what_is_theirs():
    first, second, other = (rgb_material(name) for name in ("First", "Second", "Other"))
    left_out = rgb_material("Left out")
    mesh_object("Away", left_out).select_set(False)
    two = mesh_object("Two", other, second)
    two.active_material_index = 1
    bare, also = mesh_object("Bare"), mesh_object("Also bare")
    mesh_object("One", first)
    choose(BRICK)
    first.rough_spectra.illuminant = "A"
    choose(GREEN, scope="EACH")
    named = "ColorChecker 14 Green"
    assert [m.rough_spectra.sample_name for m in (first, second)] == [named, named]
    assert (first.rough_spectra.illuminant, second.rough_spectra.illuminant) == ("A", "D65")
    assert not other.rough_spectra.spectrum  # of another slot
    assert not left_out.rough_spectra.spectrum
    assert bare.active_material == also.active_material == first  # that of the active object


def test_objects_without_a_material_share_a_new_one_that_is_called_as_the_sample():
    things = [mesh_object(name) for name in ("One", "Two", "Three")]
    choose(BRICK, scope="EACH")
    [material] = bpy.data.materials
    assert [thing.active_material for thing in things] == [material] * 3
    assert material.name == "Brick"
    choose(GREEN)
    assert material.name == "ColorChecker 14 Green"


def test_one_of_several_that_cannot_be_set_leaves_all_as_they_were():
    from tests.integration.support import checkered_and_glowing

    mesh_object("Bad", checkered_and_glowing("Bad"))
    bare = mesh_object("Bare")
    with pytest.raises(RuntimeError, match="'Bad'"):
        OPS.choose_sample("EXEC_DEFAULT", sample=BRICK, scope="EACH")
    assert bare.active_material is None
    assert [material.name for material in bpy.data.materials] == ["Bad"]


def test_solid_shading_shows_the_reading_unless_the_user_gave_it_a_color():
    from rough_spectra.addon.colorimetry import srgb, tristimulus
    from rough_spectra.addon.samples import presets

    wall = rgb_material("Wall")
    mesh_object("Wall", wall)
    alpha = wall.diffuse_color[3]
    choose(BRICK)
    sample = presets.load(BRICK)
    xyz = sample.values @ tristimulus.weights(sample.wavelengths)
    expected = srgb.from_xyz(tristimulus.white("D65", 2)) @ xyz
    # Blender's own matrix to Rec.709 is another in the fourth digit.
    assert tuple(wall.diffuse_color)[:3] == pytest.approx(expected.tolist(), abs=2e-3)
    assert wall.diffuse_color[3] == alpha
    choose(GREEN)
    green = tuple(wall.diffuse_color)
    assert green[1] > max(green[0], green[2])
    wall.rough_spectra.sigma = math.radians(40)  # an albedo reads darker then
    assert wall.diffuse_color[1] < green[1]
    wall.diffuse_color = (1, 0, 0, 0.5)
    choose(BRICK)
    assert tuple(wall.diffuse_color) == (1, 0, 0, 0.5)


def test_a_sample_brings_its_own_gloss_until_the_user_sets_one():
    from rough_spectra.addon.matching import own_gloss
    from rough_spectra.addon.material import storage
    from rough_spectra.addon.samples import presets

    glossy, other = "everyday/tarp-blue", "everyday/nylon-red"
    wall = mesh_object("Wall")
    choose(glossy)
    wall = wall.active_material
    expected = own_gloss.estimated(*own_gloss.readings(presets.load(glossy)))
    found = storage.shown_gloss(wall)
    assert found.numbers() == pytest.approx(expected.numbers(), abs=1e-5)
    choose(other)
    assert storage.shown_gloss(wall).roughness > found.roughness + 0.05
    choose(GREEN)  # which has none
    assert storage.shown_gloss(wall) is None
    choose(glossy)
    node = next(node for node in wall.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    node.inputs["Roughness"].default_value = 0.2
    for sample in (other, GREEN, glossy):
        choose(sample)
        assert storage.shown_gloss(wall).roughness == pytest.approx(0.2)
    node.inputs["Specular IOR Level"].default_value = 0.0
    choose(other)
    assert storage.shown_gloss(wall) is None  # the user took it away


def test_gloss_of_an_asset_is_its_samples():
    from rough_spectra.addon.blender import shader_nodes
    from rough_spectra.addon.matching import own_gloss
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive, storage
    from rough_spectra.addon.samples import presets

    sample = presets.load("everyday/tarp-blue")
    wall = shader_nodes.new_material("Wall", shines=True)
    shader_nodes.put_gloss(wall, own_gloss.of_sample(sample))
    derive.assign([(wall, Request(sample, 0.1))])
    assert not storage.is_gloss_set(wall)
    mesh_object("Wall", wall)
    choose(GREEN)
    assert storage.shown_gloss(wall) is None


def test_gloss_that_the_user_gave_a_material_before_stays():
    from rough_spectra.addon.material import storage

    wall = bpy.data.materials.new("Wall")
    wall.use_nodes = True
    node = next(node for node in wall.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    node.inputs["Coat Weight"].default_value = 0.25
    mesh_object("Wall", wall)
    before = storage.shown_gloss(wall)
    choose("everyday/tarp-blue")
    assert storage.shown_gloss(wall) == before


def test_a_sample_that_is_matte_takes_the_gloss_of_a_new_node_away_and_no_other():
    from rough_spectra.addon.material import storage

    bpy.ops.wm.read_factory_settings()
    cube = bpy.data.objects["Cube"].active_material
    assert storage.shown_gloss(cube) is not None
    choose(GREEN)  # which says nothing of its gloss
    assert storage.shown_gloss(cube) is not None
    choose(BRICK)
    assert storage.shown_gloss(cube) is None
    cube.rough_spectra.gloss = 0.3
    before = storage.shown_gloss(cube)
    choose("everyday/concrete")
    assert storage.shown_gloss(cube) == before


def test_the_list_begins_with_everyday_materials_and_ends_with_yours(tmp_path, monkeypatch):
    from rough_spectra.addon.interface.operators import choose_sample
    from rough_spectra.addon.material import preferences

    monkeypatch.setattr(preferences, "user_folder", lambda: tmp_path / "library")
    path = tmp_path / "atelier.csv"
    path.write_text("nm,Lime\n" + "\n".join(f"{nm},0.6" for nm in range(400, 701, 20)))
    OPS.import_samples("EXEC_DEFAULT", filepath=str(path), collection="atelier")
    choose_sample._fill()
    listed = [identifier.partition("/")[0] for identifier, *_ in choose_sample._items]
    assert list(dict.fromkeys(listed)) == ["everyday", "colorchecker", "atelier"]
    monkeypatch.undo()
    choose_sample._fill()


def listed():
    from rough_spectra.addon.interface.operators import choose_sample

    choose_sample._fill()
    return [(identifier, label) for identifier, label, *_ in choose_sample._items]


def test_the_list_first_offers_the_files_own_and_gives_the_very_material(empty_file):
    wall = mesh_object("Wall")
    assert " – in this file" not in listed()[0][1]
    assert dict(listed())[BRICK] == "Brick"
    choose(BRICK)
    brick = wall.active_material
    brick.rough_spectra.sigma, brick.rough_spectra.gloss = math.radians(40), 0.6
    choose(GREEN, scope="ACTIVE")
    mesh_object("Chart").data.materials.append(rgb_material("Chart"))
    for_chart = bpy.data.objects["Chart"]
    choose(BRICK)
    own = [(identifier, label) for identifier, label in listed() if "in this file" in label]
    assert own == listed()[: len(own)]
    # Blender ranks what is before its menus' arrow lower: nothing new comes before the file's own.
    assert all("▸" in label for _, label in listed()[len(own) :])
    named = {label: identifier for identifier, label in own}
    assert set(named) == {"ColorChecker 14 Green – in this file", "Chart (Brick) – in this file"}
    count = len(bpy.data.materials)
    other, more = mesh_object("Other", rgb_material("Others")), mesh_object("More")
    for_chart.select_set(False)
    wall.select_set(False)
    chart = for_chart.active_material
    before = chart.rough_spectra.stamp
    choose(named["Chart (Brick) – in this file"], scope="EACH")
    assert other.active_material == more.active_material == chart
    assert chart.rough_spectra.stamp == before
    assert len(bpy.data.materials) == count + 1  # that of rgb_material


def test_the_files_own_has_its_ball_as_it_is_now():
    from rough_spectra.addon.interface.operators import of_this_file

    wall = mesh_object("Wall")
    choose(BRICK)
    [before] = of_this_file.entries()
    wall.active_material.rough_spectra.sigma = math.radians(45)
    wall.active_material.rough_spectra.gloss = 0.5
    [after] = of_this_file.entries()
    assert (before.pictured.sigma_degrees, after.pictured.sigma_degrees) == (20, 45)
    assert before.pictured.gloss is None
    assert after.pictured.gloss.roughness == pytest.approx(0.5)
    assert after.pictured.color == before.pictured.color
    red, green, blue = after.pictured.color
    assert red > green > blue
    bpy.data.meshes.remove(wall.data)
    assert of_this_file.entries() == []  # nothing uses it any more: who deleted it knows it as gone


def test_a_material_of_the_file_that_is_gone_is_told(empty_file):
    from rough_spectra.addon.interface.operators import choose_sample

    wall = mesh_object("Wall")
    choose(BRICK)
    [own, *_] = [identifier for identifier, label in listed() if "in this file" in label]
    bpy.data.materials.remove(wall.active_material)
    with pytest.raises(RuntimeError, match="no longer in this file"):
        OPS.choose_sample("EXEC_DEFAULT", sample=own)
    choose_sample._fill()


def untouched(name):
    """A material as the button New makes it, in Blender 4.5 too."""
    made = bpy.data.materials.new(name)
    if not made.use_nodes:
        made.use_nodes = True
    return made


def test_objects_that_nobody_gave_a_material_share_one(empty_file):
    """Bare, or with what Blender itself made; of one's own, every object keeps its own."""
    plain, more = untouched("Material"), untouched("Material")
    typed, changed = untouched("Floor"), untouched("Material")
    node = next(node for node in changed.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    node.inputs["Roughness"].default_value = 0.2
    things = [mesh_object(m.name, m) for m in (plain, more, typed, changed)]
    things.append(mesh_object("Bare"))
    choose(BRICK, scope="EACH")
    [first, second, third, fourth, bare] = [thing.active_material for thing in things]
    assert first == second == bare == plain
    assert (third, fourth) == (typed, changed)
    names = [material.name for material in (first, third, fourth)]
    assert names == ["Brick", "Floor", "Material.002"]
    assert all(m.rough_spectra.sample_name == "Brick" for m in (first, third, fourth))
    assert not more.rough_spectra.spectrum


def test_the_cube_of_the_first_file_shares_its_material(empty_file):
    bpy.ops.wm.read_factory_settings()
    cube = bpy.data.objects["Cube"]
    other = mesh_object("Other", untouched("Material"))
    cube.select_set(True)
    bpy.context.view_layer.objects.active = cube
    choose(BRICK, scope="EACH")
    assert other.active_material == cube.active_material
    assert cube.active_material.name == "Brick"


def test_a_name_of_ours_follows_the_sample_and_one_of_the_users_never(empty_file):
    taken = mesh_object("Taken")
    choose(BRICK)
    wall = mesh_object("Wall")
    choose(BRICK)
    assert wall.active_material.name == "Brick.001"
    choose(GREEN)
    assert wall.active_material.name == "ColorChecker 14 Green"
    choose(BRICK)
    assert wall.active_material.name == "Brick.001"
    wall.active_material.name = "Old wall"
    choose(GREEN)
    assert wall.active_material.name == "Old wall"
    assert taken.active_material.name == "Brick"


def test_a_name_that_blender_cut_is_still_ours(empty_file, tmp_path):
    long = "Weathered " * 40
    path = tmp_path / "long.csv"
    path.write_text(f"nm,{long.strip()}\n" + "\n".join(f"{nm},0.4" for nm in range(400, 701, 20)))
    wall = mesh_object("Wall")
    OPS.assign_file("EXEC_DEFAULT", filepath=str(path))
    assert len(wall.active_material.name) < len(long)
    choose(BRICK)
    assert wall.active_material.name == "Brick"
