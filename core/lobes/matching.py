# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Color and roughness with which a lobe reads the same as a target.

As for Cycles (`core.cycles.matching`): the color follows from the reading at the instrument,
exactly, and the one roughness brings the other directions closest. Channels may be RGB or the
bands of a spectrum: then each band reads what it should.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..color.color_difference import delta_e
from ..numerics.arrays import Array
from .lobe import Lobe, color_for, reflected

_TRIED = np.linspace(0, 1, 17)
"""Parts of the largest roughness that are tried, and between the neighbors of the best again."""
_ZOOMS = 3
"""After them roughness is known to a thousandth of the largest."""
_LIMITS = np.linspace(0, 1, 129)
_ROUNDING = 1e-9


def match(
    lobe: Lobe,
    reading: npt.ArrayLike,
    targets: npt.ArrayLike,
    geometries: tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike],
    perceive: Callable[[Array], Array],
    instrument: str = "45a:0",
) -> tuple[Array, float]:
    """Choose color and roughness so that a lobe reads the same as the target.

    Some lobes darken as they get rougher, and bright colors then end above 1: the roughness stays
    where the color is one, since the reading at the instrument comes first.

    Parameters
    ----------
    lobe
        One of `core.lobes.ALL`.
    reading
        Target reading at the instrument, shape (channels,).
    targets
        Target reflectance factor in other directions, shape (directions, channels).
    geometries
        θi, θr and Δφ of those, radians, each of shape (directions,).
    perceive
        Turns channels (..., channels) into L*a*b*.
    instrument
        One of `core.instruments.REGISTRY`.

    Returns
    -------
    color, roughness
        Shape (channels,), unclipped, and the roughness in the lobe's own unit.

    Examples
    --------
    >>> from core.lobes import EON
    >>> angles = np.radians([[45.0, 60.0], [10.0, 50.0], [0.0, 180.0]])
    >>> color = np.array([0.2, 0.5, 0.8])
    >>> read = reflected(color, EON.at(0.6, "45a:0"))
    >>> targets = EON.reflectance(color, 0.6, *angles)
    >>> found, roughness = match(EON, read, targets, angles, lambda rgb: 100 * rgb)
    >>> np.round(found, 2).tolist(), round(roughness, 2)
    ([0.2, 0.5, 0.8], 0.6)
    """
    r, goal = np.asarray(reading, np.float64), perceive(np.asarray(targets, np.float64))
    angles = tuple(np.asarray(each, np.float64) for each in geometries)

    def cost(roughness: Array) -> Array:
        color = color_for(r, lobe.at(roughness, instrument))
        seen = reflected(color[:, np.newaxis], lobe.terms(roughness[:, np.newaxis], *angles))
        return np.asarray(delta_e(perceive(seen), goal).mean(axis=-1))

    low, high = 0.0, _largest(lobe, r, instrument)
    best = 0.0
    for _ in range(_ZOOMS if high else 0):
        tried = low + (high - low) * _TRIED
        at = int(np.argmin(cost(tried)))
        best, low, high = (
            float(tried[min(max(i, 0), tried.size - 1)]) for i in (at, at - 1, at + 1)
        )
    return color_for(r, lobe.at(best, instrument)), best


def _largest(lobe: Lobe, reading: Array, instrument: str) -> float:
    """Give the largest roughness up to which no channel needs a color above 1."""
    if not lobe.largest:
        return 0.0
    tried = lobe.largest * _LIMITS
    needed = color_for(reading, lobe.at(tried, instrument)).max(axis=-1)
    too_bright = np.flatnonzero(needed > max(1.0, needed[0]) + _ROUNDING)
    return float(tried[too_bright[0] - 1] if too_bright.size else tried[-1])
