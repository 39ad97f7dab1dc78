# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays through the picture of a camera or of a viewport."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from mathutils import Matrix

from ...core.errors import InputError
from ...core.numerics.arrays import Array

COLUMNS, ROWS = 96, 64
"""Rays across and down the picture, each at a random place of its cell."""


@dataclass(frozen=True)
class View:
    """What looks at the scene: a viewport, where it isn't the scene's camera.

    Parameters
    ----------
    view_matrix, window_matrix
        As `bpy.types.RegionView3D` has them: world to view, and view to clip space.
    """

    view_matrix: Any
    window_matrix: Any


def rays(
    depsgraph: Any, scene: Any, view: View | None, random: np.random.Generator
) -> tuple[Array, Array]:
    """Spread rays over the picture.

    Returns
    -------
    origins, directions
        World space, each of shape (rays, 3); directions are unit vectors.

    Raises
    ------
    InputError
        If there is neither view nor camera.
    """
    rows, columns = np.indices((ROWS, COLUMNS)).reshape(2, -1)
    jitter = random.uniform(size=(2, rows.size))
    across, down = (columns + jitter[0]) / COLUMNS, (rows + jitter[1]) / ROWS
    if view is not None:
        return _through_viewport(view, across, down)
    if scene.camera is None or scene.camera.type != "CAMERA":
        msg = f"Scene {scene.name!r} has no camera; add one, or look at the scene in a viewport."
        raise InputError(msg)
    camera = scene.camera.evaluated_get(depsgraph)
    placed = np.array(camera.matrix_world.normalized())
    lens = camera.data
    if lens.type == "PANO":
        ways = _around(across, down)
        origins = np.zeros_like(ways)
    else:
        frame = np.array([list(corner) for corner in lens.view_frame(scene=scene)])
        right_top, right_bottom, left_bottom, left_top = frame
        across, down = across[:, np.newaxis], down[:, np.newaxis]
        upper = left_top + across * (right_top - left_top)
        lower = left_bottom + across * (right_bottom - left_bottom)
        plane = upper + down * (lower - upper)
        parallel = lens.type == "ORTHO"
        ways = np.broadcast_to([0.0, 0.0, -1.0], plane.shape) if parallel else plane
        origins = plane * [1, 1, 0] if parallel else np.zeros_like(plane)
    return _placed(placed, origins, ways)


def _through_viewport(view: View, across: Array, down: Array) -> tuple[Array, Array]:
    inverse = np.array((Matrix(view.window_matrix) @ Matrix(view.view_matrix)).inverted())
    flat = np.stack((2 * across - 1, 1 - 2 * down, np.ones_like(across), np.ones_like(across)))
    near, far = (inverse @ (flat * np.array([[1], [1], [depth], [1]])) for depth in (-1, 1))
    origins, ends = (near[:3] / near[3]).T, (far[:3] / far[3]).T
    ways = ends - origins
    return origins, ways / np.linalg.norm(ways, axis=1, keepdims=True)


def _around(across: Array, down: Array) -> Array:
    """Directions of a panorama, each with the same solid angle."""
    up, azimuth = 1 - 2 * down, 2 * np.pi * across
    level = np.sqrt(1 - up * up)
    return np.stack((level * np.sin(azimuth), up, level * np.cos(azimuth)), axis=-1)


def _placed(matrix: Array, origins: Array, ways: Array) -> tuple[Array, Array]:
    turned = ways @ matrix[:3, :3].T
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    return origins @ matrix[:3, :3].T + matrix[:3, 3], turned
