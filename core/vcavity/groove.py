# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Light inside one infinitely long V-groove: shadow edges, exchange between walls, bounces.

Lengths are in units of a wall; x is the distance of a point from the bottom, so x = 1 is the rim.
A wall of slope θ makes the opening angle ω = π - 2θ with its opposite.

Only the cross-section matters. A direction of polar angle ϑ whose azimuth makes the angle φ with
the cross-section plane enters with m = tan ϑ cos φ tan θ. Three facts then give everything:

1. Both walls are lit whole for abs(m) ≤ 1; beyond that one wall is dark and the other is lit from
   the rim down to the fraction v = 2 / (1 + abs(m)) of its length. In units of what falls on the
   level surface the walls receive (1 ± κ) / v per unit of lit length, κ = m clipped to ±1.
2. The light that the part [p, 1] of one wall sends to the part [q, 1] of the other follows from
   crossed strings (H. C. Hottel, "Radiant heat transmission", in McAdams, Heat Transmission, 1954):
   M₁(p, q) = ½ (d(p, 1) + d(q, 1) - d(1, 1) - d(p, q)), d the distance between two points.
3. The operator that takes the light of one wall to the other is symmetric, so its eigenvectors
   turn every later bounce into powers of eigenvalues.

One groove therefore has, with Y₀ = 1 / max(v_i, v_r) and Y_k the k-fold exchange between the lit
and the visible part, each per unit of its length,

    a_k = cos θ (1 + (-1)^(k-1) κ_i κ_r) Y_(k-1)(v_i, v_r).

Y₀ and Y₁ are closed forms. Y₂ and later use a Galerkin projection on panels of constant radiosity
with exact crossed-string exchange between them, which keeps the energy whatever their number;
the error of Y_k falls with the square of that number.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numerics.arrays import Array

_RIM_SCALE = 3.0
"""Panels are spaced evenly in asinh(depth / (_RIM_SCALE · half the mouth)): a steep groove is lit
to a few mouth widths below its rim, and even spacing would leave that to one panel."""

_BOTTOM_EXPONENT = 1.3
"""x is raised to this power to crowd panels at the bottom, where the exchange varies as fast as
the walls approach. Without it the error at θ = 60° is 1.4 times as large."""


@dataclass(frozen=True)
class Grooves:
    """Grooves of several slopes, ready for any light and view.

    Attributes
    ----------
    slope
        θ of each groove, radians, shape (grooves,).
    ratio
        Eigenvalues of the exchange operator, 0..1, shape (grooves, modes).
    response
        Modes of the first exchange from a lit part per unit of its length, tabulated over the lit
        fraction, shape (grooves, table nodes, modes).
    """

    slope: Array
    ratio: Array
    response: Array

    def modes(self, fraction: Array) -> Array:
        """Interpolate `response` at lit fractions (..., grooves, n): (..., grooves, n, modes)."""
        last = self.response.shape[1] - 1
        scale = np.cos(self.slope)[:, np.newaxis]
        position = np.arcsinh(fraction / scale) * (last / np.arcsinh(1 / scale))
        index = np.minimum(position.astype(np.intp), last - 1)
        share = (position - index)[..., np.newaxis]
        groove = np.arange(self.slope.size)[:, np.newaxis]
        low = self.response[groove, index]
        high: Array = self.response[groove, index + 1]
        high -= low
        high *= share
        high += low
        return high


def build(slope: Array, panels: int, table_nodes: int) -> Grooves:
    """Solve the exchange in grooves of the given slopes (radians, shape (grooves,)).

    Examples
    --------
    >>> grooves = build(np.radians([0.0, 45.0]), panels=16, table_nodes=32)
    >>> grooves.ratio.shape, grooves.response.shape
    ((2, 16), (2, 32, 16))
    """
    ratios, responses = [], []
    for angle in slope:
        edges = _panel_edges(angle, panels)
        lengths = np.diff(edges)
        scaled = 1 / np.sqrt(lengths)
        shortfall = _string_shortfall(edges[:, np.newaxis], edges, angle)
        exchange = 0.5 * np.diff(np.diff(shortfall, axis=0), axis=1)
        ratio, vectors = np.linalg.eigh(exchange * scaled[:, np.newaxis] * scaled)
        lit = _table_fractions(angle, table_nodes)
        to_edges = (1 - edges) * exchange_per_length(lit[:, np.newaxis], 1 - edges, angle)
        responses.append(-np.diff(to_edges, axis=1) * scaled @ vectors)
        ratios.append(ratio)
    return Grooves(slope, np.array(ratios), np.array(responses))


def lit_fraction(m: Array) -> Array:
    """Part of the lit wall, from the rim down, that light of slope ratio `m` reaches.

    Examples
    --------
    >>> lit_fraction(np.array([0.5, -3.0])).tolist()
    [1.0, 0.5]
    """
    return np.asarray(2 / (1 + np.maximum(np.abs(m), 1)))


def exchange_per_length(v_i: Array, v_r: Array, slope: Array) -> Array:
    """Y₁: Hottel's M₁(1 - v_i, 1 - v_r) divided by v_i v_r, shape by broadcasting.

    Both divisions are done by algebra. The plain quotient loses every digit at grazing incidence,
    where v falls to 1e-16 and M₁ with it.

    Examples
    --------
    >>> whole, slope = np.ones(2), np.radians([0.0, 45.0])
    >>> np.round(exchange_per_length(whole, whole, slope), 4).tolist()
    [0.0, 0.2929]
    """
    p, q = 1 - v_i, 1 - v_r
    cos_opening = -np.cos(2 * slope)
    d_11 = 2 * np.cos(slope)
    d_p1 = _distance(p, 1.0, slope)
    d_1q = _distance(1.0, q, slope)
    d_pq = _distance(p, q, slope)
    far = 1 + q - 2 * cos_opening
    slide = (1 + p - 2 * cos_opening) / (d_11 + d_p1) + (1 + p - 2 * q * cos_opening) / (
        d_1q + d_pq
    )
    rims = d_11 + d_1q
    return np.asarray(0.5 * (2 * cos_opening * rims + far * slide) / (rims * (d_p1 + d_pq)))


def _distance(x: Array | float, y: Array | float, slope: Array | float) -> Array:
    """Distance between the points x and y of the two walls."""
    return np.asarray(np.sqrt((x - y) ** 2 + 4 * x * y * np.cos(slope) ** 2))


def _string_shortfall(x: Array, y: Array, slope: float) -> Array:
    """Give x + y - d(x, y) without cancellation in shallow grooves, where it is of order θ²."""
    total = x + y + _distance(x, y, slope)
    return np.asarray(4 * x * y * np.sin(slope) ** 2 / np.where(total > 0, total, 1))


def _panel_edges(slope: float, panels: int) -> Array:
    scale = _RIM_SCALE * np.cos(slope)
    depth = np.sinh(np.linspace(1, 0, panels + 1) * np.arcsinh(1 / scale)) * scale
    depth[0], depth[-1] = 1, 0
    return np.asarray((1 - depth) ** _BOTTOM_EXPONENT)


def _table_fractions(slope: float, nodes: int) -> Array:
    scale = np.cos(slope)
    return np.asarray(np.sinh(np.linspace(0, 1, nodes) * np.arcsinh(1 / scale)) * scale)
