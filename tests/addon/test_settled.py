# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Panel, pictures and bake hold a material to the same target, whatever happened to it."""

import json
import math

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, sockets
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.instrument import bake
from rough_spectra.addon.interface.panels.redraw import PanelMaterial
from rough_spectra.addon.matching import scene_view, solve
from rough_spectra.addon.material import (
    changes,
    derive,
    settled,
    snapshot,
    state,
    storage,
)
from rough_spectra.addon.preview import icons, theme
from rough_spectra.addon.samples import presets
from rough_spectra.addon.scene import follow_scene
from rough_spectra.core import cycles
from rough_spectra.core.numerics import direction_grid

_ROUNDING = 5e-4
"""Bake keeps four decimals of Lab and of ΔE00."""


@pytest.fixture(autouse=True)
def _cycles():
    bpy.context.scene.render.engine = "CYCLES"
    yield
    icons.clear()


@pytest.fixture
def assigned(make_material):
    """A gray at 3°, which is smooth enough for the simplest model where that is left to choose."""

    def assigned(model, preset="colorchecker/20-neutral-8"):
        material = make_material()
        request = solve.Request(presets.load(preset), math.radians(3), model)
        derive.assign([(material, request)])
        return material

    return assigned


def edit(material):
    shader_nodes.roughness_socket(shader_nodes.shader_node(material)).default_value = 0.33


def of_panel(material):
    """ΔE00 at the instrument as the panel tells it, once the pictures are made."""
    look = theme.current(bpy.context.preferences)
    shown = PanelMaterial(material.session_uid, snapshot.of(material), look, 20)
    shown.picture("swatches", 5.0)
    icons._work()
    return shown.apart()[0]


def of_bake(material):
    """The model that a bake predicts with, and its ΔE00 if Cycles renders what its formula says."""
    node = shader_nodes.shader_node(material)
    color = np.array(shader_nodes.color_socket(node).default_value[:3])
    roughness = shader_nodes.roughness_socket(node).default_value
    seen = cycles.reflectance(color, roughness, math.radians(45), 0.0, 0.0)
    [item] = bake.prepare([("", material)])
    [entry] = bake.compare([item], np.stack((seen, np.zeros(3)))[np.newaxis]).entries
    return item.request.model, bake.from_spectrum(item, entry)


def renewed_model(material):
    """The model of a new material with the same spectrum and settings."""
    fresh = bpy.data.materials.new("fresh")
    [solution] = derive.assign([(fresh, storage.load(material))])
    return solution.model


SETTINGS = {
    "sigma": math.radians(45),
    "kind": "reading",
    "instrument": "di:8",
    "illuminant": "A",
    "model": "first-order",
    "tolerance": 0.06,
}


def set_by_hand(setting):
    """Edit the node, after which no setting is followed, and change one."""

    def change(material):
        edit(material)
        # Only of a reading does the instrument matter.
        with changes.paused():
            material.rough_spectra.kind = "reading" if setting == "instrument" else "albedo"
        setattr(material.rough_spectra, setting, SETTINGS[setting])

    return change


def replace_spectrum(material):
    other = bpy.data.materials.new("other")
    derive.assign([(other, solve.Request(presets.load("colorchecker/14-green"), 0.8))])
    with changes.paused():
        material.rough_spectra.spectrum = other.rough_spectra.spectrum
        material.rough_spectra.sigma = 0.8


def keep(material):
    set_by_hand("sigma")(material)
    storage.keep(material)


def change_after_keeping(material):
    edit(material)
    storage.keep(material)
    material.rough_spectra.sigma = math.radians(45)


def fail(material):
    """Derive anew in vain, which the material notes."""
    shader_nodes.color_socket(shader_nodes.shader_node(material)).keyframe_insert(
        "default_value", frame=1
    )
    material.rough_spectra.sigma = math.radians(45)


def lose_the_stamp(material):
    material.rough_spectra.stamp = ""
    material.rough_spectra.sigma = math.radians(45)


def derive_long_ago(material):
    """An older version took another model for the same settings."""
    group = material.rough_spectra
    group.sigma = math.radians(45)
    data = json.loads(group.stamp) | {"derivation": 0}
    assert data["model"] != "first-order"
    group.stamp = json.dumps(data | {"model": "first-order"})


def animate(material):
    group = material.rough_spectra
    for frame, degrees in ((1, 3), (11, 45)):
        group.sigma = math.radians(degrees)
        group.keyframe_insert("sigma", frame=frame)
    bpy.data.meshes.new("mesh").materials.append(material)
    thing = bpy.data.objects.new("thing", bpy.data.meshes["mesh"])
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.frame_set(11)


def animate_and_edit(material):
    animate(material)
    bpy.context.scene.frame_set(1)
    edit(material)
    bpy.context.scene.frame_set(11)


def follow_a_scene(material):
    lamps = [np.linspace(0, 1, illuminant_spectra.GRID.size), np.ones(illuminant_spectra.GRID.size)]
    lights = tuple(
        scene_view.make_light(name, name, lamp / illuminant_spectra.to_xyz(lamp)[1], 0.5)
        for name, lamp in zip(("Red", "White"), lamps, strict=True)
    )
    spread = np.column_stack(direction_grid.hemisphere(8)).tolist()
    rows = tuple((*angles, light, 1 / 16) for light in (0, 1) for angles in spread)
    derive.follow_scene({material: scene_view.SceneView("Scene", lights, rows)})


def change_in_a_scene(material):
    follow_a_scene(material)
    set_by_hand("sigma")(material)


def leave_a_scene(material):
    change_in_a_scene(material)
    material.rough_spectra.use_scene = False


STATES = {
    "fresh": ("fresh", lambda _: None),
    "edited by hand": ("stale", edit),
    **{f"stale by {name}": ("stale", set_by_hand(name)) for name in SETTINGS},
    "another spectrum": ("stale", replace_spectrum),
    "kept": ("kept", keep),
    "stale after it was kept": ("stale", change_after_keeping),
    "error": ("error", fail),
    "nothing derived": ("stale", lose_the_stamp),
    "derived long ago": ("stale", derive_long_ago),
    "animated": ("fresh", animate),
    "animated and edited": ("stale", animate_and_edit),
    "in a scene": ("fresh", follow_a_scene),
    "stale in a scene": ("stale", change_in_a_scene),
    "out of the scene again": ("stale", leave_a_scene),
}


@pytest.mark.parametrize("model", ["auto", "two-bounce"])
@pytest.mark.parametrize("told", STATES)
def test_panel_and_bake_tell_the_same_number(assigned, told, model):
    material = assigned(model)
    kind, change = STATES[told]
    change(material)
    assert state.state(material).kind == kind
    taken, apart = of_bake(material)
    assert taken == renewed_model(material)
    assert of_panel(material) == pytest.approx(apart, abs=_ROUNDING)


def test_a_linked_material_too(assigned, tmp_path):
    set_by_hand("sigma")(assigned("auto"))
    bpy.data.materials["Material"].use_fake_user = True
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.engine = "CYCLES"
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = ["Material"]
    [material] = wanted.materials
    assert state.state(material).kind == "linked"
    taken, apart = of_bake(material)
    assert (taken, of_panel(material)) == ("surface", pytest.approx(apart, abs=_ROUNDING))
    assert apart > 3


def test_without_a_spectrum_there_is_no_target(make_material):
    [item] = bake.prepare([("", make_material())])
    assert item.request is None


def test_what_was_derived_is_said_only_of_what_is_shown(assigned):
    """The sentences about spectrum and target stay; those of the shader go with it."""
    material = assigned("auto", "colorchecker/19-white-9-5")
    group = material.rough_spectra
    group.kind, group.model, group.sigma = "reading", "two-bounce", math.radians(60)
    [before] = bake.prepare([("", material)])
    assert before.shader_reason
    told = [warning for warning in before.warnings if "white facets give" in warning]
    assert len(told) == 1
    edit(material)
    [after] = bake.prepare([("", material)])
    assert after.shader_reason == ""
    assert [w for w in after.warnings if not w.startswith("stale: ")] == told
    with changes.paused():
        group.sigma = math.radians(10)
    [after] = bake.prepare([("", material)])
    assert [w for w in after.warnings if not w.startswith("stale: ")] == []


def use(name):
    def change(material):
        shader_nodes.shader_node(material).inputs[name].default_value = 0.5

    return change


def link_texture(material):
    tree, node = material.node_tree, shader_nodes.shader_node(material)
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs[0], shader_nodes.color_socket(node))


def mute(material):
    shader_nodes.shader_node(material).mute = True


def link_another_shader(material):
    tree = material.node_tree
    glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
    tree.links.new(glossy.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])


def set_color(value):
    def change(material):
        shader_nodes.color_socket(shader_nodes.shader_node(material)).default_value[1] = value

    return change


OBSTACLES = {
    **{
        f"no ΔE00 is predicted with {name} in use": use(name)
        for name in sockets.OF_SHADER["PRINCIPLED"].neutral
    },
    "color or roughness comes from another node: there is no one color to compare": link_texture,
    "the shader node is muted: there is no color to compare": mute,
    "the surface comes from no Diffuse or Principled BSDF: there is no color to compare": (
        link_another_shader
    ),
    "color or roughness is no number: there is no color to compare": set_color(math.nan),
    "no ΔE00 is predicted for a color above 1": set_color(1.2),
}


@pytest.mark.parametrize("kept", [False, True])
@pytest.mark.parametrize("sentence", OBSTACLES)
def test_there_is_no_number_for_what_is_not_predicted(assigned, sentence, kept):
    """Neither in the panel nor in a bake, and a scene is not said to have been off by any."""
    material = assigned("auto")
    material.rough_spectra.shader = "PRINCIPLED"
    [before] = bake.prepare([("", material)])
    OBSTACLES[sentence](material)
    if kept:
        storage.keep(material)
    look = theme.current(bpy.context.preferences)
    shown = PanelMaterial(material.session_uid, snapshot.of(material), look, 20)
    assert str(shown.obstacle) == sentence
    shown.picture("swatches", 5.0)
    icons._work()
    assert (shown.apart(), shown.picture("swatches", 5.0)) == (None, 0)
    [item] = bake.prepare([("", material)])
    assert f"{sentence}; the predicted reading is the spectrum's alone" in item.warnings
    assert item.shader_reason == ""
    # The target is that of the spectrum, whatever else shows.
    [told, same] = (bake.compare([each], None).entries[0] for each in (item, before))
    assert told.predicted == same.predicted
    assert follow_scene._mean_now(None, material) is None


def test_several_are_named_together(assigned):
    material = assigned("auto")
    material.rough_spectra.shader = "PRINCIPLED"
    for name in ("Sheen Weight", "Metallic"):
        use(name)(material)
    found = settled.obstacle(shader_nodes.surface(material))
    assert str(found) == "no ΔE00 is predicted with Metallic, Sheen Weight in use"


@pytest.mark.parametrize("where", ["Normal", "Displacement"])
def test_bump_is_told_of_and_takes_no_number_away(assigned, where):
    material = assigned("auto")
    before = of_bake(material)
    tree, node = material.node_tree, shader_nodes.shader_node(material)
    place = node if where == "Normal" else tree.get_output_node("CYCLES")
    tree.links.new(tree.nodes.new("ShaderNodeBump").outputs[0], place.inputs[where])
    assert state.state(material).kind == "fresh"
    assert of_bake(material) == before
    assert of_panel(material) == pytest.approx(before[1], abs=_ROUNDING)
    [item] = bake.prepare([("", material)])
    assert any(warning.startswith("bump is not counted") for warning in item.warnings)
