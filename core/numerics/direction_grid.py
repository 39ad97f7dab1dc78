# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sets of light and view directions that stand for the hemisphere."""

from __future__ import annotations

import numpy as np

from .arrays import Array
from .memoized import memoized

STEEPEST = np.radians(80.0)
"""Matching and its error figures stop here; beyond, the published model itself breaks down."""

_PLASTIC = 1.2207440846057596
"""Real root of x⁴ = x + 1; its powers give the least clumped sequence in three dimensions
(M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018)."""


@memoized(maxsize=16)
def hemisphere(count: int, steepest: float = STEEPEST) -> tuple[Array, Array, Array]:
    """Spread light and view directions over the hemisphere, each with density cos θ.

    The same count always gives the same directions.

    Parameters
    ----------
    count
        How many geometries.
    steepest
        Largest polar angle, radians.

    Returns
    -------
    θi, θr, Δφ
        Radians, each of shape (count,), read-only; Δφ in [0, π].

    Examples
    --------
    >>> light, view, azimuth = hemisphere(1000)
    >>> light.shape, bool(light.max() <= STEEPEST)
    ((1000,), True)
    >>> round(float(np.mean(np.sin(light) ** 2) / np.sin(STEEPEST) ** 2), 2)
    0.5
    """
    steps = _PLASTIC ** -np.arange(1.0, 4.0)
    u = (0.5 + np.arange(1, count + 1)[:, np.newaxis] * steps) % 1.0
    # sin² θ is uniform when directions have density cos θ.
    theta = np.arcsin(np.sqrt(u[:, :2]) * np.sin(steepest))
    found = theta[:, 0], theta[:, 1], np.pi * u[:, 2]
    for angles in found:
        angles.setflags(write=False)
    return found
