# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral Oren-Nayar reflectance: r(λ) = F1 ρ(λ) + F2 ρ(λ)².

F1 and F2 depend on geometry and roughness alone, so any number of bands costs one rank-2 product.

Source: M. Oren and S. K. Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994,
the functional model with interreflection (equations 30 and 31). The constants 0.57 of the paper's
qualitative model and 2/π - 1 of the 1993 fit belong to other models and are not used here.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from .numerics.arrays import (
    Array,
    polar_angle,
    precision,
    slope_deviation,
    spectrum,
)
from .numerics.blocks import apply_in_blocks, blocks, part
from .numerics.memoized import remembered

_BEYOND = {4: -4.371139000186241e-08, 8: 6.123233995736766e-17}
"""π/2 minus its nearest float32 and float64, by size in bytes: the rest of π/2 - β."""


def first_bounce_at_normal(s2: Array) -> Array:
    """C1 of the model: what is left of the first bounce when light or view is along the normal.

    `s2` is σ². Equals F1 wherever min(θi, θr) = 0.

    Examples
    --------
    >>> float(first_bounce_at_normal(np.array(0.0)))
    1.0
    >>> round(float(first_bounce_at_normal(np.array(0.25))), 4)
    0.7845
    """
    return 1 - 0.5 * s2 / (s2 + 0.33)


def second_bounce_at_normal(s2: Array) -> Array:
    """F2 of the model when light or view is along the normal. `s2` is σ².

    Examples
    --------
    >>> float(second_bounce_at_normal(np.array(0.0)))
    0.0
    >>> round(float(second_bounce_at_normal(np.array(0.25))), 4)
    0.1118
    """
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

    Examples
    --------
    >>> f1, f2 = factors(np.pi / 4, [0.0, 0.5], 0.0, 0.5)
    >>> np.round(f1, 4).tolist(), np.round(f2, 4).tolist()
    ([0.7845, 0.9123], [0.1118, 0.1005])
    """
    dtype = precision(theta_i, theta_r, delta_phi, sigma)
    geometry = _checked(theta_i, theta_r, delta_phi, sigma, dtype)
    shape = np.broadcast_shapes(*(array.shape for array in geometry))
    f1, f2 = np.empty(shape, dtype), np.empty(shape, dtype)
    for index in blocks(shape):
        f1[index], f2[index] = _factors(*(part(array, index, len(shape)) for array in geometry))
    return f1, f2


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

    Examples
    --------
    >>> np.round(reflectance([0.2, 0.6], np.pi / 4, [0.0, 0.5], 0.0, 0.5), 4).tolist()
    [[0.1614, 0.511], [0.1865, 0.5836]]
    """
    rho = spectrum(albedo, "the albedo")
    geometry = _checked(theta_i, theta_r, delta_phi, sigma, rho.dtype)
    leading = np.broadcast_shapes(rho.shape[:-1], *(array.shape for array in geometry))
    out = np.empty((*leading, rho.shape[-1]), rho.dtype)
    basis = np.stack((rho, rho * rho)) if rho.ndim == 1 else None
    for index in blocks(leading):
        f1, f2 = _factors(*(part(array, index, len(leading)) for array in geometry))
        # An infinite albedo is NaN where F2 is 0, and needs no warning beside it.
        with np.errstate(invalid="ignore"):
            if basis is not None:
                np.matmul(np.stack((f1, f2), axis=-1), basis, out=out[index])
                continue
            of_block = part(rho, index, len(leading) + 1)
            apply_in_blocks(_horner, out[index], of_block, f1[..., np.newaxis], f2[..., np.newaxis])
    return out


def _horner(out: Array, rho: Array, f1: Array, f2: Array) -> None:
    np.multiply(f2, rho, out=out)
    out += f1
    out *= rho


def _checked(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
    dtype: np.dtype[Any],
) -> tuple[Array, Array, Array, Array]:
    return (
        polar_angle(theta_i, "theta_i", dtype),
        polar_angle(theta_r, "theta_r", dtype),
        np.asarray(delta_phi, dtype=dtype),
        slope_deviation(sigma, dtype),
    )


def _factors(light: Array, view: Array, delta_phi: Array, sigma: Array) -> tuple[Array, Array]:
    """F1 and F2 of checked arguments."""
    dtype = light.dtype
    tilted, slanted, second = _directions(light, view, delta_phi)
    s2 = sigma * sigma
    share = s2 / (s2 + 0.09)
    f1 = first_bounce_at_normal(s2) + 0.45 * share * tilted + 0.125 * share * slanted
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(f1, dtype), np.asarray(second_bounce_at_normal(s2) * second, dtype)


@remembered
def _directions(light: Array, view: Array, delta_phi: Array) -> tuple[Array, ...]:
    """Give what multiplies C2 and C3 of the model in F1, but for their part in σ, and F2.

    The half-angle tangent is written with sines and cosines, which are needed anyway: numpy's
    float32 tangent costs several times its sine.
    """
    dtype = light.dtype
    with np.errstate(invalid="ignore"):  # an infinite azimuth is NaN, like a missing one
        cos_phi = np.cos(delta_phi)
    alpha, beta = np.maximum(light, view), np.minimum(light, view)
    sin_alpha, cos_alpha = np.sin(alpha), np.cos(alpha)
    sin_beta, cos_beta = np.sin(beta), np.cos(beta)
    two_over_pi = dtype.type(2 / np.pi)
    slant = beta * two_over_pi
    squared = slant * slant

    # sin α - (2β/π)³ vanishes at grazing where tan β is infinite, and what counts is the product.
    # Subtracted as it stands it leaves noise: F1 = 0.70 for -0.02 at θi = θr = 90°, Δφ = 180°,
    # σ = 0.7, and in float32 an error of 2e-4 already at 89.99°. 1 - sin α and 1 - (2β/π)³ each
    # have a form without a difference of rounded numbers.
    steepness = (dtype.type(np.pi / 2) - beta + dtype.type(_BEYOND[dtype.itemsize])) * two_over_pi
    backward = steepness * (1 + slant + squared) - cos_alpha * cos_alpha / (1 + sin_alpha)
    tilted = cos_phi * np.where(cos_phi < 0, backward, sin_alpha) * (sin_beta / cos_beta)
    half_angle = (sin_alpha + sin_beta) / (cos_alpha + cos_beta)
    shadow = dtype.type(4 / np.pi**2) * (alpha * alpha * squared)
    slanted = (1 - np.abs(cos_phi)) * shadow * half_angle
    # numpy 1.26 promotes scalars on the way.
    return tuple(np.asarray(found, dtype) for found in (tilted, slanted, 1 - cos_phi * squared))
