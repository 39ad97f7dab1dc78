# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render the laboratory's samples side by side for the manual, from the Python of the bpy module.

.venv/bpy-5.2/bin/python -m tools.manual.laboratory_picture
"""

from __future__ import annotations

import sys
from math import radians
from pathlib import Path

import bpy

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.laboratory import kinds, place

SAMPLES = (("grooves", 32), ("gaussian", 256), ("multiscale", 512), ("grains", 256))
"""Kinds and cells: few grooves, for them to be seen."""

SIGMA = radians(30)
WIDTH, HEIGHT, RAYS = 1600, 400, 128
ALBEDO = 0.6
TARGET = ROOT / "docs" / "images" / "laboratory.jpg"


def main(target: Path = TARGET) -> int:
    """Render and write the picture."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    material = bpy.data.materials.new("Facets")
    if material.node_tree is None:
        material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = (
        nodes.new(f"Shader{name}") for name in ("NodeBsdfDiffuse", "NodeOutputMaterial")
    )
    diffuse.inputs["Color"].default_value = (ALBEDO, ALBEDO * 0.93, ALBEDO * 0.82, 1)
    material.node_tree.links.new(diffuse.outputs[0], output.inputs[0])
    for number, (kind, cells) in enumerate(SAMPLES):
        sigma = None if kind == "grains" else SIGMA
        rough = kinds.make(kind, sigma, cells=cells)
        thing = place.put(rough, scene.collection, 2.0, ((number - 1.5) * 2.2, 0, 0))
        thing.data.materials.append(material)
    sun = bpy.data.lights.new("Light", "SUN")
    sun.energy, sun.angle = 3.2, radians(1)
    light = bpy.data.objects.new("Light", sun)
    light.rotation_euler = (0, radians(45), radians(150))
    scene.collection.objects.link(light)
    world = bpy.data.worlds.new("Sky")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.12, 0.12, 0.12, 1)
    scene.world = world
    lens = bpy.data.cameras.new("View")
    lens.type, lens.ortho_scale = "ORTHO", 9.0
    camera = bpy.data.objects.new("View", lens)
    camera.location, camera.rotation_euler = (0, -8, 10), (radians(38.7), 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = 88
    scene.view_settings.view_transform = "Standard"
    scene.cycles.samples, scene.cycles.max_bounces = RAYS, 64
    scene.cycles.diffuse_bounces = 64
    scene.cycles.use_denoising = False
    bpy.ops.render.render(scene=scene.name)
    bpy.data.images["Render Result"].save_render(str(target), scene=scene)
    return 0


if __name__ == "__main__":
    sys.exit(main())
