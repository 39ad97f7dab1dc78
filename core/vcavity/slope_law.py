# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The slope distribution, and one set of slopes that serves every roughness.

σ is defined by the share of *macroscopic* area (area seen from above) that grooves of slope θ
cover: exp(-θ²/2σ²) sin θ on [0, π/2), normalized. Other readings of "Gaussian slopes" are in use,
and they matter: they move the first bounce at σ = 30°, 45°/0° from 0.78 to 0.87 or 0.90.

What a groove reflects does not depend on σ. It is computed at Gauss nodes of fixed panels, and σ
enters through weights alone: the integral of each node's Lagrange polynomial times the
distribution. So any σ, however small, costs one row of weights.
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array
from ..numerics.memoized import memoized

PANEL_EDGES = np.radians([0, 3, 7, 14, 22, 30, 38, 45, 52, 60, 68, 76, 83, 87.5, 90])
"""Slopes between which a groove's answer is taken as one polynomial. 45° is among them because
that is where shadows begin for light at 45°; the last panels are short because the number of
bounces grows without bound toward 90°."""

_REACH = 9.0
"""The distribution is cut at 9σ, beyond which it holds 3e-18 of the area."""

_WEIGHT_NODES = 24
"""Gauss nodes a panel for the weights; 24 integrate the distribution over 9σ to 1e-10."""


_BLOCK = 256
"""Roughnesses at a time: 4 MB an array."""


def nodes(per_panel: int) -> Array:
    """Slopes at which grooves are solved, radians, shape (1 + panels · per_panel,).

    The first is 0: a level surface, whose answer is known, so that nothing but ρ is left as σ → 0.

    Examples
    --------
    >>> slopes = nodes(6)
    >>> slopes.size, float(slopes[0]), bool(slopes.max() < np.pi / 2)
    (85, 0.0, True)
    """
    points, _ = _gauss(per_panel)
    low, high = PANEL_EDGES[:-1, np.newaxis], PANEL_EDGES[1:, np.newaxis]
    return np.concatenate(([0], (low + (points + 1) / 2 * (high - low)).ravel()))


def weights(sigma: Array, per_panel: int) -> Array:
    """Share of each slope of `nodes` at roughness σ (radians, shape (n,)): shape (n, slopes).

    The weights of one σ add up to 1. At σ = 0 they are those of a level surface.

    Examples
    --------
    >>> shares = weights(np.array([0.0, 0.5]), 6)
    >>> np.round(shares.sum(axis=1), 12).tolist(), float(shares[0, 0])
    ([1.0, 1.0], 1.0)
    """
    if sigma.size > _BLOCK:
        blocks = np.split(sigma, range(_BLOCK, sigma.size, _BLOCK))
        return np.concatenate([weights(block, per_panel) for block in blocks])
    level, inner = _panels(per_panel)
    quadrature, quadrature_weights = _gauss(_WEIGHT_NODES)
    spread = np.maximum(sigma, np.finfo(np.float64).tiny)[:, np.newaxis, np.newaxis]
    # Axes: σ, panel, node of the quadrature.
    low, high = PANEL_EDGES[:-1, np.newaxis], PANEL_EDGES[1:, np.newaxis]
    top = np.clip(_REACH * spread, low, high)
    slope = low + (quadrature + 1) / 2 * (top - low)
    # Every length is in units of σ: products of small σ underflow below 1e-154.
    with np.errstate(over="ignore"):
        share = np.exp(-0.5 * (slope / spread) ** 2)
    share *= np.sin(slope) / spread * ((top - low) / spread) * quadrature_weights
    of_level, of_inner = _gaps(per_panel)
    first = np.einsum("nq,nqs->ns", share[:, 0], _lagrange(slope[:, 0], level, of_level))
    others = np.einsum("npq,npqs->nps", share[:, 1:], _lagrange(slope[:, 1:], inner, of_inner))
    out = np.concatenate((first, others.reshape(sigma.size, inner.size)), axis=1)
    return np.asarray(out / np.sum(out, axis=1, keepdims=True))


@memoized(maxsize=8)
def _gauss(count: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss's quadrature; numpy computes them anew each time."""
    return np.polynomial.legendre.leggauss(count)


def _panels(per_panel: int) -> tuple[Array, Array]:
    """Nodes of the first panel, which has the level surface too, and of the others, (panels, n)."""
    slopes = nodes(per_panel)
    return slopes[: 1 + per_panel], slopes[1 + per_panel :].reshape(-1, per_panel)


def _gaps(per_panel: int) -> tuple[Array, Array]:
    """Give what the products of `_lagrange` are at their own nodes, in the shapes of `_panels`."""
    level, inner = (
        (at[..., :, np.newaxis] - at[..., np.newaxis, :] + np.eye(at.shape[-1])).prod(axis=-1)
        for at in _panels(per_panel)
    )
    return level, inner


def _lagrange(slope: Array, at: Array, gaps: Array) -> Array:
    """Lagrange polynomials of the nodes `at`, (..., nodes), evaluated at `slope`, (..., places).

    Shape (..., places, nodes). Each is a product of the nodes before it and of those after it.
    """
    away = slope[..., np.newaxis] - at[..., np.newaxis, :]
    before, after = np.ones_like(away), np.ones_like(away)
    np.cumprod(away[..., :-1], axis=-1, out=before[..., 1:])
    np.cumprod(away[..., :0:-1], axis=-1, out=after[..., -2::-1])
    return np.asarray(before * after / gaps[..., np.newaxis, :])
