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
_PROBE = 1e-5
"""Step of derivatives, of parameters that run from 0 to 1."""
_METRIC_PROBE = 0.02
"""Step in Lab within which a color difference is a quadratic form."""
_KINK = 0.01
"""Difference below which a place counts as met, and its weight grows no more."""
_SETTLED = 1e-4
"""Gain below which a search ends. With ten times as much, some end over 0.02 above the least."""


def fit(
    perceive: Callable[[Array], Array],
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
        Lab in all places of parameters within 0 and 1: (..., n) -> (..., places, 3).
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
    metric = _metric(wanted, difference)
    found = np.array(starts, np.float64)
    count = found.shape[1]
    damping = np.full(len(found), 1e-3)
    seen, slopes = _linear(perceive, found)
    cost = _cost(seen - wanted, metric, weights)
    for _ in range(_STEPS):
        apart = seen - wanted
        scaled = weights / np.sqrt(_square(apart, metric) + _KINK**2)
        pulled = np.einsum("bg,gij,bgj->bgi", scaled, metric, apart)
        gradient = np.einsum("bgin,bgi->bn", slopes, pulled)
        leaning = np.einsum("gij,bgjn->bgin", metric, slopes) * scaled[..., np.newaxis, np.newaxis]
        bend = np.einsum("bgin,bgim->bnm", slopes, leaning)
        bend += np.eye(count) * (damping * np.trace(bend, axis1=1, axis2=2))[:, None, None]
        # What already lies at its bound and would leave it stays there.
        outward = ((found <= 0) & (gradient > 0)) | ((found >= 1) & (gradient < 0))
        moving = free & ~outward
        both = moving[:, :, np.newaxis] & moving[:, np.newaxis, :]
        bend = np.where(both, bend, np.eye(count))
        step = np.linalg.solve(bend, np.where(moving, -gradient, 0)[..., np.newaxis])[..., 0]
        tried = np.clip(found + step, 0, 1)
        new_seen, new_slopes = _linear(perceive, tried)
        new_cost = _cost(new_seen - wanted, metric, weights)
        better = new_cost < cost
        gained = np.where(better, cost - new_cost, 0)
        damping = np.where(better, damping / 5, damping * 8)
        found = np.where(better[:, None], tried, found)
        seen = np.where(better[:, None, None], new_seen, seen)
        slopes = np.where(better[:, None, None, None], new_slopes, slopes)
        cost = np.where(better, new_cost, cost)
        if ((better & (gained < _SETTLED)) | (damping > 1e3)).all():
            break
    return found, difference(seen, wanted)


def _linear(perceive: Callable[[Array], Array], at: Array) -> tuple[Array, Array]:
    """Lab (starts, places, 3) and its derivatives (starts, places, 3, n)."""
    count = at.shape[1]
    # Probes go inward, where the shader is defined.
    steps = np.where(at > 0.5, -_PROBE, _PROBE)
    probes = at[:, np.newaxis] + np.eye(count) * steps[:, np.newaxis]
    values = perceive(np.concatenate((at[:, np.newaxis], probes), axis=1))
    changes = (values[:, 1:] - values[:, :1]) / steps[..., np.newaxis, np.newaxis]
    return values[:, 0], np.moveaxis(changes, 1, -1)


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


def _square(apart: Array, metric: Array) -> Array:
    return np.asarray(np.maximum(np.einsum("bgi,gij,bgj->bg", apart, metric, apart), 0))


def _cost(apart: Array, metric: Array, weights: Array) -> Array:
    return np.asarray((weights * np.sqrt(_square(apart, metric) + _KINK**2)).sum(axis=-1))
