# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface of V-grooves of every azimuth: what each slope answers, averaged over azimuth.

The integrand over the groove's azimuth has kinks where a shadow or a masked strip begins, and
where the shadow's edge passes the masked edge. All are known in closed form, so the circle is cut
there and each piece gets a Gauss rule. Steep grooves are lit deep down only within a narrow range
of azimuths along them, so the circle is cut once more on either side of that range.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numerics.arrays import Array
from ..numerics.memoized import memoized
from . import bounce_series, groove, slope_law

_DEEP_RATIO = 6.0
"""Slope ratio m at the additional cuts. Between 4 and 8 its value hardly matters; without the cuts
the error of white facets in steep grooves doubles."""


@dataclass(frozen=True)
class Resolution:
    """Node counts of the solver. The defaults hold the errors stated in `core.vcavity`."""

    slopes: int = 6
    """Gauss nodes in each of the slope panels."""
    azimuths: int = 6
    """Gauss nodes in each of the ten pieces of the azimuth circle."""
    panels: int = 64
    """Panels of constant radiosity on each wall."""
    table: int = 128
    """Lit fractions at which a groove's answer is tabulated."""


STANDARD = Resolution()


@dataclass(frozen=True)
class _Solver:
    """Grooves of all slopes but 0, and the powers of their modes that make a series."""

    grooves: groove.Grooves
    even: Array
    """Columns a_3 … a_K and the tail, for light that comes from both walls alike:
    shape (slopes, modes, K - 2 + J)."""
    odd: Array
    """The same for the difference of the walls, which changes sign at each bounce."""


def response(
    theta_i: Array,
    theta_r: Array,
    delta_phi: Array,
    bounces: int,
    resolution: Resolution = STANDARD,
) -> Array:
    """Series of each slope under each geometry, averaged over the azimuth of the groove.

    Parameters
    ----------
    theta_i, theta_r, delta_phi
        Geometries, radians, shape (geometries,), polar angles below π/2.
    bounces
        K ≥ 2.
    resolution
        Node counts.

    Returns
    -------
    Rows of `core.vcavity.bounce_series`, shape (geometries, slopes, K + J).

    Examples
    --------
    >>> coarse = Resolution(slopes=3, azimuths=3, panels=16, table=32)
    >>> rows = response(np.array([0.7]), np.array([0.2]), np.array([1.0]), 6, coarse)
    >>> rows.shape
    (1, 43, 15)
    >>> rows[0, 0, :3].tolist()
    [1.0, 0.0, 0.0]
    """
    solver = _solver(bounces, resolution)
    slope = solver.grooves.slope
    light = np.tan(theta_i)[:, np.newaxis] * np.tan(slope)
    view = np.tan(theta_r)[:, np.newaxis] * np.tan(slope)
    azimuth, share = _azimuth_rule(light, view, delta_phi[:, np.newaxis], resolution.azimuths)
    m_i = light[..., np.newaxis] * np.cos(azimuth)
    m_r = view[..., np.newaxis] * np.cos(azimuth - delta_phi[:, np.newaxis, np.newaxis])
    v_i, v_r = groove.lit_fraction(m_i), groove.lit_fraction(m_r)
    same_wall = np.clip(m_i, -1, 1) * np.clip(m_r, -1, 1)

    rows = np.empty((theta_i.size, 1 + slope.size, bounces + bounce_series.TAIL_RATIOS.size))
    rows[:, 0] = np.eye(1, rows.shape[-1])  # the level surface sends all light out at once
    out = rows[:, 1:]
    out[..., 0] = np.sum(share * (1 + same_wall) / np.maximum(v_i, v_r), axis=-1)
    exchange = groove.exchange_per_length(v_i, v_r, slope[:, np.newaxis])
    out[..., 1] = np.sum(share * (1 - same_wall) * exchange, axis=-1)
    product = solver.grooves.modes(v_i)
    product *= solver.grooves.modes(v_r)
    weights = np.stack((share, share * same_wall), axis=-2)
    parts = weights @ product
    out[..., 2:] = np.einsum("gsm,smk->gsk", parts[..., 0, :], solver.even, optimize=True)
    out[..., 2:] += np.einsum("gsm,smk->gsk", parts[..., 1, :], solver.odd, optimize=True)
    out *= np.cos(slope)[:, np.newaxis]
    return rows


@memoized(maxsize=8)
def _solver(bounces: int, resolution: Resolution) -> _Solver:
    slopes = slope_law.nodes(resolution.slopes)[1:]
    grooves = groove.build(slopes, resolution.panels, resolution.table)
    even = _powers(grooves.ratio, bounces)
    odd = _powers(-grooves.ratio, bounces)
    return _Solver(grooves, even, odd)


def _powers(ratio: Array, bounces: int) -> Array:
    """g^(k-3) for k = 3 … K, then the shares of the tail that starts with g^(K-2)."""
    ratio = ratio[..., np.newaxis]
    tail = bounce_series.tail_shares(ratio[..., 0], bounces) * ratio ** (bounces - 2)
    return np.concatenate((ratio ** np.arange(bounces - 2), tail), axis=-1)


def _azimuth_rule(
    light: Array, view: Array, delta_phi: Array, per_piece: int
) -> tuple[Array, Array]:
    """Azimuths and shares, shape (geometries, slopes, pieces · per_piece); shares add up to 1.

    `light` and `view` are the largest slope ratios m over the azimuth. A groove turned by π is the
    same groove, so half a turn is all there is.
    """
    cosine, sine = np.cos(delta_phi), np.sin(delta_phi)
    edges = [
        # Shadow and mask reach equally deep, on the same wall and on opposite ones.
        np.arctan2(light - view * cosine, view * sine),
        np.arctan2(light + view * cosine, -view * sine),
    ]
    for ratio in (1.0, _DEEP_RATIO):
        for largest, across in ((light, 0.0), (view, delta_phi)):
            with np.errstate(divide="ignore"):
                from_axis = np.arcsin(np.minimum(ratio / largest, 1))
            edges += [across + np.pi / 2 - from_axis, across + np.pi / 2 + from_axis]
    stacked = np.sort(np.mod(np.stack(np.broadcast_arrays(*edges), axis=-1), np.pi), axis=-1)
    bounds = np.concatenate((stacked, stacked[..., :1] + np.pi), axis=-1)[..., np.newaxis]
    points, gauss_weights = np.polynomial.legendre.leggauss(per_piece)
    width = np.diff(bounds, axis=-2)
    azimuth = bounds[..., :-1, :] + (points + 1) / 2 * width
    share = gauss_weights / 2 * width / np.pi
    return azimuth.reshape(*light.shape, -1), share.reshape(*light.shape, -1)
