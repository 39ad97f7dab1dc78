# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes such as people render, each of some seconds, to ask of each whether RGB is enough."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

Color = tuple[float, float, float]
WHITE: Color = (0.8, 0.8, 0.8)
STRONG: tuple[Color, ...] = (
    (0.7, 0.05, 0.03), (0.05, 0.4, 0.08), (0.04, 0.1, 0.6), (0.8, 0.55, 0.03), (0.5, 0.05, 0.4),
)  # fmt: skip
SOFT: tuple[Color, ...] = (
    (0.55, 0.48, 0.42), (0.42, 0.46, 0.44), (0.5, 0.5, 0.52), (0.6, 0.55, 0.45),
)  # fmt: skip


def _paint(color: Color, **sockets: float) -> Any:
    """Make a Principled BSDF of a color."""
    material = bpy.data.materials.new("Paint")
    if material.node_tree is None:
        material.use_nodes = True
    node = material.node_tree.nodes["Principled BSDF"]
    node.inputs["Base Color"].default_value = (*color, 1)
    node.inputs["Specular IOR Level"].default_value = 0.0
    for name, value in sockets.items():
        node.inputs[name.replace("_", " ")].default_value = value
    return material


def _shader(kind: str, output: str = "Surface", **sockets: Any) -> Any:
    """Make a material of one shader node."""
    material = _paint(WHITE)
    tree = material.node_tree
    node = tree.nodes.new(kind)
    for name, value in sockets.items():
        node.inputs[name.replace("_", " ")].default_value = value
    tree.nodes.remove(tree.nodes["Principled BSDF"])
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs[output])
    return material


def _image(name: str, colors: Any) -> Any:
    """Make an image of (rows, columns, 3), scene-linear."""
    rows, columns = colors.shape[:2]
    image = bpy.data.images.new(name, columns, rows, float_buffer=True)
    pixels = np.concatenate((colors, np.ones((rows, columns, 1))), axis=-1)
    image.pixels.foreach_set(pixels.astype(np.float32).ravel())
    image.pack()
    return image


def _textured(colors: Any) -> Any:
    material = _paint(WHITE)
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = _image("Pattern", colors)
    place = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(place.outputs["Generated"], node.inputs[0])
    tree.links.new(node.outputs[0], tree.nodes["Principled BSDF"].inputs["Base Color"])
    return material


def _put(data: Any, place: Color, turn: Color = (0, 0, 0), size: Any = 1.0) -> Any:
    thing = bpy.data.objects.new(data.name, data)
    thing.location, thing.rotation_euler = place, turn
    thing.scale = (size,) * 3 if isinstance(size, float) else size
    bpy.context.scene.collection.objects.link(thing)
    return thing


def _square(material: Any, place: Color, turn: Color = (0, 0, 0), size: Any = 1.0) -> None:
    mesh = bpy.data.meshes.new("Square")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    _put(mesh, place, turn, size)


def _ball(material: Any, place: Color, size: float = 0.5) -> None:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, location=place, radius=size)
    thing = bpy.context.object
    thing.data.shade_smooth()
    thing.data.materials.append(material)


def _box(material: Any, place: Color, size: Any) -> None:
    bpy.ops.mesh.primitive_cube_add(size=1, location=place)
    bpy.context.object.scale = size
    bpy.context.object.data.materials.append(material)


def _lamp(name: str, place: Color, watts: float, kelvin: float | None, size: float = 1.0) -> Any:
    light = bpy.data.lights.new(name, "AREA")
    light.energy, light.size = watts, size
    if kelvin is not None:
        light.use_temperature, light.temperature = True, kelvin
    _put(light, place)
    return light


def _world(color: Color, strength: float = 1.0) -> Any:
    world = bpy.context.scene.world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True
    node = world.node_tree.nodes["Background"]
    node.inputs["Color"].default_value = (*color, 1)
    node.inputs["Strength"].default_value = strength
    return world


def _room(walls: tuple[Color, ...], material: Callable[[Color], Any] = _paint) -> None:
    """Make floor, back, left, right, ceiling, and the wall behind the camera."""
    half, high = 2.0, 3.0
    right = math.pi / 2
    for number, (place, turn) in enumerate((
        ((0, 0, 0), (0, 0, 0)), ((0, half, high / 2), (right, 0, 0)),
        ((-half, 0, high / 2), (0, right, 0)), ((half, 0, high / 2), (0, right, 0)),
        ((0, 0, high), (0, 0, 0)), ((0, -half, high / 2), (right, 0, 0)),
    )):  # fmt: skip
        _square(material(walls[number % len(walls)]), place, turn, 2.0)
    _camera((0, -1.9, 1.5), (0, 1, 1.2), 18)


def _camera(place: Color, ahead: Color, lens: float = 35) -> None:
    from mathutils import Vector

    camera = bpy.data.cameras.new("Camera")
    camera.lens = lens
    thing = _put(camera, place)
    toward = Vector(ahead) - Vector(place)
    thing.rotation_euler = toward.to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = thing


def _table(material: Any, count: int = 4, colors: tuple[Color, ...] = STRONG) -> None:
    """Put balls on a floor, with a camera before them."""
    _square(_paint(WHITE), (0, 0, 0), size=6.0)
    for number in range(count):
        _ball(material(colors[number % len(colors)]), (1.1 * (number - (count - 1) / 2), 0, 0.5))
    _camera((0, -4.5, 2), (0, 0, 0.4))


def gray_studio() -> None:
    """Gray things in white light: nothing has a color."""
    _table(lambda c: _paint((sum(c) / 3,) * 3))
    _lamp("Lamp", (1, -1, 3), 200, 6500)
    _world((0.5, 0.5, 0.5))


def soft_interior() -> None:
    """Paint a room in muted paints, by daylight."""
    _room(SOFT)
    _box(_paint(SOFT[1]), (-0.7, 0.7, 0.5), (0.8, 0.8, 1))
    _lamp("Window", (0, 0, 2.95), 60, 6500, 1.5)


def strong_interior() -> None:
    """Paint a room in strong colors, by an incandescent lamp."""
    _room((WHITE, *STRONG[:3], WHITE))
    _box(_paint(STRONG[3]), (-0.7, 0.7, 0.5), (0.8, 0.8, 1))
    _box(_paint(STRONG[4]), (0.8, 0.4, 0.4), (0.7, 0.7, 0.8))
    _lamp("Bulb", (0, 0, 2.9), 60, 2856, 0.6)


def exterior() -> None:
    """Put up a lawn, a house of brick and a tree under a clear sky."""
    _square(_paint((0.1, 0.25, 0.04)), (0, 0, 0), size=30.0)
    _box(_paint((0.4, 0.12, 0.06)), (0, 3, 1.5), (4, 3, 3))
    _box(_paint((0.15, 0.1, 0.08)), (3.2, 1.5, 0.7), (0.3, 0.3, 1.4))
    _ball(_paint((0.06, 0.2, 0.03)), (3.2, 1.5, 2.1), 1.0)
    world = _world((1, 1, 1), 0.1)
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    sky.sun_elevation, sky.sun_rotation = math.radians(40), math.radians(140)
    background = world.node_tree.nodes["Background"]
    world.node_tree.links.new(sky.outputs[0], background.inputs["Color"])
    _camera((-3, -8, 2), (0.8, 2, 1.3))


def hdri() -> None:
    """Balls in the light of an image: blue above, a warm window, dark ground."""
    _table(_paint)
    rows, columns = 64, 128
    picture = np.full((rows, columns, 3), (0.1, 0.09, 0.08))
    picture[rows // 2 :] = (0.35, 0.5, 0.9)
    picture[36:52, 20:40] = (12, 8, 4)
    world = _world((1, 1, 1), 0.8)
    node = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = _image("Sky", picture)
    world.node_tree.links.new(node.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])


def textures() -> None:
    """Walls and boxes of printed patterns by a lamp of warm white."""
    chance = np.random.default_rng(3)
    patterns = [np.repeat(np.repeat(chance.uniform(0.03, 0.8, (6, 6, 3)), 16, 0), 16, 1)
                for _ in range(3)]  # fmt: skip
    made = iter([_textured(each) for each in patterns * 2])
    _room((WHITE, *STRONG[:2]), lambda _: next(made))
    _lamp("Lamp", (0, 0, 2.9), 60, 3000, 0.8)


def glass() -> None:
    """Balls of tinted glass on white."""
    tints = ((0.9, 0.3, 0.25), (0.3, 0.8, 0.4), (0.3, 0.5, 0.9), (0.95, 0.8, 0.3))
    _table(lambda c: _shader("ShaderNodeBsdfGlass", Color=(*c, 1), Roughness=0.1), colors=tints)
    _world((0.7, 0.7, 0.7))
    _lamp("Lamp", (2, -2, 4), 300, 4000, 2.0)


def metal() -> None:
    """Balls of copper, gold, brass and steel that mirror each other."""
    tints = ((0.93, 0.42, 0.25), (1.0, 0.7, 0.25), (0.85, 0.68, 0.35), (0.55, 0.55, 0.57))
    _table(lambda c: _paint(c, Metallic=1.0, Roughness=0.3), colors=tints)
    _world((0.4, 0.5, 0.7), 0.6)
    _lamp("Lamp", (2, -2, 4), 300, 3200, 2.0)


def emitters() -> None:
    """Light a white room by colored tubes."""
    _room((WHITE,))
    for number, color in enumerate(((1, 0.1, 0.15), (0.1, 0.3, 1.0), (0.2, 1.0, 0.3))):
        glow = _shader("ShaderNodeEmission", Color=(*color, 1), Strength=8.0)
        _box(glow, (1.2 * (number - 1), 1.5, 1.2), (0.08, 0.08, 1.8))
    _ball(_paint(STRONG[3]), (-0.5, 0.3, 0.5))
    _ball(_paint(STRONG[2]), (0.7, 0.1, 0.4), 0.4)


def volume() -> None:
    """Colored smoke between strong things in warm light."""
    _table(_paint, 3)
    smoke = _shader("ShaderNodeVolumePrincipled", "Volume", Color=(0.8, 0.35, 0.2, 1), Density=0.6)
    _box(smoke, (0, 0, 0.8), (4, 2, 1.6))
    _lamp("Lamp", (1, -2, 4), 500, 3000, 2.0)
    _world((0.3, 0.35, 0.5), 0.4)


def measured_daylight() -> None:
    """Things of measured paints, far from each other, by daylight."""
    _table(lambda _: _paint(WHITE))
    _assign(("red", "green", "blue", "yellow"))
    _lamp("Lamp", (1, -2, 4), 400, 6500, 2.0)


def measured_lamp() -> None:
    """Put the same by an incandescent lamp: matched for daylight."""
    _table(lambda _: _paint(WHITE))
    _assign(("red", "green", "blue", "yellow"))
    _lamp("Lamp", (1, -2, 4), 400, 2856, 2.0)


def _assign(names: tuple[str, ...]) -> None:
    from rough_spectra.addon import api

    materials = [t.active_material for t in bpy.context.scene.objects if "Sphere" in t.name]
    pairs = [(m, api.request(api.find(n), 0.0)) for m, n in zip(materials, names, strict=True)]
    api.assign(pairs, gloss="none")


SCENES: dict[str, Callable[[], None]] = {
    each.__name__.replace("_", " "): each
    for each in (
        gray_studio, soft_interior, strong_interior, exterior, hdri, textures, glass, metal,
        emitters, volume, measured_daylight, measured_lamp,
    )
}  # fmt: skip


def build(name: str, width: int = 480, height: int = 270, samples: int = 128) -> Any:
    """Make a scene in an empty file; gives it."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    random.seed(1)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    SCENES[name]()
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.cycles.samples, scene.cycles.max_bounces = samples, 8
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    return scene
