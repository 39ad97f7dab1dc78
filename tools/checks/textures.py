# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures to judge with: five images and three procedurals."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

SIDE = 512


def pictures() -> dict[str, NDArray[np.float64]]:
    """Five images, encoded as sRGB, rows from below, (SIDE, SIDE, 3)."""
    random = np.random.default_rng(3)
    y, x = np.mgrid[:SIDE, :SIDE]

    def noise(sigma: float, count: int = 1) -> Any:
        return random.normal(0, sigma, (SIDE, SIDE, count))

    # Of lengths that don't fit the pixels of a measurement, which would see the same in each.
    mortar = ((y % 61 < 7) | ((x + 55 * (y // 61 % 2)) % 110 < 7))[..., np.newaxis]
    bricks = np.where(mortar, 0.75, np.array([0.65, 0.3, 0.22]) + noise(0.06))
    wave = np.sin(x / 23 + 3 * np.sin(y / 61))[..., np.newaxis]
    wood = np.array([0.55, 0.36, 0.2]) + wave * np.array([0.15, 0.12, 0.08]) + noise(0.03)
    checker = np.where(((x // 37 + y // 41) % 2)[..., np.newaxis], 0.95, 0.05) + noise(0.0, 3)
    spots = np.kron(random.normal(0, 0.1, (SIDE // 8, SIDE // 8, 3)), np.ones((8, 8, 1)))
    leaves = np.maximum(np.array([0.3, 0.45, 0.2]) + spots, 0.05)
    ramp = np.stack((x / SIDE, y / SIDE, (x + y) / (2 * SIDE)), axis=-1)
    found = {"bricks": bricks, "wood": wood, "checker": checker, "leaves": leaves, "ramp": ramp}
    return {name: np.clip(values, 0, 1) for name, values in found.items()}


def image(name: str, pixels: NDArray[np.float64]) -> Any:
    """Make a packed image of 8 bits."""
    height, width, _ = pixels.shape
    made = bpy.data.images.new(name, width, height)
    rgba = np.concatenate((pixels, np.ones((height, width, 1))), axis=2)
    made.pixels.foreach_set(rgba.astype(np.float32).ravel())
    made.pack()
    return made


def _noise(tree: Any) -> Any:
    node = tree.nodes.new("ShaderNodeTexNoise")
    node.inputs["Scale"].default_value = 8
    return node.outputs["Color"]


def _ramp(tree: Any) -> Any:
    """Cells through a color ramp."""
    node, ramp = tree.nodes.new("ShaderNodeTexVoronoi"), tree.nodes.new("ShaderNodeValToRGB")
    node.inputs["Scale"].default_value = 6
    ramp.color_ramp.elements[0].color = (0.05, 0.02, 0.01, 1)
    ramp.color_ramp.elements[1].color = (0.8, 0.7, 0.5, 1)
    tree.links.new(node.outputs["Distance"], ramp.inputs[0])
    return ramp.outputs["Color"]


def _brick(tree: Any) -> Any:
    node = tree.nodes.new("ShaderNodeTexBrick")
    node.inputs["Scale"].default_value = 3
    return node.outputs["Color"]


PROCEDURALS: dict[str, Callable[[Any], Any]] = {
    "noise, procedural": _noise,
    "cells and ramp, procedural": _ramp,
    "brick, procedural": _brick,
}
"""Each makes its nodes in a tree, and gives the output that is the color."""
