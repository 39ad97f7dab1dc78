# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""BRDFs over the adaptive parameters of RGL's goniophotometer, evaluated in single directions.

Directions of light are a grid. Those of view are points of the unit square, which the distribution
of visible normals spreads to where the surface reflects; what is stored there is f cos θ over that
distribution's density.

Source: J. Dupuy and W. Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and
Rendering", ACM Transactions on Graphics 37 (2018), and `powitacq.inl` of rgl-epfl/brdf-loader.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .....core.numerics.arrays import Array


@dataclass(frozen=True)
class MeasuredBrdf:
    """A measured BRDF.

    Parameters
    ----------
    phi, theta
        Azimuths and angles from the normal of the light, radians, increasing.
    normals
        Density of normals over the square of half vectors, shape (y, x).
    area
        Projected area of the microsurface over the square of directions of the light, (y, x).
    visible
        Density of visible normals, shape (phi, theta, y, x).
    spectra
        Shape (phi, theta, wavelengths, y, x).
    divided
        Whether `spectra` are over the density of visible normals.
    """

    phi: Any
    theta: Any
    normals: Any
    area: Any
    visible: Any
    spectra: Any
    divided: bool

    @property
    def is_isotropic(self) -> bool:
        """Whether turning the sample changes nothing."""
        return len(self.phi) <= 2

    @property
    def symmetries(self) -> int:
        """How many like parts an anisotropic sample's azimuths have, of which one is stored."""
        return 1 if self.is_isotropic else round(2 * np.pi / float(self.phi[-1] - self.phi[0]))

    def factors(self, light: Array, view: Array) -> Array:
        """Return the reflectance factor π f at all wavelengths.

        Parameters
        ----------
        light, view
            Unit vectors, z along the normal, both above the surface.
        """
        light, view = self._in_stored_part(light, view)
        middle = light + view
        middle /= np.linalg.norm(middle)
        turn = np.arctan2(light[1], light[0])
        of_middle = np.arctan2(middle[1], middle[0]) - (turn if self.is_isotropic else 0.0)
        place = (_across(middle), (of_middle + np.pi) / (2 * np.pi) % 1.0)
        corners = self._corners(turn, np.arccos(light[2]))
        densities = (
            weight * _normalized(self.visible[i, j].astype(np.float64)) for weight, i, j in corners
        )
        point = _inverted(np.sum(list(densities), axis=0), place)
        stored = [weight * _bilinear(self.spectra[i, j], point) for weight, i, j in corners]
        values = np.sum(stored, axis=0, dtype=np.float64)
        if self.divided:
            lit = _bilinear(self.area, (_across(light), (turn + np.pi) / (2 * np.pi)))
            values *= _bilinear(self.normals, place) / (4.0 * lit)
        factors: Array = np.pi * values / view[2]
        return factors

    def _in_stored_part(self, light: Array, view: Array) -> tuple[Array, Array]:
        """Mirror directions into the azimuths that are stored, if these are half of all or less."""
        if self.symmetries < 2:
            return light, view
        y = light[1]
        x = light[0] if self.symmetries == 4 else y
        mirror = np.array([-np.copysign(1.0, x), -np.copysign(1.0, y), 1.0])
        return mirror * light, mirror * view

    def _corners(self, turn: float, theta: float) -> list[tuple[float, int, int]]:
        return [
            (of_turn * of_theta, i, j)
            for i, of_turn in _between(self.phi, turn)
            for j, of_theta in _between(self.theta, theta)
            if of_turn * of_theta > 0.0
        ]


def _across(direction: Array) -> float:
    """Return where the angle from the normal lies on the square's first axis."""
    return float(np.sqrt(np.arccos(np.clip(direction[2], -1.0, 1.0)) * (2.0 / np.pi)))


def _between(grid: Any, value: float) -> list[tuple[int, float]]:
    """Return indices and weights of a linear interpolation, held at the ends."""
    if len(grid) == 1:
        return [(0, 1.0)]
    i = int(np.clip(np.searchsorted(grid, value, side="right") - 1, 0, len(grid) - 2))
    weight = float(np.clip((value - grid[i]) / (grid[i + 1] - grid[i]), 0.0, 1.0))
    return [(i, 1.0 - weight), (i + 1, weight)]


def _cell(size: int, value: float) -> tuple[int, float]:
    scaled = value * (size - 1)
    i = int(min(size - 2, max(0.0, scaled)))  # in this order NaN gives 0, and stays in the rest
    return i, scaled - i


def _bilinear(table: Any, place: tuple[float, float]) -> Any:
    """Return values of tables over the unit square, shape (..., y, x), at (x, y)."""
    (i, right), (j, up) = _cell(table.shape[-1], place[0]), _cell(table.shape[-2], place[1])
    lower = (1.0 - right) * table[..., j, i] + right * table[..., j, i + 1]
    upper = (1.0 - right) * table[..., j + 1, i] + right * table[..., j + 1, i + 1]
    return (1.0 - up) * lower + up * upper


def _sums(values: Array) -> Array:
    """Return sums by the trapezoid rule along the last axis, from 0 on, in cells."""
    found = np.zeros_like(values)
    np.cumsum((values[..., 1:] + values[..., :-1]) / 2.0, axis=-1, out=found[..., 1:])
    return found


def _normalized(density: Array) -> Array:
    """Return a density that is 1 in all, counted in cells."""
    normalized: Array = density / _sums(_sums(density)[:, -1])[-1]
    return normalized


def _inverted(density: Array, place: tuple[float, float]) -> tuple[float, float]:
    """Return the point of the unit square that a density spreads to a place (x, y).

    The density is linear between its nodes; rows are chosen first, and a place within one next.
    """
    (i, right), (j, up) = _cell(density.shape[1], place[0]), _cell(density.shape[0], place[1])
    along = _sums(density)
    left = (1.0 - up) * density[j, i] + up * density[j + 1, i]
    end = (1.0 - up) * density[j, i + 1] + up * density[j + 1, i + 1]
    before = (1.0 - up) * along[j, i] + up * along[j + 1, i]
    lower, upper = along[j, -1], along[j + 1, -1]
    x = (before + right * (left + right * (end - left) / 2.0)) / ((1.0 - up) * lower + up * upper)
    y = _sums(along[:, -1])[j] + up * (lower + up * (upper - lower) / 2.0)
    return float(x), float(y)
