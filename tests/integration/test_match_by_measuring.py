# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A color found by measuring, for what no formula tells; the truth is a measurement apart."""

import re

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import colors, working_space
from rough_spectra.addon.instrument.adjustment import Adjustment, told
from rough_spectra.addon.instrument.measure import measure
from rough_spectra.addon.matching import color_search
from rough_spectra.addon.material import last_measurement, state, storage
from rough_spectra.core.color import color_difference
from rough_spectra.core.errors import MaterialError

from tests.integration.support import rgb_material

OPS = bpy.ops.rough_spectra
SAMPLE = "everyday/terracotta"


@pytest.fixture
def card():
    """An active object that shows a material."""
    mesh = bpy.data.meshes.new("Card")
    thing = bpy.data.objects.new("Card", mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing

    def show(material):
        mesh.materials.clear()
        mesh.materials.append(material)
        return material

    return show


def mixed(share=0.2):
    """Diffuse and Glossy BSDF mixed."""
    material = rgb_material("Mixed", (0.1, 0.2, 0.3))
    nodes, links = material.node_tree.nodes, material.node_tree.links
    diffuse, output = nodes["Diffuse BSDF"], nodes["Material Output"]
    glossy, mix = nodes.new("ShaderNodeBsdfGlossy"), nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = share
    links.new(diffuse.outputs[0], mix.inputs[1])
    links.new(glossy.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output.inputs["Surface"])
    return material


def grouped():
    """A group with a color for input, whose channels mix on the way to a Diffuse BSDF."""
    tree = bpy.data.node_groups.new("Paint", "ShaderNodeTree")
    tree.interface.new_socket("Pigment", in_out="INPUT", socket_type="NodeSocketColor")
    tree.interface.new_socket("BSDF", in_out="OUTPUT", socket_type="NodeSocketShader")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    turn, diffuse = (
        tree.nodes.new("ShaderNodeHueSaturation"),
        tree.nodes.new("ShaderNodeBsdfDiffuse"),
    )
    turn.inputs["Saturation"].default_value = 0.8
    tree.links.new(start.outputs[0], turn.inputs["Color"])
    tree.links.new(turn.outputs[0], diffuse.inputs["Color"])
    tree.links.new(diffuse.outputs[0], end.inputs[0])
    material = rgb_material("Grouped")
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.remove(nodes["Diffuse BSDF"])
    group = nodes.new("ShaderNodeGroup")
    group.node_tree = tree
    links.new(group.outputs[0], nodes["Material Output"].inputs["Surface"])
    return material


def difference(material, adjusted):
    """ΔE00 of what the virtual instrument reads now."""
    space = working_space.current()
    read = measure([material])[0, 0, 0]
    wanted = space.to_lab(adjusted.target, "D65")
    return float(color_difference.delta_e(space.to_lab(read, "D65"), wanted))


@pytest.mark.parametrize(("make", "name"), [(mixed, "terracotta"), (grouped, "light skin")])
def test_what_is_measured_afterwards_is_the_sample(make, name):
    material, sample = make(), api.find(name)
    adjusted = api.match_by_measuring(material, sample)
    assert adjusted.is_met
    assert adjusted.measurements <= 5
    assert difference(material, adjusted) <= 0.1
    assert adjusted.delta_e == pytest.approx(difference(material, adjusted), abs=1e-3)
    assert storage.load(material).sample.name == sample.name
    found = state.state(material)
    assert found.kind == "kept"
    assert "found by measuring" in found.reasons[0]
    assert last_measurement.get(material).current


def test_the_operator_takes_the_stored_sample_and_undoes_nothing_else(card):
    material = card(rgb_material("Wall"))
    OPS.choose_sample("EXEC_DEFAULT", sample=SAMPLE)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    sheen = nodes.new("ShaderNodeBsdfPrincipled")
    sheen.inputs["Sheen Weight"].default_value = 0.3
    links.new(sheen.outputs[0], nodes["Material Output"].inputs["Surface"])
    before = list(nodes["Diffuse BSDF"].inputs["Color"].default_value)
    assert OPS.match_by_measuring("EXEC_DEFAULT") == {"FINISHED"}
    assert list(nodes["Diffuse BSDF"].inputs["Color"].default_value) == before
    assert sheen.inputs["Sheen Weight"].default_value == pytest.approx(0.3)
    assert last_measurement.get(material).delta_e <= 0.1


def test_a_color_without_a_say_changes_nothing(card):
    material = card(mixed(0.0))
    before = last_measurement.fingerprint(material)
    with pytest.raises(MaterialError, match=r"does not change what is read, and nothing was"):
        api.match_by_measuring(material, api.find(SAMPLE), color="Glossy BSDF: Color")
    assert last_measurement.fingerprint(material) == before
    assert not material.rough_spectra.spectrum


def test_a_material_that_was_changed_meanwhile_is_left_alone():
    material = rgb_material("Wall")
    request = api.request(api.find(SAMPLE))
    adjustment = Adjustment(material, request, colors.find(material))
    try:
        material.node_tree.nodes["Diffuse BSDF"].inputs["Color"].default_value = (0, 1, 0, 1)
        with pytest.raises(MaterialError, match="was changed while it was measured"):
            adjustment.wait()
    finally:
        adjustment.close()


def test_colors_are_found_from_the_output_on():
    names = [place.name for place in colors.places(mixed())]
    assert names == ["Diffuse BSDF: Color", "Glossy BSDF: Color"]
    assert [place.name for place in colors.places(grouped())] == ["Group: Pigment"]
    with pytest.raises(MaterialError, match="choose one of 'Diffuse BSDF: Color', 'Glossy"):
        colors.find(mixed(), "Paint")
    linked = rgb_material("Linked")
    tree = linked.node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs["Color"], tree.nodes["Diffuse BSDF"].inputs["Color"])
    with pytest.raises(MaterialError, match="has no color to set"):
        colors.find(linked)


MIXING = np.array([[0.8, 0.1, 0.1], [0.05, 0.9, 0.05], [0.1, 0.1, 0.8]])


@pytest.mark.parametrize(
    "reads",
    [
        lambda x: 0.05 + 0.8 * x**2,
        lambda x: 0.6 * (x @ MIXING.T) + 0.3 * (x @ MIXING.T) ** 3,
        lambda x: 1 - 0.95 * x,
        lambda x: 0.7 * np.sqrt(x),
    ],
)
def test_the_search_solves_what_it_knows_nothing_of(reads):
    def perceive(rgb):
        return color_difference.xyz_to_lab(np.maximum(rgb, 0), np.ones(3))

    searching = color_search.search(np.array([0.1, 0.2, 0.6]), np.full(3, 0.5), perceive)
    tried = next(searching)
    found = None
    while found is None:
        assert ((tried >= 0) & (tried <= 1)).all()
        try:
            tried = searching.send(reads(tried))
        except StopIteration as end:
            found = end.value
    assert found.is_met
    assert found.measurements <= 4
    np.testing.assert_allclose(reads(found.color), found.reading, atol=1e-12)
    np.testing.assert_allclose(found.reading, [0.1, 0.2, 0.6], atol=5e-4)


def test_what_cannot_be_is_told_and_comes_as_near_as_it_can():
    material = mixed(0.5)
    adjustment = Adjustment(
        material, api.request(api.find("colorchecker/16-yellow")), colors.find(material)
    )
    try:
        adjustment.wait()
        sentence, found = told(adjustment, material.name), adjustment.found
    finally:
        adjustment.close()
    assert not found.is_met
    assert found.color[2] == 0
    assert re.search(r"blue 0\.\d{3} is wanted, and 0\.\d{3} to 0\.\d{3} can be had\.$", sentence)
