# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is remembered of a few directions is what would be computed, and cannot be spoiled."""

import numpy as np
import pytest

from core import cycles, oren_nayar, surface
from core.errors import DomainError
from core.numerics import direction_grid, memoized
from core.vcavity import closed

FEW = memoized.FEW


@pytest.fixture
def sums():
    """A function that is remembered, and how often it ran."""
    runs = []

    @memoized.remembered
    def add(light, view, azimuth):
        runs.append(light.size)
        return (light + view + azimuth,)

    return add, runs


def test_the_same_directions_are_computed_once(sums):
    add, runs = sums
    angles = direction_grid.hemisphere(12)
    first, again = add(*angles), add(*(angle.copy() for angle in angles))
    assert runs == [12]
    assert first[0] is again[0]
    with pytest.raises(ValueError, match="read-only"):
        first[0][0] = 7


def test_other_directions_shapes_and_precisions_are_others(sums):
    add, runs = sums
    light, view, azimuth = (angle.copy() for angle in direction_grid.hemisphere(12))
    add(light, view, azimuth)
    light[3] += 0.01
    assert add(light, view, azimuth)[0][3] == light[3] + view[3] + azimuth[3]
    shaped = add(*(angle.reshape(3, 4) for angle in (light, view, azimuth)))[0]
    single = add(*(angle.astype(np.float32) for angle in (light, view, azimuth)))[0]
    assert (shaped.shape, single.dtype, len(runs)) == ((3, 4), np.float32, 4)


def test_of_many_directions_nothing_is_kept(sums):
    add, runs = sums
    for _ in range(2):
        found = add(*direction_grid.hemisphere(FEW + 1))[0]
    assert runs == [FEW + 1, FEW + 1]
    found[0] = 7


def test_of_a_grid_of_few_by_few_directions_nothing_is_kept(sums):
    add, runs = sums
    light, view = np.full((FEW - 1, 1), 0.1), np.full(FEW - 1, 0.2)
    for _ in range(2):
        assert add(light, view, np.zeros(1))[0].shape == (FEW - 1, FEW - 1)
    assert len(runs) == 2
    for _ in range(2):
        add(light, np.full(1, 0.2), np.zeros(()))
    assert len(runs) == 3


def test_bytes_in_the_other_order_are_other_numbers(sums):
    add, _ = sums
    angles = direction_grid.hemisphere(3)
    swapped = [angle.astype(angle.dtype.newbyteorder()) for angle in angles]
    np.testing.assert_array_equal(add(*swapped)[0], add(*angles)[0])


@pytest.mark.parametrize(
    "of",
    [
        lambda angles: closed.factors(*angles, 0.6),
        lambda angles: oren_nayar.factors(*angles, 0.6),
        lambda angles: surface.factors(*angles, 0.6),
        lambda angles: [cycles.reflectance(np.full((angles[0].size, 3), 0.4), 0.6, *angles)],
    ],
    ids=["closure", "published", "surface", "cycles"],
)
def test_few_directions_give_what_they_give_among_many(of):
    many = direction_grid.hemisphere(FEW + 50)
    few = tuple(angle[:40] for angle in many)
    for alone, among in zip(of(few), of(many), strict=True):
        rest = among[:40] if alone.shape[0] == 40 else among[..., :40]
        np.testing.assert_allclose(alone, rest, rtol=1e-13)
    for again, alone in zip(of(few), of(few), strict=True):
        np.testing.assert_array_equal(again, alone)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "of",
    [
        closed.factors,
        oren_nayar.factors,
        surface.factors,
        lambda *angles: cycles.reflectance(np.full((1, 3), 0.4), angles[-1], *angles[:-1]),
    ],
    ids=["closure", "published", "surface", "cycles"],
)
def test_what_is_wrong_is_said_every_time(of):
    """An infinite azimuth is no number, and needs no warning beside it, the first time or later."""
    for _ in range(2):
        with pytest.raises(DomainError, match="outside 0 to π/2"):
            of(np.array([45.0]), np.array([0.0]), np.array([0.0]), 0.3)
        of(np.array([0.5]), np.array([0.4]), np.array([np.inf]), 0.3)
