# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an analysis of a scene cannot read, and what it must not write."""

import math

import bpy
import pytest
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive, state
from rough_spectra.addon.samples import presets
from rough_spectra.addon.scene import analysis


def analyze():
    return analysis.analyze(bpy.context.evaluated_depsgraph_get(), bpy.context.scene)


def add_lamp(name="Bulb"):
    light = bpy.data.lights.new(name, "POINT")
    light.energy = 50
    lamp = bpy.data.objects.new(name, light)
    lamp.location = (1, 0, 2)
    bpy.context.scene.collection.objects.link(lamp)
    return lamp


def show(material, size=2.0, height=0.0):
    bpy.ops.mesh.primitive_plane_add(size=size, location=(0, 0, height))
    bpy.context.object.data.materials.append(material)
    request = solve.Request(presets.load("light skin"), math.radians(30), "closure")
    derive.assign([(material, request)])
    return material


@pytest.fixture
def plate(make_material):
    """A square under a camera; gives its material, which stores a spectrum."""
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("View", bpy.data.cameras.new("View"))
    scene.camera.location = (0.5, 0, 3)
    scene.collection.objects.link(scene.camera)
    return show(make_material("Plate"))


def test_what_only_renders_show_is_named(plate):
    add_lamp("Bulb")
    add_lamp("Lantern").hide_set(True)
    add_lamp("Gone").hide_render = True
    bpy.data.objects["Gone"].hide_set(True)
    [sentence] = analyze().warnings
    assert sentence.startswith("Hidden in the viewport only, and left out: Lantern;")


def instancer(collection):
    thing = bpy.data.objects.new(collection.name, None)
    thing.instance_type, thing.instance_collection = "COLLECTION", collection
    return thing


def in_collection(thing, collection):
    bpy.context.scene.collection.objects.unlink(thing)
    collection.objects.link(thing)


def hidden_by_itself(thing, inner, middle, outer):
    thing.hide_render = True


def hidden_by_its_collection(thing, inner, middle, outer):
    inner.hide_render = True


def hidden_by_a_collection_around(thing, inner, middle, outer):
    middle.hide_render = True


def hidden_with_the_instancer(thing, inner, middle, outer):
    outer.hide_render = True


@pytest.mark.parametrize(
    "hide",
    [
        *(hidden_by_itself, hidden_by_its_collection),
        *(hidden_by_a_collection_around, hidden_with_the_instancer),
    ],
)
def test_instances_hidden_in_renders_do_not_count(plate, make_material, hide):
    """A lamp in a collection, in an instanced one, in another instanced one."""
    lamp = add_lamp()
    inner, middle, top = (bpy.data.collections.new(name) for name in ("Inner", "Middle", "Top"))
    in_collection(lamp, inner)
    middle.children.link(inner)
    top.objects.link(instancer(middle))
    outer = instancer(top)
    bpy.context.scene.collection.objects.link(outer)
    assert plate in analyze().views
    hide(lamp, inner, middle, outer)
    assert plate not in analyze().views


def test_geometry_nodes_show_instances_of_what_is_hidden_itself(plate):
    """As renders do; without them, instances of a hidden child are hidden, too."""
    add_lamp()
    [shown] = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    bpy.ops.mesh.primitive_plane_add(size=1)
    source = bpy.context.object
    shown.hide_render, shown.parent, source.instance_type = True, source, "VERTS"
    bpy.context.view_layer.update()
    assert plate not in analyze().pixels
    shown.hide_render = False
    assert plate in analyze().pixels
    shown.hide_render, shown.parent, source.instance_type = True, None, "NONE"
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    kinds = ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeInstanceOnPoints")
    start, end, spread = (tree.nodes.new(kind) for kind in kinds)
    info = tree.nodes.new("GeometryNodeObjectInfo")
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = shown, True
    tree.links.new(start.outputs[0], spread.inputs["Points"])
    tree.links.new(info.outputs["Geometry"], spread.inputs["Instance"])
    tree.links.new(spread.outputs[0], end.inputs[0])
    source.modifiers.new("Scatter", "NODES").node_group = tree
    bpy.context.view_layer.update()
    assert plate in analyze().pixels


def test_nodes_that_cannot_be_read_are_named_wherever_they_are(plate):
    light = add_lamp("Bulb").data
    if light.node_tree is None:
        light.use_nodes = True
    tree = light.node_tree
    names = ("Mix", "Blackbody", "Math", "Wavelength", "TexNoise")
    mix, body, less, wave, noise = (tree.nodes.new(f"ShaderNode{name}") for name in names)
    mix.data_type = "RGBA"
    color, strength = (tree.nodes["Emission"].inputs[name] for name in ("Color", "Strength"))

    def told():
        return [warning.split("'")[3] for warning in analyze().warnings]

    def link(output, socket):
        tree.links.new(output, socket)

    second = next(socket for socket in mix.inputs if socket.enabled and socket.name == "B")
    link(wave.outputs[0], second)
    link(next(socket for socket in mix.outputs if socket.enabled), color)
    assert told() == ["Wavelength"]
    link(noise.outputs[0], body.inputs[0])
    link(body.outputs[0], color)
    assert told() == ["Noise Texture"]
    tree.links.remove(color.links[0])
    assert told() == []
    link(noise.outputs[0], less.inputs[0])
    link(less.outputs[0], strength)
    assert told() == ["Noise Texture"]
    link(tree.nodes.new("ShaderNodeTexImage").outputs[0], strength)
    assert told() == ["Image Texture"]


def color_of(material):
    return shader_nodes.color_socket(shader_nodes.shader_node(material)).default_value[:]


def test_edits_by_hand_are_not_overwritten_unasked(plate, make_material):
    add_lamp()
    other = show(make_material("Other"), 1, 0.2)
    shader_nodes.color_socket(shader_nodes.shader_node(plate)).default_value = (0.9, 0.1, 0.1, 1)
    before = color_of(plate)
    assert bpy.ops.rough_spectra.analyze_scene() == {"FINISHED"}
    assert color_of(plate) == before
    assert state.state(plate).kind == "stale"
    assert other.rough_spectra.use_scene
    assert not plate.rough_spectra.use_scene
    bpy.context.view_layer.objects.active = bpy.data.objects["Plane"]
    with pytest.raises(RuntimeError, match="Plate was edited by hand"):
        bpy.ops.rough_spectra.analyze_scene(scope="ACTIVE")
    assert color_of(plate) == before
    assert bpy.ops.rough_spectra.analyze_scene(overwrite_edits=True) == {"FINISHED"}
    assert state.state(plate).kind == "fresh"


def test_what_cannot_be_written_does_not_hold_up_others(plate, make_material, tmp_path):
    add_lamp()
    muted = show(make_material("Muted"), 0.5, 0.2)
    shader_nodes.shader_node(muted).mute = True
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {show(make_material("Linked"), 0.5, 0.3)})
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = ["Linked"]
    bpy.context.object.data.materials[0] = wanted.materials[0]
    before = [color_of(material) for material in (muted, wanted.materials[0])]
    assert bpy.ops.rough_spectra.analyze_scene() == {"FINISHED"}
    assert plate.rough_spectra.use_scene
    assert [color_of(material) for material in (muted, wanted.materials[0])] == before
    with pytest.raises(RuntimeError, match="make it local first"):
        bpy.ops.rough_spectra.analyze_scene(scope="ACTIVE")


def test_a_damaged_analysis_is_mended_by_analyzing_again(plate):
    add_lamp()
    plate.rough_spectra.scene_view = "{}"
    plate.rough_spectra.use_scene = True
    assert state.state(plate).reasons[0].endswith("analyze it again.")
    assert bpy.ops.rough_spectra.analyze_scene() == {"FINISHED"}
    assert state.state(plate).kind == "fresh"


def test_lights_of_one_name_are_told_apart(plate):
    add_lamp("Sky").data.color = (1, 0.5, 0.2)
    world = bpy.context.scene.world = bpy.data.worlds.new("Sky")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.1, 0.2, 1, 1)
    lights = analyze().views[plate].lights
    assert {light.name for light in lights} == {"Sky", "Sky (2)"}
