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

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..color.color_difference import delta_e
from ..numerics.arrays import Array

_STEPS = 24
_SIFTED = 3
"""Steps after which only the best of the starts goes on that are free in the same parameters. Any
fewer, and the best then is not always the best in the end."""
_LONGER = 1.3
"""How much longer each step is than the last one, if that gained; if not, it has its own length."""
_LONGEST = 4.0
_DAMPING = 1e-5
"""Of the first step, as a share of the trace; a tenth after each that gains, eight times if not."""
_MOST_DAMPED = 1e3
_METRIC_PROBE = 0.02
"""Step in Lab within which a color difference is a quadratic form."""
_KINK = 0.01
"""Difference below which a place counts as met, and its weight grows no more."""
_SETTLED = 1e-4
"""Gain below which a search ends. With ten times as much, some end over 0.02 above the least."""

_WAYS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1]], np.float64)
"""Along each axis, and between two each: the six numbers of a quadratic form."""
_FORM = np.array(
    # By the polarization identity: half of what the way between two axes has over both of them.
    [
        [[2, -1, -1], [-1, 0, 0], [-1, 0, 0]],
        [[0, -1, 0], [-1, 2, -1], [0, -1, 0]],
        [[0, 0, -1], [0, 0, -1], [-1, -1, 2]],
        [[0, 1, 0], [1, 0, 0], [0, 0, 0]],
        [[0, 0, 1], [0, 0, 0], [1, 0, 0]],
        [[0, 0, 0], [0, 0, 1], [0, 1, 0]],
    ]
)
"""Twice the matrix of the form that is 1 along one of `_WAYS` and 0 along the others."""

Numbers = list[float]
"""Of one search: in plain numbers, because for so few calling numpy takes several times as long as
computing them."""

Distance = Callable[[list[Numbers]], Array]
"""See `fit`."""


def fit(
    distance: Distance, weights: Array, starts: list[Numbers], free: list[list[bool]]
) -> list[Numbers]:
    """Search from several starts at once.

    Parameters
    ----------
    distance
        How far all places are from what is wanted, in a space where color differences are plain
        distances (see `whitener`), for n parameters within 0 and 1 of each search; then its
        derivatives by them. Shape (places, 3, searches, 1 + n).
    weights
        Of the places, shape (places,).
    starts
        n parameters to start from, for each search.
    free
        Which of them may change.

    Returns
    -------
    n parameters for each start.

    Examples
    --------
    >>> wanted = np.array([0.2, 0.3, 0.9])
    >>> def distance(points):
    ...     apart = np.zeros((3, 3, len(points), 2))
    ...     apart[:, 0, :, 0] = 100 * (np.array(points).T - wanted[:, np.newaxis])
    ...     apart[:, 0, :, 1] = 100
    ...     return apart
    >>> [[found]] = fit(distance, np.ones(3), [[0.5]], [[True]])
    >>> round(found, 3)
    0.3
    """
    squares = _squares(distance(starts), weights)
    found = [_Search(*each) for each in zip(starts, free, *squares, strict=True)]
    searching = found
    for number in range(1, _STEPS + 1):
        tried = [search.step() for search in searching]
        moves = zip(searching, tried, *_squares(distance(tried), weights), strict=True)
        searching = [
            search
            for search, to, cost, gradient, bend in moves
            if search.take(to, cost, gradient, bend)
        ]
        if number == _SIFTED:
            searching = [search for search in searching if search.is_best_of_its_kind(found)]
        if not searching:
            break
    return [search.at for search in found]


@dataclass
class _Search:
    """Where one search is, the sum there with the squares that touch it, and how it goes on."""

    at: Numbers
    free: list[bool]
    cost: float
    gradient: Numbers
    bend: list[Numbers]
    damping: float = _DAMPING
    length: float = 1.0

    def step(self) -> Numbers:
        """Tell where a step leads to the least of the squares, damped, of what is free to move."""
        # What already lies at its bound and would leave it stays there.
        moving = [
            i
            for i, (at, slope) in enumerate(zip(self.at, self.gradient, strict=True))
            if self.free[i] and (at > 0 if slope > 0 else at < 1)
        ]
        most = self.damping * sum(row[i] for i, row in enumerate(self.bend))
        bowl = [[row[j] for j in moving] for i, row in enumerate(self.bend) if i in moving]
        for i, row in enumerate(bowl):
            row[i] += most
        to = self.at.copy()
        for i, step in zip(moving, _solve(bowl, [-self.gradient[i] for i in moving]), strict=True):
            to[i] = min(max(to[i] + step * self.length, 0.0), 1.0)
        return to

    def take(self, to: Numbers, cost: float, gradient: Numbers, bend: list[Numbers]) -> bool:
        """Go there if that gains anything, and tell whether there is more to find."""
        promised = self.cost - cost
        if promised > 0:
            self.at, self.cost, self.gradient, self.bend = to, cost, gradient, bend
            self.damping *= 0.1
            self.length = min(self.length * _LONGER, _LONGEST)
        elif self.length > 1:
            # A longer step is tried again at its own length first.
            self.length = 1.0
            return True
        else:
            promised = self._promised([b - a for a, b in zip(self.at, to, strict=True)])
            self.damping *= 8
        return promised >= _SETTLED and self.damping <= _MOST_DAMPED

    def _promised(self, step: Numbers) -> float:
        """Tell what the squares lose in a step."""
        return -sum(
            (slope + _dot(row, step) / 2) * way
            for slope, row, way in zip(self.gradient, self.bend, step, strict=True)
        )

    def is_best_of_its_kind(self, others: list[_Search]) -> bool:
        """Whether none that is free in the same parameters is better."""
        return all(self.cost <= other.cost for other in others if other.free == self.free)


def _dot(one: Numbers, other: Numbers) -> float:
    return sum(a * b for a, b in zip(one, other, strict=True))


def _solve(rows: list[Numbers], right: Numbers) -> Numbers:
    """Solve for the least of damped squares, by elimination; changes what it is given.

    Such squares need no pivoting. Where rounding leaves no curvature, nothing moves.
    """
    count = len(right)
    for i, row in enumerate(rows):
        if not row[i] > 0:
            row[i] = math.inf
        for j in range(i + 1, count):
            other = rows[j]
            share = other[i] / row[i]
            for k in range(i + 1, count):
                other[k] -= share * row[k]
            right[j] -= share * right[i]
    for i in reversed(range(count)):
        row = rows[i]
        for k in range(i + 1, count):
            right[i] -= row[k] * right[k]
        right[i] /= row[i]
    return right


def _squares(apart: Array, weights: Array) -> tuple[Numbers, list[Numbers], list[list[Numbers]]]:
    """Sum of differences (searches,), and the squares that touch it there.

    Their gradient (searches, n) and curvature (searches, n, n), of distances as `fit` takes them.
    """
    away = apart[..., 0]
    lengths = np.sqrt(np.einsum("pxs,pxs->ps", away, away) + _KINK**2)
    shares = weights[:, np.newaxis] / lengths
    weighted = apart * shares[:, np.newaxis, :, np.newaxis]
    rows = apart.reshape(-1, *apart.shape[2:])
    products = weighted.reshape(rows.shape).transpose(1, 2, 0) @ rows.transpose(1, 0, 2)
    return (weights @ lengths).tolist(), products[:, 0, 1:].tolist(), products[:, 1:, 1:].tolist()


def whitener(at: Array, difference: Callable[[Array, Array], Array] = delta_e) -> Array:
    """Matrices after which a color difference is a plain distance, close to some colors.

    Parameters
    ----------
    at
        The colors, L*a*b* unless `difference` takes others, shape (places, 3).
    difference
        Of two arrays of colors, (..., 3) and (..., 3) -> (...); CIEDE2000 unless another is given.

    Returns
    -------
    Shape (places, 3, 3), from colors to the space of distances.

    Examples
    --------
    >>> lab = np.array([[50.0, 20.0, -10.0]])
    >>> near = lab + [0.1, -0.2, 0.1]
    >>> length = np.linalg.norm(whitener(lab)[0] @ (near - lab)[0])
    >>> round(float(length / delta_e(near, lab)[0]), 2)
    1.0
    """
    metric = _metric(at, difference)
    try:
        return np.swapaxes(np.linalg.cholesky(metric), 1, 2)
    except np.linalg.LinAlgError:
        # The form is never negative, but its rounding is.
        squares, axes = np.linalg.eigh(metric)
        return np.asarray(
            np.sqrt(np.maximum(squares, 0))[..., np.newaxis] * np.swapaxes(axes, 1, 2)
        )


def _metric(at: Array, difference: Callable[[Array, Array], Array]) -> Array:
    """Quadratic form of the difference around colors of shape (places, 3): (places, 3, 3)."""
    near = at + (_METRIC_PROBE * _WAYS)[:, np.newaxis]
    squares = (difference(near, at) / _METRIC_PROBE) ** 2
    return np.asarray((squares.T @ _FORM.reshape(6, 9) / 2).reshape(-1, 3, 3))
