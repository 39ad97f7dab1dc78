# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets of a rough surface, and their slopes as measured on the facets themselves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numerics.arrays import Array
from .field import HeightField
from .grooves import Grooves

_GROOVE_REACH = 1.0
"""Grooves go on beyond their period by so many periods at either end, and have to: light that is
caught in one wanders along it."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles or quadrilaterals over one period, whose middle is the origin.

    Attributes
    ----------
    vertices
        Shape (vertices, 3); the mean height is 0.
    faces
        Shape (faces, 3 or 4), counterclockwise seen from above.
    period
        Along x and y.
    rings
        Copies that the surface needs around it along x and y, for its edges not to matter.
    """

    vertices: Array
    faces: Array
    period: tuple[float, float]
    rings: tuple[int, int]

    def slopes(self) -> tuple[Array, Array]:
        """Give each facet's slope along x and y, and its share of the area seen from above.

        Returns
        -------
        Shapes (faces, 2) and (faces,).

        Examples
        --------
        >>> tilted = HeightField(np.array([[0.0, 1.0], [0.0, 1.0]]), (1.0, 1.0))
        >>> slopes, share = mesh_of_field(tilted).slopes()
        >>> slopes[:2].tolist(), round(float(share.sum()), 12)
        ([[1.0, 0.0], [1.0, 0.0]], 1.0)
        """
        first, second, third = (self.vertices[self.faces[:, corner]] for corner in range(3))
        normal = np.cross(second - first, third - first)
        area = normal[:, 2] * (1 if self.faces.shape[1] == 3 else 2)
        return -normal[:, :2] / normal[:, 2:], area / area.sum()

    @property
    def rdq(self) -> float:
        """Rdq of profiles, averaged over azimuth."""
        return self.sdq / float(np.sqrt(2))

    @property
    def sdq(self) -> float:
        """Sdq over the area seen from above."""
        slopes, share = self.slopes()
        return float(np.sqrt(np.sum(share[:, np.newaxis] * slopes**2)))


def mesh_of_field(field: HeightField) -> Mesh:
    """Divide every cell of a grid of heights into two triangles.

    Examples
    --------
    >>> level = mesh_of_field(HeightField(np.zeros((2, 3)), (1.0, 1.0)))
    >>> level.vertices.shape, level.faces.shape, level.period
    ((12, 3), (12, 3), (3.0, 2.0))
    """
    rows, columns = field.heights.shape
    heights = np.pad(field.heights - field.heights.mean(), ((0, 1), (0, 1)), mode="wrap")
    x = (np.arange(columns + 1) - columns / 2) * field.spacing[0]
    y = (np.arange(rows + 1) - rows / 2) * field.spacing[1]
    grid = np.broadcast_arrays(x, y[:, np.newaxis], heights)
    corner = np.arange(rows)[:, np.newaxis] * (columns + 1) + np.arange(columns)
    right, above = corner + 1, corner + columns + 1
    below_diagonal = np.stack((corner, right, above + 1), axis=-1)
    above_diagonal = np.stack((corner, above + 1, above), axis=-1)
    faces = np.stack((below_diagonal, above_diagonal), axis=2).reshape(-1, 3)
    return Mesh(np.stack(grid, axis=-1).reshape(-1, 3), faces, field.period, (2, 2))


def mesh_of_grooves(grooves: Grooves) -> Mesh:
    """Make two walls a groove, along y and longer than the period.

    Examples
    --------
    >>> walls = mesh_of_grooves(Grooves(np.radians([45.0]), np.array([2.0])))
    >>> walls.faces.shape, round(walls.sdq, 12), walls.rings
    ((2, 4), 1.0, (0, 0))
    """
    rims = np.concatenate(([0], np.cumsum(grooves.widths))) - grooves.period / 2
    count = grooves.widths.size
    x, z = np.empty(2 * count + 1), np.zeros(2 * count + 1)
    x[::2], x[1::2] = rims, (rims[1:] + rims[:-1]) / 2
    z[1::2] = -grooves.depths
    reach = grooves.period * (0.5 + _GROOVE_REACH)
    ends = [np.stack((x, np.full_like(x, y), z), axis=-1) for y in (-reach, reach)]
    near = np.arange(2 * count)
    far = near + 2 * count + 1
    faces = np.stack((near, near + 1, far + 1, far), axis=-1)
    period = grooves.period
    return Mesh(np.concatenate(ends), faces, (period, period), (0, 0))
