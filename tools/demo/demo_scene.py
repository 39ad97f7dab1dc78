# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo's scene: a strip of tiles a patch, one tile a roughness, and its picture in Cycles.

Every tile carries a half sphere. The flat part shows the color that the instrument reads, the
sphere how roughness flattens the shading. Tiles of one patch touch, so that the eye compares them.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import bpy
import numpy as np

WIDTH, HEIGHT = 1600, 900
SAMPLES = 16

ROWS = 6
"""Strips in a column: a row of the chart."""
_TILE = 1.0
_ROW = 1.53
_COLUMN = 4.5
_RADIUS = 0.42
_RINGS, _SEGMENTS = 24, 96

_TILT = math.radians(15.0)
"""Camera, from the board's normal towards the lower edge: enough to see the half spheres stand."""
_SUN_POLAR = math.radians(30.0)
_SUN_AZIMUTH = math.radians(160.0)
"""35° off the view, from the left: near enough to it that a rough sphere looks flat."""
_SUN = 0.9 * math.pi
"""Irradiance. With the world's it leaves the white patch just below 1, so nothing clips."""
_WORLD = 0.08
_BOARD = 0.05
_INK = (0.80, 0.80, 0.80)


def build(strips: Sequence[tuple[str, Sequence[Any]]], heads: Sequence[str], title: str) -> Any:
    """Lay out the open file's scene.

    Parameters
    ----------
    strips
        Label and materials of each strip, from the top of the first column down.
    heads
        What to write above the tiles of a column.
    title
        A line below all of it.

    Returns
    -------
    The scene.
    """
    scene = bpy.context.scene
    columns = math.ceil(len(strips) / ROWS)
    tile = _tile()
    ink = _emission("Ink", _INK)
    for index, (label, materials) in enumerate(strips):
        left, top = _COLUMN * (index // ROWS), -_ROW * (index % ROWS)
        _text(scene, label, (left, top + 0.6), 0.32, "LEFT", ink)
        for place, material in enumerate(materials):
            thing = bpy.data.objects.new(material.name, tile)
            thing.location = (left + _TILE * (place + 0.5), top, 0.0)
            scene.collection.objects.link(thing)
            # The mesh is shared, so the material belongs to the object.
            thing.material_slots[0].link = "OBJECT"
            thing.material_slots[0].material = material
    for column in range(columns):
        for place, head in enumerate(heads):
            at = (_COLUMN * column + _TILE * (place + 0.5), 1.12)
            _text(scene, head, at, 0.32, "CENTER", ink)
    width = _COLUMN * (columns - 1) + _TILE * len(heads)
    bottom = -_ROW * (ROWS - 1) - 1.07
    _text(scene, title, (width / 2, bottom), 0.32, "CENTER", ink)
    _board(scene, width / 2)
    _light(scene)
    _camera(scene, (width / 2, (1.4 + bottom) / 2), width + 0.9)
    return scene


def render(scene: Any, target: Path) -> None:
    """Render the scene in Cycles on the CPU into a PNG."""
    from rough_spectra.addon.instrument.worker import render_into

    settings = scene.render
    settings.engine = "CYCLES"
    settings.resolution_x, settings.resolution_y = WIDTH, HEIGHT
    settings.resolution_percentage = 100
    settings.image_settings.file_format = "PNG"
    settings.image_settings.color_mode = "RGB"
    settings.image_settings.color_depth = "8"
    settings.use_file_extension = False
    # Standard shows colors as they are; AgX and Filmic bend them.
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    cycles = scene.cycles
    cycles.device, cycles.seed, cycles.samples = "CPU", 0, SAMPLES
    cycles.use_adaptive_sampling, cycles.use_denoising = False, True
    # The default denoiser takes longer than the render, for no difference one could see here.
    cycles.denoising_quality = cycles.denoising_prefilter = "FAST"
    cycles.max_bounces = cycles.diffuse_bounces = 2
    with _progress(), quiet():
        render_into(scene, target)
    # Blender notes date and duration in the file, so no two would be equal.
    target.write_bytes(_without_texts(target.read_bytes()))


def _without_texts(png: bytes) -> bytes:
    """Leave out the text chunks of a PNG."""
    kept, start = [png[:8]], 8
    while start < len(png):
        # Length, type, data, checksum.
        end = start + 12 + int.from_bytes(png[start : start + 4])
        if png[start + 4 : start + 8] not in (b"tEXt", b"zTXt", b"iTXt"):
            kept.append(png[start:end])
        start = end
    return b"".join(kept)


def _tile() -> Any:
    """Make a square with a half sphere on it; the sphere alone is smooth."""
    azimuth = np.linspace(0, 2 * np.pi, _SEGMENTS, endpoint=False)
    polar = np.linspace(np.pi / 2, 0, _RINGS, endpoint=False)
    ring = np.stack((np.cos(azimuth), np.sin(azimuth), np.zeros(_SEGMENTS)), axis=-1)
    sphere = np.sin(polar)[:, None, None] * ring
    sphere[..., 2] = np.cos(polar)[:, None]
    half = _TILE / 2
    corners = [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]
    vertices = [*corners, *(_RADIUS * sphere.reshape(-1, 3)).tolist(), (0, 0, _RADIUS)]
    pole = len(vertices) - 1
    faces: list[list[int]] = [[0, 1, 2, 3]]
    for row in range(_RINGS):
        for i in range(_SEGMENTS):
            this, following = (4 + row * _SEGMENTS + k for k in (i, (i + 1) % _SEGMENTS))
            above = [following + _SEGMENTS, this + _SEGMENTS] if row < _RINGS - 1 else [pole]
            faces.append([this, following, *above])
    mesh = bpy.data.meshes.new("Tile")
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [False] + [True] * (len(faces) - 1))
    mesh.materials.append(None)
    mesh.update()
    return mesh


def _text(
    scene: Any, words: str, at: tuple[float, float], size: float, align: str, ink: Any
) -> None:
    curve = bpy.data.curves.new(words, "FONT")
    curve.body, curve.size, curve.align_x = words, size, align
    curve.materials.append(ink)
    thing = bpy.data.objects.new(words, curve)
    thing.location = (*at, 0.002)
    thing.visible_diffuse = thing.visible_shadow = False
    scene.collection.objects.link(thing)


def _emission(name: str, color: tuple[float, float, float]) -> Any:
    material = bpy.data.materials.new(name)
    # Else every triangle of every letter is a lamp to draw samples from.
    material.cycles.emission_sampling = "NONE"
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = (*color, 1.0)
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material


def _board(scene: Any, middle: float) -> None:
    """Put a gray board behind everything, larger than the picture."""
    material = bpy.data.materials.new("Board")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (_BOARD, _BOARD, _BOARD, 1.0)
    tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    mesh = bpy.data.meshes.new("Board")
    mesh.from_pydata([(-40, -40, 0), (40, -40, 0), (40, 40, 0), (-40, 40, 0)], [], [[0, 1, 2, 3]])
    mesh.materials.append(material)
    thing = bpy.data.objects.new("Board", mesh)
    thing.location = (middle, 0, -0.01)
    scene.collection.objects.link(thing)


def _light(scene: Any) -> None:
    sun = bpy.data.lights.new("Key", "SUN")
    sun.energy, sun.angle = _SUN, math.radians(3.0)
    lamp = bpy.data.objects.new("Key", sun)
    lamp.rotation_euler = (0.0, _SUN_POLAR, _SUN_AZIMUTH)
    scene.collection.objects.link(lamp)
    world = bpy.data.worlds.new("Dim neutral world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = _WORLD
    scene.world = world


def _camera(scene: Any, center: tuple[float, float], width: float) -> None:
    """Look without perspective: every strip is seen from the same direction."""
    lens = bpy.data.cameras.new("View")
    lens.type, lens.sensor_fit, lens.ortho_scale = "ORTHO", "HORIZONTAL", width
    camera = bpy.data.objects.new("View", lens)
    (x, y), away = center, 50.0
    camera.location = (x, y - away * math.sin(_TILT), away * math.cos(_TILT))
    camera.rotation_euler = (_TILT, 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera


@contextmanager
def _progress() -> Iterator[None]:
    """Say every few seconds how far the render is."""
    start = time.monotonic()
    state = {"last": start}

    def tell(stats: Any, *_rest: Any) -> None:
        now = time.monotonic()
        if now - state["last"] < 5.0 or not isinstance(stats, str):
            return
        state["last"] = now
        part = next((p.strip() for p in stats.split("|") if "Sample" in p), "")
        os.write(saved, f"  {now - start:3.0f} s {part}\n".encode())

    saved = os.dup(2)
    bpy.app.handlers.render_stats.append(tell)
    try:
        yield
    finally:
        bpy.app.handlers.render_stats.remove(tell)
        os.close(saved)


@contextmanager
def quiet() -> Iterator[None]:
    """Keep what Blender itself prints on standard output away."""
    saved, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    try:
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(nothing)
