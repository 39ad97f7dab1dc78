# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`thermal`: from a .blend to radiance and apparent temperature in a file."""

import json

import bpy
import numpy as np
import pytest
from rough_spectra.addon.picture import thermal
from rough_spectra.addon.support.openimageio import openimageio
from rough_spectra.core import emissivity

from tests.integration.support import rgb_material


@pytest.fixture
def blend(tmp_path):
    """A warm plate of foil below a sky, and nothing else."""
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=40)
    bpy.context.object.data.materials.append(rgb_material("Foil", (0.8, 0.8, 0.8)))
    bpy.context.object[thermal.PROPERTY] = 330.0
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 8, 8
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_a_plate_below_a_sky(blend, tmp_path, main):
    before = blend.read_bytes()
    target = tmp_path / "warm.exr"
    words = ("thermal", "--blend", blend, "-o", target, "--samples", "2", "--sky", "250", "--json")
    result = main(*words, "--material", "Foil=0.3")
    assert result.status == 0, result.err
    told = json.loads(result.out.splitlines()[-1])["result"]
    truth = float(
        emissivity.apparent_temperature(
            [0.3, 0.3], [8000.0, 14000.0], 330.0, thermal.BAND, background=250.0
        )
    )
    assert told["kelvin"]["mean"] == pytest.approx(truth, abs=0.05)
    assert told["assumed"] == []
    assert told["temperatures"] == {bpy.context.scene.objects[0].name: 330.0}
    file = openimageio().ImageInput.open(str(target))
    names, pixels = file.spec().channelnames, file.read_image(openimageio().FLOAT)
    file.close()
    kelvin = pixels[..., names.index("kelvin")]
    assert np.allclose(kelvin, truth, atol=0.05)
    assert blend.read_bytes() == before


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--band", "100-200"), "from 700"),
        (("--band", "wide"), "write 8000-14000"),
        (("--material", "Foil"), "write Foil=0.05"),
        (("--material", "Foil=2"), "0 to 1"),
    ],
)
def test_what_is_refused(words, sentence, blend, tmp_path, main):
    result = main("thermal", "--blend", blend, "-o", tmp_path / "x.exr", *words)
    assert result.status == 2
    assert sentence in result.err


def test_frames_of_a_plate_that_warms_up(blend, tmp_path, main):
    """Its temperature is a property with keys; what is done is left out, and the frame put back."""
    plate = bpy.context.scene.objects[0]
    for frame, kelvin in ((1, 300.0), (3, 340.0)):
        plate[thermal.PROPERTY] = kelvin
        plate.keyframe_insert(f'["{thermal.PROPERTY}"]', frame=frame)
    bpy.context.scene.frame_set(2)
    bpy.ops.wm.save_mainfile()
    target = tmp_path / "out" / "warm.exr"
    words = ("thermal", "--blend", blend, "-o", target, "--samples", "1", "--frames", "1-3x2")
    black = ("--emissivity", "1", "--json")
    first = main(*words, *black, "--shard", "1/2")
    assert first.status == 0, first.err
    result = main(*words, *black, "--skip-done")
    assert result.status == 0, result.err
    told = [json.loads(each.out.splitlines()[-1])["result"] for each in (first, result)]
    assert [found["done_before"] for found in told] == [0, 1]
    assert [each["frame"] for found in told for each in found["frames"]] == [1, 3]
    kelvin = [each["kelvin"]["mean"] for found in told for each in found["frames"]]
    assert kelvin == pytest.approx([300.0, 340.0], abs=0.05)
    assert sorted(path.name for path in target.parent.iterdir()) == [
        "warm-0001.exr",
        "warm-0003.exr",
    ]
    assert bpy.context.scene.frame_current == 2
