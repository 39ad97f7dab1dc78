# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions that stand for the hemisphere, against closed-form integrals."""

import math

import numpy as np
import pytest

from core.numerics import direction_grid


def test_the_same_count_gives_the_same_directions():
    for a, b in zip(direction_grid.hemisphere(50), direction_grid.hemisphere(50), strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("count", [0, 1, 32, 500])
@pytest.mark.parametrize("steepest", [0.1, direction_grid.STEEPEST, math.pi / 2])
def test_directions_stay_in_their_range(count, steepest):
    theta_i, theta_r, phi = direction_grid.hemisphere(count, steepest)
    assert theta_i.shape == theta_r.shape == phi.shape == (count,)
    for theta in (theta_i, theta_r):
        assert ((theta >= 0) & (theta <= steepest)).all()
    assert ((phi >= 0) & (phi <= math.pi)).all()


def test_directions_have_cosine_density_and_do_not_depend_on_each_other():
    theta_i, theta_r, phi = direction_grid.hemisphere(2000)
    limit = math.sin(direction_grid.STEEPEST) ** 2
    # Means of polynomials of u = sin² θ / sin² 80°, uniform in 0..1. 5e-3: the sequence errs by up
    # to 3e-3 here; directions spread over the solid angle without the cosine miss 1/2 by 0.13.
    u, v, w = np.sin(theta_i) ** 2 / limit, np.sin(theta_r) ** 2 / limit, phi / math.pi
    for x in (u, v, w):
        assert x.mean() == pytest.approx(1 / 2, abs=5e-3)
        assert (x**2).mean() == pytest.approx(1 / 3, abs=5e-3)
    for x, y in ((u, v), (v, w), (u, w)):
        assert (x * y).mean() == pytest.approx(1 / 4, abs=5e-3)
    assert (u * v * w).mean() == pytest.approx(1 / 8, abs=5e-3)
