# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A closure fitted to the V-cavity reference: all bounces in one square root.

    r = ρ (b + a / (1 + √(1 - g ρ)))  =  b ρ + (a/g) (1 - √(1 - g ρ))

The first term is light that leaves after one bounce. The second is a random walk between two
walls: the chance to leave at the k-th step of such a walk has the generating function
1 - √(1 - ρ), whose coefficients fall like k^-1.5, as the bounces of steep grooves do. A geometric
series falls too fast to follow them: fitted as well as it can be, it misses by 1.7 % at σ = 50°,
45°/0°, where this form misses by less than 1 %.

a, b and g depend on roughness and geometry alone. For the 45a:0 reading (`from_albedo`,
`to_albedo`) they are functions of σ that are exact at σ = 0, where r = ρ to the last bit, and meet
the reference's r(ρ = 1) within 1e-4. For any geometry (`factors`, `reflectance`) they come from
polynomials in the angles: over σ ≤ 50° and polar angles to 80° the error, worst over ρ, is 0.4 % in
the mean and below 1.3 % in 95 % of cases, where the published model has 8 % and 23 %. It is large
in two corners, up to 8 % with light and view both along the normal, where white steep grooves
are lit to the bottom, and 13 % with both at 80° from the same side.

r grows with ρ because b + a/2 > 0 and a ≥ 0, and its inverse is a quadratic in 1 - √(1 - g ρ).
Above ρ = 1 there is no physics; there r goes on as r(1) ρ, so that a reading 5 % above that of
white facets gives the albedo 1.05.

`tools/tables/fit_closure.py` derives the constants and prints the errors stated here.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import comb
from typing import Any

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import (
    Array,
    polar_angle,
    precision,
    slope_deviation,
    spectrum,
)
from ..numerics.blocks import apply_in_blocks
from ..numerics.memoized import remembered
from . import fitted

RING_ERROR = 0.01
"""Largest relative error of a 45a:0 reading, σ ≤ 50°, 0 < ρ ≤ 1; up to σ = 90° it is 0.0131."""

LARGEST_ANGLE = np.radians(85.0)
"""Polar angles are taken as at most this: beyond it the polynomials were not fitted."""

_STEEPEST = 0.999
"""Largest g for any geometry: at 1 the slope of r at ρ = 1 would be infinite."""

_CHUNK = 1 << 12
"""Geometries worked on at once: their 56 monomials take 1 to 2 MB."""


def roughness_variable(sigma: Array) -> Array:
    """Turn roughness into a number from 0 to 0.93: t = σ²/(σ² + c).

    Examples
    --------
    >>> round(float(roughness_variable(np.array(0.5))), 4)
    0.5556
    """
    s2 = sigma * sigma
    return np.asarray(s2 / (s2 + fitted.ROUGHNESS_SCALE))


def coefficients(sigma: npt.ArrayLike) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g of the 45a:0 reading.

    Parameters
    ----------
    sigma
        Roughness, radians in [0, π/2], any shape.

    Returns
    -------
    b, a, g
        Arrays of the shape of `sigma`; float32 if it is float32, else float64.

    Raises
    ------
    DomainError
        If σ is out of range. NaN passes and stays where it was.

    Examples
    --------
    >>> single, walk, ratio = coefficients(0.0)
    >>> float(single + walk / 2), float(ratio)
    (1.0, 0.0)
    >>> [round(float(values), 3) for values in coefficients(0.5)]
    [0.216, 1.155, 0.788]
    """
    dtype = precision(sigma)
    t = roughness_variable(slope_deviation(sigma, dtype).astype(np.float64))
    white = _polynomial(fitted.RING_WHITE, t)
    walk = _polynomial(fitted.RING_WALK, t)
    odds = t * np.exp(_polynomial(fitted.RING_RATIO, t))
    ratio = odds / (1 + odds)
    single = white - walk / (1 + np.sqrt(1 - ratio))
    return single.astype(dtype), walk.astype(dtype), ratio.astype(dtype)


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike) -> Array:
    """Predict the 45a:0 reading of a rough surface.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    sigma
        Roughness, radians in [0, π/2]; broadcasts against the leading axes of `albedo`.

    Returns
    -------
    Reflectance factor, shape (..., bands), in the precision of `albedo`. Relative error against
    the reference: `RING_ERROR`.

    Raises
    ------
    DomainError
        If σ is out of range or `albedo` has no band axis.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6, 1.0], 0.5), 3).tolist()
    [0.164, 0.531, 1.006]
    """
    rho = spectrum(albedo, "the albedo")
    return over_blocks(forward, coefficients(np.asarray(sigma, np.float64)), rho)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike) -> Array:
    """Find the albedo behind a 45a:0 reading: the inverse of `from_albedo`.

    A reading above that of white facets gives an albedo above 1, a negative one a negative albedo;
    nothing is clipped.

    Parameters
    ----------
    reading
        r(λ), shape (..., bands).
    sigma
        As in `from_albedo`.

    Returns
    -------
    ρ(λ), shape (..., bands), in the precision of `reading`.

    Raises
    ------
    DomainError
        If σ is out of range or `reading` has no band axis.

    Examples
    --------
    >>> np.round(to_albedo(from_albedo([0.2, 0.6], 0.5), 0.5), 12).tolist()
    [0.2, 0.6]
    >>> np.round(to_albedo(1.05 * from_albedo([1.0], 0.5), 0.5), 6).tolist()
    [1.05]
    """
    r = spectrum(reading, "the reading")
    return over_blocks(inverse, coefficients(np.asarray(sigma, np.float64)), r)


def factors(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g for any geometry.

    Parameters
    ----------
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2]; taken as at most `LARGEST_ANGLE`.
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Roughness, radians in [0, π/2]. All four broadcast against each other.

    Returns
    -------
    b, a, g
        Arrays of the broadcast shape; float32 if every array given is float32, else float64.
        At 45°/0° they differ from `coefficients`, which is the finer fit, by up to 1 % in r.

    Raises
    ------
    DomainError
        If an angle lies outside its range. NaN passes and stays where it was.

    Examples
    --------
    >>> single, walk, ratio = factors(0.8, [0.0, 0.5], 0.0, 0.5)
    >>> np.round(single + walk / (1 + np.sqrt(1 - ratio)), 2).tolist()
    [1.0, 1.1]
    """
    dtype = precision(theta_i, theta_r, delta_phi, sigma)
    angles = (np.asarray(angle, dtype) for angle in (theta_i, theta_r, delta_phi))
    t = roughness_variable(slope_deviation(sigma, dtype))
    half = _halved(*angles)
    shape = np.broadcast_shapes(half[0].shape, t.shape)
    table = _powers(dtype)
    if t.size == 1:
        # One roughness: the polynomials in t become numbers before any geometry is looked at.
        t = t.reshape(1)
        table = _polynomial(table, t)[np.newaxis]
        light, view, cosine = (values.ravel() for values in half)
    else:
        light, view, cosine, t = (np.broadcast_to(x, shape).ravel() for x in (*half, t))
    found = np.empty((3, light.size), dtype)
    for start in range(0, light.size, _CHUNK):
        block = slice(start, start + _CHUNK)
        of_block = t if t.size == 1 else t[block]
        found[:, block] = _factors(table, light[block], view[block], cosine[block], of_block)
    single, walk, ratio = found.reshape(3, *shape)
    return single, walk, ratio


def _powers(dtype: np.dtype[Any]) -> Array:
    """Give the table of the fit, the powers of t first: shape (powers, 3 functions, terms)."""
    return np.ascontiguousarray(np.moveaxis(fitted.GEOMETRY, -1, 0), dtype)


def _halved(theta_i: Array, theta_r: Array, delta_phi: Array) -> tuple[Array, ...]:
    """Give tan(θ/2) of light and view, and cos Δφ, all of the same shape."""
    light, view = (
        np.tan(np.minimum(polar_angle(angle, what, angle.dtype), LARGEST_ANGLE) / 2)
        for angle, what in ((theta_i, "theta_i"), (theta_r, "theta_r"))
    )
    with np.errstate(invalid="ignore"):  # an infinite azimuth is NaN, like a missing one
        cosine = np.cos(delta_phi)
    return tuple(np.broadcast_arrays(light, view, cosine))


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
    >>> np.round(reflectance([0.2, 0.6], 0.8, [0.0, 0.5], 0.0, 0.5), 2).tolist()
    [[0.16, 0.53], [0.19, 0.6]]
    """
    rho = spectrum(albedo, "the albedo")
    return over_blocks(forward, factors(theta_i, theta_r, delta_phi, sigma), rho)


def monomials(light: Array, view: Array, cosine: Array, degree: int) -> Array:
    """Products of u = x² + y², v = x y and v cos Δφ up to a degree, shape (terms, n).

    x and y are tan(θ/2) of light and view, `light` and `view` here, shape (n,). Swapping the two
    changes nothing, and where one of them is 0 the azimuth drops out. Terms of lower degree come
    first, so that the first terms are those of the lower degree.

    Examples
    --------
    >>> light, view, cosine = np.array([2.0]), np.array([3.0]), np.array([-1.0])
    >>> monomials(light, view, cosine, 1).ravel().tolist()
    [1.0, 13.0, 6.0, -6.0]
    """
    variables = np.stack((light * light + view * view, light * view, light * view * cosine))
    out = np.empty((comb(degree + 3, 3), light.size), light.dtype)
    out[0] = 1
    # A term is one of the degree before it times a variable; each is made once, because the
    # variables of a product come in order.
    count, starts = 1, [0, 0, 0]
    for _ in range(degree):
        end = count
        for index, variable in enumerate(variables):
            start, starts[index] = starts[index], count
            count += end - start
            np.multiply(out[start:end], variable, out=out[starts[index] : count])
    return out


def combine(first: Array, later: Array, odds: Array, t: Array) -> tuple[Array, Array, Array]:
    """Find b, a and g from the three fitted functions.

    r'(0) = exp(t · first) is the first bounce, t · exp(later) what white facets add to it, and
    t · exp(odds) = g' / (1 - g') with g' = g / _STEEPEST.

    Examples
    --------
    >>> zero, level = np.zeros(1), np.zeros(1)
    >>> [values.tolist() for values in combine(zero, zero, zero, level)]
    [[1.0], [0.0], [0.0]]
    """
    one_bounce = np.exp(t * first)
    scale = np.exp(odds)
    ratio = _STEEPEST * t * scale / (1 + t * scale)
    # a/2 · g / (1 + √(1 - g))² is what white facets add; t cancels, so that t = 0 is no 0/0.
    added_per_ratio = np.exp(later) * (1 + t * scale) / (_STEEPEST * scale)
    walk = 2 * added_per_ratio * (1 + np.sqrt(1 - ratio)) ** 2
    # A level surface: r = ρ to the last bit, whatever the geometry.
    walk = np.where(t == 0, 0, walk)
    return one_bounce - walk / 2, walk, ratio


def _factors(
    table: Array, light: Array, view: Array, cosine: Array, t: Array
) -> tuple[Array, Array, Array]:
    """b, a and g of geometries (n,), with `table` as in `_powers`; t is of shape (n,) or (1,)."""
    [terms] = _terms(light, view, cosine)
    powers = table.reshape(-1, terms.shape[0]) @ terms
    first, later, odds = _polynomial(powers.reshape(-1, 3, light.size), t)
    return combine(first, later, odds, t)


@remembered
def _terms(light: Array, view: Array, cosine: Array) -> tuple[Array, ...]:
    """Give the monomials of the fit, and nothing else."""
    return (monomials(light, view, cosine, fitted.DEGREE),)


def _polynomial(coefficients: Array | Sequence[float], x: Array) -> Array:
    """Horner's form, constant term first; x broadcasts to coefficients that are arrays."""
    value = np.zeros_like(x) + coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        value *= x
        value += coefficient
    return np.asarray(value)


def over_blocks(
    formula: Callable[..., None], coefficients: tuple[Array, Array, Array], values: Array
) -> Array:
    """Apply `formula(out, values, b, a, g)` to spectra, in their precision.

    Examples
    --------
    >>> np.round(over_blocks(forward, coefficients(0.5), np.array([0.2, 0.6])), 3).tolist()
    [0.164, 0.531]
    """
    per_spectrum = [c.astype(values.dtype, copy=False)[..., np.newaxis] for c in coefficients]
    out = np.empty(np.broadcast_shapes(values.shape, per_spectrum[0].shape), values.dtype)
    # ∞ - ∞ and 0 · ∞ are NaN, and need no warning beside it.
    with np.errstate(invalid="ignore"):
        apply_in_blocks(formula, out, values, *per_spectrum)
    return out


def forward(out: Array, rho: Array, single: Array, walk: Array, ratio: Array) -> None:
    """Write r of ρ for b, a and g, which broadcast: a formula for `over_blocks`.

    Examples
    --------
    >>> out = np.empty(2)
    >>> forward(out, np.array([0.5, 1.0]), np.array(0.5), np.array(1.0), np.array(0.0))
    >>> out.tolist()
    [0.5, 1.0]
    """
    # A comparison with NaN is false, so NaN goes the longer way, like albedos above 1.
    inside = rho if np.max(rho) <= 1 else np.minimum(rho, 1)
    np.multiply(inside, -ratio, out=out)
    out += 1
    np.sqrt(out, out=out)
    # a/g · (1 - √(1 - gρ)) would lose its digits for small gρ; the sum has no difference in it.
    out += 1
    np.divide(walk, out, out=out)
    out += single
    # Where ρ > 1 the bracket is r(1), so this is r(1) ρ.
    out *= rho


def inverse(out: Array, reading: Array, single: Array, walk: Array, ratio: Array) -> None:
    """Write ρ of r for b, a and g, which broadcast: a formula for `over_blocks`.

    Examples
    --------
    >>> out = np.empty(2)
    >>> inverse(out, np.array([0.5, 1.0]), np.array(0.5), np.array(1.0), np.array(0.0))
    >>> out.tolist()
    [0.5, 1.0]
    """
    white = single + walk / (1 + np.sqrt(1 - ratio))
    within = np.max(reading) <= np.min(white)
    inside = reading if within else np.minimum(reading, white)
    # With w = (1 - √(1 - gρ)) / g the form is r = (2b + a) w - b g w², and ρ = w (2 - g w).
    linear = 2 * single + walk
    np.multiply(inside, -4 * single * ratio, out=out)
    out += linear * linear
    np.sqrt(out, out=out)
    out += linear
    np.divide(inside, out, out=out)
    # out is w/2 here.
    out *= 4 - (4 * ratio) * out
    if not within:
        out *= np.maximum(reading / white, 1)
