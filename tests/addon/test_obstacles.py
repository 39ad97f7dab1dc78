# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What keeps a color from being set is removed as its sentence says, and nothing else is."""

import bpy
import pytest
from rough_spectra.addon.blender import obstacles, shader_nodes
from rough_spectra.core.errors import MaterialError


@pytest.fixture
def material():
    found = bpy.data.materials.new("Wall")
    found.use_nodes = True
    yield found
    bpy.data.materials.remove(found)


def link(material, socket):
    tree = material.node_tree
    tree.links.new(tree.nodes.new("ShaderNodeValue").outputs[0], socket)


def key(material, socket):
    socket.keyframe_insert("default_value", frame=1)


def push_down(material, socket):
    key(material, socket)
    data = material.node_tree.animation_data
    data.nla_tracks.new().strips.new("strip", 1, data.action)
    data.action = None


def drive(material, socket):
    socket.driver_add("default_value")


def use(material, socket):
    socket.default_value = 0.5


CASES = {
    "linked": (link, "Diffuse Roughness", "UNLINK"),
    "keyed": (key, "Base Color", "CLEAR"),
    "in the NLA": (push_down, "Diffuse Roughness", "CLEAR"),
    "driven": (drive, "Base Color", "CLEAR"),
    "shiny by a node": (link, "Roughness", "UNLINK"),
    "shiny, keyed": (key, "Roughness", "CLEAR"),
    "metal": (use, "Metallic", "NEUTRAL"),
    "metal by a node": (link, "Metallic", "NEUTRAL"),
    "see-through": (use, "Alpha", "NEUTRAL"),
    "brushed": (use, "Anisotropic", "NEUTRAL"),
    "metal later": (key, "Metallic", "CLEAR"),
}


@pytest.mark.parametrize("name", CASES)
def test_what_the_sentence_names_is_removed(material, name):
    spoil, socket, kind = CASES[name]
    node = shader_nodes.shader_node(material)
    key(material, node.inputs["Subsurface Scale"])
    link(material, node.inputs["Emission Color"])
    spoil(material, node.inputs[socket])
    with pytest.raises(obstacles.SocketError) as refused:
        shader_nodes.find(material)
    assert (refused.value.kind, refused.value.socket) == (kind, socket)
    obstacles.remove(material, kind, socket)
    assert shader_nodes.find(material).node_name == node.name
    assert node.inputs["Emission Color"].is_linked
    assert obstacles.is_animated(material.node_tree, node.inputs["Subsurface Scale"])


def test_metal_that_is_animated_stays_gone(material):
    socket = shader_nodes.shader_node(material).inputs["Metallic"]
    key(material, socket)
    use(material, socket)
    obstacles.remove(material, "NEUTRAL", "Metallic")
    bpy.context.scene.frame_set(1)
    assert socket.default_value == 0
    shader_nodes.find(material)


def test_an_animation_that_others_use_is_left_alone(material):
    socket = shader_nodes.shader_node(material).inputs["Base Color"]
    key(material, socket)
    other = material.copy()
    other.node_tree.animation_data.action = material.node_tree.animation_data.action
    with pytest.raises(MaterialError, match="which others use, too"):
        obstacles.remove(material, "CLEAR", "Base Color")
    assert obstacles.is_animated(material.node_tree, socket)
    bpy.data.materials.remove(other)
    with pytest.raises(MaterialError, match="no socket 'Nonsense'"):
        obstacles.remove(material, "CLEAR", "Nonsense")
