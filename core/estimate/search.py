# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The σ that explains readings best, and the interval that noise leaves open.

A grid over σ finds the valley, Gauss and Newton its lowest point. The interval is where χ² is less
than 3.84 above that, 95 % of what noise does, and not σ ± 1.96 standard errors: near σ = 0 the
readings depend on σ² alone, and a parabola over σ would promise an interval that reaches below 0 or
misses the truth. There the interval begins at 0. For a smooth surface it then holds the truth in
97.5 % of all cases, and in 95 % as soon as σ is told from 0.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..numerics.arrays import Array
from . import likelihood
from .readings import Measured

QUANTILE = 1.959964
"""Of the normal distribution, for 95 % within both sides."""

_STEPS = 6
"""Of Gauss and Newton toward the lowest point; four are enough but at σ → 0."""

_GRID_STEPS = 1
"""Toward the albedos of the grid, where only the valley is looked for."""

_END_STEPS = 7
"""Of regula falsi (Illinois) toward an end of the interval."""

_AT_ONCE = 1 << 20
"""Numbers in an array of the grid: 8 MB."""


class Found(NamedTuple):
    """Best σ with its interval, radians, shapes (draws,) and (draws, 2), and what was fitted."""

    sigma: Array
    interval: Array
    chi_square: Array
    albedo: Array


def search(measured: Measured, model: str, values: Array, nodes: Array) -> Found:
    """Find σ of draws of readings.

    Parameters
    ----------
    measured
        Which reading is of what, and its weights.
    values
        Shape (draws, readings, bands).
    nodes
        σ to begin with, radians, increasing from 0; the last is the largest that is thought of.

    Examples
    --------
    >>> from .readings import Reading, prepare
    >>> pair = prepare([Reading([0.5], rough=False), Reading([0.42])])
    >>> found = search(pair, "two-bounce", pair.values[np.newaxis], np.radians(np.arange(61.0)))
    >>> np.round(np.degrees(found.sigma), 1).tolist()
    [28.7]
    >>> np.round(np.degrees(found.interval), 1).tolist()
    [[28.4, 29.0]]
    """
    step = max(1, _AT_ONCE // (nodes.size * max(1, measured.values.size)))
    blocks = [
        _search(measured, model, values[start : start + step], nodes)
        for start in range(0, len(values), step)
    ]
    return Found(*(np.concatenate(parts) for parts in zip(*blocks, strict=True)))


def _search(measured: Measured, model: str, values: Array, nodes: Array) -> Found:
    on_grid = likelihood.fit(measured, model, values[:, np.newaxis], nodes, steps=_GRID_STEPS)
    chi_square = on_grid.chi_square
    draw = np.arange(len(values))
    lowest = chi_square.argmin(axis=1)
    squares = nodes**2
    low = squares[np.maximum(lowest - 1, 0)]
    high = squares[np.minimum(lowest + 1, nodes.size - 1)]
    square, best = _descend(
        measured, model, values, squares[lowest], on_grid.albedo[draw, lowest], low, high
    )
    ends = _ends(measured, model, values, (square, best), squares, chi_square)
    return Found(np.sqrt(square), np.sqrt(ends), best.chi_square, best.albedo)


def _descend(
    measured: Measured,
    model: str,
    values: Array,
    square: Array,
    albedo: Array,
    low: Array,
    high: Array,
) -> tuple[Array, likelihood.Fitted]:
    """Go from σ² to the lowest point between `low` and `high`; a step that climbs is halved."""
    best = likelihood.fit(measured, model, values, np.sqrt(square), albedo)
    reach = np.ones(len(values))
    for _ in range(_STEPS):
        free = likelihood.sensitivity(measured, model, best, square)
        pull = np.sum(measured.weights * free * (values - best.predicted), axis=(-2, -1))
        information = np.sum(measured.weights * free * free, axis=(-2, -1))
        step = np.divide(pull, information, out=np.zeros_like(pull), where=information > 0)
        tried = np.clip(square + reach * step, low, high)
        there = likelihood.fit(
            measured, model, values, np.sqrt(tried), best.albedo, likelihood.FEW_STEPS
        )
        better = there.chi_square <= best.chi_square
        reach = np.where(better, 1.0, reach / 4)
        square = np.where(better, tried, square)
        best = likelihood.Fitted(
            *(
                np.where(better.reshape(-1, *[1] * (new.ndim - 1)), new, old)
                for new, old in zip(there, best, strict=True)
            )
        )
    return square, best


def _ends(
    measured: Measured,
    model: str,
    values: Array,
    best: tuple[Array, likelihood.Fitted],
    squares: Array,
    chi_square: Array,
) -> Array:
    """Find the σ² on both sides of the best at which χ² has risen by 3.84: shape (draws, 2)."""
    square, fitted = best
    within = chi_square <= fitted.chi_square[:, np.newaxis] + QUANTILE**2
    ends = []
    for lowest in (True, False):
        # The outermost node that noise leaves open, or the best itself.
        unlikely = np.inf if lowest else -np.inf
        open_nodes = np.where(within, squares, unlikely)
        inner = (
            np.minimum(open_nodes.min(axis=1), square)
            if lowest
            else np.maximum(open_nodes.max(axis=1), square)
        )
        side = "left" if lowest else "right"
        place = np.searchsorted(squares, inner, side) - (1 if lowest else 0)
        at_limit = (place < 0) | (place >= squares.size)
        outer = np.where(at_limit, inner, squares[np.clip(place, 0, squares.size - 1)])
        ends.append(_crossing(measured, model, values, best, inner, outer))
    return np.stack(ends, axis=1)


def _crossing(
    measured: Measured,
    model: str,
    values: Array,
    best: tuple[Array, likelihood.Fitted],
    inner: Array,
    outer: Array,
) -> Array:
    """Find where √(χ² - its least) is the quantile, between σ² inside and outside of it.

    The root is nearly straight over σ², so that regula falsi needs few steps.
    """

    def above(square: Array) -> Array:
        there = likelihood.fit(
            measured, model, values, np.sqrt(square), best[1].albedo, likelihood.FEW_STEPS
        )
        return np.sqrt(np.maximum(there.chi_square - best[1].chi_square, 0)) - QUANTILE

    at_inner, at_outer = above(inner), above(outer)
    settled = (at_outer <= 0) | (inner == outer)
    end = np.where(settled, outer, inner)
    was_outside = np.zeros(inner.shape, bool)
    was_inside = was_outside
    for _ in range(_END_STEPS):
        gap = np.where(at_outer == at_inner, 1, at_outer - at_inner)
        tried = np.clip(inner - at_inner * (outer - inner) / gap, *_ordered(inner, outer))
        value = above(tried)
        outside = value > 0
        # Illinois: an end that stays a second time counts half, or it would stay for ever.
        kept_inner = np.where(was_outside, at_inner / 2, at_inner)
        kept_outer = np.where(was_inside, at_outer / 2, at_outer)
        at_inner = np.where(outside, kept_inner, value)
        at_outer = np.where(outside, value, kept_outer)
        was_outside, was_inside = outside, ~outside
        inner, outer = np.where(outside, inner, tried), np.where(outside, tried, outer)
        end = np.where(settled, end, tried)
    return end


def _ordered(first: Array, second: Array) -> tuple[Array, Array]:
    return np.minimum(first, second), np.maximum(first, second)
