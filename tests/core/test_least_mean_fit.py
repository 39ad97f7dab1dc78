# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The search for the least sum of differences, where the least is known."""

import numpy as np
import pytest

from core.cycles import least_mean_fit

ANY = [[True, True]]


def sum_of_distances(wanted):
    """Places that each want a point of a plane: how far others are from them, and the slopes.

    The whole plane is as wide as colors are: a hundred.
    """

    def distance(points):
        apart = np.zeros((len(wanted), 3, len(points), 3))
        apart[:, :2, :, 0] = 100 * (np.array(points).T - wanted[:, :, np.newaxis])
        apart[:, 0, :, 1] = apart[:, 1, :, 2] = 100
        return apart

    return distance


@pytest.mark.parametrize("start", [[0.5, 0.5], [1.0, 0.0]])
def test_most_weight_at_one_place_wins_as_in_a_median(start):
    wanted = np.array([[0.2, 0.7], [0.9, 0.1], [0.6, 0.6]])
    weights = np.array([0.6, 0.25, 0.15])
    [found] = least_mean_fit.fit(sum_of_distances(wanted), weights, [start], ANY)
    assert found == pytest.approx(wanted[0], abs=1e-3)


def test_each_search_keeps_to_the_bounds_and_to_what_is_free():
    """A target that no parameters reach ends at the bound nearest to it."""
    wanted = np.array([[1.5, 0.4]])
    free = [[True, True], [True, False], [False, True], [False, False]]
    starts = [[0.5, 0.8]] * 4
    found = least_mean_fit.fit(sum_of_distances(wanted), np.ones(1), starts, free)
    expected = [[1, 0.4], [1, 0.8], [0.5, 0.4], [0.5, 0.8]]
    assert found == [pytest.approx(each, abs=1e-3) for each in expected]
    assert found[0][0] == found[1][0] == 1
    assert starts == [[0.5, 0.8]] * 4


def test_what_changes_nothing_stays_where_it_is():
    def distance(points):
        return np.zeros((2, 3, len(points), 3))

    assert least_mean_fit.fit(distance, np.ones(2), [[0.3, 0.6]], ANY) == [[0.3, 0.6]]


def test_elimination_solves_damped_squares():
    random = np.random.default_rng(8)
    for count in range(5):
        rows = random.normal(size=(count, 30))
        bowl, right = rows @ rows.T + 1e-5 * np.eye(count), random.normal(size=count)
        found = least_mean_fit._solve(bowl.tolist(), right.tolist())
        assert found == pytest.approx(np.linalg.solve(bowl, right), rel=1e-9)


@pytest.mark.parametrize("least", [0.5, 0.0, -1e-9])
def test_whitened_differences_are_distances(least):
    """Also where rounding makes the smallest curvature negative."""
    axes = np.linalg.qr(np.random.default_rng(9).normal(size=(3, 3)))[0]
    form = axes @ np.diag([4.0, 1.0, least]) @ axes.T

    def difference(one, other):
        apart = one - other
        return np.sqrt(np.maximum(np.einsum("...i,ij,...j", apart, form, apart), 0))

    at = np.array([[50.0, 20.0, -10.0], [0.0, 0.0, 0.0]])
    matrices = least_mean_fit.whitener(at, difference)
    assert np.swapaxes(matrices, 1, 2) @ matrices == pytest.approx(
        np.broadcast_to(form, (2, 3, 3)), abs=1e-6
    )
