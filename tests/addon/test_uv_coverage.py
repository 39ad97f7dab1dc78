# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A part of a texture counts by how often the UVs of the objects that show it cover it."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, texture_scale, uv_coverage

from tools.checks.textures import image

LEFT, RIGHT = (0.0, 0.0, 0.5, 1.0), (0.5, 0.0, 1.0, 1.0)
SEAM = 0.15 / 128 * 4
"""Of a half: its two seams are mixed with the other half, half a texel of 64 wide."""


def plane(material, *parts, maps=("UVMap",)):
    """An object with a face for each part of UV: left, bottom, right, top."""
    mesh = bpy.data.meshes.new("Part")
    corners = np.array([[(a, b), (c, b), (c, d), (a, d)] for a, b, c, d in parts])
    flat = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    places = np.concatenate([flat + np.array([2 * i, 0, 0]) for i in range(len(parts))])
    mesh.from_pydata(places.tolist(), [], np.arange(4 * len(parts)).reshape(-1, 4).tolist())
    for shift, name in enumerate(maps):
        uv = corners + np.array([0.5 * shift, 0])
        mesh.uv_layers.new(name=name).uv.foreach_set("vector", uv.astype(np.float32).ravel())
    mesh.materials.append(material)
    thing = bpy.data.objects.new("Part", mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


@pytest.fixture
def halves(make_material):
    """Makes materials whose image is 0.2 on the left and 0.8 on the right."""
    pixels = np.full((64, 64, 3), 0.8)
    pixels[:, :32] = 0.2
    picture = image("halves", 1.055 * pixels ** (1 / 2.4) - 0.055)

    def make(name, uv_map=""):
        material = make_material(name, node="ShaderNodeBsdfDiffuse")
        tree = material.node_tree
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = picture
        if uv_map:
            chosen = tree.nodes.new("ShaderNodeUVMap")
            chosen.uv_map = uv_map
            tree.links.new(chosen.outputs[0], texture.inputs["Vector"])
        shader = shader_nodes.shader_node(material)
        tree.links.new(texture.outputs["Color"], shader_nodes.color_socket(shader))
        return material

    return make


def test_places_are_where_the_objects_look(make_material):
    material = make_material("Wall", node="ShaderNodeBsdfDiffuse")
    assert uv_coverage.places(material, 10) is None, "no object shows it"
    plane(material, LEFT)
    twice = plane(material, (0.5, 0.0, 1.0, 2.0), maps=("UVMap", "Other"))
    twice.modifiers.new("Again", "ARRAY").count = 2
    found = uv_coverage.places(material, 30_000)
    assert list(found) == ["", "UVMap", "Other"]
    uv = found[""]
    # 0.5 on the left; on the right 1, over two tiles, and that twice.
    assert (uv[:, 0] < 0.5).mean() == pytest.approx(0.2, abs=1e-3)
    assert (uv[:, 1] > 1).mean() == pytest.approx(0.4, abs=1e-3)
    assert uv.mean(axis=0) == pytest.approx([0.2 * 0.25 + 0.8 * 0.75, 0.2 * 0.5 + 0.8], abs=1e-3)
    right = uv[:, 0] > 0.5
    assert found["Other"][right] == pytest.approx(uv[right] + np.array([0.5, 0]), abs=1e-6)
    assert not found["Other"][~right].any(), "the first object has no such map"
    # Even: no cell of a grid holds more than its share.
    counts, *_ = np.histogram2d(*uv[right].T, bins=(8, 16), range=((0.5, 1), (0, 2)))
    assert counts == pytest.approx(np.full(counts.shape, counts.mean()), rel=0.1)


def test_the_mean_is_over_what_is_shown(halves, make_material):
    """Chosen by the operator: part of an atlas, a repeated one, another map, and no object."""
    shown = {
        "atlas": (0.2 + SEAM, [LEFT], ("UVMap",), ""),
        "repeated": ((4 * 0.2 + 3 * 0.8) / 7, [(0.0, 0.0, 3.5, 1.0)], ("UVMap",), ""),
        "second": (0.8 - SEAM, [LEFT], ("UVMap", "Second"), "Second"),
    }
    for name, (_, parts, maps, uv_map) in shown.items():
        plane(halves(name, uv_map), *parts, maps=maps).select_set(True)
    plain = plane(make_material("plain", node="ShaderNodeBsdfDiffuse"), LEFT)
    plain.select_set(True)
    bpy.context.view_layer.objects.active = plain
    words = {"preset": "colorchecker/23-neutral-3-5", "scope": "SELECTED"}
    assert bpy.ops.rough_spectra.assign_preset(**words) == {"FINISHED"}
    wanted = np.array(shader_nodes.surface(plain.active_material).color)
    for name, (mean, *_) in shown.items():
        shader = shader_nodes.shader_node(bpy.data.materials[name])
        node = texture_scale.node_of(shader_nodes.color_socket(shader))
        # 8 bits a channel: 0.2 is 0.2016.
        assert np.array(texture_scale.factors(node)) * mean == pytest.approx(wanted, rel=0.01)
