# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Heights on a rectangular grid, periodic both ways, and the slopes of its facets.

A grid of heights becomes a mesh of two triangles a cell (`core.heights.mesh`). Each triangle has
one edge along x and one along y, and each edge belongs to two triangles of equal area seen from
above: the root mean square of the differences between neighbors *is* that of the facets' slopes.
So Rdq is exact for what is rendered, and not only for the surface that the grid samples.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import DomainError
from ..numerics.arrays import Array


@dataclass(frozen=True, eq=False)
class HeightField:
    """Heights over one period of a surface.

    Attributes
    ----------
    heights
        Shape (rows along y, columns along x), float64; the row after the last is the first again.
    spacing
        Between columns and between rows, in the unit of the heights.
    """

    heights: Array
    spacing: tuple[float, float]

    def __post_init__(self) -> None:
        """Refuse what is no surface."""
        if self.heights.ndim != 2 or min(self.heights.shape) < 2:
            msg = f"The heights have the shape {self.heights.shape}; give 2 × 2 or more of them."
            raise DomainError(msg)
        missing = int(np.count_nonzero(~np.isfinite(self.heights)))
        if missing:
            msg = (
                f"{missing} of {self.heights.size} heights are missing; fill the holes first, as "
                "every profilometer's program can."
            )
            raise DomainError(msg)
        if not (np.isfinite(self.spacing).all() and min(self.spacing) > 0):
            msg = f"The heights are spaced {self.spacing}; give two lengths above 0."
            raise DomainError(msg)

    @property
    def period(self) -> tuple[float, float]:
        """Lengths along x and y after which the surface repeats."""
        rows, columns = self.heights.shape
        return columns * self.spacing[0], rows * self.spacing[1]

    @property
    def rdq_along(self) -> tuple[float, float]:
        """Rdq of profiles along x and along y: root mean square of the slope (ISO 21920-2)."""
        across = (np.roll(self.heights, -1, axis) - self.heights for axis in (1, 0))
        x, y = (
            float(np.sqrt(np.mean(np.square(difference)))) / step
            for difference, step in zip(across, self.spacing, strict=True)
        )
        return x, y

    @property
    def rdq(self) -> float:
        """Rdq of profiles, those along x and those along y alike."""
        return self.sdq / float(np.sqrt(2))

    @property
    def sdq(self) -> float:
        """Sdq, the root mean square of the steepest slope (ISO 25178-2); √2 Rdq."""
        return float(np.hypot(*self.rdq_along))

    @property
    def sq(self) -> float:
        """Sq, the standard deviation of the heights (ISO 25178-2)."""
        return float(np.std(self.heights))

    def of_slope(self, sigma: float) -> HeightField:
        """Stretch the heights until Rdq = tan σ.

        Parameters
        ----------
        sigma
            Radians, from 0 to below π/2.

        Raises
        ------
        DomainError
            If σ lies outside, or the surface is level and cannot be stretched.

        Examples
        --------
        >>> ridges = HeightField(np.array([[0.0, 1.0], [0.0, 1.0]]), (1.0, 1.0))
        >>> round(ridges.rdq, 3), round(float(np.degrees(np.arctan(ridges.of_slope(0.5).rdq))), 3)
        (0.707, 28.648)
        """
        check_slope(sigma)
        if self.rdq == 0:
            if sigma == 0:
                return self
            raise DomainError("The surface is level; no stretching gives it a slope.")
        heights = (self.heights - self.heights.mean()) * (np.tan(sigma) / self.rdq)
        return replace(self, heights=heights)


def check_slope(sigma: float) -> None:
    """Refuse a σ that no surface can have.

    Raises
    ------
    DomainError
        If it is not from 0 to below π/2 radians.

    Examples
    --------
    >>> check_slope(0.5)
    """
    if not 0 <= sigma < np.pi / 2:
        msg = f"σ is {np.degrees(sigma):g}°; give 0 to below 90 degrees for a surface of facets."
        raise DomainError(msg)


def check_grid(cells: int, correlation_cells: float) -> None:
    """Refuse a grid that is too coarse for a correlation length, or holds too little of it.

    Raises
    ------
    DomainError
        If it is so.

    Examples
    --------
    >>> check_grid(256, 8)
    """
    if cells < 8:
        raise DomainError(f"The grid has {cells} cells a side; give 8 or more.")
    if not 1 <= correlation_cells <= cells / 4:
        msg = (
            f"The correlation length is {correlation_cells:g} cells of a grid of {cells}; give 1 "
            "to a quarter of the grid."
        )
        raise DomainError(msg)
