# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Guards of the command line that nothing else would miss: scripts stay off, limits are exact."""

import json
import math

import bpy
import pytest

from tests.integration.support import rgb_material


def test_the_limit_of_a_check_is_exact(scene, main, tmp_path):
    """ΔE00 at the limit passes, and at the next number below the limit fails."""
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    shader = next(
        n for n in bpy.data.materials["Alpha"].node_tree.nodes if n.type == "BSDF_DIFFUSE"
    )
    shader.inputs["Color"].default_value[1] *= 1.02
    bpy.ops.wm.save_mainfile()
    words = ("--blend", scene, "--material", "Alpha")
    assert main("bake", *words, "--output", tmp_path / "x", "--format", "csv").status == 0
    difference = json.loads((tmp_path / "x.json").read_bytes())["largest_delta_e_00"]
    assert difference > 0.1
    assert main("check", *words, "--max-delta-e", repr(difference)).status == 0
    below = math.nextafter(difference, 0)
    assert main("check", *words, "--max-delta-e", repr(below)).status == 1


@pytest.fixture
def with_scripts(tmp_path):
    """A .blend that runs Python when it is opened with scripts on: a text, and a driver."""
    marks = tmp_path / "text ran", tmp_path / "driver ran"
    text = bpy.data.texts.new("start.py")
    text.write(f"open({str(marks[0])!r}, 'w').close()\n")
    text.use_module = True
    material = rgb_material("Wall")
    curve = material.driver_add("pass_index")
    curve.driver.type = "SCRIPTED"
    # What Blender does not take for a plain formula needs scripts to be on.
    curve.driver.expression = f"len([open({str(marks[1])!r}, 'w').close()])"
    mesh = bpy.data.meshes.new("Wall")
    mesh.materials.append(material)
    bpy.context.collection.objects.link(bpy.data.objects.new("Wall", mesh))
    path = tmp_path / "scripts.blend"
    bpy.context.preferences.filepaths.use_scripts_auto_execute = False
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    for mark in marks:
        mark.unlink(missing_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return path, marks


def test_scripts_of_a_blend_stay_off_whatever_the_preferences_say(with_scripts, main, tmp_path):
    path, marks = with_scripts
    trusting = bpy.context.preferences.filepaths
    trusting.use_scripts_auto_execute = True
    try:
        words = ("--preset", "green", "--material", "Wall", "--output", tmp_path / "new.blend")
        assert main("assign", "--blend", path, *words).status == 0
        bpy.context.evaluated_depsgraph_get().update()
        assert [mark.name for mark in marks if mark.exists()] == []
        # Opened with scripts on, as this test would be without the guard, both do run.
        bpy.ops.wm.open_mainfile(filepath=str(path), use_scripts=True)
        bpy.context.evaluated_depsgraph_get().update()
        assert all(mark.exists() for mark in marks)
    finally:
        trusting.use_scripts_auto_execute = False
