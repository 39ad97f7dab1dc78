# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rungs of the ladder: five models of the same surface, cheapest first.

lambert       r = ρ
first-order   r = F1 ρ                             light that leaves after one bounce
two-bounce    r = F1 ρ + F2 ρ²                     the published model: `core.oren_nayar`
closure       r = ρ (b + a / (1 + √(1 - g ρ)))     all bounces, fitted: `core.closure`
reference     r = Σ a_k ρ^k                        what the others approximate: `core.vcavity`
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from . import closure, oren_nayar, vcavity
from .arrays import Array, polar_angle, slope_deviation, spectrum
from .errors import DomainError

RUNGS = ("lambert", "first-order", "two-bounce", "closure", "reference")
"""Names of the models, cheapest first."""


def reflectance(
    model: str,
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Reflectance factor r(λ) by the model of one rung.

    Parameters
    ----------
    model
        One of `RUNGS`.
    albedo
        ρ(λ), shape (..., bands).
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2].
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Roughness, radians in [0, π/2]. The four broadcast against the leading axes of `albedo`.

    Returns
    -------
    Array of shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If the model is unknown, an angle lies outside its range or `albedo` has no band axis.
    """
    if model not in _FORMULAS:
        msg = f"Model {model!r} is not known; choose one of {', '.join(RUNGS)}."
        raise DomainError(msg)
    return _FORMULAS[model](albedo, theta_i, theta_r, delta_phi, sigma)


def _lambert(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    rho = spectrum(albedo, "the albedo")
    checked = (
        polar_angle(theta_i, "theta_i", rho.dtype),
        polar_angle(theta_r, "theta_r", rho.dtype),
        np.asarray(delta_phi, rho.dtype),
        slope_deviation(sigma, rho.dtype),
    )
    leading = np.broadcast_shapes(rho.shape[:-1], *(array.shape for array in checked))
    return np.broadcast_to(rho, (*leading, rho.shape[-1])).copy()


def _first_order(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    rho = spectrum(albedo, "the albedo")
    angles = (np.asarray(angle, rho.dtype) for angle in (theta_i, theta_r, delta_phi, sigma))
    f1, _ = oren_nayar.factors(*angles)
    return np.asarray(f1[..., np.newaxis] * rho, rho.dtype)


_FORMULAS: dict[str, Callable[..., Array]] = {
    "lambert": _lambert,
    "first-order": _first_order,
    "two-bounce": oren_nayar.reflectance,
    "closure": closure.reflectance,
    "reference": vcavity.reflectance,
}
