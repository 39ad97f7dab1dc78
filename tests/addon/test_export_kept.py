# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of Blender's own exporters is what they do: exported, imported again, measured."""

from math import radians

import addon_utils
import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.export import kept
from rough_spectra.core.color.color_difference import delta_e

CASES = {
    "Bystander": ("diffuse", "none"),  # with the Principled BSDF that was there before
    "Matte": ("principled", "none"),
    "Glossy": ("principled", "keep"),
    "Alone": ("auto", "none"),
}


@pytest.fixture
def gltf_exporter():
    addon_utils.enable("io_scene_gltf2")
    yield
    addon_utils.disable("io_scene_gltf2")


def material(name, shader, gloss):
    made = bpy.data.materials.new(name)
    if made.node_tree is None:
        made.use_nodes = True
    if shader == "auto":
        made.node_tree.nodes.clear()
    api.assign([(made, api.request(api.find("light skin"), radians(30)))], shader, gloss)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [], [(0, 1, 2)])
    mesh.materials.append(made)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))
    return made


def test_what_is_told_of_each_exporter_is_what_blender_imports_again(tmp_path, gltf_exporter):
    made = [material(name, *how) for name, how in CASES.items()]
    for each in made:
        each.rough_spectra.tolerance = 0.05
    told = {(loss.exporter, loss.material): loss for loss in kept.losses(made)}
    assert len(told) == 2 * len(CASES)
    goals = np.array([e.predicted.lab for e in api.bake(made, measure=False).entries])
    gltf, usd = str(tmp_path / "out.gltf"), str(tmp_path / "out.usda")
    bpy.ops.export_scene.gltf(filepath=gltf, export_format="GLTF_SEPARATE")
    bpy.ops.wm.usd_export(filepath=usd)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=gltf)
    back = [bpy.data.materials[name] for name in CASES]
    for each in back:
        each.name = f"glTF {each.name}"
    bpy.ops.wm.usd_import(filepath=usd)
    back += [bpy.data.materials[name] for name in CASES]
    read = np.array([entry.measured.lab for entry in api.bake(back).entries])
    apart = delta_e(read, np.tile(goals, (2, 1)))
    pairs = [(exporter, name) for exporter in ("glTF", "USD") for name in CASES]
    for pair, measured in zip(pairs, apart, strict=True):
        assert told[pair].delta_e_instrument == pytest.approx(measured, abs=0.03), pair
    assert "makes its Diffuse BSDF white, which is ΔE00 30.2 at" in told[pairs[0]].sentence
    assert "takes 'Principled BSDF', which is not in use" in told[pairs[4]].sentence


def test_the_gltf_exporter_warns(tmp_path, gltf_exporter, capfd):
    entry = bpy.context.preferences.addons.new()
    entry.module = "rough_spectra"
    made = [material(name, *CASES[name]) for name in ("Bystander", "Matte")]
    smooth = material("Smooth", "principled", "none")
    smooth.rough_spectra.sigma = 0
    try:
        bpy.ops.export_scene.gltf(
            filepath=str(tmp_path / "out.gltf"), export_format="GLTF_SEPARATE"
        )
    finally:
        bpy.context.preferences.addons.remove(entry)
    said = [line for line in capfd.readouterr().out.splitlines() if "WARNING" in line]
    assert len(said) == len(made)
    assert "Material 'Bystander': Blender's glTF exporter makes its Diffuse BSDF white" in said[0]
    assert "Material 'Matte': Blender's glTF exporter drops its diffuse roughness" in said[1]
