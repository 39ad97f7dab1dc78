# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gloss as one slider: what it sets, what it leaves, and that the color follows."""

import math

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive, state
from rough_spectra.core.cycles import gloss_reading, instrument_lobe
from rough_spectra.core.gloss import Gloss

DIFFUSE, PRINCIPLED = "ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled"


@pytest.fixture
def material(make_material, colorchecker):
    """The chart's green over a Principled BSDF as an artist set it."""
    material = make_material(node=PRINCIPLED, Specular_IOR_Level=0.8, Roughness=0.4)
    derive.assign([(material, solve.Request(colorchecker[13], 0.4))])
    return material


def sockets(material):
    node = shader_nodes.shader_node(material)
    names = ("Specular IOR Level", "Roughness", "Coat Weight", "IOR")
    return [round(node.inputs[name].default_value, 6) for name in names]


def test_the_slider_shows_what_the_sockets_hold(material):
    group = material.rough_spectra
    assert group.gloss == pytest.approx(0.6)
    node = shader_nodes.shader_node(material)
    node.inputs["Roughness"].default_value = 0.7
    assert group.gloss == pytest.approx(0.3)
    node.inputs["Specular IOR Level"].default_value = 0.0
    assert group.gloss == 0


def test_one_step_makes_it_shinier_and_leaves_what_the_artist_set(material):
    material.rough_spectra.gloss = 0.75
    assert sockets(material) == [0.8, 0.25, 0.0, 1.5]
    assert state.state(material).kind == "fresh"


def test_dragged_to_nothing_and_back_it_is_what_it_was(material):
    group, before = material.rough_spectra, sockets(material)
    group.gloss = 0.0
    assert (group.gloss, sockets(material)[0]) == (0, 0)
    assert state.state(material).kind == "fresh"
    group.gloss = 0.6
    assert sockets(material) == pytest.approx(before)


def test_the_color_below_follows_so_that_the_whole_reading_stays(material, colorchecker):
    """The reading is put together anew from the sockets, by the core."""

    def read():
        surface = shader_nodes.surface(material)
        below = diffuse_reading(surface.color, surface.roughness)
        return gloss_reading.reading(below, surface.gloss, "45a:0")

    before = read()
    material.rough_spectra.gloss = 0.35
    np.testing.assert_allclose(read(), before, atol=2e-6)
    material.rough_spectra.gloss = 0.0
    assert shader_nodes.surface(material).gloss is None
    np.testing.assert_allclose(read(), before, atol=2e-6)


def diffuse_reading(color, roughness):
    return instrument_lobe.reflectance(np.array(color), roughness, "45a:0")


def test_a_diffuse_material_becomes_one_that_can_shine(make_material, colorchecker):
    material = make_material(node=DIFFUSE)
    derive.assign([(material, solve.Request(colorchecker[13], 0.4))])
    group = material.rough_spectra
    group.gloss = 0.0
    assert shader_nodes.shader_node(material).bl_idname == DIFFUSE
    group.gloss = 0.3
    assert shader_nodes.shader_node(material).bl_idname == PRINCIPLED
    assert sockets(material)[:2] == [0.5, 0.7]
    assert shader_nodes.surface(material).gloss == Gloss(roughness=pytest.approx(0.7))
    assert state.state(material).kind == "fresh"


def test_what_was_edited_by_hand_is_not_derived_again(material):
    node = shader_nodes.shader_node(material)
    node.inputs["Base Color"].default_value = (0.3, 0.1, 0.1, 1)
    material.rough_spectra.gloss = 0.2
    assert node.inputs["Base Color"].default_value[0] == pytest.approx(0.3)
    assert sockets(material)[1] == pytest.approx(0.8)
    assert state.state(material).kind == "stale"


def test_a_surface_of_other_nodes_is_left_alone(make_material):
    material = make_material(node="ShaderNodeEmission")
    material.rough_spectra.gloss = 0.5
    assert material.rough_spectra.gloss == 0
    assert [node.bl_idname for node in material.node_tree.nodes][1] == "ShaderNodeEmission"


def test_it_cannot_be_animated():
    """The sockets can: what is animated twice would be set twice."""
    known = bpy.data.materials.new("Any").rough_spectra.bl_rna.properties["gloss"]
    assert not known.is_animatable
    assert math.isclose(known.hard_max, 1.0)


def test_a_step_is_solved_once(material, monkeypatch):
    """What the slider sets is heard as a change of the nodes, too: there is nothing left to do."""
    calls, real = [], solve.solve
    monkeypatch.setattr(solve, "solve", lambda *given: calls.append(given) or real(*given))
    thing = bpy.data.objects.new("Wall", bpy.data.meshes.new("Wall"))
    bpy.context.collection.objects.link(thing)
    thing.data.materials.append(material)
    bpy.context.view_layer.update()
    calls.clear()
    material.rough_spectra.gloss = 0.25
    bpy.context.view_layer.update()
    assert len(calls) == 1
