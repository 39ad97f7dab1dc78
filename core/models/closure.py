# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "closure": all bounces in one square root, see `core.closure`."""

from __future__ import annotations

import numpy.typing as npt

from ..closure import (
    forward,
    inverse,
    over_blocks,
    reflectance,
)
from ..instruments import curves
from ..numerics.arrays import Array, spectrum

__all__ = ["from_albedo", "reflectance", "to_albedo"]


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give r = ρ (b + a / (1 + √(1 - g ρ))); arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6], 0.5, "45a:0"), 3).tolist()
    [0.164, 0.531]
    """
    rho = spectrum(albedo, "the albedo")
    return over_blocks(forward, curves.closure_coefficients(sigma, instrument), rho)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Invert `from_albedo`; arguments and errors as in `core.reading.to_albedo`.

    Examples
    --------
    >>> np.round(to_albedo(from_albedo([0.2, 0.6], 0.5, "45a:0"), 0.5, "45a:0"), 12).tolist()
    [0.2, 0.6]
    """
    r = spectrum(reading, "the reading")
    return over_blocks(inverse, curves.closure_coefficients(sigma, instrument), r)
