# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Color and roughness with which Cycles reads the same as a target.

The color follows from the reading at the instrument, exactly; the one scalar roughness is searched
so that the other directions come out closest.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from ..color.color_difference import delta_e
from ..numerics.arrays import Array, spectrum
from .instrument_lobe import mean_direction
from .lobe import (
    Lobe,
    check_roughness,
    directions,
    lobe,
    reflected,
)

_NEWTON_STEPS = 12
"""Newton on a convex cubic from above needs at most 7 steps to full double precision for c ≤ 1."""
_SURE_STEPS = 2
"""Steps taken by all: to ask whether a color needs them costs nearly as much as a step."""

_COARSE = np.linspace(0, 1, 9)
"""Roughnesses tried at first."""
_FINE = np.linspace(0, 1, 17)
"""Those tried next, between the neighbors of the best. Steps are 1/64 then, and a parabola goes on
from there."""
_KNOWN = np.arange(_FINE.size) % 8 == 0
"""Those of them that were tried before."""
_AROUND = np.arange(-1, 2)
_CHUNK = 64
"""Materials matched at once: 1 to 2 MB of colors."""


def color_for_reading(
    reading: npt.ArrayLike, roughness: npt.ArrayLike, instrument: str = "45a:0"
) -> Array:
    """Socket color whose reading in Cycles is the given one, channel by channel.

    Parameters
    ----------
    reading
        Reflectance factor in scene-linear RGB, shape (..., 3).
    roughness
        Cycles' roughness, broadcast against the leading axes of `reading`.
    instrument
        Where the reading is taken, one of `core.instruments.REGISTRY`.

    Returns
    -------
    Color, shape (..., 3). Above 1 where no color reaches the reading, negative where the reading
    is: nothing is clipped. NaN where the reading is NaN or infinite.

    Raises
    ------
    DomainError
        If the roughness lies outside 0 to 1 or the instrument is unknown.

    Examples
    --------
    >>> color = color_for_reading([0.157, 0.4161, 0.742], 1.0)
    >>> np.round(color, 3).tolist()
    [0.2, 0.5, 0.8]
    """
    r = spectrum(reading, "the reading")
    s = np.asarray(roughness, r.dtype)
    check_roughness(s)
    return _color(r, lobe(s, *mean_direction(instrument, r.dtype)))


def match(
    reading: npt.ArrayLike,
    targets: npt.ArrayLike,
    geometries: tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike],
    perceive: Callable[[Array], Array],
    instrument: str = "45a:0",
) -> tuple[Array, Array]:
    """Choose color and roughness so that Cycles reads the same as the target.

    The reading at the instrument is met exactly; the one scalar roughness then brings the other
    geometries closest, in the mean of CIEDE2000. At 45°/0° a reading of at most 1 needs no color
    above 1, because a white lobe of any roughness reads at least 1 there.

    Parameters
    ----------
    reading
        Target reading at the instrument in scene-linear RGB, shape (materials, 3).
    targets
        Target reflectance factor at other geometries, shape (materials, geometries, 3).
    geometries
        θi, θr and Δφ of those geometries, radians, each of shape (geometries,).
    perceive
        Turns scene-linear RGB (..., 3) into L*a*b*.
    instrument
        One of `core.instruments.REGISTRY`.

    Returns
    -------
    color, roughness
        Shapes (materials, 3) and (materials,). The color is unclipped, as in
        `color_for_reading`.

    Raises
    ------
    DomainError
        If a polar angle lies outside [0, π/2] or the instrument is unknown.

    Examples
    --------
    >>> angles = np.radians([[45.0, 60.0], [10.0, 50.0], [0.0, 180.0]])
    >>> color, rough = np.array([[0.2, 0.5, 0.8]]), np.array(0.6)
    >>> read = reflected(color, lobe(rough, *mean_direction("45a:0", color.dtype)))
    >>> targets = reflected(color[:, np.newaxis], lobe(rough, *directions(*angles)))
    >>> def perceive(rgb):
    ...     return 100 * rgb  # stands for L*a*b*
    >>> found, roughness = match(read, targets, angles, perceive)
    >>> np.round(found, 2).tolist(), np.round(roughness, 2).tolist()
    ([[0.2, 0.5, 0.8]], [0.6])
    """
    r = spectrum(reading, "the reading")
    wanted = spectrum(targets, "the targets")
    others = directions(*(np.asarray(angles, r.dtype) for angles in geometries))
    read_at = mean_direction(instrument, r.dtype)
    roughness = np.empty(len(r), r.dtype)
    for start in range(0, len(r), _CHUNK):
        chunk = slice(start, start + _CHUNK)
        of_chunk, goal = r[chunk, np.newaxis], perceive(wanted[chunk, np.newaxis])

        def cost(tried: Array, of_chunk: Array = of_chunk, goal: Array = goal) -> Array:
            color = _color(of_chunk, lobe(tried, *read_at))
            seen = reflected(color[..., np.newaxis, :], lobe(tried[..., np.newaxis], *others))
            apart = delta_e(perceive(seen), goal)
            return np.asarray(np.add.reduce(apart, axis=-1) / apart.shape[-1])

        roughness[chunk] = _least(cost, len(of_chunk), r.dtype)
    return _color(r, lobe(roughness, *read_at)), roughness


def _least(cost: Callable[[Array], Array], count: int, dtype: np.dtype[Any]) -> Array:
    """Find where between 0 and 1 each of `count` costs is least; (count, n) -> (count, n).

    Many places a call and few calls: numpy spends more on a call than on a hundred numbers.
    """
    tried = np.tile(_COARSE.astype(dtype), (count, 1))
    near, known = _around_least(tried, cost(tried))
    low, high = near[:, :1], near[:, 2:]
    tried = low + (high - low) * _FINE.astype(dtype)
    costs = np.empty_like(tried)
    costs[:, _KNOWN], costs[:, ~_KNOWN] = known, cost(tried[:, ~_KNOWN])
    (a, b, c), (at_a, at_b, at_c) = (x.T for x in _around_least(tried, costs))
    # The vertex of the parabola through the last three; where all are alike, the middle.
    bend = at_a - 2 * at_b + at_c
    vertex = b + (c - a) / 4 * (at_a - at_c) / np.where(bend > 0, bend, np.inf)
    return np.asarray(
        np.where((at_b <= at_a) & (at_b <= at_c), vertex, np.where(at_a < at_c, a, c))
    )


def _around_least(tried: Array, costs: Array) -> tuple[Array, Array]:
    """Give three neighbors with the least cost among them, and in the middle unless at an end."""
    middle = np.minimum(np.maximum(costs.argmin(axis=1), 1), costs.shape[1] - 2)
    row, column = np.arange(len(costs))[:, np.newaxis], middle[:, np.newaxis] + _AROUND
    return tried[row, column], costs[row, column]


def _color(r: Array, terms: Lobe) -> Array:
    """Invert `core.cycles.reflected` by Newton's method.

    r (1 - D c) = A c (1 - D c) + B c³. The start lies above the root and the cubic is convex there,
    so Newton comes down to the root without overshooting.
    """
    single, multiple, ratio = terms
    c = r / single
    # The step after one this small is below the last place: Newton doubles the digits.
    settled, moving = np.sqrt(np.finfo(r.dtype).eps) / 8, np.True_
    with np.errstate(invalid="ignore"):
        square, line = -single * ratio, single + r * ratio
        slope_cube, slope_square = 3 * multiple, 2 * square

        def step(c: Array) -> Array:
            value = ((multiple * c + square) * c + line) * c - r
            return np.asarray(value / ((slope_cube * c + slope_square) * c + line))

        for _ in range(_SURE_STEPS):
            c = c - step(c)
        for _ in range(_NEWTON_STEPS - _SURE_STEPS):
            last = np.where(moving, step(c), 0)
            c = c - last
            moving = np.abs(last) > settled * np.abs(c)
            if not np.count_nonzero(moving):
                break
    return np.asarray(c)
