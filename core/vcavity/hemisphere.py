# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Light of one direction that leaves the grooves again, wherever to: directional-hemispherical.

No integral over the view is needed. Light of unit power enters a groove and meets a wall; what
leaves it through the mouth after k hits is what does not meet the other wall next. With Y_k of
`core.vcavity.groove` for a view of whole walls, which is the power that meets a wall for the
(k + 1)-th time if facets are white,

    ρ_dh(ρ) = Σ a_k ρ^k,   a_k = Y_(k-1) - Y_k,   Y_0 = 1.

The a_k of white facets therefore add up to 1 whatever the nodes, and no light is lost. As
elsewhere, Y_1 is a closed form, later bounces are powers of the modes, and σ enters through the
weights of slopes alone; rows are those of `core.vcavity.bounce_series`.

By Helmholtz reciprocity the same number is the hemispherical-directional reflectance factor: what
is seen from this direction under a uniformly bright hemisphere.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array, polar_angle, precision, slope_deviation
from ..numerics.memoized import memoized
from . import bounce_series, groove, slope_law, surface
from .sigma_tables import SERIES_BOUNCES
from .surface import STANDARD, Resolution

ERROR_BOUND = 2e-4
"""Absolute error of ρ_dh with the default nodes, σ ≤ 50°, every angle and albedo; measured against
four times the nodes of every kind. The worst is light along the normal on facets of ρ near 0.99;
elsewhere, and for σ ≤ 30°, it is a tenth of that. Up to σ = 90° it is 4e-4."""

_AZIMUTHS = 12
"""Gauss nodes in each of the three pieces of a quarter of azimuth: 6 leave 1e-5, 12 leave 1e-6."""

_DEEP_RATIO = 6.0
"""Slope ratio m at the second cut, as in `core.vcavity.surface`."""

_REMEMBERED = 8
"""Sets of directions whose answers are kept, 10 kB a direction."""


def series(
    theta: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    slopes: str = slope_law.DEFAULT,
    resolution: Resolution = STANDARD,
) -> Array:
    """Rows of `core.vcavity.bounce_series` of ρ_dh: a_1 … a_K and the tail, float64.

    Parameters
    ----------
    theta
        Polar angle of the light, or of the view, radians in [0, π/2].
    sigma
        Roughness, radians in [0, π/2]; broadcasts against `theta`.
    slopes
        The slope law: a name in `core.vcavity.slope_law.LAWS`.
    resolution
        Node counts; azimuths are not among them here.

    Returns
    -------
    Array of the broadcast shape + (K + J,). Rows are linear: the mean of the rows of several
    directions is the row of light from all of them.

    Raises
    ------
    DomainError
        If an angle lies outside its range or the slope law is not known. NaN gives a row of NaN.

    Examples
    --------
    >>> row = series(0.0, np.radians(30), slopes="oren-nayar")
    >>> np.round(1 - bounce_series.evaluate(row, np.array([0.5, 1.0])), 3).tolist()
    [0.573, 0.0]
    >>> series(0.7, 0.0)[:3].tolist()
    [1.0, 0.0, 0.0]
    """
    angles = np.broadcast_arrays(
        polar_angle(theta, "theta", precision(theta)), slope_deviation(sigma, precision(sigma))
    )
    light, spread = (np.asarray(angle, np.float64).ravel() for angle in angles)
    known = np.isfinite(light) & np.isfinite(spread)
    directions, which = np.unique(light[known], return_inverse=True)
    sigmas, roughness = np.unique(spread[known], return_inverse=True)
    weights = slope_law.weights(sigmas, resolution.slopes, slopes)
    of_each = _response(directions.tobytes(), resolution)
    # Of each pair that is asked for, not of every direction at every roughness.
    found = np.einsum("ns,nsk->nk", weights[roughness.ravel()], of_each[which.ravel()])
    found[spread[known] == 0] = np.eye(1, found.shape[-1])
    out = np.full((light.size, found.shape[-1]), np.nan)
    out[known] = found
    return out.reshape(*angles[0].shape, -1)


@memoized(maxsize=_REMEMBERED)
def _response(directions: bytes, resolution: Resolution) -> Array:
    """Rows of each slope under directions, float64 from their bytes: (directions, slopes, K + J).

    Averaged over the azimuth of the groove.
    """
    grooves = surface._solver(SERIES_BOUNCES, resolution).grooves
    steepness = np.tan(grooves.slope)
    powers = _powers(grooves.ratio)
    whole = grooves.modes(np.ones((grooves.slope.size, 1)))[:, 0]
    theta = np.frombuffer(directions)
    out = np.empty((theta.size, 1 + grooves.slope.size, powers.shape[-1] + 2))
    out[:, 0] = np.eye(1, out.shape[-1])  # the level surface sends all light out at once
    for row, tangent in zip(out[:, 1:], np.tan(theta), strict=True):
        light = tangent * steepness
        azimuth, share = _azimuth_rule(light)
        lit = groove.lit_fraction(light[:, np.newaxis] * np.cos(azimuth))
        first = groove.exchange_per_length(lit, np.ones_like(lit), grooves.slope[:, np.newaxis])
        first = np.sum(share * first, axis=-1)
        modes = np.einsum("sa,sam->sm", share, grooves.modes(lit)) * whole
        row[:, 0] = 1 - first
        row[:, 1] = first - np.sum(modes, axis=-1)
        row[:, 2:] = np.einsum("sm,smk->sk", modes, powers)
    out.setflags(write=False)
    return out


def _powers(ratio: Array) -> Array:
    """(1 - g) g^(k-3) for k = 3 … K and the tail after it, shape (slopes, modes, K - 2 + J)."""
    ratio = ratio[..., np.newaxis]
    tail = bounce_series.tail_shares(ratio[..., 0], SERIES_BOUNCES)
    kept = ratio ** np.arange(SERIES_BOUNCES - 2)
    return np.asarray(
        np.concatenate((kept, tail * ratio ** (SERIES_BOUNCES - 2)), axis=-1) * (1 - ratio)
    )


def _azimuth_rule(light: Array) -> tuple[Array, Array]:
    """Azimuths and shares, shape (slopes, nodes); shares add up to 1.

    `light` is the largest slope ratio m over the azimuth. A quarter of a turn is all there is, cut
    where shadows begin and where light begins to reach deep into the groove.
    """
    with np.errstate(divide="ignore"):
        cuts = [np.arccos(np.minimum(ratio / light, 1)) for ratio in (_DEEP_RATIO, 1.0)]
    bounds = np.stack((np.zeros_like(light), *cuts, np.full_like(light, np.pi / 2)), axis=-1)
    bounds = bounds[..., np.newaxis]
    points, gauss_weights = np.polynomial.legendre.leggauss(_AZIMUTHS)
    width = np.diff(bounds, axis=-2)
    azimuth = bounds[..., :-1, :] + (points + 1) / 2 * width
    share = gauss_weights / 2 * width / (np.pi / 2)
    return azimuth.reshape(light.size, -1), share.reshape(light.size, -1)
