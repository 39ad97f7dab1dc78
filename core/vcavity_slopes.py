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

from itertools import pairwise

import numpy as np

from .arrays import Array

PANEL_EDGES = np.radians([0, 3, 7, 14, 22, 30, 38, 45, 52, 60, 68, 76, 83, 87.5, 90])
"""Slopes between which a groove's answer is taken as one polynomial. 45° is among them because
that is where shadows begin for light at 45°; the last panels are short because the number of
bounces grows without bound toward 90°."""

_REACH = 9.0
"""The distribution is cut at 9σ, beyond which it holds 3e-18 of the area."""

_WEIGHT_NODES = 24
"""Gauss nodes a panel for the weights; 24 integrate the distribution over 9σ to 1e-10."""


def nodes(per_panel: int) -> Array:
    """Slopes at which grooves are solved, radians, shape (1 + panels · per_panel,).

    The first is 0: a level surface, whose answer is known, so that nothing but ρ is left as σ → 0.
    """
    points, _ = np.polynomial.legendre.leggauss(per_panel)
    low, high = PANEL_EDGES[:-1, np.newaxis], PANEL_EDGES[1:, np.newaxis]
    return np.concatenate(([0], (low + (points + 1) / 2 * (high - low)).ravel()))


def weights(sigma: Array, per_panel: int) -> Array:
    """Share of each slope of `nodes` at roughness σ (radians, shape (n,)): shape (n, slopes).

    The weights of one σ add up to 1. At σ = 0 they are those of a level surface.
    """
    slopes = nodes(per_panel)
    quadrature, quadrature_weights = np.polynomial.legendre.leggauss(_WEIGHT_NODES)
    spread = np.maximum(sigma, np.finfo(np.float64).tiny)[:, np.newaxis]
    out = np.zeros((sigma.size, slopes.size))
    for panel, (low, high) in enumerate(pairwise(PANEL_EDGES)):
        top = np.clip(_REACH * spread, low, high)
        slope = low + (quadrature + 1) / 2 * (top - low)
        # Every length is in units of σ: products of small σ underflow below 1e-154.
        with np.errstate(over="ignore"):
            share = np.exp(-0.5 * (slope / spread) ** 2)
        share *= np.sin(slope) / spread * ((top - low) / spread) * quadrature_weights
        first = 1 + panel * per_panel if panel else 0
        used = slice(first, 1 + (panel + 1) * per_panel)
        out[:, used] += np.einsum("nq,nqs->ns", share, _lagrange(slope, slopes[used]))
    return np.asarray(out / np.sum(out, axis=1, keepdims=True))


def _lagrange(slope: Array, at: Array) -> Array:
    """Lagrange polynomials of the nodes `at`, evaluated at `slope`: shape (*slope.shape, nodes)."""
    result = np.ones((*slope.shape, at.size))
    for node in range(at.size):
        for other in range(at.size):
            if other != node:
                result[..., node] *= (slope - at[other]) / (at[node] - at[other])
    return result
