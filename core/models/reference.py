# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "reference": the V-cavity with all its bounces, see `core.vcavity`."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..instruments import curves
from ..numerics.arrays import Array, spectrum
from ..vcavity import bounce_series, reflectance

__all__ = ["from_albedo", "reflectance", "to_albedo"]


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give r = Σ a_k ρ^k; arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6], 0.5, "45a:0"), 3).tolist()
    [0.17, 0.55]
    """
    rho = spectrum(albedo, "the albedo")
    rows = curves.series(instrument).rows(sigma)
    with np.errstate(invalid="ignore"):  # ∞ - ∞ is NaN, and needs no warning beside it
        return bounce_series.evaluate(rows, rho)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Invert `from_albedo`; arguments and errors as in `core.reading.to_albedo`.

    Examples
    --------
    >>> np.round(to_albedo(from_albedo([0.2, 0.6], 0.5, "45a:0"), 0.5, "45a:0"), 12).tolist()
    [0.2, 0.6]
    """
    r = spectrum(reading, "the reading")
    return bounce_series.invert(curves.series(instrument).rows(sigma), r)
