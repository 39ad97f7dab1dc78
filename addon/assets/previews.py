# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered previews of materials: Cycles balls under one light, many in a picture.

Blender's own previews are of Eevee, which ignores diffuse roughness, and need a window. A ball lit
from above shows what σ does: the rougher, the flatter. No ball lights or shades another.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np
import numpy.typing as npt

from ..colorimetry import srgb
from ..instrument.worker import read_exr, render_into

PIXELS = 128
"""Width of a preview; the Asset Browser shows 96 unless told otherwise."""
SAMPLES = 8
"""Rays a pixel: the sun is sharp and the sky even, so only the rim has noise."""
AT_ONCE = 12
"""Balls in one picture: a picture costs as much as its pixels, and a step of progress is one."""

_COLUMNS = 4
_DIAMETER = 0.94  # of the preview's width
_SEGMENTS = 64
_LIGHT_POLAR, _LIGHT_AZIMUTH = math.radians(40), math.radians(125)
"""The light stands behind the viewer's left shoulder: rough balls look flat only from near it."""
_KEY, _FILL = 0.85, 0.15
"""Shares of sun and sky; together a white facet toward the light comes out white."""


def render(materials: Sequence[Any], folder: Path) -> Iterator[tuple[Any, npt.NDArray[np.uint8]]]:
    """Give each material with its picture, sRGB and alpha, shape (PIXELS, PIXELS, 4), bottom up.

    Adds what it needs to the open file and takes it away at the end.
    """
    scene = _scene()
    balls = [_ball(scene, place) for place in range(min(AT_ONCE, len(materials)))]
    rows = math.ceil(len(balls) / _COLUMNS)
    _camera(scene, rows)
    path = folder / "previews.exr"
    for start in range(0, len(materials), AT_ONCE):
        batch = materials[start : start + AT_ONCE]
        for ball, material in zip(balls, batch, strict=False):
            ball.material_slots[0].material = material
        render_into(scene, path)
        picture = _srgb(read_exr(path)[::-1])
        for place, material in enumerate(batch):
            row, column = divmod(place, _COLUMNS)
            top = (rows - 1 - row) * PIXELS
            left = column * PIXELS
            yield material, picture[top : top + PIXELS, left : left + PIXELS]
    _remove(scene)


def put(material: Any, picture: npt.NDArray[np.uint8]) -> None:
    """Make a picture the preview of a material."""
    preview = material.preview_ensure()
    preview.image_size = (picture.shape[1], picture.shape[0])
    preview.image_pixels_float.foreach_set((picture / np.float32(255)).ravel())
    icon = picture[:: PIXELS // 32, :: PIXELS // 32]
    preview.icon_size = (icon.shape[1], icon.shape[0])
    preview.icon_pixels_float.foreach_set((icon / np.float32(255)).ravel())


def _scene() -> Any:
    scene = bpy.data.scenes.new("Previews")
    settings, cycles = scene.render, scene.cycles
    settings.engine = "CYCLES"
    settings.film_transparent = True
    settings.use_compositing = settings.use_sequencer = False
    settings.resolution_percentage = 100
    settings.image_settings.file_format = "OPEN_EXR"
    settings.image_settings.color_mode = "RGBA"
    settings.image_settings.color_depth = "32"
    cycles.device, cycles.seed, cycles.samples = "CPU", 0, SAMPLES
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = 1  # the sky
    world = bpy.data.worlds.new("Previews")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    background = next(n for n in world.node_tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (_FILL, _FILL, _FILL, 1)
    background.inputs["Strength"].default_value = 1.0
    scene.world = world
    sun = bpy.data.lights.new("Previews", "SUN")
    sun.angle, sun.energy = 0.0, _KEY * math.pi
    lamp = bpy.data.objects.new("Previews", sun)
    lamp.rotation_euler = (0, _LIGHT_POLAR, _LIGHT_AZIMUTH)
    scene.collection.objects.link(lamp)
    return scene


def _ball(scene: Any, place: int) -> Any:
    mesh = bpy.data.meshes.new("Previews")
    shape = bmesh.new()
    bmesh.ops.create_uvsphere(
        shape, u_segments=_SEGMENTS, v_segments=_SEGMENTS // 2, radius=_DIAMETER / 2
    )
    for face in shape.faces:
        face.smooth = True
    shape.to_mesh(mesh)
    shape.free()
    mesh.materials.append(None)
    ball = bpy.data.objects.new("Previews", mesh)
    ball.location = (place % _COLUMNS + 0.5, -(place // _COLUMNS) - 0.5, 0)
    ball.visible_shadow = ball.visible_diffuse = False
    scene.collection.objects.link(ball)
    return ball


def _camera(scene: Any, rows: int) -> None:
    lens = bpy.data.cameras.new("Previews")
    lens.type, lens.sensor_fit, lens.ortho_scale = "ORTHO", "HORIZONTAL", _COLUMNS
    camera = bpy.data.objects.new("Previews", lens)
    camera.location = (_COLUMNS / 2, -rows / 2, 10)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = _COLUMNS * PIXELS, rows * PIXELS


def _srgb(picture: npt.NDArray[np.float32]) -> npt.NDArray[np.uint8]:
    """Encode linear Rec.709 with associated alpha as sRGB bytes with straight alpha."""
    alpha = np.clip(picture[..., 3:], 0, 1)
    linear = np.clip(picture[..., :3] / np.maximum(alpha, 1e-6), 0, 1)
    encoded = srgb.encode(linear)
    return np.round(np.concatenate((encoded, alpha), axis=-1) * 255).astype(np.uint8)


def _remove(scene: Any) -> None:
    things = list(scene.objects)
    data = [thing.data for thing in things]
    bpy.data.batch_remove([*things, *data, scene.world, scene])
