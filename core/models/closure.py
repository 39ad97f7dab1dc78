# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "closure": V-grooves with all bounces in closed form, see `core.vcavity.closed`."""

from __future__ import annotations

import numpy.typing as npt

from ..closure.formula import forward, inverse, over_blocks
from ..instruments import curves
from ..numerics.arrays import Array, spectrum
from ..vcavity.closed import TABLE, reflectance

__all__ = ["from_albedo", "reflectance", "to_albedo"]


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give r = ρ (b + a / (1 + √(1 - g ρ))); arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6], 0.5, "45a:0"), 3).tolist()
    [0.17, 0.55]
    """
    rho = spectrum(albedo, "the albedo")
    return over_blocks(forward, curves.of_table(TABLE, sigma, instrument), rho)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Invert `from_albedo`; arguments and errors as in `core.reading.to_albedo`.

    Examples
    --------
    >>> np.round(to_albedo(from_albedo([0.2, 0.6], 0.5, "45a:0"), 0.5, "45a:0"), 12).tolist()
    [0.2, 0.6]
    """
    r = spectrum(reading, "the reading")
    return over_blocks(inverse, curves.of_table(TABLE, sigma, instrument), r)
