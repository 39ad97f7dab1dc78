# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of a material: equal while nothing changed, and the file's working space."""

import math

import bpy
import pytest
from rough_spectra.addon.blender import ocio, shader_nodes, working_space
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import (
    changes,
    derivation,
    derive,
    snapshot,
    state,
    storage,
)


@pytest.fixture
def material(make_material, colorchecker):
    material = make_material(node="ShaderNodeBsdfPrincipled", Specular_IOR_Level=0.0)
    derive.assign([(material, solve.Request(colorchecker[13], 0.4))])
    return material


def socket_of(material):
    return shader_nodes.color_socket(shader_nodes.shader_node(material))


def link_to(material, socket):
    tree = material.node_tree
    tree.links.new(tree.nodes.new("ShaderNodeBump").outputs[0], socket)


CHANGES = {
    "sigma": lambda m: setattr(m.rough_spectra, "sigma", 0.5),
    "kind": lambda m: setattr(m.rough_spectra, "kind", "reading"),
    "instrument": lambda m: setattr(m.rough_spectra, "instrument", "di:8"),
    "illuminant": lambda m: setattr(m.rough_spectra, "illuminant", "A"),
    "model": lambda m: setattr(m.rough_spectra, "model", "closure"),
    "shader": lambda m: setattr(m.rough_spectra, "shader", "DIFFUSE"),
    "tolerance": lambda m: setattr(m.rough_spectra, "tolerance", 2.0),
    "spectrum": lambda m: setattr(m.rough_spectra, "spectrum", "{}"),
    "stamp": lambda m: setattr(m.rough_spectra, "stamp", "{}"),
    "error": lambda m: setattr(m.rough_spectra, "error", "odd"),
    "schema": lambda m: setattr(m.rough_spectra, "schema", 9),
    "analysis": lambda m: setattr(m.rough_spectra, "scene_view", "{}"),
    "color": lambda m: socket_of(m).default_value.__setitem__(1, 0.7),
    "no number": lambda m: socket_of(m).default_value.__setitem__(1, math.nan),
    "below zero": lambda m: socket_of(m).default_value.__setitem__(1, -1.0),
    "roughness": lambda m: setattr(
        shader_nodes.roughness_socket(shader_nodes.shader_node(m)), "default_value", 0.1
    ),
    "gloss": lambda m: setattr(
        shader_nodes.shader_node(m).inputs["Coat Weight"], "default_value", 0.1
    ),
    "bump": lambda m: link_to(m, shader_nodes.shader_node(m).inputs["Normal"]),
    "displacement": lambda m: link_to(m, m.node_tree.nodes["Material Output"].inputs[2]),
    "name": lambda m: setattr(shader_nodes.shader_node(m), "name", "Plaster"),
    "mute": lambda m: setattr(shader_nodes.shader_node(m), "mute", True),
    "link": lambda m: m.node_tree.links.clear(),
    "engine": lambda _: setattr(bpy.context.scene.render, "engine", "BLENDER_WORKBENCH"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_every_change_shows_and_nothing_else_does(material, change):
    before = snapshot.of(material)
    assert snapshot.of(material) == before
    with changes.paused():
        CHANGES[change](material)
    after = snapshot.of(material)
    assert after != before
    assert snapshot.of(material) == after
    assert hash(snapshot.of(material)) == hash(after)


def test_a_setting_that_is_no_number_is_equal_to_itself(material):
    with changes.paused():
        material.rough_spectra.sigma = material.rough_spectra.tolerance = math.nan
    assert snapshot.of(material) == snapshot.of(material)


def test_equal_facts_are_judged_once(material):
    state.state(material)
    before = state.evaluate.cache_info().misses
    state.state(material)
    assert state.evaluate.cache_info().misses == before
    socket_of(material).default_value[0] += 0.1
    state.state(material)
    assert state.evaluate.cache_info().misses == before + 1


def test_the_working_space_is_that_of_the_file(set_working_space, tmp_path):
    """Also after a switch, an undo and another file: what is looked up is the space of now."""
    for name in ("Linear Rec.2020", "ACEScg", "Linear Rec.709", "ACEScg"):
        set_working_space(name)
        assert working_space.working_space_name() == bpy.data.colorspace.working_space == name
    path = str(tmp_path / "acescg.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert (
        working_space.working_space_name() == bpy.data.colorspace.working_space == "Linear Rec.709"
    )
    bpy.ops.wm.open_mainfile(filepath=path)
    assert working_space.working_space_name() == bpy.data.colorspace.working_space == "ACEScg"


def test_a_configuration_without_the_role_is_told(tmp_path, monkeypatch):
    path = tmp_path / "config.ocio"
    for text, told in (("roles:\n", True), ("roles:\n  aces_interchange: ACES\n", False)):
        path.write_text(text)
        monkeypatch.setenv("OCIO", str(path))
        ocio.warning.cache_clear()
        assert ("no role aces_interchange" in ocio.warning()) == told
        assert (str(path) in ocio.warning()) == told
    monkeypatch.delenv("OCIO")
    ocio.warning.cache_clear()
    assert ocio.warning() == ""


def test_what_is_kept_reads_as_earlier_versions_wrote_it(material):
    """Stored texts are compared: they have to stay the same, letter by letter."""
    socket_of(material).default_value = (0.5, 0.25, 0.125, 1.0)
    shader_nodes.roughness_socket(shader_nodes.shader_node(material)).default_value = 0.0
    storage.keep(material)
    expected = "('Principled BSDF', (0.5, 0.25, 0.125, 0.0), (False, False, False), [])"
    assert derivation.get_stamp(material).kept == expected
