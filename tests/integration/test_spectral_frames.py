# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`spectral --frames`: ranges, shards, what is done before, and a run that is ended."""

import json
import signal
import subprocess
import sys
import time

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.picture import frames
from rough_spectra.addon.support.openimageio import openimageio

from tests.integration.support import COMMAND, SECONDS, rgb_material

WORDS = ("--bands", "3", "--samples", "1", "--no-comparison")


@pytest.fixture
def blend(tmp_path):
    """A square whose color turns from red to blue over five frames, in an even light."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.mesh.primitive_plane_add(size=4)
    material = rgb_material("Turning", (0.7, 0.2, 0.1))
    node = next(n for n in material.node_tree.nodes if n.type == "BSDF_DIFFUSE")
    color = node.inputs["Color"]
    for frame, rgb in ((1, (0.7, 0.1, 0.1, 1)), (5, (0.1, 0.1, 0.7, 1))):
        color.default_value = rgb
        color.keyframe_insert("default_value", frame=frame)
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 8, 8
    scene.cycles.use_denoising = False
    scene.frame_set(2)
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def pixels(path):
    file = openimageio().ImageInput.open(str(path))
    found = file.read_image(openimageio().FLOAT)
    file.close()
    return found


def test_frames_of_a_range_that_are_not_there(blend, tmp_path, main):
    target = tmp_path / "out" / "turn.exr"
    words = ("spectral", "--blend", blend, "-o", target, *WORDS, "--frames", "1-5x4")
    result = main(*words, "--shard", "2/2", "--json")
    assert result.status == 0, result.err
    told = json.loads(result.out.splitlines()[-1])["result"]
    assert [each["frame"] for each in told["frames"]] == [5]
    assert sorted(path.name for path in target.parent.iterdir()) == ["turn-0005.exr"]
    assert bpy.context.scene.frame_current == 2
    first = target.with_name("turn-0005.exr").read_bytes()
    result = main(*words, "--skip-done")
    assert result.status == 0, result.err
    assert "1 frame done before" in result.err
    assert "frame 1: " in result.err
    assert result.err.count("Material 'Turning': ") == 1
    names = sorted(path.name for path in target.parent.iterdir())
    assert names == ["turn-0001.exr", "turn-0005.exr"]
    assert target.with_name("turn-0005.exr").read_bytes() == first
    red, blue = (pixels(target.with_name(f"turn-000{n}.exr"))[4, 4] for n in (1, 5))
    assert red[0] > 3 * red[2]
    assert blue[2] > 3 * blue[0]
    bpy.context.scene.frame_set(5)
    alone = api.spectral_picture(bands=3, samples=1, compare=False)
    assert np.array_equal(pixels(target.with_name("turn-0005.exr"))[::-1], alone.rgb.astype("f4"))


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_run_that_is_ended_leaves_whole_files_and_goes_on(blend, tmp_path, environment, main):
    target, temporary = tmp_path / "out" / "turn.exr", tmp_path / "temporary"
    temporary.mkdir()
    words = ["spectral", "--blend", str(blend), "-o", str(target), *WORDS, "--frames", "1-4"]
    process = subprocess.Popen(
        [*COMMAND, *words],
        env=environment | {"TMPDIR": str(temporary)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    end = time.monotonic() + SECONDS
    while not target.with_name("turn-0001.exr").exists() and time.monotonic() < end:
        time.sleep(0.02)
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=SECONDS)
    assert process.returncode == 130, said
    there = sorted(path.name for path in target.parent.iterdir() if path.name[0] != ".")
    assert there == [f"turn-{n:04d}.exr" for n in range(1, len(there) + 1)]
    assert 1 <= len(there) < 4
    assert all(pixels(target.with_name(name)).shape == (8, 8, 4) for name in there)
    assert not list(temporary.iterdir())
    assert main(*words[:-1], f"1-{len(there) + 1}", "--skip-done").status == 0
    assert pixels(target.with_name(f"turn-{len(there) + 1:04d}.exr")).shape == (8, 8, 4)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--frames", "5-1"), "end before they begin"),
        (("--frames", "1-9x0"), "are no frames"),
        (("--frames", "all"), "are no frames"),
        (("--skip-done",), "are for --frames"),
    ],
)
def test_what_are_no_frames_is_refused(words, sentence, blend, tmp_path, main):
    result = main("spectral", "--blend", blend, "-o", tmp_path / "turn.exr", *WORDS, *words)
    assert result.status == 2
    assert sentence in result.err


def test_numbers_of_frames():
    assert frames.numbers("7") == [7]
    assert frames.numbers("-2-2x2, 1") == [-2, 0, 2, 1]
    assert frames.numbers("1-3,2-4") == [1, 2, 3, 4]
