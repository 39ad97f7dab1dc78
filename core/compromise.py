# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The least sum of color differences that one material can have in many places at once.

A sum of differences, not of their squares: most places then come out right and the few that
contradict them stay wrong, as a median does. Such a sum has a kink wherever a place is met, so the
search weights squares anew in each step (iteratively reweighted least squares; Gauss-Newton with
Levenberg's damping, projected onto the bounds). Near the end each step takes the same part of what
is left, so steps get longer as long as they gain (Salakhutdinov and Roweis, "Adaptive Overrelaxed
Bound Optimization Methods", 2003).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import Array

_STEPS = 24
_SIFTED = 3
"""Steps after which only the best of the starts goes on that are free in the same parameters. Any
fewer, and the best then is not always the best in the end."""
_LONGER = 1.3
"""How much longer each step is than the last one, if that gained; if not, it has its own length."""
_LONGEST = 4.0
_DAMPING = 1e-5
"""Of the first step, as a share of the trace; a tenth after each that gains, eight times if not."""
_METRIC_PROBE = 0.02
"""Step in Lab within which a color difference is a quadratic form."""
_KINK = 0.01
"""Difference below which a place counts as met, and its weight grows no more."""
_SETTLED = 1e-4
"""Gain below which a search ends. With ten times as much, some end over 0.02 above the least."""


def fit(
    distance: Callable[[Array], tuple[Array, Array]], weights: Array, starts: Array, free: Array
) -> Array:
    """Search from several starts at once.

    Parameters
    ----------
    distance
        How far all places are from what is wanted, in a space where color differences are plain
        distances (see `whitener`), for parameters within 0 and 1, and its derivatives by them:
        (starts, n) -> (starts, 3, places) and (starts, n, 3, places).
    weights
        Of the places, shape (places,).
    starts
        Parameters to start from, shape (starts, n).
    free
        Which of them may change, shape (starts, n).

    Returns
    -------
    Parameters, shape (starts, n).
    """
    found = np.array(starts, np.float64)
    cost, gradient, bend = _squares(*distance(found), weights)
    damping, length = np.full(len(found), _DAMPING), np.ones(len(found))
    searching = np.arange(len(found))
    for number in range(1, _STEPS + 1):
        at, pull, curve = found[searching], gradient[searching], bend[searching]
        step = _step(at, pull, curve, damping[searching], free[searching])
        relaxed = length[searching]
        to = np.clip(at + step * relaxed[:, np.newaxis], 0, 1)
        new_cost, new_gradient, new_bend = _squares(*distance(to), weights)
        gained = cost[searching] - new_cost
        better = gained > 0
        kept = searching[better]
        found[kept], cost[kept] = to[better], new_cost[better]
        gradient[kept], bend[kept] = new_gradient[better], new_bend[better]
        # Where a step gains nothing, what it promised tells whether there is more to find; one that
        # was longer is tried again at its own length first.
        step = to - at
        promised = -((pull + (curve @ step[..., np.newaxis])[..., 0] / 2) * step).sum(axis=1)
        promised = np.where(better, gained, np.where(relaxed > 1, np.inf, promised))
        damping[searching] *= np.where(better, 0.1, np.where(relaxed > 1, 1, 8))
        length[searching] = np.where(better, np.minimum(relaxed * _LONGER, _LONGEST), 1)
        going = (promised >= _SETTLED) & (damping[searching] <= 1e3)
        if number == _SIFTED:
            going &= _best_of_their_kind(cost, free)[searching]
        searching = searching[going]
        if not searching.size:
            break
    return found


def _best_of_their_kind(cost: Array, free: Array) -> Array:
    """Whether each start is the best of those that are free in the same parameters."""
    alike = (free[:, np.newaxis] == free).all(axis=-1)
    return np.asarray(cost <= np.where(alike, cost, np.inf).min(axis=1))


def _squares(apart: Array, slopes: Array, weights: Array) -> tuple[Array, Array, Array]:
    """Sum of differences (starts,), and the squares that touch it there.

    Their gradient (starts, n) and curvature (starts, n, n).
    """
    starts, n = slopes.shape[:2]
    lengths = np.sqrt((apart * apart).sum(axis=1) + _KINK**2)
    rows = (slopes * (weights / lengths)[:, np.newaxis, np.newaxis]).reshape(starts, n, -1)
    gradient = (rows @ apart.reshape(starts, -1, 1))[..., 0]
    return lengths @ weights, gradient, rows @ np.swapaxes(slopes.reshape(starts, n, -1), 1, 2)


def _step(at: Array, gradient: Array, bend: Array, damping: Array, free: Array) -> Array:
    """Step to the least of the squares, damped, of what is free to move."""
    one = np.eye(at.shape[1])
    # What already lies at its bound and would leave it stays there.
    moving = free & np.where(gradient > 0, at > 0, at < 1)
    both = moving[:, :, np.newaxis] & moving[:, np.newaxis]
    most = damping * np.trace(bend, axis1=1, axis2=2)
    bowl = np.where(both, bend, 0) + one * np.where(moving, most[:, np.newaxis], 1)[:, np.newaxis]
    return np.asarray(np.linalg.solve(bowl, (moving * -gradient)[..., np.newaxis])[..., 0])


def whitener(at: Array, difference: Callable[[Array, Array], Array]) -> Array:
    """Matrices after which a color difference is a plain distance, close to some colors.

    Parameters
    ----------
    at
        The colors, (places, 3).
    difference
        Of two arrays of colors, (..., 3) and (..., 3) -> (...).

    Returns
    -------
    Shape (places, 3, 3), from colors to the space of distances.
    """
    squares, axes = np.linalg.eigh(_metric(at, difference))
    return np.asarray(np.sqrt(np.maximum(squares, 0))[..., np.newaxis] * np.swapaxes(axes, 1, 2))


def _metric(at: Array, difference: Callable[[Array, Array], Array]) -> Array:
    """Quadratic form of the difference around colors of shape (places, 3): (places, 3, 3)."""
    axes = np.eye(3)
    pairs = [(i, j) for i in range(3) for j in range(i, 3)]
    ways = np.stack([axes[i] + (axes[j] if i != j else 0) for i, j in pairs]) * _METRIC_PROBE
    squares = (difference(at + ways[:, np.newaxis], at) / _METRIC_PROBE) ** 2
    by_pair = dict(zip(pairs, squares, strict=True))
    metric = np.empty((len(at), 3, 3))
    for i, j in pairs:
        cross = by_pair[i, j] if i == j else (by_pair[i, j] - by_pair[i, i] - by_pair[j, j]) / 2
        metric[:, i, j] = metric[:, j, i] = cross
    return metric
