# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an instrument reads from a rough surface, and the albedo behind a reading.

At 45°/0° the Oren-Nayar model shrinks to r = f1 ρ + f2 ρ², with f1 and f2 functions of σ alone.
Models, cheapest first:

first-order   r = f1 ρ
two-bounce    r = f1 ρ + f2 ρ²                     the published model
closure       r = f1 ρ + f2 ρ² / (1 - g ρ)         all bounces, energy conserved at ρ = 1
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from .arrays import Array, precision, slope_deviation, spectrum
from .errors import DomainError
from .oren_nayar import first_bounce_at_normal, second_bounce_at_normal

Model = Literal["first-order", "two-bounce", "closure"]
MODELS: tuple[Model, ...] = get_args(Model)
INSTRUMENTS = ("45a:0",)
"""Geometries known so far: ring light at 45°, view along the normal."""

INSTRUMENT_ANGLES = {"45a:0": (np.pi / 4, 0.0, 0.0)}
"""θi, θr and Δφ of each ideal instrument, radians."""


def coefficients(sigma: npt.ArrayLike, instrument: str = "45a:0") -> tuple[Array, Array]:
    """Weights f1 and f2 of ρ and ρ² in a reading.

    Parameters
    ----------
    sigma
        Roughness, radians in [0, π/2], any shape.
    instrument
        One of `INSTRUMENTS`.

    Returns
    -------
    f1, f2
        Arrays of the shape of `sigma`.

    Raises
    ------
    DomainError
        If σ is out of range or the instrument unknown.
    """
    if instrument not in INSTRUMENTS:
        known = ", ".join(INSTRUMENTS)
        msg = f"Instrument {instrument!r} is not known; choose one of: {known}."
        raise DomainError(msg)
    dtype = precision(sigma)
    s2 = slope_deviation(sigma, dtype) ** 2
    # numpy 1.26 promotes scalars on the way.
    return (
        np.asarray(first_bounce_at_normal(s2), dtype),
        np.asarray(second_bounce_at_normal(s2), dtype),
    )


def bounce_ratio(sigma: npt.ArrayLike) -> Array:
    """Ratio g of the geometric series that stands for the third and all later bounces.

    g = 1 - q with q = f2 / (1 - f1), the ratio that gives r(ρ = 1) = 1. f2 / (1 - f1) is 0/0 at
    σ = 0, so q is written as the quotient of the two fits, where σ² cancels.
    """
    dtype = precision(sigma)
    s2 = slope_deviation(sigma, dtype) ** 2
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(1 - 0.34 * (s2 + 0.33) / (s2 + 0.13), dtype)


def from_albedo(
    albedo: npt.ArrayLike,
    sigma: npt.ArrayLike,
    model: str = "two-bounce",
    instrument: str = "45a:0",
) -> Array:
    """Predict the reading of a rough surface.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    sigma
        Roughness, radians in [0, π/2]; broadcasts against the leading axes of `albedo`.
    model, instrument
        One of `MODELS` and of `INSTRUMENTS`.

    Returns
    -------
    Reflectance factor, shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If σ is out of range, or model or instrument unknown.
    """
    rho = spectrum(albedo, "the albedo")
    f1, f2, g = _model_coefficients(sigma, model, instrument, rho)
    if model == "first-order":
        return np.asarray(f1 * rho)
    if model == "two-bounce":
        return np.asarray((f1 + f2 * rho) * rho)
    return np.asarray((f1 + f2 * rho / (1 - g * rho)) * rho)


def to_albedo(
    reading: npt.ArrayLike,
    sigma: npt.ArrayLike,
    model: str = "two-bounce",
    instrument: str = "45a:0",
) -> Array:
    """Find the albedo behind a reading: the inverse of `from_albedo`.

    A reading above `white_reading` gives an albedo above 1. It is not clipped: compare with
    `white_reading` and tell the user. A reading so negative that no albedo gives it is NaN.

    Parameters
    ----------
    reading
        r(λ), shape (..., bands).
    sigma, model, instrument
        As in `from_albedo`.

    Returns
    -------
    ρ(λ), shape (..., bands), in the precision of `reading`.

    Raises
    ------
    DomainError
        If σ is out of range, or model or instrument unknown.
    """
    r = spectrum(reading, "the reading")
    f1, f2, g = _model_coefficients(sigma, model, instrument, r)
    if model == "first-order":
        return np.asarray(r / f1)
    # The textbook root (-b + √(b² + 4ar)) / 2a cancels as σ → 0, where a → 0: at σ = 1e-8 it
    # returns 0 in float64. This form of the same root has no difference in it.
    a = f2 if model == "two-bounce" else f2 - g * f1
    b = f1 if model == "two-bounce" else f1 + g * r
    with np.errstate(invalid="ignore"):
        return np.asarray(2 * r / (b + np.sqrt(b * b + 4 * a * r)))


def white_reading(
    sigma: npt.ArrayLike, model: str = "two-bounce", instrument: str = "45a:0"
) -> Array:
    """Give the reading of white facets (ρ = 1), the largest one at this roughness.

    Returns an array of the shape of `sigma`; arguments and errors as in `from_albedo`.
    """
    white = np.ones(1, dtype=precision(sigma))
    return from_albedo(white, sigma, model, instrument)[..., 0]


def sigma_max(peak_reading: npt.ArrayLike) -> Array:
    """Largest roughness at which the two-bounce model still reaches a peak reading.

    The positive root σ² = x of (.67 - r) x² + (.46 (1 - r) - .0089) x + .0429 (1 - r) = 0, which
    is f1 + f2 = r multiplied out.

    Parameters
    ----------
    peak_reading
        Largest value of a reading over its bands, any shape.

    Returns
    -------
    σ in radians, same shape: π/2 where nothing bounds it (r ≤ 0.7205), 0 at r = 1, and NaN for
    r > 1, which not even a smooth surface reflects.
    """
    dtype = precision(peak_reading)
    r = np.asarray(peak_reading, dtype=dtype)
    a, b, c = 0.67 - r, 0.46 * (1 - r) - 0.0089, 0.0429 * (1 - r)
    bounded = a < 0
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(b * b - 4 * a * c)
        # b changes sign at r = 0.98; each branch adds numbers of like sign.
        x = np.where(b < 0, 2 * c / (root - b), (b + root) / (-2 * a))
    half_pi = dtype.type(np.pi / 2)
    sigma = np.where(bounded, np.sqrt(np.clip(x, 0, half_pi**2)), half_pi)
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(np.where(r <= 1, sigma, np.nan), dtype)


def _model_coefficients(
    sigma: npt.ArrayLike, model: str, instrument: str, values: Array
) -> tuple[Array, Array, Array]:
    """f1, f2 and g with a band axis of one, in the precision of `values`."""
    if model not in MODELS:
        known = ", ".join(MODELS)
        msg = f"Model {model!r} is not known; choose one of: {known}."
        raise DomainError(msg)
    sigma_per_spectrum = np.asarray(sigma, dtype=values.dtype)[..., np.newaxis]
    f1, f2 = coefficients(sigma_per_spectrum, instrument)
    return f1, f2, bounce_ratio(sigma_per_spectrum)
