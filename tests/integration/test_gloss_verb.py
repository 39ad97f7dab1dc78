# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verb `gloss`, and what `assign` does with gloss."""

import bpy
import pytest
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.core.cycles import gloss_estimate
from rough_spectra.core.gloss import Gloss


def test_level_and_roughness_are_printed(main):
    read = gloss_estimate.readings(Gloss(level=0.5, roughness=0.3), 0.3)
    units = f"60:{read.units[60]:.2f}"
    told = main("gloss", "--sci", f"{read.sci:.4f}", "--units", units)
    assert told.status == 0
    assert "Specular IOR Level 0.500 (given), Roughness 0.30" in told.out + told.err
    odd = main("gloss", "--sci", f"{read.sci:.4f}", "--sce", "0.1", "--units", units)
    assert "no gloss of one lobe reads all of it" in odd.out + odd.err


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("--sci", "0.3"), "There is nothing to tell gloss from"),
        (("--sci", "30", "--sce", "0.3"), "--sci is 30; give 0 to 1"),
        (("--sci", "0.3", "--units", "shiny"), "'shiny' is no angle and gloss units"),
        (("--sci", "0.3", "--units", "45:30"), "45° is not known; choose one of"),
        (("--sci", "0.3", "--sce", "0.3"), "These readings have no gloss"),
    ],
)
def test_what_cannot_be_used_is_said(main, words, reason):
    told = main("gloss", *words)
    assert told.status == 2
    assert reason in told.err


@pytest.mark.parametrize(("gloss", "level"), [("keep", 0.5), ("none", 0.0)])
def test_assign_keeps_gloss_or_removes_it(main, tmp_path, make_glossy, gloss, level):
    make_glossy("Wall")
    path = str(tmp_path / "scene.blend")
    words = ("--preset", "brick", "--material", "Wall", "--gloss", gloss, "--output", path)
    assert main("assign", *words).status == 0
    bpy.ops.wm.open_mainfile(filepath=path)
    node = shader_nodes.shader_node(bpy.data.materials["Wall"])
    assert node.inputs["Specular IOR Level"].default_value == level


@pytest.fixture
def make_glossy():
    def make(name):
        material = bpy.data.materials.new(name)
        if material.node_tree is None:
            material.use_nodes = True
        material.use_fake_user = True
        return material

    return make
