# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference: a surface of V-grooves with masking, shadowing and all bounces.

Lambertian facets form infinitely long symmetric V-grooves with level rims. Their azimuth is
uniform; which share of the macroscopic area a slope θ covers, 0 ≤ θ < π/2, is a choice:

gaussian        tan θ sec²θ exp(-tan²θ / 2m²), m = tan σ: slopes of a Gaussian random surface, σ the
                angle of a profilometer's Rdq. Readings of such surfaces agree with it: the default.
oren-nayar      exp(-θ²/2σ²) sin θ: what the published formula was fitted to.

Light paths do not depend on the albedo, so r(ρ) = Σ a_k ρ^k, and one computation of the a_k serves
every wavelength.

How it is computed, from the inside out:

- `core.vcavity.groove`: one groove under one light and view. Shadow edges are exact; a_1 and a_2
  are closed forms, later bounces use constant radiosity on panels with exact exchange.
- `core.vcavity.surface`: Gauss rules over the groove's azimuth between its kinks.
- `core.vcavity.slope_law`: Gauss nodes over the slope; σ and law enter through weights alone.
- `core.vcavity.bounce_series`: the tail of the series, summed and not cut off.

How the error of r falls, measured as the worst of eleven geometries up to 85°, σ from 5° to 90° and
ρ from 0.1 to 1, law "oren-nayar", against two to four times the nodes of every kind:

=============  ======================================================================
panels a wall  3e-3 at 16, 1.4e-3 at 32, 7e-4 at 64, 4e-4 at 128. Only white facets in
               steep grooves fall so slowly: at ρ ≤ 0.9, σ ≤ 50° it is the square of
               the count, 6e-4, 1.7e-4, 6e-5
azimuth nodes  2.1e-3 at 3 a piece, 1.2e-3 at 4, 7e-4 at 6, where the panels rule
slope nodes    6e-4 at 3 a panel, 1.8e-4 at 4, 6e-5 at 6: two geometries near grazing,
               elsewhere far less
=============  ======================================================================

At 45°/0° the default nodes are within 1e-4. Light that is lost on the way cannot be told from
these numbers, but white facets can: integrated over the view hemisphere they return 1 within
2e-4 at θi ≤ 60°, σ ≤ 50°.

Gaussian slopes grow without bound as σ → π/2, where all grooves are slots, black along the normal.
To σ = 80° the error is as above, 9e-4 at worst; at 85° 2e-3, at 88° 5e-3. Beyond, slopes above
89.9° are taken for that: at 90° r is off by up to 0.005, and by 0.02 where facets are white.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import (
    Array,
    polar_angle,
    precision,
    slope_deviation,
    spectrum,
)
from ..numerics.memoized import memoized
from . import bounce_series, slope_law
from .sigma_tables import (
    SERIES_BOUNCES,
    albedo_from_reading,
    reading_from_albedo,
    ring_coefficients,
)
from .surface import STANDARD, Resolution, response

__all__ = [
    "BOUNCES",
    "ERROR_BOUND",
    "STANDARD",
    "Resolution",
    "albedo_from_reading",
    "bounce_coefficients",
    "reading_from_albedo",
    "reflectance",
    "ring_coefficients",
    "series",
]

ERROR_BOUND = 1e-3
"""Relative error of r with the default nodes, polar angles up to 85°, every ρ and every σ, with
Gaussian slopes up to 80°; half of it for σ ≤ 50°. Beyond a polar angle of 85° it was seen to stay,
but is not promised."""

BOUNCES = 16
"""Bounces that `bounce_coefficients` returns unless told otherwise."""

_CHUNK = 2
"""Geometries solved at once: about 20 MB of temporaries."""

_REMEMBERED = 128
"""Chunks whose answers are kept, a few megabytes: for another σ only the weights of slopes change,
so that a slider may be dragged."""


def bounce_coefficients(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    bounces: int = BOUNCES,
    resolution: Resolution = STANDARD,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Weights a_1 … a_K of ρ … ρ^K in the reflectance factor of the V-cavity surface.

    Parameters
    ----------
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2].
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Roughness (see the module), radians in [0, π/2].
        All four broadcast against each other.
    bounces
        K, at least 2. The sum to K is not the reflectance: use `reflectance` for that.
    resolution
        Node counts.
    slopes
        The slope law: "gaussian" or "oren-nayar".

    Returns
    -------
    Array of the broadcast shape + (K,), float32 if every array given is float32, else float64.
    With θi and θr both near π/2 and Δφ = 0, a_1 grows like 1/cos θ; at π/2 it is a large number.

    Raises
    ------
    DomainError
        If an angle lies outside its range, K is below 2 or there is no such law. NaN passes and
        stays where it was.

    Examples
    --------
    >>> np.round(bounce_coefficients(np.pi / 4, 0.0, 0.0, 0.5, bounces=3), 3).tolist()
    [0.823, 0.13, 0.035]
    >>> bounce_coefficients(np.pi / 4, 0.0, 0.0, 0.0, bounces=3).tolist()
    [1.0, 0.0, 0.0]
    """
    if bounces < 2:
        msg = f"bounces is {bounces}; the first two bounces come together, so ask for 2 or more."
        raise DomainError(msg)
    dtype = precision(theta_i, theta_r, delta_phi, sigma)
    rows = series(
        theta_i,
        theta_r,
        delta_phi,
        sigma,
        bounces=bounces,
        resolution=resolution,
        slopes=slopes,
    )
    return rows[..., :bounces].astype(dtype, copy=False)


def reflectance(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    resolution: Resolution = STANDARD,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Reflectance factor r(λ) of the V-cavity surface, all bounces summed.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands). Outside 0..1 see `core.vcavity.bounce_series`.
    theta_i, theta_r, delta_phi, sigma
        As in `bounce_coefficients`; they broadcast against the leading axes of `albedo`.
    resolution, slopes
        As in `bounce_coefficients`.

    Returns
    -------
    Array of shape (..., bands), in the precision of `albedo`. Relative error: `ERROR_BOUND`.

    Raises
    ------
    DomainError
        If an angle lies outside its range, `albedo` has no band axis or there is no such law.

    Examples
    --------
    >>> np.round(reflectance([0.2, 0.6], np.pi / 4, 0.0, 0.0, 0.5), 3).tolist()
    [0.17, 0.55]
    """
    rho = spectrum(albedo, "the albedo")
    rows = series(theta_i, theta_r, delta_phi, sigma, resolution=resolution, slopes=slopes)
    return bounce_series.evaluate(rows, rho)


def series(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    bounces: int = SERIES_BOUNCES,
    resolution: Resolution = STANDARD,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Rows of `core.vcavity.bounce_series`: a_1 … a_K and the tail, float64.

    Arguments and errors as in `bounce_coefficients`. Rows are linear: the mean of the rows of
    several geometries is the row of an instrument that averages them.

    Examples
    --------
    >>> rows = series([np.pi / 4, 0.5], 0.0, 0.0, [0.5, 0.0])
    >>> rows.shape, rows[1, :3].tolist()
    ((2, 15), [1.0, 0.0, 0.0])
    """
    # Each angle is checked in its own precision: np.float32(np.pi / 2) lies above π/2.
    angles = np.broadcast_arrays(
        polar_angle(theta_i, "theta_i", precision(theta_i)),
        polar_angle(theta_r, "theta_r", precision(theta_r)),
        np.asarray(delta_phi),
        slope_deviation(sigma, precision(sigma)),
    )
    light, view, azimuth, spread = (np.asarray(angle, np.float64).ravel() for angle in angles)
    # Swapping light and view or mirroring changes nothing; one order makes that exact.
    upper, lower = np.maximum(light, view), np.minimum(light, view)
    geometry = np.stack((upper, lower, np.arccos(np.cos(azimuth))), axis=-1)
    known = np.isfinite(geometry).all(axis=-1) & np.isfinite(spread)
    geometries, which = np.unique(geometry[known], axis=0, return_inverse=True)
    sigmas, roughness = np.unique(spread[known], return_inverse=True)
    weights = slope_law.weights(sigmas, resolution.slopes, slopes)

    width = bounces + bounce_series.TAIL_RATIOS.size
    responses = _responses(geometries, bounces, resolution)
    if len(sigmas) == 1:
        found = np.concatenate([weights[0] @ rows for rows in responses])[which.ravel()]
    else:
        found = np.empty((np.count_nonzero(known), width))
        members = np.split(
            np.argsort(which.ravel(), kind="stable"),
            np.cumsum(np.bincount(which.ravel(), minlength=len(geometries)))[:-1],
        )
        of_each = (row for rows in responses for row in rows)
        for row, member in zip(of_each, members, strict=False):  # none has one empty member
            found[member] = weights[roughness.ravel()[member]] @ row
    found[spread[known] == 0] = np.eye(1, width)

    out = np.full((spread.size, width), np.nan)
    out[known] = found
    return out.reshape(*angles[0].shape, width)


def _responses(geometries: Array, bounces: int, resolution: Resolution) -> Iterator[Array]:
    """Give `response` of geometries (n, 3), some at a time."""
    for start in range(0, len(geometries), _CHUNK):
        yield _response(geometries[start : start + _CHUNK].tobytes(), bounces, resolution)


@memoized(maxsize=_REMEMBERED)
def _response(chunk: bytes, bounces: int, resolution: Resolution) -> Array:
    """Give `response` of geometries, float64 of shape (geometries, 3), from their bytes."""
    geometries = np.frombuffer(chunk).reshape(-1, 3)
    return response(geometries[:, 0], geometries[:, 1], geometries[:, 2], bounces, resolution)
