# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verb `gloss`, and what `assign` does with gloss."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.core.cycles import gloss_estimate, gloss_reading
from rough_spectra.core.gloss import Gloss


def test_level_and_roughness_are_printed(main):
    read = gloss_estimate.readings(Gloss(level=0.5, roughness=0.3), 0.3)
    units = f"60:{read.units[60]:.2f}"
    told = main("gloss", "--sci", f"{read.sci:.4f}", "--units", units)
    assert told.status == 0
    assert "Specular IOR Level 0.500 (given), Roughness 0.30" in told.out + told.err
    odd = main("gloss", "--sci", f"{read.sci:.4f}", "--sce", "0.1", "--units", units)
    assert "no gloss of one lobe reads all of it" in odd.out + odd.err


BANDS = "400 nm,500 nm,600 nm,700 nm"


def row(name, value, units="", cells=""):
    return f"{name},{cells}{units},{','.join([f'{value:.5f}'] * 4)}\n"


def test_samples_of_files_say_it_as_numbers_do(main, tmp_path):
    made = {"Satin": Gloss(roughness=0.35), "Polished": Gloss(roughness=0.15)}
    table = tmp_path / "tiles.csv"
    text = f"name,specular,gloss 60,{BANDS}\n"
    for name, gloss in made.items():
        read = gloss_estimate.readings(gloss, 0.3)
        text += row(name, read.sci, f"{read.units[60]:.2f}", "SCI,")
        text += row(name, read.sce, "", "SCE,")
    table.write_text(text + row("Matte", 0.2, "", ","), encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    told = main("gloss", table)
    assert told.status == 0
    lines = told.err.splitlines()
    for name, gloss in made.items():
        [line] = [line for line in lines if line.startswith(f"{name}: ")]
        assert "(found)" in line
        assert float(line.split("Roughness ")[1][:5]) == pytest.approx(gloss.roughness, abs=0.02)
        assert float(line.split("Level ")[1][:5]) == pytest.approx(0.5, abs=0.03)
    [warning] = [line for line in lines if "Matte" in line]
    assert warning.startswith("warning: Sample 'Matte': There is nothing to tell gloss from")
    [line] = main("gloss", f"{table}#Satin", "--level", "0.5").err.splitlines()
    assert line.startswith("Satin: Specular IOR Level 0.500 (given)")
    assert sorted(tmp_path.iterdir()) == before, "nothing is written"


@pytest.mark.parametrize("instrument", ["45a:0", "de:8", "45as110"])
def test_gloss_units_beside_any_reading(main, tmp_path, instrument):
    """The body below is the reading's, whatever instrument it is of."""
    gloss = Gloss(roughness=0.3)
    units = gloss_estimate.readings(gloss, 0.3, (20, 60)).units
    seen = gloss_reading.at_instrument(gloss, instrument).over(np.full(3, 0.3)).mean()
    table = tmp_path / "paint.csv"
    cells = f"{units[20]:.2f},{units[60]:.2f}"
    head = f"name,instrument,gloss 20,gloss 60,gloss 45,{BANDS}\n"
    table.write_text(head + row("Paint", seen, f"{cells},50", f"{instrument},"), encoding="utf-8")
    told = main("gloss", table)
    assert told.status == 0
    assert float(told.err.split("Roughness ")[1][:5]) == pytest.approx(0.3, abs=0.01)


def test_samples_that_say_nothing_of_gloss_are_named(main, tmp_path):
    plain = main("gloss", "14 green")
    assert plain.status == 2
    assert "14 Green" in plain.err
    assert "There is nothing to tell gloss from" in plain.err
    table = tmp_path / "paint.csv"
    table.write_text(f"name,gloss 45,{BANDS}\n" + row("Paint", 0.3, "50"), encoding="utf-8")
    assert "and not at 45°" in main("gloss", table).err
    both = main("gloss", "14 green", "--sci", "0.3", "--sce", "0.2")
    assert both.status == 2
    assert "leave --sci, --sce and --units out" in both.err
    assert "Name samples" in main("gloss", "--sce", "0.2").err
    assert "no file, and no sample either" in main("gloss", "nowhere.csv").err


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
