# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The closed form of V-grooves against their solver, its limits and the cost it may have."""

import time

import numpy as np
import pytest

from core import oren_nayar, reading, vcavity
from core.errors import DomainError
from core.vcavity import closed

SIGMAS = np.radians(np.concatenate(([0.0, 1e-6, 0.1], np.linspace(1.3, 50, 60))))
ALBEDOS = np.concatenate((np.geomspace(1e-4, 0.1, 10), np.linspace(0.11, 0.99, 60), [0.999, 1.0]))
RHO = np.linspace(0.05, 1, 20)


def from_albedo(albedo, sigma):
    return reading.from_albedo(albedo, sigma, "closure")


def to_albedo(values, sigma):
    return reading.to_albedo(values, sigma, "closure")


def test_readings_stay_near_the_solver():
    found = from_albedo(ALBEDOS, SIGMAS)
    expected = vcavity.reading_from_albedo(ALBEDOS, SIGMAS)
    # The requirement is 0.003.
    np.testing.assert_allclose(found, expected, rtol=closed.RING_ERROR)
    steeper = np.radians(np.linspace(50, 60, 12))
    expected = vcavity.reading_from_albedo(ALBEDOS, steeper)
    np.testing.assert_allclose(from_albedo(ALBEDOS, steeper), expected, rtol=0.004)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_level_surface_is_exact(dtype):
    albedo = ALBEDOS.astype(dtype)
    np.testing.assert_array_equal(from_albedo(albedo, 0.0), albedo)
    found = to_albedo(albedo, 0.0)
    np.testing.assert_allclose(found, albedo, rtol=2 * np.finfo(dtype).eps)
    geometry = np.radians([[0.0, 20, 80], [0, 60, 80], [0, 100, 10]]).astype(dtype)
    level = closed.reflectance(albedo, *geometry, dtype(0))
    # 1 - a/2 + a/2 with a = 0.
    np.testing.assert_array_equal(level, np.broadcast_to(albedo, level.shape))


@pytest.mark.parametrize("model", ["closure", "surface"])
def test_what_is_lost_begins_with_the_square_of_the_slope(model):
    """A surface does not know the sign of its slopes: half of σ, a quarter of the loss."""
    sigma = np.radians([0.02, 0.04, 0.2, 0.4])
    lost = 1 - reading.from_albedo(np.array([0.05, 0.5, 0.9]), sigma, model) / [0.05, 0.5, 0.9]
    assert (lost > 0).all()
    np.testing.assert_allclose(lost[1] / lost[0], 4, rtol=1e-3)
    np.testing.assert_allclose(lost[3] / lost[2], 4, rtol=0.02)


@pytest.mark.parametrize(("dtype", "bound"), [(np.float64, 1e-12), (np.float32, 1e-5)])
def test_readings_round_trip(dtype, bound):
    sigma = np.array([0, 1e-300, 1e-8, 1e-4, 0.1, 0.5, 0.9, 1.1])
    albedo = np.concatenate(([1e-30, 1e-8], ALBEDOS, [1.2, 5.0])).astype(dtype)
    values = from_albedo(albedo, sigma)
    assert np.all(np.diff(values) > 0)
    found = to_albedo(values, sigma)
    np.testing.assert_allclose(found, np.broadcast_to(albedo, found.shape), rtol=bound)


def test_readings_outside_the_range():
    white = from_albedo(np.ones(1), 0.8)
    np.testing.assert_allclose(to_albedo(1.05 * white, 0.8), [1.05], rtol=1e-12)
    np.testing.assert_allclose(from_albedo(np.array([1.05]), 0.8), 1.05 * white, rtol=1e-12)
    negative = np.array([-0.01, 0.2])
    np.testing.assert_allclose(to_albedo(from_albedo(negative, 0.8), 0.8), negative, rtol=1e-12)


def off_grid_geometries():
    """Geometries between the nodes of the table, polar angles to 80°."""
    random = np.random.default_rng(3)
    light, view = np.degrees(np.arccos(random.uniform(np.cos(np.radians(80)), 1, (2, 60))))
    return np.radians(np.stack((light, view, random.uniform(0, 180, 60))))[..., np.newaxis]


def test_every_geometry_is_near_the_solver():
    angles = off_grid_geometries()
    sigma = np.radians([2.0, 7, 12, 18, 27, 33, 42, 50])
    expected = vcavity.reflectance(RHO, *angles, sigma)
    ours = np.abs(closed.reflectance(RHO, *angles, sigma) / expected - 1)
    published = np.abs(oren_nayar.reflectance(RHO, *angles, sigma) / expected - 1)
    assert np.max(ours) <= closed.ERROR
    assert np.median(ours) < 1e-3
    assert np.mean(ours) < np.mean(published) / 40


def test_any_geometry_is_monotone_and_bounded():
    light, view = np.radians(np.meshgrid(np.linspace(0, 90, 19), np.linspace(0, 90, 19)))
    azimuth = np.radians([0.0, 40, 90, 180])[:, np.newaxis, np.newaxis, np.newaxis]
    sigma = np.radians([0.01, 5, 30, 60, 65])
    shape = (..., np.newaxis)
    r = closed.reflectance(ALBEDOS, light[shape], view[shape], azimuth, sigma)
    assert np.all(np.isfinite(r))
    assert np.all(r > 0)
    assert np.all(np.diff(r) > 0)


def test_reciprocity():
    light, view, azimuth = off_grid_geometries()
    forward = closed.factors(light, view, azimuth, 0.6)
    np.testing.assert_array_equal(forward, closed.factors(view, light, azimuth, 0.6))


def test_azimuth_has_no_meaning_along_the_normal():
    azimuth = np.linspace(0, np.pi, 7)
    for factor in closed.factors(0.9, 0.0, azimuth, 0.6):
        assert np.ptp(factor) <= 1e-10 * np.abs(factor).max()


def test_shapes_nan_and_precision():
    single = np.full(2, 0.5, np.float32)
    assert from_albedo(single, np.float64(0.3)).dtype == np.float32
    assert to_albedo(single, np.full(3, 0.3)).shape == (3, 2)
    assert closed.reflectance(single, 0.5, 0.1, 0, 0.3).dtype == np.float32
    assert closed.factors(single, single, single, single)[2].dtype == np.float32
    assert from_albedo(np.ones((0, 3)), 0.3).shape == (0, 3)
    assert closed.reflectance(np.ones(3), np.zeros((0, 2)), 0, 0, 0.3).shape == (0, 2, 3)
    mixed = from_albedo([[0.5, np.nan, 2.0]], [0.3, np.nan])
    np.testing.assert_array_equal(np.isnan(mixed), [[False, True, False], [True] * 3])
    assert mixed[0, 2] == pytest.approx(2 * from_albedo(np.ones(1), 0.3)[0])
    with pytest.raises(DomainError, match="sigma"):
        from_albedo(single, -0.1)
    with pytest.raises(DomainError, match="theta_i"):
        closed.reflectance(single, 45.0, 0, 0, 0.1)


def test_cost_against_two_bounces():
    # 31,000 float32 values: larger than a level-1 cache, smaller than a level-3 one. The ratio of
    # the fastest of many alternating runs; 1.5 to 2.7 was seen, and 3 is the requirement.
    albedo = np.random.default_rng(0).random((1000, 31), np.float32)
    fastest = np.full(4, np.inf)
    calls = (reading.from_albedo, from_albedo, reading.to_albedo, to_albedo)
    for _ in range(60):
        for index, call in enumerate(calls):
            start = time.perf_counter()
            call(albedo, 0.5)
            fastest[index] = min(fastest[index], time.perf_counter() - start)
    assert fastest[1] < 3 * fastest[0]
    assert fastest[3] < 3 * fastest[2]
