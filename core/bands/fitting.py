# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of a few bands and what lamps send in them, by least squares of color differences.

Between bands a spectrum may be taken as a straight line. That gives weights which are never
negative: from them the search starts, and toward them it is pulled when others would raise noise.
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array

_PULL = 1e-4
"""Of the squares toward the start, as a share of the mean curvature."""
_STRONGER = 8.0
"""How much the pull grows while noise would be raised too much."""
_TURNS = 3
"""How often weights and lamps are fitted in turn where there are several lamps."""
_MIXED = 9
"""Steps from fitted weights to those that can mix lamps of any color."""
_ROUNDING = 1e-9
_NEUTRAL = 1e-9
"""Part of white by which a white surface may be off, as rounding is."""


def hats(wavelengths: Array, bands: Array) -> Array:
    """Parts of bands in wavelengths, if spectra are straight lines between bands: (all, bands).

    Examples
    --------
    >>> hats(np.array([400.0, 500.0, 550.0]), np.array([450.0, 550.0])).tolist()
    [[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]]
    """
    return np.stack([np.interp(wavelengths, bands, unit) for unit in np.eye(bands.size)], axis=1)


def raised(weights: Array, lights: Array) -> float:
    """Largest share by which noise of a white surface may grow through negative weights.

    Noise of the same relative size in all bands, whatever its signs, is at most as many times as
    large in X, Y or Z as the sum of the sizes of their parts is greater than their sum.

    Examples
    --------
    >>> raised(np.array([[1.2, 1.0, 1.0], [-0.2, 0.0, 0.0]]), np.ones((1, 2)))
    0.4
    """
    parts = weights * lights[..., np.newaxis]
    whole = np.abs(parts.sum(axis=1))
    share = np.abs(parts).sum(axis=1) / np.where(whole > 0, whole, 1) - 1
    return float(np.round(share.max(), 12))


def fit(
    transport: Array,
    targets: Array,
    metric: Array,
    start: tuple[Array, Array],
    whites: Array,
    most_raised: float,
) -> tuple[Array, Array]:
    """Fit weights, and what lamps send in the bands.

    Parameters
    ----------
    transport
        Of each lamp's light in the bands, shape (lamps, pixels, bands).
    targets
        What the observer sees of it, shape (lamps, pixels, channels).
    metric
        Matrices after which a difference of that is a plain distance, shape (pixels, channels,
        channels).
    start
        Weights (bands, channels) and lamps (lamps, bands) by `hats`.
    whites
        What the observer sees of the lamps, and white surfaces show exactly, (lamps, channels).
    most_raised
        See `raised`.

    Returns
    -------
    weights, lights
        Shapes (bands, channels) and (lamps, bands).

    Examples
    --------
    >>> transport = np.array([[[1.0, 0.0], [0.5, 0.5], [0.2, 0.8]]])
    >>> start = np.array([[0.5], [0.5]]), np.ones((1, 2))
    >>> targets = transport @ np.array([[0.3], [0.7]])
    >>> weights, _ = fit(transport, targets, np.ones((3, 1, 1)), start, np.array([[1.0]]), 0.2)
    >>> np.round(weights, 3).tolist()
    [[0.3], [0.7]]
    """
    pull = _PULL
    while True:
        weights, lights = start
        for _ in range(_TURNS if len(lights) > 1 else 1):
            weights = _weights(transport, targets, metric, (start[0], lights), whites, pull)
            if len(lights) > 1:
                lights = _lights(transport, targets, metric, (weights, start[1]), whites, pull)
        if raised(weights, lights) <= most_raised:
            break
        pull *= _STRONGER
    # Lamps of colors far apart may lie outside of what the bands can mix with these weights. Toward
    # a band for each channel they can mix more, and at last everything.
    fitted, far = weights, _a_band_a_channel(start[0])
    for share in np.linspace(0, 1, _MIXED):
        if share:
            weights = (1 - share) * fitted + share * far
            lights = _lights(transport, targets, metric, (weights, lights), whites, pull)
        neutral = np.abs(lights @ weights - whites).max() <= _NEUTRAL * whites.max()
        if neutral and raised(weights, lights) <= most_raised:
            break
    return weights, lights


def _a_band_a_channel(start: Array) -> Array:
    """Let each channel be a band of its own, near where it sees most: weights (bands, channels)."""
    bands, channels = start.shape
    weights = np.zeros_like(start)
    middles = np.arange(bands) @ start / start.sum(axis=0)
    band = -1
    for number, channel in enumerate(np.argsort(middles)):
        last = bands - (channels - number)  # leaves one for each channel that follows
        band = min(max(round(middles[channel]), band + 1), last)
        weights[band, channel] = start[:, channel].sum()
    return weights


def _weights(
    transport: Array,
    targets: Array,
    metric: Array,
    start: tuple[Array, Array],
    whites: Array,
    pull: float,
) -> Array:
    before, lights = start
    shown = transport * lights[:, np.newaxis]
    bands, channels = before.shape
    # Unknown are the weights, by band and then channel.
    gram = np.einsum("pab,pac->pbc", metric, metric)
    products = np.einsum("lpk,lpm->pkm", shown, shown)
    square = np.einsum("pkm,pbc->kbmc", products, gram).reshape((bands * channels,) * 2)
    missed = targets - shown @ before
    right = np.einsum("lpk,lpc,pbc->kb", shown, missed, gram, optimize=True).ravel()
    rows = wanted = None
    if len(lights) == 1:
        rows = np.kron(lights, np.eye(channels))
        wanted = whites[0] - lights[0] @ before
    return before + _least(square, right, rows, wanted, pull).reshape(bands, channels)


def _lights(
    transport: Array,
    targets: Array,
    metric: Array,
    start: tuple[Array, Array],
    whites: Array,
    pull: float,
) -> Array:
    weights, before = start
    seen = np.einsum("pab,kb->pak", metric, weights)
    found = before.copy()
    for lamp, (shown, target) in enumerate(zip(transport, targets, strict=True)):
        rows = seen * shown[:, np.newaxis]
        square = np.einsum("pak,pam->km", rows, rows)
        missed = np.einsum("pab,pb->pa", metric, target - (shown * before[lamp]) @ weights)
        right = np.einsum("pak,pa->k", rows, missed)
        found[lamp] = _not_below_0(square, right, weights.T, whites[lamp], before[lamp], pull)
    return found


def _not_below_0(
    square: Array, right: Array, rows: Array, white: Array, before: Array, pull: float
) -> Array:
    """Solve for a lamp; what would be negative is 0, and the others are solved again."""
    free = np.ones(before.size, bool)
    while True:
        part = np.ix_(free, free)
        at = np.where(free, before, 0.0)
        gone = square[:, ~free] @ before[~free]
        change = _least(square[part], (right + gone)[free], rows[:, free], white - rows @ at, pull)
        found = np.zeros(before.size)
        found[free] = at[free] + change
        negative = found < -_ROUNDING * np.abs(found).max()
        if not negative.any():
            return np.maximum(found, 0)
        if free.sum() - negative.sum() < len(white):
            return before
        free &= ~negative


def _least(
    square: Array, right: Array, rows: Array | None, wanted: Array | None, pull: float
) -> Array:
    """Least squares, pulled toward no change, with some sums met exactly (Lagrange)."""
    count = right.size
    mean = np.trace(square) / count
    pulled = square + pull * (mean if mean > 0 else 1.0) * np.eye(count)
    if rows is None or wanted is None:
        return np.asarray(np.linalg.solve(pulled, right))
    inverse = np.linalg.solve(pulled, np.column_stack((right, rows.T)))
    free, along = inverse[:, 0], inverse[:, 1:]
    factors, *_ = np.linalg.lstsq(rows @ along, wanted - rows @ free, rcond=1e-12)
    return np.asarray(free + along @ factors)
