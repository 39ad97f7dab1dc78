# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of scenes as people have them: what is hidden, linked or drawn, and what cannot be."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api

from tests.addon.test_spectral_picture import ROWS, from_above, new_material, strip, sun

pytestmark = pytest.mark.usefixtures("empty_file")

COLUMNS = 4


def room():
    """A red square in the light of a lamp and a dim world."""
    scene = from_above(COLUMNS)
    for column in range(COLUMNS):
        strip(column, bpy.data.materials.get("Red") or new_material("Red", (0.7, 0.2, 0.1)))
    sun(scene)
    scene.world = bpy.data.worlds.new("World")
    scene.cycles.samples = 1
    return scene


PICTURES = {
    "spectral": lambda: api.spectral_picture(bands=3),
    "verdict": api.picture_verdict,
    "lights": lambda: api.picture_lights(bands=3),
    "thermal": api.thermal_picture,
    "infrared": api.infrared_picture,
}


def rgb(**more):
    picture = api.spectral_picture(bands=3, samples=1, **more)
    return picture.rgb, picture


def test_what_is_drawn_or_hidden_in_viewports_alone_changes_no_light():
    """Stamp, lines and Grease Pencil would be taken for bands; what viewports hide, for RGB."""
    scene = room()
    clean, _ = rgb(compare=False)
    scene.render.use_stamp = True
    scene.render.use_freestyle = scene.view_layers[0].use_freestyle = True
    bpy.ops.object.grease_pencil_add(type="MONKEY", location=(2, 2, 0.5))
    pencil = bpy.context.object.name
    for thing in scene.objects:
        thing.hide_viewport = thing.type in {"MESH", "LIGHT"}
    if hasattr(scene.view_layers[0], "world_override"):
        scene.view_layers[0].world_override = scene.world
        scene.world = None
    found, picture = rgb()
    assert found == pytest.approx(clean, rel=1e-5)
    assert picture.rules[f"Object {pencil!r}"] == ("left out: Grease Pencil is no light",)
    assert picture.comparison.largest < 5


def test_linked_objects_are_as_local_ones(tmp_path):
    """By a relative path, which is another one in the copy that is rendered."""
    room()
    clean, _ = rgb(compare=False)
    warm = {thing.name: 300.0 for thing in bpy.context.scene.objects if thing.type == "MESH"}
    for name, kelvin in warm.items():
        bpy.data.objects[name]["rough_spectra_temperature"] = kelvin
    library = tmp_path / "there" / "library.blend"
    library.parent.mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(library), copy=True)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "own.blend"))
    with bpy.data.libraries.load(str(library), link=True, relative=True) as (there, wanted):
        wanted.objects, wanted.worlds = list(there.objects), list(there.worlds)
    scene = from_above(COLUMNS)
    bpy.data.objects.remove(scene.camera)
    for thing in wanted.objects:
        scene.collection.objects.link(thing)
    scene.camera = next(thing for thing in wanted.objects if thing.type == "CAMERA")
    [scene.world] = wanted.worlds
    assert scene.world.library.filepath.startswith("//")
    found, _ = rgb(compare=False)
    assert found == pytest.approx(clean, rel=1e-5)
    assert api.picture_lights(bands=3, samples=1).names == ("Sun", "World")
    thermal = api.thermal_picture(sky=300.0, samples=1)
    assert dict(thermal.temperatures) == warm
    assert thermal.kelvin == pytest.approx(np.full((ROWS, COLUMNS), 300.0), abs=0.01)

    library.unlink()
    for make in PICTURES.values():
        with pytest.raises(
            api.MaterialError, match=r"library\.blend is missing.*'Scene'.*relocate"
        ):
            make()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("scene.collection.objects.unlink(scene.camera)", "'Camera' of scene 'Scene' is in no"),
        ("scene.camera = None", "'Scene' has no camera; add one"),
        ("scene.render.resolution_percentage = 1", "'Scene' has no pixels at 1 % of 4 × 4; give"),
        (
            "scene.render.use_border, scene.render.border_max_x = True, 0.1",
            "no pixels at 100 %; dr",
        ),
        ("scene.view_layers[0].use = False", "'Scene' has no view layer"),
    ],
)
def test_a_scene_without_a_picture_is_told_before(change, words):
    """By every kind of picture, and by the same sentence."""
    exec(change, {"scene": room()})
    told = set()
    for make in PICTURES.values():
        with pytest.raises(api.MaterialError, match=words) as error:
            make()
        told.add(str(error.value))
    assert len(told) == 1


def test_a_linked_scene_is_to_be_opened(tmp_path):
    room()
    path = tmp_path / "linked.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        wanted.scenes = ["Scene"]
    with pytest.raises(api.MaterialError, match=r"linked from .*; open that file"):
        api.spectral_picture(wanted.scenes[0], bands=3)


def test_a_lamp_that_is_not_rendered_is_none():
    scene = room()
    scene.world = None
    bpy.data.objects["Sun"].hide_render = True
    with pytest.raises(api.MaterialError, match="Nothing in the scene sheds light"):
        api.picture_verdict()
    bpy.data.objects["Sun"].hide_render = False
    bpy.data.objects["Sun"].data.energy = 0
    with pytest.raises(api.MaterialError, match=r"'Scene' is black.*light what it sees"):
        api.picture_verdict(samples=2)


def test_an_image_that_is_missing_is_told():
    room()
    tree = bpy.data.materials["Red"].node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("gone", 4, 4)
    node.image.source, node.image.filepath = "FILE", str(Path(bpy.app.tempdir) / "gone.png")
    shader = next(each for each in tree.nodes if each.type == "BSDF_DIFFUSE")
    tree.links.new(node.outputs["Color"], shader.inputs["Color"])
    _, picture = rgb(compare=False)
    assert "magenta, as the file of image 'gone' is missing" in picture.rules["Material 'Red'"]


def test_a_region_makes_the_small_pictures_no_smaller():
    """A narrow one had no pixel left in them."""
    scene = room()
    scene.render.resolution_x, scene.render.resolution_y = 1000, 1000
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.5, 0.504
    assert api.picture_verdict(samples=2).comparison.mean > 0
