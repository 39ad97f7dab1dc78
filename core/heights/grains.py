# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A bed of equal spheres, dropped one after the other, as seen from above.

Each falls at a random place and comes to rest on the others at the lowest place near by, as grains
of sand do (after W. M. Visscher & M. Bolsterli, Nature 239 (1972) 504). What lies under the
equator of a sphere is not seen from above: the surface is the height of whatever is uppermost.
"""

from __future__ import annotations

import numpy as np

from ..errors import DomainError
from ..numerics.arrays import Array
from .field import HeightField, check_grid

_LAYERS = 4.0
"""Volume of the grains over that of a full layer one diameter high: after three layers the floor
is out of sight, and no layer remembers it."""


def grains(
    sigma: float | None = None,
    diameter: float = 1.0,
    *,
    cells: int = 512,
    diameter_cells: float = 32.0,
    seed: int = 0,
) -> HeightField:
    """Drop spheres until the floor is covered several times.

    Parameters
    ----------
    sigma
        Radians: the bed is flattened, spheres to ellipsoids, until Rdq of the facets is tan σ. None
        leaves spheres, whose Rdq grows slowly with the cells, for a sphere's edge is upright.
    diameter
        Of a grain, in any unit of length.
    cells
        Of the grid, a side.
    diameter_cells
        Cells in a diameter.
    seed
        Another bed for each number.

    Raises
    ------
    DomainError
        If σ, the diameter or the grid make no surface.

    Examples
    --------
    >>> bed = grains(diameter=0.2, cells=64, diameter_cells=16)
    >>> bed.heights.shape, round(bed.period[0], 6)
    ((64, 64), 0.8)
    """
    check_grid(cells, diameter_cells)
    if not (np.isfinite(diameter) and diameter > 0):
        raise DomainError("The diameter of the grains is not above 0; give a length.")
    heights = _bed(cells, diameter_cells, np.random.default_rng(seed))
    spacing = diameter / diameter_cells
    bed = HeightField((heights - heights.mean()) * spacing, (spacing, spacing))
    return bed if sigma is None else bed.of_slope(sigma)


def _bed(cells: int, diameter: float, random: np.random.Generator) -> Array:
    """Heights in cells."""
    count = int(np.ceil(_LAYERS * cells**2 / (np.pi / 6 * diameter**2)))
    reach = int(np.ceil(diameter))
    offsets = np.arange(-reach, reach + 1)
    distance2 = offsets[:, np.newaxis] ** 2 + offsets**2
    # A second sphere's center over a first one at this distance, and the first one's own surface.
    rest = np.sqrt(np.maximum(diameter**2 - distance2, 0))
    rest[distance2 >= diameter**2] = -np.inf
    cap = np.sqrt(np.maximum((diameter / 2) ** 2 - distance2, 0))
    cap[distance2 >= (diameter / 2) ** 2] = -np.inf
    centers = np.full((cells, cells), diameter / 2)
    surface = np.zeros((cells, cells))
    for row, column in random.integers(0, cells, (count, 2)):
        near = np.ix_((row + offsets) % cells, (column + offsets) % cells)
        low = np.unravel_index(np.argmin(centers[near]), rest.shape)
        row, column = row + offsets[low[0]], column + offsets[low[1]]
        height = centers[row % cells, column % cells]
        around = np.ix_((row + offsets) % cells, (column + offsets) % cells)
        centers[around] = np.maximum(centers[around], height + rest)
        surface[around] = np.maximum(surface[around], height + cap)
    return surface
