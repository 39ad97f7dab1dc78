# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "lambert": r = ρ, whatever the roughness."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .. import instruments
from ..numerics.arrays import (
    Array,
    polar_angle,
    slope_deviation,
    spectrum,
)


def reflectance(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Give ρ(λ) in every direction; arguments and errors as in `core.ladder.reflectance`.

    Examples
    --------
    >>> reflectance([0.2, 0.6], [0.0, 0.8], 0.0, 0.0, 0.5).tolist()
    [[0.2, 0.6], [0.2, 0.6]]
    """
    rho = spectrum(albedo, "the albedo")
    checked = (
        polar_angle(theta_i, "theta_i", rho.dtype),
        polar_angle(theta_r, "theta_r", rho.dtype),
        np.asarray(delta_phi, rho.dtype),
        slope_deviation(sigma, rho.dtype),
    )
    return _spread(rho, *checked)


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give ρ(λ) at every instrument; arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> from_albedo([0.2, 0.6], 0.5, "di:8").tolist()
    [0.2, 0.6]
    """
    instruments.find(instrument)
    return _read(spectrum(albedo, "the albedo"), sigma)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give the reading itself; arguments and errors as in `core.reading.to_albedo`.

    NaN and infinity are NaN, as for every model.

    Examples
    --------
    >>> to_albedo([0.2, 0.6], 0.5, "di:8").tolist()
    [0.2, 0.6]
    """
    instruments.find(instrument)
    found = _read(spectrum(reading, "the reading"), sigma)
    found[np.isinf(found)] = np.nan
    return found


def _read(values: Array, sigma: npt.ArrayLike) -> Array:
    """Repeat spectra for every σ; NaN where σ is, as with every model."""
    spread = slope_deviation(sigma, values.dtype)
    found = _spread(values, spread)
    found[np.broadcast_to(np.isnan(spread), found.shape[:-1])] = np.nan
    return found


def _spread(values: Array, *others: Array) -> Array:
    """Repeat spectra over the axes of the others, which broadcast against their leading ones."""
    leading = np.broadcast_shapes(values.shape[:-1], *(array.shape for array in others))
    return np.broadcast_to(values, (*leading, values.shape[-1])).copy()
