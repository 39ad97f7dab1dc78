# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Roughness σ and what a profilometer prints: tan σ is the rms slope of a profile.

Rdq (also RΔq) is the rms slope along a profile, Sdq the rms slope of an area, steepest way up.
Where a surface is the same in all directions, both components of the slope have the same mean
square, so that Sdq is √2 times Rdq. Both are slopes, rise over run, and no angles.

Sources: ISO 21920-2:2021 (Rdq), ISO 25178-2:2021 (Sdq).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .errors import DomainError
from .numerics.arrays import Array

RDQ = "Rdq"
SDQ = "Sdq"

_PROFILES = 2.0**0.5
"""Sdq over Rdq of a surface without a direction."""


def sigma_from_rdq(rdq: npt.ArrayLike) -> Array:
    """Give the roughness σ of a surface from the rms slope of its profile.

    Parameters
    ----------
    rdq
        Rise over run, 0 or larger, any shape.

    Returns
    -------
    σ in radians, 0 to below π/2, in the same shape; NaN stays NaN.

    Raises
    ------
    DomainError
        If a slope is negative or infinite.

    Examples
    --------
    >>> np.degrees(sigma_from_rdq([0.0, 0.5, 1.0])).round(2).tolist()
    [0.0, 26.57, 45.0]
    """
    return np.arctan(_slope(rdq, RDQ))


def sigma_from_sdq(sdq: npt.ArrayLike) -> Array:
    """Give the roughness σ of a surface without a direction from the rms slope of its area.

    Parameters, results and errors as of `sigma_from_rdq`.

    Examples
    --------
    >>> round(float(np.degrees(sigma_from_sdq(2**0.5))), 2)
    45.0
    """
    return np.arctan(_slope(sdq, SDQ) / _PROFILES)


def rdq_from_sigma(sigma: npt.ArrayLike) -> Array:
    """Give the rms slope of a profile from the roughness σ; undoes `sigma_from_rdq`.

    Parameters
    ----------
    sigma
        Radians, 0 to below π/2, any shape.

    Raises
    ------
    DomainError
        If σ is outside: a wall has no slope that a number tells.

    Examples
    --------
    >>> rdq_from_sigma(np.radians([0, 30, 45])).round(3).tolist()
    [0.0, 0.577, 1.0]
    """
    angle = np.asarray(sigma, dtype=float)
    if (angle < 0).any() or (angle >= np.pi / 2).any():
        msg = "σ has to be 0 or larger and below π/2 to have a slope."
        raise DomainError(msg)
    return np.tan(angle)


def sdq_from_sigma(sigma: npt.ArrayLike) -> Array:
    """Give the rms slope of an area from the roughness σ; undoes `sigma_from_sdq`.

    Parameters and errors as of `rdq_from_sigma`.

    Examples
    --------
    >>> round(float(sdq_from_sigma(np.pi / 4)), 4)
    1.4142
    """
    return rdq_from_sigma(sigma) * _PROFILES


def _slope(given: npt.ArrayLike, name: str) -> Array:
    slope = np.asarray(given, dtype=float)
    if (slope < 0).any() or np.isinf(slope).any():
        msg = f"{name} is an rms slope, rise over run: it has to be 0 or larger, and finite."
        raise DomainError(msg)
    return slope
