# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All bounces in one square root, and its inverse.

    r = ρ (b + a / (1 + √(1 - g ρ)))  =  b ρ + (a/g) (1 - √(1 - g ρ))

The first term is light that leaves after one bounce. The second is a random walk between two
walls: the chance to leave at the k-th step of such a walk has the generating function
1 - √(1 - ρ), whose coefficients fall like k^-1.5, as the bounces of steep grooves do. A geometric
series falls too fast to follow them.

r grows with ρ because b + a/2 > 0 and a ≥ 0, and its inverse is a quadratic in 1 - √(1 - g ρ).
Above ρ = 1 there is no physics; there r goes on as r(1) ρ, so that a reading 5 % above that of
white facets gives the albedo 1.05.

a, b and g depend on the surface, its roughness and the directions: see `core.closure.table`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..numerics.arrays import Array
from ..numerics.blocks import apply_in_blocks


def over_blocks(
    formula: Callable[..., None], coefficients: tuple[Array, Array, Array], values: Array
) -> Array:
    """Apply `formula(out, values, b, a, g)` to spectra, in their precision.

    Examples
    --------
    >>> level = np.array(0.5), np.array(1.0), np.array(0.0)
    >>> over_blocks(forward, level, np.array([0.25, 0.5])).tolist()
    [0.25, 0.5]
    """
    per_spectrum = [c.astype(values.dtype, copy=False)[..., np.newaxis] for c in coefficients]
    out = np.empty(np.broadcast_shapes(values.shape, per_spectrum[0].shape), values.dtype)
    # ∞ - ∞ and 0 · ∞ are NaN, and need no warning beside it.
    with np.errstate(invalid="ignore"):
        apply_in_blocks(formula, out, values, *per_spectrum)
    return out


def forward(out: Array, rho: Array, single: Array, walk: Array, ratio: Array) -> None:
    """Write r of ρ for b, a and g, which broadcast: a formula for `over_blocks`.

    Examples
    --------
    >>> out = np.empty(2)
    >>> forward(out, np.array([0.5, 1.0]), np.array(0.5), np.array(1.0), np.array(0.0))
    >>> out.tolist()
    [0.5, 1.0]
    """
    # A comparison with NaN is false, so NaN goes the longer way, like albedos above 1.
    inside = rho if np.max(rho) <= 1 else np.minimum(rho, 1)
    np.multiply(inside, -ratio, out=out)
    out += 1
    np.sqrt(out, out=out)
    # a/g · (1 - √(1 - gρ)) would lose its digits for small gρ; the sum has no difference in it.
    out += 1
    np.divide(walk, out, out=out)
    out += single
    # Where ρ > 1 the bracket is r(1), so this is r(1) ρ.
    out *= rho


def inverse(out: Array, reading: Array, single: Array, walk: Array, ratio: Array) -> None:
    """Write ρ of r for b, a and g, which broadcast: a formula for `over_blocks`.

    Examples
    --------
    >>> out = np.empty(2)
    >>> inverse(out, np.array([0.5, 1.0]), np.array(0.5), np.array(1.0), np.array(0.0))
    >>> out.tolist()
    [0.5, 1.0]
    """
    white = single + walk / (1 + np.sqrt(1 - ratio))
    within = np.max(reading) <= np.min(white)
    inside = reading if within else np.minimum(reading, white)
    # With w = (1 - √(1 - gρ)) / g the form is r = (2b + a) w - b g w², and ρ = w (2 - g w).
    linear = 2 * single + walk
    np.multiply(inside, -4 * single * ratio, out=out)
    out += linear * linear
    np.sqrt(out, out=out)
    out += linear
    np.divide(inside, out, out=out)
    # out is w/2 here.
    out *= 4 - (4 * ratio) * out
    if not within:
        out *= np.maximum(reading / white, 1)
