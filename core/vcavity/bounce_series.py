# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reflectance factor as a function of albedo: bounce coefficients with their tail.

r(ρ) = Σ_k≤K a_k ρ^k + ρ^(K+1) Σ_j w_j / (1 - ρ g_j)

is stored as one row (a_1 … a_K, w_1 … w_J). Steep grooves let a_k fall only like 1/k²: white
facets at σ = 50°, 45°/0° still send out 4 % of the light after the 16th bounce, so the tail has to
be summed and not cut off. The ratios g_j are the same for every surface, which keeps the rows
linear: rows of grooves, geometries or apertures average to the row of the mixture.

r grows and is convex on 0 ≤ ρ ≤ 1, because every a_k is positive. Outside there is no physics, but
there are readings: r goes on as r(1) ρ above 1 and as a_1 ρ below 0. So a reading 5 % above that
of white facets gives the albedo 1.05, which can be reported, and the map stays one to one. (The
tangent at 1 would not do: in steep grooves it is so steep that the albedo would be 1.002.)
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array

TAIL_RATIOS = np.array([-1.0, *(1 - 0.25 ** np.arange(8))])
"""The g_j. Grooves solved here hold ratios up to 1 - 8e-5; factors of 4 in 1 - g reach them in
eight steps and let `tail_shares` reproduce any ratio in between to 2e-6 of the reflectance. -1
serves the part of the light that changes sides at each bounce."""

_BLOCK = 1 << 14
"""Values worked on at once: about 1 MB with the temporaries, which stays in a core's cache."""

_NEWTON_STEPS = 6
"""Measured for 45a:0: six steps reach 1e-14 at every σ and ρ, five 4e-9. The slow place is ρ near
0.999 at σ = 90°, where the slope of r grows from 3.6 to 44 within the last percent."""


def tail_shares(ratio: Array, bounces: int) -> Array:
    """Shares of `TAIL_RATIOS` that stand for a geometric tail ρ^(K+1) / (1 - ρ g).

    Parameters
    ----------
    ratio
        g, any shape, -1 < g < 1.
    bounces
        K.

    Returns
    -------
    Least-squares shares over 0 ≤ ρ ≤ 1, exact at ρ = 1, shape (..., J).

    Examples
    --------
    >>> shares, albedo = tail_shares(np.array([0.5]), 6), np.array([0.3, 1.0])
    >>> np.round(shares @ (1 / (1 - np.outer(TAIL_RATIOS, albedo))), 3).tolist()
    [[1.064, 2.0]]
    """
    # ρ crowds toward 1, where 1 / (1 - ρ g) does what it does.
    rho = 1 - np.concatenate(([0], np.geomspace(1e-4, 0.95, 60)))
    row = np.ones(rho.size)
    row[0] = 1e4  # large enough to make the equation at ρ = 1 hold to rounding
    row *= rho ** (bounces + 1)
    basis = row[:, np.newaxis] / (1 - np.outer(rho, TAIL_RATIOS))
    target = row[:, np.newaxis] / (1 - np.outer(rho, ratio.ravel()))
    shares = np.linalg.lstsq(basis, target, rcond=1e-13)[0]
    return np.asarray(shares.T.reshape(*ratio.shape, TAIL_RATIOS.size))


def evaluate(series: Array, albedo: Array) -> Array:
    """r(ρ) of rows (..., K + J) at albedos (..., bands); leading axes broadcast.

    The result has the precision of `albedo`.

    Examples
    --------
    >>> row = np.concatenate(([0.5, 0.25], np.zeros(TAIL_RATIOS.size)))
    >>> np.round(evaluate(row, np.array([-0.1, 0.4, 1.0, 2.0])), 4).tolist()
    [-0.05, 0.24, 0.75, 1.5]
    """
    series = series.astype(albedo.dtype, copy=False)
    if albedo.ndim == 1:
        return _evaluate_matrix(series, albedo)
    rows, values, shape = _align(series, albedo)
    out = np.empty_like(values)
    for block in _blocks(values.shape):
        inside = np.clip(values[block], 0, 1)
        out[block], _ = _value_and_slope(rows[block], inside)
        # r(1) where ρ > 1, and r(0) / 0 = a_1 where ρ < 0.
        ratio = np.where(values[block] < 0, rows[block, :1], out[block])
        out[block] += ratio * (values[block] - inside)
    return out.reshape(shape)


def invert(series: Array, reading: Array) -> Array:
    """ρ with r(ρ) = `reading`, by a fixed number of Newton steps; shapes as in `evaluate`.

    Examples
    --------
    >>> row = np.concatenate(([0.5, 0.25], np.zeros(TAIL_RATIOS.size)))
    >>> np.round(invert(row, np.array([-0.05, 0.24, 0.75, 1.5])), 12).tolist()
    [-0.1, 0.4, 1.0, 2.0]
    """
    series = series.astype(reading.dtype, copy=False)
    rows, values, shape = _align(series, reading)
    white, _ = _value_and_slope(rows, np.ones((rows.shape[0], 1), rows.dtype))
    out = np.empty_like(values)
    for block in _blocks(values.shape):
        target, first, top = values[block], rows[block, :1], white[block]
        inside = np.clip(target, 0, top)
        rho = _closure_guess(first, rows[block, 1:2], top, inside)
        for _ in range(_NEWTON_STEPS):
            value, slope = _value_and_slope(rows[block], rho)
            # r is convex, so every step but the first lands above the root and none overshoots.
            rho = np.clip(rho - (value - inside) / slope, 0, 1)
        excess = np.maximum(target - top, 0) / top
        out[block] = rho + excess + np.minimum(target, 0) / first
    return out.reshape(shape)


def _evaluate_matrix(series: Array, albedo: Array) -> Array:
    """One spectrum under many rows: a product of two small matrices."""
    bounces = series.shape[-1] - TAIL_RATIOS.size
    inside = np.clip(albedo, 0, 1)
    order = np.arange(1, bounces + 1)[:, np.newaxis]
    tail = 1 / (1 - np.outer(TAIL_RATIOS, inside))
    basis = np.concatenate((inside**order, inside ** (bounces + 1) * tail))
    basis *= np.maximum(albedo, 1)
    basis[0] += np.minimum(albedo, 0)
    return np.asarray(series @ basis.astype(series.dtype, copy=False))


def _align(series: Array, values: Array) -> tuple[Array, Array, tuple[int, ...]]:
    """Flatten the common leading axes of rows and spectra into one."""
    lead = np.broadcast_shapes(series.shape[:-1], values.shape[:-1])
    rows = np.broadcast_to(series, (*lead, series.shape[-1])).reshape(-1, series.shape[-1])
    shape = (*lead, values.shape[-1])
    count = int(np.prod(lead))
    return rows, np.broadcast_to(values, shape).reshape(count, values.shape[-1]), shape


def _blocks(shape: tuple[int, ...]) -> list[slice]:
    step = max(1, _BLOCK // max(1, shape[1]))
    return [slice(start, start + step) for start in range(0, shape[0], step)]


def _value_and_slope(rows: Array, rho: Array) -> tuple[Array, Array]:
    """r(ρ) and dr/dρ for rows (n, K + J) and albedos (n, bands) in [0, 1]."""
    bounces = rows.shape[1] - TAIL_RATIOS.size
    tail = np.zeros_like(rho)
    tail_slope = np.zeros_like(rho)
    for column, ratio in enumerate(TAIL_RATIOS.astype(rho.dtype), start=bounces):
        part = 1 / (1 - ratio * rho)
        tail_slope += (rows[:, column, np.newaxis] * ratio) * part * part
        part *= rows[:, column, np.newaxis]
        tail += part
    # Horner's form of a_1 ρ + … + a_K ρ^K + tail(ρ) ρ^(K+1), and of its derivative beside it.
    value, slope = tail, tail_slope
    for column in range(bounces - 1, -1, -1):
        slope *= rho
        slope += value
        value *= rho
        value += rows[:, column, np.newaxis]
    slope *= rho
    slope += value
    value *= rho
    return value, slope


def _closure_guess(first: Array, second: Array, white: Array, reading: Array) -> Array:
    """Invert a_1 ρ + a_2 ρ²/(1 - g ρ) with the g that meets r(1), as a first guess."""
    later = np.maximum(white - first, np.finfo(white.dtype).tiny)
    ratio = np.clip(1 - second / later, 0, 1)
    linear = first + ratio * reading
    square = second - ratio * first
    # The sum stays positive, but float32 rounding may take it below 0 near ρ = 1.
    root = np.sqrt(np.maximum(linear * linear + 4 * square * reading, 0))
    return np.asarray(np.clip(2 * reading / (linear + root), 0, 1))
