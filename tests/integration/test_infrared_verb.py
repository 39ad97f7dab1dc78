# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`infrared`: from a .blend to a picture in a file."""

import json

import bpy
import numpy as np
import pytest
from rough_spectra.addon.support.openimageio import openimageio

from tests.addon.test_infrared_picture import lamp, mean, worlds_color
from tests.addon.test_spectral_picture import new_material


@pytest.fixture
def blend(tmp_path):
    """A leaf below an even sky, which is all that the camera sees."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    worlds_color((1, 1, 1))
    bpy.ops.mesh.primitive_plane_add(size=40)
    bpy.context.object.data.materials.append(new_material("Leaf", (0.05, 0.2, 0.02)))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 8, 8
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_a_leaf_below_a_sky(blend, tmp_path, main):
    before = blend.read_bytes()
    target, through = tmp_path / "near.exr", tmp_path / "filter.csv"
    through.write_text("wavelength,response\n800,1\n860,1\n", encoding="utf-8")
    words = ("infrared", "--blend", blend, "-o", target, "--samples", "1", "--json")
    words += ("--response", through, "--light", "Sky=5800K", "--false-color")
    result = main(*words, "--material", "Leaf=0.5")
    assert result.status == 0, result.err
    told = json.loads(result.out.splitlines()[-1])["result"]
    nm = np.linspace(800.0, 860.0, 6001)
    truth = lamp(nm, 5800.0)
    assert told["mean"] == pytest.approx(0.5 * mean(truth), rel=2e-3)
    assert told["assumed"] == told["dark"] == {}
    file = openimageio().ImageInput.open(str(target))
    names, pixels = file.spec().channelnames, file.read_image(openimageio().FLOAT)
    file.close()
    assert names == ("R", "G", "B", "A")
    shortest = 0.5 * mean(truth[:2001])
    assert pixels[..., 2].mean() == pytest.approx(shortest, rel=2e-3)
    assert blend.read_bytes() == before


def test_what_is_not_known_is_named_and_refused(blend, tmp_path, main):
    words = ("infrared", "--blend", blend, "-o", tmp_path / "x.exr", "--samples", "1")
    result = main(*words)
    assert result.status == 2
    assert "Nothing in the scene is known to shine at 700 to 1000 nm" in result.err
    result = main(*words, "--light", "Sky=D65")
    assert result.status == 2
    assert "CIE D65 is defined where eyes see" in result.err
