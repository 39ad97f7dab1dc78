# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`relight`: lights rendered once, kept, and put together anew without another Blender."""

import json

import bpy
import numpy as np
from rough_spectra.addon.picture import relight
from rough_spectra.addon.support.openimageio import openimageio

from tests.integration.support import rgb_material


def scene_file(tmp_path):
    """A red floor in the world's light, with a square that glows above it."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.mesh.primitive_plane_add(size=40)
    bpy.context.object.data.materials.append(rgb_material("Plain", (0.7, 0.2, 0.1)))
    bpy.ops.mesh.primitive_plane_add(size=1, location=(0, 0, 8))
    glow = rgb_material("Glow", (0, 0, 0))
    tree = glow.node_tree
    node = tree.nodes.new("ShaderNodeEmission")
    node.inputs["Strength"].default_value = 50
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(glow)
    bpy.ops.object.camera_add(location=(0, 0, 4))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 12, 8
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def pixels(path):
    file = openimageio().ImageInput.open(str(path))
    found = file.read_image(openimageio().FLOAT)
    file.close()
    return found


def test_lights_are_kept_and_mixed(tmp_path, main, monkeypatch):
    blend, kept = scene_file(tmp_path), tmp_path / "lights.npz"
    before = blend.read_bytes()
    words = ("relight", "--blend", blend, "--kept", kept)
    result = main(*words, "-o", tmp_path / "a.exr", "--bands", "6", "--samples", "4")
    assert result.status == 0, result.err
    assert "lights: Glow, World; wrote a.exr" in result.err
    # From here on nothing may be rendered.
    monkeypatch.setattr("rough_spectra.addon.picture.groups.Gathering.__init__", None)
    off = ("--intensity", "Glow=0"), ("--intensity", "World=0")
    for name, more in zip(("world", "glow"), off, strict=True):
        assert main(*words, "-o", tmp_path / f"{name}.exr", *more).status == 0
    whole, world, glow = (pixels(tmp_path / f"{n}.exr")[..., :3] for n in ("a", "world", "glow"))
    assert np.allclose(world + glow, whole, rtol=1e-4)
    assert glow.mean() > 0.05 * whole.mean()
    assert world.mean() > 0.05 * whole.mean()
    pair = ("--pixel", "2,2", "--pixel", "9,5", "--illuminant", "F11")
    result = main(*words, "-o", tmp_path / "b.exr", "--light", "Glow=F11", *pair, "--json")
    assert result.status == 0, result.err
    told = json.loads(result.out.splitlines()[-1])["result"]
    assert told["lights"] == ["Glow", "World"]
    desk = relight.Desk(relight.read(kept))
    assert told["delta_e_00"] == relight.metamerism(desk, (2, 2), (9, 5), ["F11"])
    assert not np.allclose(pixels(tmp_path / "b.exr"), pixels(tmp_path / "a.exr"), rtol=1e-2)
    assert blend.read_bytes() == before
    result = main(*words, "-o", tmp_path / "c.exr", "--light", "Moon=A")
    assert (result.status, (tmp_path / "c.exr").exists()) == (2, False)
    assert "there are Glow, World" in result.err
