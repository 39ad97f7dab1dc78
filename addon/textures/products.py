# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Products over the bands of many pixels, in pieces that one core works through."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from .image import Pixels

_PIXELS_AT_ONCE = 512


def times(values: Pixels, matrix: Pixels) -> Pixels:
    """Multiply (pixels, bands) by (bands, 3), some pixels at a time.

    Of all at once OpenBLAS gives a part to each core, and these wait for each other by spinning: up
    to twenty times as long where another program has a core.
    """
    out = np.empty((len(values), matrix.shape[1]), np.float32)
    whole = len(values) // _PIXELS_AT_ONCE * _PIXELS_AT_ONCE
    stacked = values[:whole].reshape(-1, _PIXELS_AT_ONCE, len(matrix))
    np.matmul(stacked, matrix, out=out[:whole].reshape(*stacked.shape[:2], matrix.shape[1]))
    np.matmul(values[whole:], matrix, out=out[whole:])
    return out


def total(values: Pixels) -> Array:
    """Add pixels up, shape (bands,), for the reason of `times` some at a time."""
    whole = len(values) // _PIXELS_AT_ONCE * _PIXELS_AT_ONCE
    stacked = values[:whole].reshape(-1, _PIXELS_AT_ONCE, values.shape[1])
    sums = np.ones((1, _PIXELS_AT_ONCE), np.float32) @ stacked
    rest = values[whole:].sum(axis=0, dtype=np.float64)
    return np.asarray(sums.sum(axis=(0, 1), dtype=np.float64) + rest)
