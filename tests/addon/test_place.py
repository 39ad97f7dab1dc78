# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A reading is the same to the last bit wherever its sample lies and whatever lies beside it."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon.instrument import arrangement, gloss
from rough_spectra.addon.instrument.measure import measure

COORDINATES = ("Generated", "UV", "Object", "Position", "In a group")
SPARE = 30
"""Even materials, so that the others lie in two rows of the picture."""


def textured(material, coordinate, number):
    """Let noise, whose digits follow its coordinates' last ones, set color, bump and glow."""
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = 7 + number
    tree.links.new(noise.outputs["Color"], shader.inputs["Color"])
    if coordinate == "Position":
        source = tree.nodes.new("ShaderNodeNewGeometry").outputs[coordinate]
    elif coordinate == "In a group":
        group = bpy.data.node_groups.get(coordinate) or bpy.data.node_groups.new(
            coordinate, "ShaderNodeTree"
        )
        if not group.nodes:
            group.interface.new_socket("At", in_out="OUTPUT", socket_type="NodeSocketVector")
            inside = group.nodes.new("ShaderNodeTexCoord").outputs["Object"]
            group.links.new(inside, group.nodes.new("NodeGroupOutput").inputs[0])
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        source = node.outputs[0]
    else:
        source = tree.nodes.new("ShaderNodeTexCoord").outputs[coordinate]
    tree.links.new(source, noise.inputs["Vector"])
    bump = tree.nodes.new("ShaderNodeBump")
    tree.links.new(noise.outputs[0], bump.inputs["Height"])
    tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    if number == 1:
        glow, both = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(noise.outputs[0], glow.inputs["Strength"])
        tree.links.new(shader.outputs[0], both.inputs[0])
        tree.links.new(glow.outputs[0], both.inputs[1])
        output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
        tree.links.new(both.outputs[0], output.inputs["Surface"])


@pytest.fixture
def materials(make_material):
    """Textured materials of each kind, glowing ones too, among even ones of many colors."""
    colors = np.random.default_rng(3).random((SPARE, 4))
    found = [make_material(f"Even {i}", Color=color) for i, color in enumerate(colors)]
    for number in (0, 1):
        for coordinate in COORDINATES:
            found.append(make_material(f"{coordinate} {number}", Roughness=0.4))
            textured(found[-1], coordinate, number)
    # Under this surface light wanders about by random numbers.
    found.append(make_material("Wax", "ShaderNodeBsdfPrincipled", Subsurface_Weight=1.0))
    return found


def test_readings_do_not_depend_on_place_or_neighbors(materials):
    together = measure(materials)
    spread = together[0, :, 1, 0]
    assert (spread[SPARE:-1] > 0.01).all()
    np.testing.assert_array_equal(spread[:SPARE], 0)
    np.testing.assert_array_equal(measure(materials[::-1])[:, ::-1], together)
    np.testing.assert_array_equal(measure(materials[1::3]), together[:, 1::3])
    for index in (3, SPARE + 2, SPARE + 5, len(materials) - 1):
        np.testing.assert_array_equal(measure([materials[index]])[:, 0], together[:, index])


def test_the_whole_square_is_measured_and_nothing_beyond_it(make_material):
    """A ramp over UV and Generated coordinates reads their mean over 0 to 1.

    Cycles misses the middle of a pixel by 1/2048 of its width, which is a quarter of the square.
    """
    ramps = []
    for coordinate in ("UV", "Generated"):
        ramps.append(make_material(coordinate))
        tree = ramps[-1].node_tree
        shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
        source = tree.nodes.new("ShaderNodeTexCoord").outputs[coordinate]
        tree.links.new(source, shader.inputs["Color"])
    mean, spread = np.moveaxis(measure(ramps)[0], 1, 0)
    np.testing.assert_allclose(mean[:, :2], 0.5, atol=1.5e-4)
    # Pixels are means over a quarter of the square: 1/8, 3/8, 5/8, 7/8.
    np.testing.assert_allclose(spread[:, :2], np.std([1, 3, 5, 7]) / 8, atol=1.5e-4)


def test_views_from_aside_and_glowing_hemispheres_read_even_materials_alike_anywhere(make_material):
    colors = np.random.default_rng(4).random((SPARE, 4))
    work = [make_material(f"Even {i}", Color=c, Roughness=0.6) for i, c in enumerate(colors)]
    shiny = {"Roughness": 0.3, "Base_Color": (0.2, 0.4, 0.1, 1)}
    work += [make_material(f"Shiny {i}", "ShaderNodeBsdfPrincipled", **shiny) for i in range(4)]
    geometries = [arrangement.of(name) for name in ("0:45a", "45as110", "di:8", "de:8")]
    geometries.append(gloss.arrangement(60))
    together = measure(work, geometries, rays=64)
    np.testing.assert_array_equal(measure(work[::-1], geometries, rays=64)[:, ::-1], together)
    np.testing.assert_array_equal(measure(work[2::5], geometries, rays=64), together[:, 2::5])
    # All pixels go through the same random numbers.
    np.testing.assert_array_equal(together[:, SPARE:], together[:, [SPARE] * 4])
