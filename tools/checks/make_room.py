# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Furnish a room: a scene of many objects and materials to analyze.

    .venv/bpy-5.2/bin/python -m tools.checks.make_room room.blend

Floor, ceiling and four walls, things strewn over the floor, an incandescent lamp, a lamp of warm
white, a window that lets in skylight, and a camera. The same numbers give the same room.
"""

from __future__ import annotations

import math
import random
import sys
from pathlib import Path
from typing import Any

import bpy

SIZE = 6.0
HEIGHT = 3.0


def furnish(objects: int = 200, materials: int = 40, seed: int = 1) -> list[Any]:
    """Fill the open file's scene; gives the materials, walls first."""
    chance = random.Random(seed)
    scene = bpy.context.scene
    made = [_material(f"Paint {number:02d}") for number in range(materials)]
    half = SIZE / 2
    sides = [
        ("Floor", (0, 0, 0), (0, 0, 0), SIZE),
        ("Ceiling", (0, 0, HEIGHT), (math.pi, 0, 0), SIZE),
        ("Back", (0, half, HEIGHT / 2), (math.pi / 2, 0, 0), HEIGHT),
        ("Left", (-half, 0, HEIGHT / 2), (math.pi / 2, 0, math.pi / 2), HEIGHT),
        ("Front", (0, -half, HEIGHT / 2), (-math.pi / 2, 0, 0), HEIGHT),
    ]
    for number, (name, place, turn, tall) in enumerate(sides):
        mesh = _square(name, SIZE, tall, made[number % materials])
        _put(scene, name, mesh, place, turn)
    shapes = _shapes()
    for number in range(objects - len(sides)):
        mesh = shapes[number % len(shapes)].copy()
        mesh.materials.append(made[number % materials])
        size = chance.uniform(0.08, 0.3)
        place = (chance.uniform(-2.6, 2.6), chance.uniform(-1.6, 2.7), chance.uniform(0.1, 1.9))
        thing = _put(scene, f"Thing {number:03d}", mesh, place, (0, 0, chance.uniform(0, 6)))
        thing.scale = (size, size, size * chance.uniform(0.6, 1.6))
    _lamp(scene, "Bulb", "POINT", 120, (-1.2, 0.4, 2.6), temperature=2856, shadow_soft_size=0.05)
    _lamp(scene, "Warm", "AREA", 60, (1.2, -1.0, 2.9), temperature=4000, size=0.6)
    scene.world = bpy.data.worlds.new("Window light")
    scene.world.color = (0.6, 0.8, 1.0)
    if scene.world.node_tree is None:
        scene.world.use_nodes = True
    background = next(n for n in scene.world.node_tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.6, 0.8, 1.0, 1.0)
    lens = bpy.data.cameras.new("View")
    lens.lens = 22
    camera = bpy.data.objects.new("View", lens)
    camera.location = (0, -2.9, 1.6)
    camera.rotation_euler = (math.radians(84), 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    return made


def _material(name: str) -> Any:
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output, shader = (
        tree.nodes.new(kind) for kind in ("ShaderNodeOutputMaterial", "ShaderNodeBsdfDiffuse")
    )
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def _square(name: str, wide: float, tall: float, material: Any) -> Any:
    mesh = bpy.data.meshes.new(name)
    x, y = wide / 2, (tall if tall < wide else wide) / 2
    mesh.from_pydata([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    return mesh


def _shapes() -> list[Any]:
    """Make a ball, a can and a box, smooth where they are round."""
    found = []
    for maker, settings in (
        ("uv_sphere", {"segments": 32, "ring_count": 16}),
        ("cylinder", {"vertices": 32}),
        ("cube", {}),
    ):
        getattr(bpy.ops.mesh, f"primitive_{maker}_add")(**settings)
        thing = bpy.context.object
        mesh = thing.data
        if maker != "cube":
            mesh.shade_smooth()
        bpy.data.objects.remove(thing)
        found.append(mesh)
    return found


def _put(scene: Any, name: str, data: Any, place: Any, turn: Any = (0, 0, 0)) -> Any:
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.rotation_euler = place, turn
    scene.collection.objects.link(thing)
    return thing


def _lamp(
    scene: Any, name: str, kind: str, watts: float, place: Any, temperature: float, **settings: Any
) -> None:
    light = bpy.data.lights.new(name, kind)
    light.energy, light.use_temperature, light.temperature = watts, True, temperature
    for key, value in settings.items():
        setattr(light, key, value)
    _put(scene, name, light, place)


if __name__ == "__main__":
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    furnish()
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(sys.argv[-1]).resolve()))
