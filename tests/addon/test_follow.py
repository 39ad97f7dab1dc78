# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Color and roughness follow the settings: at once, over undo, and through an animation."""

import dataclasses
import math

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import (
    changes,
    derivation,
    derive,
    follow,
    snapshot,
    state,
    storage,
)
from rough_spectra.addon.support.openimageio import openimageio
from rough_spectra.core import cycles
from rough_spectra.core.cycles import gloss_lobe, gloss_reading


def sockets(material):
    node = shader_nodes.shader_node(material)
    return (
        *shader_nodes.color_socket(node).default_value[:3],
        shader_nodes.roughness_socket(node).default_value,
    )


def derived(request):
    """What the request gives when it is assigned."""
    [solution] = solve.solve([request], working_space.current())
    return (*solution.color, solution.roughness)


@pytest.fixture
def material(make_material, colorchecker, request_for):
    found = make_material("Wall", node="ShaderNodeBsdfPrincipled")
    derive.assign([(found, request_for(colorchecker[6], 20))])
    return found


@pytest.mark.parametrize(
    ("setting", "value"),
    [
        ("sigma", math.radians(40)),
        ("kind", "reading"),
        ("illuminant", "A"),
        ("model", "auto"),
    ],
)
def test_a_setting_is_followed_at_once(material, setting, value):
    before = sockets(material)
    setattr(material.rough_spectra, setting, value)
    assert sockets(material) != before
    assert sockets(material) == pytest.approx(derived(storage.load(material)), abs=1e-6)
    assert state.state(material).kind == "fresh"


def test_instrument_is_followed(make_material, nix, request_for):
    material = make_material()
    derive.assign([(material, request_for(next(iter(nix.values()))))])
    before = sockets(material)
    material.rough_spectra.instrument = "di:8"
    assert sockets(material) == pytest.approx(derived(storage.load(material)), abs=1e-6)
    assert sockets(material) != before


def test_another_shader_is_made_at_once(material):
    material.rough_spectra.shader = "DIFFUSE"
    assert shader_nodes.shader_node(material).bl_idname == "ShaderNodeBsdfDiffuse"
    assert state.state(material).kind == "fresh"


def test_shaders_are_changed_back_and_forth_and_undone(material):
    """Six changes leave one node more, and undo takes them back one by one."""
    window = bpy.data.window_managers[0].windows[0]

    def seen():
        wall = bpy.data.materials["Wall"]
        tree = wall.node_tree
        return (
            shader_nodes.shader_node(wall).name,
            sorted(tree.nodes.keys()),
            state.state(wall).kind,
        )

    with bpy.context.temp_override(window=window, screen=window.screen):
        bpy.ops.ed.undo_push(message="start")
        steps = [seen()]
        for shader in ("DIFFUSE", "PRINCIPLED") * 3:
            bpy.data.materials["Wall"].rough_spectra.shader = shader
            bpy.ops.ed.undo_push(message="step")
            steps.append(seen())
        assert [len(names) for _, names, _ in steps] == [2, *[3] * 6]
        assert steps[1] == steps[3] == steps[5]
        assert steps[2] == steps[4] == steps[6]
        assert {kind for _, _, kind in steps} == {"fresh"}
        for expected in reversed(steps[:-1]):
            bpy.ops.ed.undo()
            assert seen() == expected


def test_what_does_not_change_the_color_writes_nothing(material):
    before = material.rough_spectra.stamp
    material.rough_spectra.observer = "10"
    assert material.rough_spectra.stamp == before


def edit_color(material):
    shader_nodes.color_socket(shader_nodes.shader_node(material)).default_value[0] = 0.9


def edit_roughness(material):
    shader_nodes.roughness_socket(shader_nodes.shader_node(material)).default_value = 0.9


def mute(material):
    shader_nodes.shader_node(material).mute = True


def link_texture(material):
    tree = material.node_tree
    texture = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(
        texture.outputs["Color"], shader_nodes.color_socket(shader_nodes.shader_node(material))
    )


def keep_edit(material):
    edit_color(material)
    storage.keep(material)


def newer(material):
    material.rough_spectra.schema = 99


@pytest.mark.parametrize("edit", [edit_color, edit_roughness, mute, link_texture, keep_edit, newer])
def test_what_was_edited_by_hand_is_not_overwritten_unasked(material, edit):
    edit(material)
    before, written = sockets(material), material.rough_spectra.stamp
    material.rough_spectra.sigma = math.radians(45)
    assert sockets(material) == before
    assert material.rough_spectra.stamp == written
    assert state.state(material).kind in {"stale", "error"}


def test_a_material_without_spectrum_is_left_alone(make_material):
    material = make_material()
    before = sockets(material)
    material.rough_spectra.sigma = 0.5
    assert sockets(material) == before


def test_storing_writes_the_sockets_once(material, colorchecker, request_for, monkeypatch):
    count = []
    write = shader_nodes.write
    monkeypatch.setattr(shader_nodes, "write", lambda *args: count.append(1) or write(*args))
    derive.assign([(material, request_for(colorchecker[3], 45, illuminant="A", model="closure"))])
    assert len(count) == 1


def test_what_cannot_be_derived_is_told_and_mended(material, capfd):
    shader_nodes.shader_node(material).inputs["Metallic"].default_value = 0.0
    before = sockets(material)
    material.node_tree.nodes.active = shader_nodes.shader_node(material)
    shader_nodes.shader_node(material).inputs["Base Color"].keyframe_insert("default_value")
    material.rough_spectra.sigma = math.radians(45)
    told = state.state(material)
    assert told.kind == "error"
    assert "animated" in told.reasons[0]
    assert sockets(material) == before
    material.node_tree.animation_data_clear()
    material.rough_spectra.sigma = math.radians(46)
    assert state.state(material).kind == "fresh"
    assert capfd.readouterr().err == ""


def test_dragging_and_undo_go_together(material):
    window = bpy.data.window_managers[0].windows[0]
    with bpy.context.temp_override(window=window, screen=window.screen):
        bpy.ops.ed.undo_push(message="assigned")
        before = sockets(material)
        for degrees in (25, 30, 35):
            bpy.data.materials["Wall"].rough_spectra.sigma = math.radians(degrees)
        bpy.ops.ed.undo_push(message="dragged")
        after = sockets(bpy.data.materials["Wall"])
        bpy.ops.ed.undo()
        found = bpy.data.materials["Wall"]
        assert sockets(found) == before
        assert snapshot.sigma_degrees(found.rough_spectra) == 20
        assert state.state(found).kind == "fresh"
        bpy.ops.ed.redo()
        found = bpy.data.materials["Wall"]
        assert sockets(found) == after
        assert snapshot.sigma_degrees(found.rough_spectra) == 35
        assert state.state(found).kind == "fresh"


def test_loading_a_file_derives_nothing(material, tmp_path):
    with changes.paused():
        material.rough_spectra.sigma = 0.9
    material.use_fake_user = True
    before, written = sockets(material), material.rough_spectra.stamp
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    found = bpy.data.materials["Wall"]
    assert (sockets(found), found.rough_spectra.stamp) == (before, written)
    assert state.state(found).kind == "stale"


@pytest.fixture
def wall(material):
    """A wall seen and lit along its normal by a sun that makes radiance the reflectance factor."""
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(material)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.location = "ORTHO", (0, 0, 3)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.data.angle = math.pi, 0
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera, scene.render.engine = camera, "CYCLES"
    scene.cycles.samples, scene.cycles.max_bounces = 4, 0
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = 4
    scene.frame_start, scene.frame_end = 1, 3
    return material


def animate(material):
    for frame, degrees in ((1, 5.0), (3, 45.0)):
        with changes.paused():
            material.rough_spectra.sigma = math.radians(degrees)
        assert material.rough_spectra.keyframe_insert("sigma", frame=frame)


def test_renders_follow_an_animated_sigma(wall, request_for, colorchecker, tmp_path):
    animate(wall)
    render = bpy.context.scene.render
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.filepath = str(tmp_path / "frame-")
    bpy.ops.render.render(animation=True)
    oiio = openimageio()
    for frame in (1, 2, 3):
        pixels = oiio.ImageBuf(str(tmp_path / f"frame-{frame:04d}.exr")).get_pixels()
        bpy.context.scene.frame_set(frame)
        sigma = snapshot.sigma_degrees(wall.rough_spectra)
        gloss = shader_nodes.surface(wall).gloss
        wanted = dataclasses.replace(request_for(colorchecker[6], sigma), gloss=gloss)
        *color, roughness = derived(wanted)
        diffuse = cycles.reflectance(color, roughness, 0.0, 0.0, 0.0)
        expected = gloss_lobe.layer(gloss, 0.0, 0.0, 0.0).over(diffuse)
        # Four samples in single precision.
        np.testing.assert_allclose(pixels[2, 2, :3], expected, rtol=1e-4)


def test_frames_are_followed_and_in_step(wall):
    animate(wall)
    seen = []
    for frame in (1, 2, 3):
        bpy.context.scene.frame_set(frame)
        seen.append(sockets(wall))
        assert sockets(wall) == pytest.approx(derived(storage.load(wall)), abs=1e-6)
        assert state.state(wall).kind == "fresh"
    assert len(set(seen)) == 3


def test_a_driven_sigma_is_followed(wall):
    bpy.context.scene["age"] = 0.1
    curve = wall.rough_spectra.driver_add("sigma")
    curve.driver.type = "SUM"
    variable = curve.driver.variables.new()
    variable.targets[0].id_type = "SCENE"
    variable.targets[0].id = bpy.context.scene
    variable.targets[0].data_path = '["age"]'
    for age in (0.3, 0.6):
        bpy.context.scene["age"] = age
        bpy.context.scene.update_tag()
        bpy.context.view_layer.update()
        assert wall.rough_spectra.sigma == pytest.approx(age)
        assert sockets(wall) == pytest.approx(derived(storage.load(wall)), abs=1e-6)


BY_HAND = {
    "Specular IOR Level": 0.9,
    "Roughness": 0.2,
    "IOR": 1.7,
    "Specular Tint": (1.0, 0.4, 0.2, 1.0),
    "Coat Weight": 0.7,
}


def update():
    bpy.context.view_layer.update()


@pytest.mark.parametrize("name", BY_HAND)
def test_gloss_set_by_hand_is_followed_at_once(wall, name):
    """The whole reading stays the sample's, where the gloss alone does not read more."""
    update()
    heard = []
    changes.derived.subscribe(heard.append)
    before = sockets(wall)
    shader_nodes.shader_node(wall).inputs[name].default_value = BY_HAND[name]
    assert state.state(wall).reasons == ("its gloss was changed",)
    update()
    changes.derived.unsubscribe(heard.append)
    assert [done.material for done in heard] == [wall]
    assert state.state(wall).kind == "fresh"
    assert sockets(wall) != before
    assert sockets(wall) == pytest.approx(derived(storage.load(wall)), abs=1e-6)
    *color, roughness = sockets(wall)
    gloss = shader_nodes.surface(wall).gloss
    read = gloss_reading.at_instrument(gloss, "45a:0").over(
        cycles.reflectance(color, roughness, math.pi / 4, 0.0, 0.0)
    )
    target = heard[0].solved.solution.target
    least = gloss_reading.at_instrument(gloss, "45a:0").shine
    np.testing.assert_allclose(read, np.maximum(target, least), atol=1e-6)
    told = [text for text in state.state(wall).stamp.warnings if "cannot have this gloss" in text]
    assert bool(told) == bool((least > target).any())


def test_gloss_that_goes_is_followed_too(wall):
    update()
    shader_nodes.shader_node(wall).inputs["Specular IOR Level"].default_value = 0.0
    update()
    assert state.state(wall).kind == "fresh"
    assert storage.load(wall).gloss is None
    assert "gloss" not in state.state(wall).stamp.shader_reason


@pytest.mark.parametrize("edit", ["color", "kept", "older file"])
def test_below_gloss_what_was_edited_by_hand_stays(wall, edit):
    update()
    node, group = shader_nodes.shader_node(wall), wall.rough_spectra
    if edit == "color":
        node.inputs["Base Color"].default_value[0] = 0.3
    elif edit == "kept":
        storage.keep(wall)
    else:  # one that was derived before gloss was counted, with gloss put back by hand
        stamp = derivation.get_stamp(wall)._replace(gloss=None)
        group.stamp = derivation.to_text(stamp).replace(', "gloss": null', "")
        assert derivation.get_stamp(wall).gloss is None
    before = sockets(wall)
    node.inputs["Specular IOR Level"].default_value = 0.9
    update()
    assert sockets(wall) == before
    assert state.state(wall).kind == ("kept" if edit == "kept" else "stale")


def test_animation_spares_edits_by_hand_and_others(wall, make_material):
    other = make_material("Other")
    animate(wall)
    edit_color(wall)
    before = sockets(wall), sockets(other)
    bpy.context.scene.frame_set(2)
    assert (sockets(wall), sockets(other)) == before
    assert state.state(wall).kind == "stale"


def test_one_that_fails_does_not_hold_up_others(make_material, colorchecker, request_for):
    good, bad = make_material("good"), make_material("bad")
    derive.assign([(m, request_for(colorchecker[6])) for m in (good, bad)])
    with changes.paused():
        bad.rough_spectra.spectrum = "{}"
        good.rough_spectra.sigma = 0.2
    derive.follow([(bad, bad), (good, good)])
    assert state.state(good).kind == "fresh"
    assert "assign the sample again" in state.state(bad).reasons[0]


def test_nothing_runs_once_unregistered(extension):
    handlers = bpy.app.handlers
    ours = [f for f in handlers.frame_change_post if f.__module__ == follow.__name__]
    assert len(ours) == 1
    follow.unregister()
    try:
        assert ours[0] not in handlers.frame_change_post[:]
    finally:
        follow.register()
