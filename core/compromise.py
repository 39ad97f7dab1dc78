# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The least sum of color differences that one material can have in many places at once.

A sum of differences, not of their squares: most places then come out right and the few that
contradict them stay wrong, as a median does. Such a sum has a kink wherever a place is met, so the
search weights squares anew in each step (iteratively reweighted least squares; Gauss-Newton with
Levenberg's damping, projected onto the bounds).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import Array

_STEPS = 24
_METRIC_PROBE = 0.02
"""Step in Lab within which a color difference is a quadratic form."""
_KINK = 0.01
"""Difference below which a place counts as met, and its weight grows no more."""
_SETTLED = 1e-4
"""Gain below which a search ends. With ten times as much, some end over 0.02 above the least."""


def fit(
    perceive: Callable[[Array], tuple[Array, Array]],
    wanted: Array,
    weights: Array,
    difference: Callable[[Array, Array], Array],
    starts: Array,
    free: Array,
) -> tuple[Array, Array]:
    """Search from several starts at once.

    Parameters
    ----------
    perceive
        Lab in all places of parameters within 0 and 1, and its derivatives by them:
        (starts, n) -> (starts, places, 3) and (starts, places, 3, n).
    wanted
        Lab that the places should show, shape (places, 3).
    weights
        Of the places, shape (places,).
    difference
        Color difference of two arrays of Lab, (..., 3) and (..., 3) -> (...).
    starts
        Parameters to start from, shape (starts, n).
    free
        Which of them may change, shape (starts, n).

    Returns
    -------
    found, differences
        Parameters, shape (starts, n), and what remains in each place, shape (starts, places).
    """
    whitener = _whitener(wanted, difference)
    found = np.array(starts, np.float64)
    apart, slopes = _linear(perceive, found, wanted, whitener)
    cost, damping = _cost(apart, weights), np.full(len(found), 1e-3)
    searching = np.arange(len(found))
    for _ in range(_STEPS):
        at = found[searching]
        gradient, bend = _normal(apart[searching], slopes[searching], weights)
        step = _step(at, gradient, bend, damping[searching], free[searching])
        new_apart, new_slopes = _linear(perceive, at + step, wanted, whitener)
        new_cost = _cost(new_apart, weights)
        gained = cost[searching] - new_cost
        better = gained > 0
        kept = searching[better]
        found[kept], cost[kept] = (at + step)[better], new_cost[better]
        apart[kept], slopes[kept] = new_apart[better], new_slopes[better]
        damping[searching] *= np.where(better, 1 / 5, 8)
        # Where a step gains nothing, what it had promised tells whether there is more to find.
        promised = -np.einsum("bn,bn->b", gradient + (bend @ step[..., None])[..., 0] / 2, step)
        ended = np.where(better, gained, promised) < _SETTLED
        searching = searching[~ended & (damping[searching] <= 1e3)]
        if not searching.size:
            break
    return found, difference(perceive(found)[0], wanted)


def _linear(
    perceive: Callable[[Array], tuple[Array, Array]], at: Array, wanted: Array, whitener: Array
) -> tuple[Array, Array]:
    """Whitened distance from what is wanted (starts, places, 3), and its slopes (…, 3, n)."""
    seen, slopes = perceive(at)
    return (whitener @ (seen - wanted)[..., np.newaxis])[..., 0], whitener @ slopes


def _normal(apart: Array, slopes: Array, weights: Array) -> tuple[Array, Array]:
    """Gradient (starts, n) and curvature (starts, n, n) of the squares, weighted anew."""
    root = np.sqrt(weights / np.sqrt((apart * apart).sum(axis=-1) + _KINK**2))[..., np.newaxis]
    rows = (slopes * root[..., np.newaxis]).reshape(len(apart), -1, slopes.shape[-1])
    columns = np.swapaxes(rows, 1, 2)
    pulled = (apart * root).reshape(len(apart), -1, 1)
    return (columns @ pulled)[..., 0], columns @ rows


def _step(at: Array, gradient: Array, bend: Array, damping: Array, free: Array) -> Array:
    """Step to the least of the squares, damped, within the bounds."""
    one = np.eye(at.shape[1])
    damped = bend + one * (damping * np.trace(bend, axis1=1, axis2=2))[:, None, None]
    # What already lies at its bound and would leave it stays there.
    outward = ((at <= 0) & (gradient > 0)) | ((at >= 1) & (gradient < 0))
    moving = free & ~outward
    both = moving[:, :, np.newaxis] & moving[:, np.newaxis, :]
    pull = np.where(moving, -gradient, 0)[..., np.newaxis]
    step = np.linalg.solve(np.where(both, damped, one), pull)[..., 0]
    return np.asarray(np.clip(at + step, 0, 1) - at)


def _whitener(at: Array, difference: Callable[[Array, Array], Array]) -> Array:
    """Matrices (places, 3, 3) after which the difference is a plain distance."""
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


def _cost(apart: Array, weights: Array) -> Array:
    return np.asarray((weights * np.sqrt((apart * apart).sum(axis=-1) + _KINK**2)).sum(axis=-1))
