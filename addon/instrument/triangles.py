# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of a surface in a scene: their middle, the place nearest to a point, what a line meets.

Plain numpy over all triangles at once: a place is looked for once, and a tree would take longer to
build.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...core.numerics.arrays import Array

_ALIKE = 1e-6
"""Of distances that differ by less, in parts, the first triangle's counts: rounding must not tell
the faces of a cube apart."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """A surface as triangles.

    Parameters
    ----------
    corners
        In the scene, shape (triangles, 3, 3).
    slots
        Number of the material slot of each.
    weights
        Of a vertex group at each corner, shape (triangles, 3); 1 without one.
    is_mirrored
        Whether the surface's transform turns its triangles inside out.
    """

    corners: Array
    slots: Array
    weights: Array
    is_mirrored: bool = False

    def __len__(self) -> int:
        """Count the triangles."""
        return len(self.corners)

    def only(self, chosen: Array) -> Triangles:
        """Give a part of them, by a mask."""
        part = {key: getattr(self, key)[chosen] for key in ("corners", "slots", "weights")}
        return replace(self, **part)

    def normal(self, number: int) -> Array:
        """Give the unit normal of a triangle's front, shape (3,); 0 where it has no area."""
        a, b, c = self.corners[number]
        across = np.cross(b - a, c - a) * (-1 if self.is_mirrored else 1)
        length = np.linalg.norm(across)
        return np.asarray(across / length if length > 0 else across)

    def middle(self) -> Array:
        """Give the mean of all places, each by its weight, shape (3,)."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        # What a linear weight makes of a triangle's mean.
        parts = (self.weights + self.weights.sum(axis=1, keepdims=True)) / 12
        masses = areas[:, np.newaxis] * parts
        return np.asarray((masses[..., np.newaxis] * self.corners).sum(axis=(0, 1)) / masses.sum())

    def nearest(self, point: Array) -> tuple[int, Array]:
        """Find the triangle that is nearest to a point, and the place on it."""
        places = self._nearest_places(np.asarray(point, float))
        distances = np.linalg.norm(places - point, axis=1)
        reach = distances.min() + _ALIKE * max(float(distances.min()), float(np.ptp(self.corners)))
        number = int(np.flatnonzero(distances <= reach)[0])
        return number, places[number]

    def _nearest_places(self, point: Array) -> Array:
        """Place of each triangle that is nearest to a point, shape (triangles, 3)."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        across = np.cross(b - a, c - a)
        square = np.einsum("ij,ij->i", across, across)
        with np.errstate(divide="ignore", invalid="ignore"):
            above = np.einsum("ij,ij->i", point - a, across) / square
        foot = point - above[:, np.newaxis] * across
        is_inside = square > 0
        best, found = np.full(len(a), np.inf), a.copy()
        for start, end in ((a, b), (b, c), (c, a)):
            edge = end - start
            is_inside &= np.einsum("ij,ij->i", np.cross(edge, foot - start), across) >= 0
            length = np.maximum(np.einsum("ij,ij->i", edge, edge), 1e-300)
            along = np.clip(np.einsum("ij,ij->i", point - start, edge) / length, 0, 1)
            place = start + along[:, np.newaxis] * edge
            distance = np.linalg.norm(place - point, axis=1)
            found = np.where((distance < best)[:, np.newaxis], place, found)
            best = np.minimum(best, distance)
        return np.where(is_inside[:, np.newaxis], foot, found)

    def met(self, origin: Array, direction: Array) -> tuple[Array, Array]:
        """Find what a line meets, to both sides of its origin.

        Returns
        -------
        Numbers of the triangles, and how far along the direction each is met; both ways.
        """
        origin, direction = np.asarray(origin, float), np.asarray(direction, float)
        a, b, c = np.moveaxis(self.corners, 1, 0)
        one, two, start = b - a, c - a, origin - a
        across = np.cross(direction, two)
        size = np.einsum("ij,ij->i", one, across)
        size[size == 0] = np.nan  # the line runs along them
        turned = np.cross(start, one)
        u = np.einsum("ij,ij->i", start, across) / size
        v = turned @ direction / size
        far = np.einsum("ij,ij->i", two, turned) / size
        slack = 1e-9
        numbers = np.flatnonzero((u >= -slack) & (v >= -slack) & (u + v <= 1 + slack))
        return numbers, np.asarray(far[numbers])
