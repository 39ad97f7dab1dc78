# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Emissivity of the V-cavity surface: a model of `core.emissivity.surface`."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array
from ..vcavity import bounce_series, hemisphere


def of_direction(theta: npt.ArrayLike, sigma: npt.ArrayLike, slopes: str) -> Array:
    """Rows of `core.vcavity.hemisphere`; arguments and errors as there.

    Examples
    --------
    >>> of_direction(0.7, 0.0, "gaussian")[:3].tolist()
    [1.0, 0.0, 0.0]
    """
    return hemisphere.series(theta, sigma, slopes=slopes)


def emissivity(rows: Array, rho: Array) -> Array:
    """1 - Σ a_k ρ^k of rows (..., K + J) at albedos (..., bands); leading axes broadcast.

    Examples
    --------
    >>> emissivity(of_direction(0.7, 0.0, "gaussian"), np.array([0.25, 1.0])).tolist()
    [0.75, 0.0]
    """
    return np.asarray(1 - bounce_series.evaluate(rows, rho))


def albedo(rows: Array, epsilon: Array) -> Array:
    """Invert `emissivity`.

    Examples
    --------
    >>> albedo(of_direction(0.7, 0.0, "gaussian"), np.array([0.75, -0.5])).tolist()
    [0.25, 1.5]
    """
    return bounce_series.invert(rows, 1 - epsilon)
