# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an instrument reads from a rough surface, and the albedo behind a reading.

Whatever an instrument averages (see `core.instruments`), the Oren-Nayar model shrinks to
r = f1 ρ + f2 ρ², with f1 and f2 functions of σ alone, and the other models to as little (see
`core.instruments.curves`). The models are those of `core.models`.

`geometric_closure` is none of them. It sums the later bounces of the published model as a
geometric series, which conserves energy but misses the reference by up to 4.7 % at σ ≤ 50°.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import instruments, models
from .instruments import curves, quadrature
from .numerics.arrays import (
    Array,
    precision,
    slope_deviation,
    spectrum,
)

INSTRUMENTS = tuple(instruments.REGISTRY)
"""Names of all instruments; the first, 45a:0, is meant wherever none is named."""

INSTRUMENT_ANGLES = {
    name: angles
    for name in instruments.REGISTRY
    if (angles := quadrature.of(name).angles) is not None
}
"""θi, θr and Δφ, radians, of the instruments that light from one direction and look from one."""


def coefficients(sigma: npt.ArrayLike, instrument: str = "45a:0") -> tuple[Array, Array]:
    """Weights f1 and f2 of ρ and ρ² in a reading of the two-bounce model.

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

    Examples
    --------
    >>> [round(float(weight), 4) for weight in coefficients(np.pi / 2)]
    [0.559, 0.1615]
    """
    return curves.first_and_second(sigma, instrument)


def bounce_ratio(sigma: npt.ArrayLike) -> Array:
    """Ratio g of the series of `geometric_closure`.

    g = 1 - q with q = f2 / (1 - f1), the ratio that gives r(ρ = 1) = 1. f2 / (1 - f1) is 0/0 at
    σ = 0, so q is written as the quotient of the two fits, where σ² cancels.

    Examples
    --------
    >>> f1, f2 = coefficients(0.5)
    >>> round(float(f1 + f2 / (1 - bounce_ratio(0.5))), 12)
    1.0
    """
    dtype = precision(sigma)
    s2 = slope_deviation(sigma, dtype) ** 2
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(1 - 0.34 * (s2 + 0.33) / (s2 + 0.13), dtype)


def geometric_closure(albedo: npt.ArrayLike, sigma: npt.ArrayLike) -> Array:
    """Predict a 45a:0 reading with r = f1 ρ + f2 ρ² / (1 - g ρ), g of `bounce_ratio`.

    The closure with no new parameter: what follows the second bounce is the geometric series that
    lets white facets lose nothing. Kept to compare with; the model "closure" is
    a hundred times nearer to the reference.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    sigma
        Roughness, radians in [0, π/2]; broadcasts against the leading axes of `albedo`.

    Returns
    -------
    Reflectance factor, shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If σ is out of range or `albedo` has no band axis.

    Examples
    --------
    >>> np.round(geometric_closure([0.2, 0.6, 1.0], 0.5), 4).tolist()
    [0.1618, 0.5273, 1.0]
    """
    rho = spectrum(albedo, "the albedo")
    per_spectrum = np.asarray(sigma, dtype=rho.dtype)[..., np.newaxis]
    f1, f2 = coefficients(per_spectrum)
    # 0 · ∞ is NaN, and needs no warning beside it.
    with np.errstate(invalid="ignore"):
        return np.asarray(rho * (f1 + f2 * (rho / (1 - bounce_ratio(per_spectrum) * rho))))


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
        One of `core.models.NAMES` and of `INSTRUMENTS`.

    Returns
    -------
    Reflectance factor, shape (..., bands), in the precision of `albedo`. A band that is NaN or
    infinite stays NaN or infinite, and no other is touched.

    Raises
    ------
    DomainError
        If σ is out of range, or model or instrument unknown.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6], np.radians(30)), 4).tolist()
    [0.1592, 0.5054]
    >>> np.round(from_albedo([0.2, 0.6], np.radians(30), "closure", "di:8"), 3).tolist()
    [0.168, 0.543]
    """
    return models.find(model).formulas.from_albedo(albedo, sigma, instrument)


def to_albedo(
    reading: npt.ArrayLike,
    sigma: npt.ArrayLike,
    model: str = "two-bounce",
    instrument: str = "45a:0",
) -> Array:
    """Find the albedo behind a reading: the inverse of `from_albedo`.

    A reading above `white_reading` gives an albedo above 1. It is not clipped: compare with
    `white_reading` and tell the user. A reading so negative that no albedo gives it is NaN, as
    are NaN and infinity.

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

    Examples
    --------
    >>> read = from_albedo([0.2, 0.6], np.radians(30), "closure")
    >>> np.round(to_albedo(read, np.radians(30), "closure"), 12).tolist()
    [0.2, 0.6]
    """
    return models.find(model).formulas.to_albedo(reading, sigma, instrument)


def white_reading(
    sigma: npt.ArrayLike, model: str = "two-bounce", instrument: str = "45a:0"
) -> Array:
    """Give the reading of white facets (ρ = 1), the largest one at this roughness.

    In a single direction it may exceed 1, because white rough facets send more light back toward
    its source than a white diffuser does, and less elsewhere.

    Returns an array of the shape of `sigma`; arguments and errors as in `from_albedo`.

    Examples
    --------
    >>> round(float(white_reading(np.pi / 2)), 4)
    0.7205
    >>> round(float(white_reading(np.radians(30), "closure")), 2)
    1.01
    """
    white = np.ones(1, dtype=precision(sigma))
    return from_albedo(white, sigma, model, instrument)[..., 0]


def sigma_max(peak_reading: npt.ArrayLike) -> Array:
    """Largest roughness at which the two-bounce model still reaches a peak reading at 45a:0.

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

    Examples
    --------
    >>> np.round(np.degrees(sigma_max([0.8, 0.9, 0.95])), 1).tolist()
    [48.9, 28.0, 19.5]
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
