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
from typing import Any

import numpy as np

from .arrays import Array

FEW = 256
"""Directions up to which results are remembered."""

_KEPT = 32
"""Sets of directions that are remembered of one function, the latest."""

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
    def of_bytes(*keys: Any) -> tuple[Array, ...]:
        """Of the bytes of the three, their shapes and their types."""
        angles = zip(keys[:3], keys[3:6], keys[6:], strict=True)
        found = function(*(np.frombuffer(data, of).reshape(shape) for data, shape, of in angles))
        for array in found:
            array.setflags(write=False)
        return found

    @wraps(function)
    def of_arrays(light: Array, view: Array, azimuth: Array) -> tuple[Array, ...]:
        shapes = light.shape, view.shape, azimuth.shape
        # Of angles that broadcast against each other, the results are what would be kept.
        alike = shapes[0] == shapes[1] == shapes[2]
        if (light.size if alike else prod(np.broadcast_shapes(*shapes))) > FEW:
            return function(light, view, azimuth)
        kinds = light.dtype.str, view.dtype.str, azimuth.dtype.str  # the order of bytes, too
        return of_bytes(light.tobytes(), view.tobytes(), azimuth.tobytes(), *shapes, *kinds)

    return of_arrays
