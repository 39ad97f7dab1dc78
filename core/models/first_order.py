# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "first-order": r = F1 ρ, the published one without its second bounce."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .. import oren_nayar
from ..numerics.arrays import Array, spectrum
from .two_bounce import over_coefficients


def reflectance(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Give F1 ρ(λ); arguments and errors as in `core.ladder.reflectance`.

    Examples
    --------
    >>> np.round(reflectance([0.2, 0.6], 0.8, 0.0, 0.0, 0.5), 4).tolist()
    [0.1569, 0.4707]
    """
    rho = spectrum(albedo, "the albedo")
    angles = (np.asarray(angle, rho.dtype) for angle in (theta_i, theta_r, delta_phi, sigma))
    f1, _ = oren_nayar.factors(*angles)
    return np.asarray(f1[..., np.newaxis] * rho, rho.dtype)


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give r = f1 ρ; arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6], 0.5, "45a:0"), 4).tolist()
    [0.1569, 0.4707]
    """
    return over_coefficients(_forward, spectrum(albedo, "the albedo"), sigma, instrument)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Invert `from_albedo`; arguments and errors as in `core.reading.to_albedo`.

    Examples
    --------
    >>> np.round(to_albedo(from_albedo([0.2, 0.6], 0.5, "di:8"), 0.5, "di:8"), 12).tolist()
    [0.2, 0.6]
    """
    return over_coefficients(_inverse, spectrum(reading, "the reading"), sigma, instrument)


def _forward(out: Array, rho: Array, f1: Array, _f2: Array) -> None:
    np.multiply(f1, rho, out=out)


def _inverse(out: Array, r: Array, f1: Array, _f2: Array) -> None:
    np.divide(r, f1, out=out)
