# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The slope distributions, and one set of slopes that serves every roughness and either law.

A law says which share of *macroscopic* area (area seen from above) grooves of slope θ cover,
0 ≤ θ < π/2, normalized:

gaussian        tan θ sec²θ exp(-tan²θ / 2m²), m = tan σ: the slopes of a Gaussian random surface. m
                is their root mean square along a profile, a profilometer's Rdq; that of the
                gradient, Sdq, is √2 m. As σ → π/2 every groove becomes a slot.
oren-nayar      exp(-θ²/2σ²) sin θ: what the published formula was fitted to. σ is a parameter: at
                σ = 30° the slope angle has the mean 35.5°, the root mean square 39.8° and the
                standard deviation 18.0°.

What a groove reflects does not depend on σ or the law. It is computed at Gauss nodes of fixed
panels, and σ enters through weights alone: the integral of each node's Lagrange polynomial times
the distribution. So any σ, however small, costs one row of weights.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from ..errors import DomainError
from ..numerics.arrays import Array
from ..numerics.memoized import memoized

GAUSSIAN, OREN_NAYAR = "gaussian", "oren-nayar"

DEFAULT = GAUSSIAN
"""The law unless one is named: it agrees with random surfaces, see docs/physics.md."""

PANEL_EDGES = np.radians([0, 3, 7, 14, 22, 30, 38, 45, 52, 60, 68, 76, 83, 87.5, 90])
"""Slopes between which a groove's answer is taken as one polynomial. 45° is among them because
that is where shadows begin for light at 45°; the last panels are short because the number of
bounces grows without bound toward 90°."""

_REACH = 9.0
"""The distribution is cut at 9σ (at tan θ = 9m), beyond which it holds 3e-18 of the area."""

_LEAST = 1e-6
"""tan θ / m below which Gaussian slopes hold but 5e-13 of the area: its logarithm needs a limit."""

_WEIGHT_NODES = 24
"""Gauss nodes a panel for the weights; 24 integrate the distribution over 9σ to 1e-10. Gaussian
slopes at σ > 89.5°, which spread over decades of the last panel, get 1e-6."""

_BLOCK = 256
"""Roughnesses at a time: 4 MB an array."""


def check(slopes: str) -> None:
    """Check that there is a slope law of this name.

    Raises
    ------
    DomainError
        If there is none; the message lists the names.

    Examples
    --------
    >>> check("gaussian")
    """
    if slopes not in LAWS:
        msg = f"Slope law {slopes!r} is not known; choose one of: {', '.join(LAWS)}."
        raise DomainError(msg)


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


def weights(sigma: Array, per_panel: int, slopes: str = DEFAULT) -> Array:
    """Share of each slope of `nodes` at roughness σ (radians, shape (n,)): shape (n, slopes).

    The weights of one σ add up to 1. At σ = 0 they are those of a level surface.

    Raises
    ------
    DomainError
        If there is no law of the name `slopes`.

    Examples
    --------
    >>> shares = weights(np.array([0.0, 0.5]), 6)
    >>> np.round(shares.sum(axis=1), 12).tolist(), float(shares[0, 0])
    ([1.0, 1.0], 1.0)
    """
    check(slopes)
    if sigma.size == 1:
        return _of_one(float(sigma[0]), per_panel, slopes)
    if sigma.size > _BLOCK:
        blocks = np.split(sigma, range(_BLOCK, sigma.size, _BLOCK))
        return np.concatenate([weights(block, per_panel, slopes) for block in blocks])
    return _of_all(sigma, per_panel, slopes)


@memoized(maxsize=16)
def _of_one(sigma: float, per_panel: int, slopes: str) -> Array:
    """Keep those of one σ, which is asked for a reading, for a match and for a plot in turn."""
    found = _of_all(np.array([sigma]), per_panel, slopes)
    found.setflags(write=False)
    return found


def _of_all(sigma: Array, per_panel: int, slopes: str) -> Array:
    slope, share = LAWS[slopes](sigma)
    level, inner = _panels(per_panel)
    # Steeper ones are taken for the steepest solved: beyond it a polynomial knows nothing.
    slope = np.minimum(slope, inner[-1, -1]) if slopes == GAUSSIAN else slope
    of_level, of_inner = _gaps(per_panel)
    first = np.einsum("nq,nqs->ns", share[:, 0], _lagrange(slope[:, 0], level, of_level))
    others = np.einsum("npq,npqs->nps", share[:, 1:], _lagrange(slope[:, 1:], inner, of_inner))
    out = np.concatenate((first, others.reshape(sigma.size, inner.size)), axis=1)
    return np.asarray(out / np.sum(out, axis=1, keepdims=True))


def _gaussian(sigma: Array) -> tuple[Array, Array]:
    """Slopes and their shares of area, each of shape (n, panels, nodes of the quadrature).

    With u = tan θ / m the density is u exp(-u²/2), whatever σ. The first panel's nodes are spread
    over u and those of the others over its logarithm s, of which θ = atan(m exp s) is smooth.
    """
    points, points_weights = _gauss(_WEIGHT_NODES)
    # float32's π/2 lies above π/2 and has a negative tangent.
    spread = np.tan(np.clip(sigma, np.finfo(np.float64).tiny, np.pi / 2))[:, np.newaxis]
    with np.errstate(over="ignore"):
        edges = np.minimum(np.tan(PANEL_EDGES[:-1]) / spread, _REACH)
    edges = np.concatenate((edges, np.full_like(spread, _REACH)), axis=1)
    low, high = edges[:, :-1, np.newaxis], edges[:, 1:, np.newaxis]
    steep = np.log(np.maximum(low[:, 1:], _LEAST))
    width = np.concatenate((high[:, :1], np.log(np.maximum(high[:, 1:], _LEAST)) - steep), axis=1)
    place = (points + 1) / 2 * width
    u = np.concatenate((place[:, :1], np.exp(steep + place[:, 1:])), axis=1)
    share = u * np.exp(-0.5 * u * u) * width * points_weights
    share[:, 1:] *= u[:, 1:]
    return np.arctan(spread[..., np.newaxis] * u), share


def _oren_nayar(sigma: Array) -> tuple[Array, Array]:
    """As `_gaussian`, but the nodes are spread over θ."""
    points, points_weights = _gauss(_WEIGHT_NODES)
    spread = np.maximum(sigma, np.finfo(np.float64).tiny)[:, np.newaxis, np.newaxis]
    low, high = PANEL_EDGES[:-1, np.newaxis], PANEL_EDGES[1:, np.newaxis]
    top = np.clip(_REACH * spread, low, high)
    slope = low + (points + 1) / 2 * (top - low)
    # Every length is in units of σ: products of small σ underflow below 1e-154.
    with np.errstate(over="ignore"):
        share = np.exp(-0.5 * (slope / spread) ** 2)
    share *= np.sin(slope) / spread * ((top - low) / spread) * points_weights
    return slope, share


LAWS: Mapping[str, Callable[[Array], tuple[Array, Array]]] = MappingProxyType(
    {GAUSSIAN: _gaussian, OREN_NAYAR: _oren_nayar}
)
"""The slope laws by name."""


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
