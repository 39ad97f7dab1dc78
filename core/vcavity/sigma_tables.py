# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Series of the V-cavity over σ: solved once for an instrument, then interpolated.

An instrument is a set of geometries with weights. Its series at any σ comes from Chebyshev
polynomials on panels of σ, within `INTERPOLATION_ERROR` of the solver.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import (
    Array,
    precision,
    slope_deviation,
    spectrum,
)
from ..numerics.memoized import memoized
from . import bounce_series, slope_law
from .surface import STANDARD, Resolution, response

SERIES_BOUNCES = 6
"""Bounces kept one by one when only the sum matters; the tail stands for the others to 2e-6."""

INTERPOLATION_ERROR = 1e-12
"""Largest difference in any entry between a table and the solver; measured for 45a:0: 1e-13. With
Gaussian slopes it holds to σ = 89.2°, where slopes begin to be taken for 89.9°; beyond, r is off by
up to 5e-4."""

_STEEP = (60, 70, 76, 80.5, 83.5, 85.5, 87, 87.9, 88.5, 89.1, 89.5, 89.8, 90)

_SIGMA_EDGES: Mapping[str, Array] = MappingProxyType(
    {
        slope_law.GAUSSIAN: np.radians([0, 3, 7, 12, 20, 32, 46, *_STEEP]),
        slope_law.OREN_NAYAR: np.radians([0, 3, 7, 12, 18, 26, 38, 58, 90]),
    }
)
"""Panels of σ. They grow with σ: what matters is how many σ fit below the slopes, near 30° to 45°,
at which shadows set in. Gaussian slopes crowd toward 90° as 1 / tan σ does, so their panels shrink
again."""

_DEGREE = 13
"""Degree of the polynomials on each panel."""


@dataclass(frozen=True)
class SigmaTable:
    """Rows of `core.vcavity.bounce_series` as a function of σ.

    Attributes
    ----------
    coefficients
        Chebyshev coefficients, shape (panels, degree + 1, K + J).
    slopes
        The slope law.
    """

    coefficients: Array
    slopes: str = slope_law.DEFAULT

    def rows(self, sigma: npt.ArrayLike) -> Array:
        """Series at roughness σ (radians in [0, π/2], any shape): shape (..., K + J), float64.

        Raises
        ------
        DomainError
            If σ is out of range. NaN gives a row of NaN.
        """
        spread = slope_deviation(sigma, precision(sigma)).astype(np.float64)
        edges = _SIGMA_EDGES[self.slopes]
        panel = np.clip(np.searchsorted(edges, spread) - 1, 0, edges.size - 2)
        low, high = edges[panel], edges[panel + 1]
        place = ((2 * spread - low - high) / (high - low))[..., np.newaxis]
        # Clenshaw's recurrence.
        later = np.zeros((*spread.shape, self.coefficients.shape[-1]))
        current = later
        for order in range(self.coefficients.shape[1] - 1, 0, -1):
            current, later = (
                self.coefficients[panel, order] + 2 * place * current - later,
                current,
            )
        out = self.coefficients[panel, 0] + place * current - later
        # A level surface returns ρ to the last bit.
        out[spread == 0] = np.eye(1, out.shape[-1])
        return np.asarray(out)


def build(
    theta_i: Array,
    theta_r: Array,
    delta_phi: Array,
    weight: Array,
    resolution: Resolution = STANDARD,
    *,
    slopes: str = slope_law.DEFAULT,
) -> SigmaTable:
    """Solve a weighted mean of geometries (radians, shape (geometries,)) for every σ.

    Raises
    ------
    DomainError
        If there is no slope law of the name `slopes`.

    Examples
    --------
    >>> half = np.array([0.5, 0.5])
    >>> table = build(np.array([0.7, 0.8]), np.zeros(2), np.zeros(2), half)
    >>> table.rows(0.0)[:3].tolist()
    [1.0, 0.0, 0.0]
    """
    slope_law.check(slopes)
    answer = np.zeros((1, 1))
    for angles in zip(theta_i, theta_r, delta_phi, weight, strict=True):
        light, view, azimuth = (np.array([angle]) for angle in angles[:3])
        answer = answer + angles[3] * response(light, view, azimuth, SERIES_BOUNCES, resolution)[0]
    answer = answer / np.sum(weight)
    # Values at the zeros of T_n give its interpolant by a discrete cosine sum.
    count = _DEGREE + 1
    angle = (np.arange(count) + 0.5) * np.pi / count
    edges = _SIGMA_EDGES[slopes]
    low, high = edges[:-1, np.newaxis], edges[1:, np.newaxis]
    sigma = (low + high) / 2 + (high - low) / 2 * np.cos(angle)
    rows = slope_law.weights(sigma.ravel(), resolution.slopes, slopes) @ answer
    cosines = np.cos(np.outer(np.arange(count), angle)) * (2 / count)
    cosines[0] /= 2
    return SigmaTable(np.asarray(cosines @ rows.reshape(*sigma.shape, -1)), slopes)


@memoized(maxsize=len(slope_law.LAWS))
def ring(slopes: str = slope_law.DEFAULT) -> SigmaTable:
    """Table of the ideal 45a:0 instrument; argument and errors as in `build`.

    At θr = 0 the azimuth has no meaning, so one geometry stands for the ring.

    Examples
    --------
    >>> round(float(ring().rows(np.radians(30))[0]), 4)
    0.8101
    >>> round(float(ring("oren-nayar").rows(np.radians(30))[0]), 4)
    0.7765
    """
    return build(np.array([np.pi / 4]), np.zeros(1), np.zeros(1), np.ones(1), slopes=slopes)


def ring_coefficients(
    sigma: npt.ArrayLike,
    bounces: int = SERIES_BOUNCES,
    *,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Bounce coefficients a_1 … a_K of the 45a:0 reading, K ≤ 6.

    Parameters
    ----------
    sigma
        Roughness, see `core.vcavity.slope_law`; radians in [0, π/2], any shape.
    bounces
        K. Their sum is not the reading of white facets: `reading_from_albedo` adds the tail.
    slopes
        The slope law: a name in `core.vcavity.slope_law.LAWS`.

    Returns
    -------
    Array of the shape of `sigma` + (K,), float32 if `sigma` is float32, else float64.

    Raises
    ------
    DomainError
        If σ is out of range or the slope law is not known.

    Examples
    --------
    >>> np.round(ring_coefficients([0.0, 0.5], bounces=3), 3).tolist()
    [[1.0, 0.0, 0.0], [0.823, 0.13, 0.035]]
    """
    dtype = precision(sigma)
    return ring(slopes).rows(sigma)[..., :bounces].astype(dtype, copy=False)


def reading_from_albedo(
    albedo: npt.ArrayLike, sigma: npt.ArrayLike, *, slopes: str = slope_law.DEFAULT
) -> Array:
    """Predict the 45a:0 reading of the V-cavity surface.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands). Outside 0..1 see `core.vcavity.bounce_series`.
    sigma
        Roughness, see `core.vcavity.slope_law`; radians in [0, π/2]; broadcasts against the leading
        axes of `albedo`.
    slopes
        The slope law: a name in `core.vcavity.slope_law.LAWS`.

    Returns
    -------
    Reflectance factor, shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If σ is out of range, `albedo` has no band axis, or the slope law is not known.

    Examples
    --------
    >>> np.round(reading_from_albedo([0.2, 0.6, 1.0], 0.5), 3).tolist()
    [0.17, 0.55, 1.008]
    """
    return bounce_series.evaluate(ring(slopes).rows(sigma), spectrum(albedo, "the albedo"))


def albedo_from_reading(
    reading: npt.ArrayLike, sigma: npt.ArrayLike, *, slopes: str = slope_law.DEFAULT
) -> Array:
    """Find the albedo behind a 45a:0 reading: the inverse of `reading_from_albedo`.

    A reading above that of white facets gives an albedo above 1, a negative one a negative albedo;
    nothing is clipped.

    Parameters
    ----------
    reading
        r(λ), shape (..., bands).
    sigma, slopes
        As in `reading_from_albedo`.

    Returns
    -------
    ρ(λ), shape (..., bands), in the precision of `reading`.

    Raises
    ------
    DomainError
        If σ is out of range, `reading` has no band axis, or the slope law is not known.

    Examples
    --------
    >>> np.round(albedo_from_reading(reading_from_albedo([0.2, 0.6], 0.5), 0.5), 9).tolist()
    [0.2, 0.6]
    """
    return bounce_series.invert(ring(slopes).rows(sigma), spectrum(reading, "the reading"))
