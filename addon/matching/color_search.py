# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find the color with which something that can only be measured reads as it should.

Nothing is known of what lies between the color and the reading, but that it changes smoothly. A
measurement of several colors costs hardly more than of one, so each comes with its neighbors:

1. Nine grays and the color that is there tell, channel by channel, about where to look.
2. Then the best color so far is measured together with three that differ in one channel each, and
   Newton's step with the Jacobian of these leads on. Channels may mix.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass

import numpy as np

from ...core.color.color_difference import delta_e
from ...core.numerics.arrays import Array

ENOUGH = 0.02
"""ΔE00 below which the search ends."""

GOOD = 0.1
"""ΔE00 up to which a reading counts as met."""

MEASUREMENTS = 5
"""At most."""

_ROOTS = np.linspace(0, 1, 9)
_GRAYS = _ROOTS**2
"""Denser in the dark, where a difference is seen sooner."""
_ASIDE = 0.02
"""By how much a neighbor differs at first; then by a part of the step that led there."""
_PART = 0.25
_LEAST_ASIDE = 1e-3
_FLAT = 1e-4
"""Change of the reading, over all colors, below which the color has no say."""

Search = Generator[Array, Array, "Found"]


@dataclass(frozen=True, eq=False)
class Found:
    """What a search ended with.

    Attributes
    ----------
    color
        Within 0 to 1, shape (3,).
    reading
        As measured with it, shape (3,).
    difference
        ΔE00 between reading and target.
    measurements
        How many there were.
    darkest, brightest
        Readings with black and with white, shape (3,): what any color can come to, where channels
        don't mix.
    """

    color: Array
    reading: Array
    difference: float
    measurements: int
    darkest: Array
    brightest: Array

    @property
    def is_met(self) -> bool:
        """Whether the reading is the target."""
        return self.difference <= GOOD

    @property
    def has_say(self) -> bool:
        """Whether the color changes the reading at all."""
        return bool(np.abs(self.brightest - self.darkest).max() > _FLAT)


def search(target: Array, start: Array, perceive: Callable[[Array], Array]) -> Search:
    """Search as a generator: it yields colors to measure and is sent their readings.

    Parameters
    ----------
    target
        Reading that is wanted, scene-linear RGB, shape (3,).
    start
        Color that is there, shape (3,).
    perceive
        Turns scene-linear RGB (..., 3) into L*a*b*.

    Yields
    ------
    Colors (n, 3) within 0 to 1; readings of the same shape are to be sent back.

    Examples
    --------
    >>> def lab(rgb):
    ...     return 100 * rgb  # stands for L*a*b*
    >>> searching = search(np.array([0.1, 0.2, 0.3]), np.array([0.5, 0.5, 0.5]), lab)
    >>> colors = next(searching)
    >>> try:
    ...     while True:
    ...         colors = searching.send(0.05 + 0.8 * colors**2)
    ... except StopIteration as end:
    ...     found = end.value
    >>> np.round(found.color, 3).tolist(), found.is_met
    ([0.25, 0.433, 0.559], True)
    """
    goal = perceive(target)
    start = np.minimum(np.maximum(start, 0), 1)
    tried = np.concatenate((np.repeat(_GRAYS, 3).reshape(-1, 3), start[np.newaxis]))
    read = yield tried
    darkest, brightest = read[0], read[_GRAYS.size - 1]
    away = delta_e(perceive(read), goal)
    best = int(away.argmin())
    color, reading, difference = tried[best], read[best], float(away[best])
    count = 1
    guess = np.array([_between(read[: _GRAYS.size, k], target[k]) for k in range(3)])
    apart = np.full(3, _ASIDE)
    is_flat = np.abs(brightest - darkest).max() <= _FLAT
    while not is_flat and difference > ENOUGH and count < MEASUREMENTS:
        aside = np.where(guess <= 0.5, apart, -apart)
        tried = np.concatenate((guess[np.newaxis], guess + np.diag(aside)))
        read = yield tried
        count += 1
        away = delta_e(perceive(read), goal)
        nearest = int(away.argmin())
        if away[nearest] < difference:
            color, reading, difference = tried[nearest], read[nearest], float(away[nearest])
        jacobian = (read[1:] - read[0]).T / aside
        step, *_ = np.linalg.lstsq(jacobian, target - read[0], rcond=1e-6)
        following = np.minimum(np.maximum(guess + step, 0), 1)
        if np.abs(following - guess).max() < 1e-6:
            break  # the nearest that there is
        apart = np.clip(_PART * np.abs(following - guess), _LEAST_ASIDE, _ASIDE)
        guess = following
    return Found(color, reading, difference, count, darkest, brightest)


def _between(readings: Array, wanted: float) -> float:
    """Give where a channel reads what is wanted, by the grays; the nearest end beyond them."""
    order = np.argsort(readings, kind="stable")
    return float(np.interp(wanted, readings[order], _ROOTS[order])) ** 2
