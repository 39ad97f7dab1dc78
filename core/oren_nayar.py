# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral Oren-Nayar reflectance: r(λ) = F1 ρ(λ) + F2 ρ(λ)².

F1 and F2 depend on geometry and roughness alone, so any number of bands costs one rank-2 product.

Source: M. Oren and S. K. Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994,
the functional model with interreflection (equations 30 and 31). The constants 0.57 of the paper's
qualitative model and 2/π - 1 of the 1993 fit belong to other models and are not used here.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .arrays import Array, polar_angle, precision, slope_deviation, spectrum


def first_bounce_at_normal(s2: Array) -> Array:
    """C1 of the model: what is left of the first bounce when light or view is along the normal.

    `s2` is σ². Equals F1 wherever min(θi, θr) = 0.
    """
    return 1 - 0.5 * s2 / (s2 + 0.33)


def second_bounce_at_normal(s2: Array) -> Array:
    """F2 of the model when light or view is along the normal. `s2` is σ²."""
    return 0.17 * s2 / (s2 + 0.13)


def factors(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> tuple[Array, Array]:
    """Weights of ρ and ρ² in the reflectance factor of a rough surface.

    Parameters
    ----------
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2].
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Standard deviation of the facet slope angle, radians in [0, π/2].
        All four broadcast against each other.

    Returns
    -------
    F1, F2
        Arrays of the broadcast shape; float32 if every array given is float32, else float64.
        With θi and θr both at π/2 the published F1 grows without bound; it is returned as the
        large number it is.

    Raises
    ------
    DomainError
        If an angle lies outside its range. NaN passes and stays where it was.
    """
    dtype = precision(theta_i, theta_r, delta_phi, sigma)
    light = polar_angle(theta_i, "theta_i", dtype)
    view = polar_angle(theta_r, "theta_r", dtype)
    s2 = slope_deviation(sigma, dtype) ** 2
    cos_phi = np.cos(np.asarray(delta_phi, dtype=dtype))
    alpha, beta = np.maximum(light, view), np.minimum(light, view)
    slant = beta * dtype.type(2 / np.pi)

    c1 = first_bounce_at_normal(s2)
    c2 = 0.45 * s2 / (s2 + 0.09) * (np.sin(alpha) - np.where(cos_phi < 0, slant**3, dtype.type(0)))
    c3 = 0.125 * s2 / (s2 + 0.09) * (alpha * slant * dtype.type(2 / np.pi)) ** 2
    f1 = c1 + cos_phi * c2 * np.tan(beta) + (1 - np.abs(cos_phi)) * c3 * np.tan((alpha + beta) / 2)
    f2 = second_bounce_at_normal(s2) * (1 - cos_phi * slant**2)
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(f1, dtype), np.asarray(f2, dtype)


def reflectance(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Reflectance factor r(λ) of a rough surface whose facets have the given albedo.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    theta_i, theta_r, delta_phi, sigma
        As in `factors`; they broadcast against the leading axes of `albedo`.

    Returns
    -------
    Array of shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If an angle lies outside its range or `albedo` has no band axis.
    """
    rho = spectrum(albedo, "the albedo")
    geometry = (np.asarray(g, dtype=rho.dtype) for g in (theta_i, theta_r, delta_phi, sigma))
    f1, f2 = factors(*geometry)
    if rho.ndim == 1:
        pairs = np.stack(np.broadcast_arrays(f1, f2), axis=-1)
        return np.asarray(pairs @ np.stack((rho, rho * rho)))
    # Horner's form in place: one array of the output's size and no other.
    out = np.asarray(f2[..., np.newaxis] * rho)
    out += f1[..., np.newaxis]
    out *= rho
    return out
