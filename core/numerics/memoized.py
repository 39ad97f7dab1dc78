# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remember what depends on directions alone, which come again while everything else changes.

While σ is dragged a material is computed at every step for the same few directions, and most of the
time of so few goes into calling numpy. Of many directions nothing is kept: there the time goes into
the numbers, and keeping them costs memory.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, wraps
from math import prod

import numpy as np

from .arrays import Array

FEW = 256
"""Directions up to which results are remembered."""

_KEPT = 32
"""Sets of directions that are remembered of one function, the latest."""

_Key = tuple[bytes, tuple[int, ...], str]

Directions = Callable[[Array, Array, Array], tuple[Array, ...]]
"""A function of θi, θr and Δφ that depends on nothing else."""


def remembered(function: Directions) -> Directions:
    """Let a function of θi, θr and Δφ remember its results, which are read-only then.

    Examples
    --------
    >>> def sums(light, view, azimuth):
    ...     return (light + view + azimuth,)
    >>> of_few = remembered(sums)
    >>> of_few(np.ones(2), np.ones(2), np.zeros(2))[0].tolist()
    [2.0, 2.0]
    >>> of_few(np.ones(2), np.ones(2), np.zeros(2))[0].flags.writeable
    False
    """

    @lru_cache(maxsize=_KEPT)
    def of_bytes(*keys: _Key) -> tuple[Array, ...]:
        light, view, azimuth = (
            np.frombuffer(data, dtype).reshape(shape) for data, shape, dtype in keys
        )
        found = function(light, view, azimuth)
        for array in found:
            array.setflags(write=False)
        return found

    @wraps(function)
    def of_arrays(light: Array, view: Array, azimuth: Array) -> tuple[Array, ...]:
        angles = (light, view, azimuth)
        shapes = {angle.shape for angle in angles}
        # Of angles that broadcast against each other, the results are what would be kept.
        if prod(shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)) > FEW:
            return function(*angles)
        return of_bytes(*((angle.tobytes(), angle.shape, angle.dtype.str) for angle in angles))

    return of_arrays
