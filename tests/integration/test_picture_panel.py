# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of the Render tab: the verdict, what is to be done, and what was rendered."""

import types

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.interface.panels import cameras, lamps, pictures
from rough_spectra.addon.picture import camera_images, images, last_verdict, verdict

from tests.integration.support import rgb_material
from tests.integration.test_panels import Layout, context

OPS = bpy.ops.rough_spectra
JUDGE, RENDER = "rough_spectra.judge_picture", "rough_spectra.render_spectral"


@pytest.fixture
def room(empty_file):
    """A colored square in the light of an incandescent lamp, which covers the picture."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(rgb_material("Plain", (0.7, 0.2, 0.1)))
    light = bpy.data.lights.new("Sun", "SUN")
    light.use_temperature, light.temperature = True, 2856
    scene.collection.objects.link(bpy.data.objects.new("Sun", light))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 12, 8
    scene.cycles.use_denoising, scene.cycles.samples = False, 4
    return scene


def drawn():
    """What the panels of the tab draw, in order."""
    where = context(engine=bpy.context.scene.render.engine)
    page, shown = [], {""}
    for cls in (*pictures.classes, *lamps.classes, *cameras.classes):
        around = getattr(cls, "bl_parent_id", "")
        if getattr(cls, "bl_context", "") == "render" and around in shown:
            poll = getattr(cls, "poll", None)
            if poll is None or cls.poll(where):
                shown.add(cls.__name__)
                cls.draw(types.SimpleNamespace(layout=Layout(page)), where)
    return page


def judged(scene, *usual):
    """Let there be a verdict by which the ways are off by so much, from RGB as it is."""
    kinds = ("rgb", "space", "lights", "space and lights", "passes")
    rungs = [
        verdict.Rung(k, 1 + (k == "passes"), u, u, u, 10.0)
        for k, u in zip(kinds, usual, strict=False)
    ]
    sure = (rung for rung in rungs if rung.usual <= 0.85)
    found = verdict.Verdict(tuple(rungs), 1.0, next(sure, None), None, {}, 0.0, 1.0)
    last_verdict.put(scene, found)
    return found


def test_another_engine_has_one_sentence_and_the_remedy():
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    page = drawn()
    assert page[0] == "Spectral pictures are rendered with Cycles"
    assert page[1] == "rough_spectra.switch_to_cycles"
    assert JUDGE not in page


def test_a_verdict_stands_in_the_panel_with_what_is_to_be_done(room):
    assert drawn()[0] == JUDGE
    assert not any("RGB is" in line for line in drawn())
    assert OPS.judge_picture() == {"FINISHED"}
    found = last_verdict.of(room)
    assert not found.enough
    page = " ".join(drawn())
    assert found.sentence in page
    assert room.rough_spectra.tolerance == found.tolerance
    other = bpy.data.scenes.new("Other")
    assert last_verdict.of(other) is None
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert last_verdict.of(bpy.context.scene) is None


@pytest.mark.parametrize(
    ("usual", "buttons"),
    [
        ((0.5, 0.5, 0.5, 0.5, 0.1), []),
        ((2.0, 0.5, 0.5, 0.5, 0.1), ["rough_spectra.use_rec2020"]),
        ((2.0, 1.5, 0.5, 0.5, 0.1), ["rough_spectra.analyze_scene: Match to the Lights"]),
        (
            (2.0, 1.5, 1.5, 0.5, 0.1),
            ["rough_spectra.use_rec2020", "rough_spectra.analyze_scene: Match to the Lights"],
        ),
        ((2.0, 1.5, 1.5, 1.5, 0.1), [f"{RENDER}: Render 2 Passes"]),
        ((4.0, 3.0, 3.0, 3.0, 2.0), [f"{RENDER}: Render 2 Passes"]),
    ],
)
def test_each_advice_has_its_button(room, usual, buttons):
    judged(room, *usual)
    page = drawn()
    assert page[1 : page.index("by")] != []
    offered = [line for line in page[1 : page.index("by")] if line.startswith("rough_spectra.")]
    assert offered == buttons


@pytest.mark.skipif(bpy.app.version < (5, 0, 0), reason="4.5 has one working space")
def test_what_was_advised_ends_a_verdict(room):
    judged(room, 2.0, 0.5)
    assert OPS.use_rec2020() == {"FINISHED"}
    assert last_verdict.of(room) is not None  # it is the space that was meant
    assert not OPS.use_rec2020.poll()
    judged(room, 2.0, 1.5, 0.5)
    bpy.ops.wm.set_working_color_space(convert_colors=True, working_space="Linear Rec.709")
    assert last_verdict.of(room) is None  # of what is not judged there is no verdict


def test_passes_of_a_verdict_are_rendered_without_changing_the_settings(room):
    room.rough_spectra.by, room.rough_spectra.renders = "RENDERS", 1
    assert OPS.render_spectral(renders=2) == {"FINISHED"}
    assert len(images.last().picture.wavelengths) == 6
    assert room.rough_spectra.renders == 1
    page = drawn()
    assert "rough_spectra.show_picture: Picture" in page
    assert "rough_spectra.show_picture: ΔE00 Map" in page
    assert images.find(images.MAP).name == images.MAP
    with pytest.raises(RuntimeError, match="no such picture; render it first"):
        OPS.show_picture(which="Nothing")


@pytest.mark.parametrize(
    ("said", "progress"),
    [
        ("Remaining: 00:15.96 | Mem: 6M | Sample 144/256", "0.562 3"),
        ("Mem: 6M | Rendered 1/4 Tiles, Sample 128/256", "0.375 3"),
        ("Time:00:17.54 | Mem:5.67M, Peak:5.67M | Scene, ViewLayer | Sample 128/256", "0.5 3"),
        ("Mem: 0M | Synchronizing object | Suzanne", "0 3"),
    ],
)
def test_how_far_a_picture_is_counts_parts_of_renders(said, progress, tmp_path):
    """By what Cycles says in both versions, of samples and of tiles."""
    from rough_spectra.addon.picture import worker

    there = worker.Progress(tmp_path, 3)
    try:
        there(said, None)
        assert (tmp_path / "progress").read_text() == progress
        there._told = 0
        there._rendered()
        there("Sample 0/256", None)  # as Cycles says at the end
        assert (tmp_path / "progress").read_text() == progress
        there.step()
        assert (tmp_path / "progress").read_text() == "1 3"
    finally:
        bpy.app.handlers.render_stats.remove(there)
        bpy.app.handlers.render_complete.remove(there._rendered)


def test_cameras_for_the_infrared_have_a_panel_each(room):
    """A band, what is known, and a picture; a temperature is a click for the active object."""
    plane = next(thing for thing in room.objects if thing.type == "MESH")
    bpy.context.view_layer.objects.active = plane
    page = drawn()
    assert "rough_spectra.render_infrared" in page
    assert f"rough_spectra.set_temperature: Set Temperature of {plane.name}" in page
    assert OPS.render_infrared() == {"FINISHED"}
    held = images.find(camera_images.INFRARED)
    pixels = np.array(held.pixels[:]).reshape(8, 12, 4)
    assert pixels[..., 0] == pytest.approx(pixels[..., 2])
    gray = api.infrared_picture().gray
    assert pixels[..., 0] == pytest.approx(gray, rel=1e-4)
    room.rough_spectra.false_color = True
    OPS.render_infrared()
    shown = images.find(camera_images.INFRARED)
    assert np.ptp(np.array(shown.pixels[:]).reshape(8, 12, 4)[4, 6, :3]) > 0
    told = camera_images.told(camera_images.INFRARED)
    assert any("Material 'Plain' has no infrared data" in line for line in told)

    assert OPS.set_temperature(kelvin=310.0) == {"FINISHED"}
    assert plane["rough_spectra_temperature"] == 310.0
    room.rough_spectra.emissivity = 1.0
    room.render.engine = "BLENDER_WORKBENCH"  # which a thermal camera does not mind
    assert OPS.render_thermal() == {"FINISHED"}
    assert "310.00 K" in camera_images.told(camera_images.THERMAL)[0]
    assert images.find(camera_images.THERMAL) is not None
    page = " ".join(drawn())
    assert "rough_spectra.render_thermal" in page
    assert "rough_spectra.render_infrared" not in page
