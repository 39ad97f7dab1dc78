# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`verdict`: exit statuses for a pipeline, the ladder, and the result as JSON."""

import json

import bpy

from tests.integration.support import rgb_material


def scene_file(tmp_path):
    """A colored square in an even light, which covers the picture."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(rgb_material("Plain", (0.7, 0.2, 0.1)))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 12, 8
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_status_tells_whether_rgb_is_enough(tmp_path, main):
    blend = scene_file(tmp_path)
    before = blend.read_bytes()
    words = ("verdict", "--blend", blend, "--samples", "1", "--light", "World=F11")
    result = main(*words, "--json")
    assert result.status == 1, result.err
    told = json.loads(result.out.splitlines()[-1])
    assert told["status"] == 1
    facts = told["result"]
    assert facts["enough"] is False
    assert facts["chosen"] in ("space", "passes")
    assert facts["rungs"][0]["kind"] == "rgb"
    assert facts["rungs"][0]["usual"] > 1
    assert facts["sentence"].startswith("RGB is not enough")
    result = main(*words, "--tolerance", "60")
    assert result.status == 0, result.err
    assert "RGB is enough: 95 % of the picture within ΔE00" in result.out
    assert "RGB as it is" in result.out
    assert blend.read_bytes() == before


def test_what_cannot_be_judged_is_refused(tmp_path, main):
    blend = scene_file(tmp_path)
    result = main("verdict", "--blend", blend, "--tolerance", "0")
    assert result.status == 2
    assert "give a number above 0" in result.err
