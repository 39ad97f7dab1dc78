# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The world as lamps: an even color, a picture, or a sky with its sun."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.numerics.arrays import Array
from ..colorimetry import srgb
from ..colorimetry.rgb_space import WorkingSpace
from . import emission, sky
from .lamps import Dome, Source, Sun

_ROWS = 32
"""Rows to which a picture of the world is brought down: 6° a pixel."""
_LARGEST = 1 << 25
"""Numbers of a picture that are read whole, 128 MB; beyond, only some of its rows would be."""


@dataclass(frozen=True)
class Part:
    """One lamp of the world, as in `sources.Lamp`."""

    name: str
    source: Source
    rgb: Array
    temperature: float | None = None
    is_of_one_color: bool = False


def read(world: Any, space: WorkingSpace) -> tuple[list[Part], list[str]]:
    """Read what a `bpy.types.World` sheds, and sentences about what could not be read."""
    tree = emission.tree(world)
    if tree is None:
        rgb = np.array(world.color[:])
        part = Part(world.name, _even(), rgb, is_of_one_color=True)
        return ([part] if rgb.max() > 0 else []), []
    shining = emission.of_tree(tree, "ShaderNodeOutputWorld", space)
    if shining is None:
        return [], []
    node = shining.source
    if node is not None and node.bl_idname == "ShaderNodeTexSky":
        return _sky(world, node, shining.rgb, space)
    if node is not None and node.bl_idname == "ShaderNodeTexEnvironment":
        return _picture(world, node, shining.rgb, space)
    warnings = []
    if shining.unread or node is not None:
        name = shining.unread or node.name
        warnings.append(
            f"World {world.name!r}: node {name!r} cannot be read without rendering; it counts as "
            "white."
        )
    even = _even(), shining.rgb, shining.temperature
    return [Part(world.name, *even, is_of_one_color=not warnings)], warnings


def _even() -> Dome:
    return Dome(np.ones((2, 4)))


def _picture(
    world: Any, node: Any, strength: Array, space: WorkingSpace
) -> tuple[list[Part], list[str]]:
    image = node.image
    name = world.name if image is None else image.name
    pixels = None if image is None else _pixels(image)
    if pixels is None:
        sentence = f"World {world.name!r}: the picture {name!r} cannot be read; it counts as white."
        return [Part(world.name, _even(), strength)], [sentence]
    small = _reduce(pixels)
    xyz = np.maximum(small * strength, 0) @ np.linalg.inv(space.from_xyz).T
    if not xyz[..., 1].max() > 0:
        return [], []
    # Its luminance is in the picture; white has one of 1.
    return [Part(name, Dome(xyz[..., 1], _turn(node), xyz), np.ones(3))], []


def _pixels(image: Any) -> Array | None:
    """Pixels of an image as scene-linear RGB, from the top down, every so many rows and columns."""
    width, height = image.size
    count = width * height * image.channels
    if not 0 < count <= _LARGEST or image.channels not in {3, 4}:
        return None
    values = np.empty(count, np.float32)
    image.pixels.foreach_get(values)
    pixels = values.reshape(height, width, image.channels)[::-1, :, :3]
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        return srgb.decode(pixels)
    return np.asarray(pixels)


def _reduce(pixels: Array) -> Array:
    """Average blocks so that `_ROWS` rows and twice as many columns remain, at most."""
    height, width = pixels.shape[:2]
    rows, columns = min(_ROWS, height), min(2 * _ROWS, width)
    tops, lefts = np.arange(rows) * height // rows, np.arange(columns) * width // columns
    sums = np.add.reduceat(np.add.reduceat(pixels.astype(np.float64), tops, 0), lefts, 1)
    sizes = np.outer(np.diff([*tops, height]), np.diff([*lefts, width]))
    return np.asarray(sums / sizes[..., np.newaxis])


def _turn(node: Any) -> float:
    """Angle about Z by which a Mapping node turns the world."""
    vector = node.inputs.get("Vector")
    links = vector.links if vector is not None else ()
    mapping = links[0].from_node if links else None
    if mapping is None or mapping.bl_idname != "ShaderNodeMapping":
        return 0.0
    if mapping.inputs["Rotation"].is_linked:
        return 0.0
    sign = 1.0 if mapping.vector_type == "TEXTURE" else -1.0
    return sign * float(mapping.inputs["Rotation"].default_value[2])


def _sky(
    world: Any, node: Any, strength: Array, space: WorkingSpace
) -> tuple[list[Part], list[str]]:
    found = sky.read(node, space)
    turn = _turn(node)
    upper = np.zeros((_ROWS, 1))
    upper[: _ROWS // 2] = 1
    parts = [Part(f"{world.name} (sky)", Dome(upper), found.radiance * strength)]
    if found.irradiance is not None:
        elevation, azimuth = found.elevation, found.azimuth + turn
        level = math.cos(elevation)
        toward = np.array(
            [level * math.cos(azimuth), level * math.sin(azimuth), math.sin(elevation)]
        )
        sun = Sun(toward, found.half_angle)
        parts.append(Part(f"{world.name} (sun)", sun, found.irradiance * strength))
    return parts, list(found.warnings)
