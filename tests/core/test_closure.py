# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fitted closure against the V-cavity reference, its limits and the cost it may have."""

import time

import numpy as np
import pytest

from core import (
    closure,
    oren_nayar,
    reading,
    vcavity,
)
from core.closure import fitted
from core.errors import DomainError
from tools.tables import fit_closure

SLOPES = fit_closure.SLOPES
SIGMAS = np.radians(np.concatenate(([0.0, 1e-6, 0.1], np.linspace(1.3, 50, 60))))
ALBEDOS = np.concatenate((np.geomspace(1e-4, 0.1, 10), np.linspace(0.11, 0.99, 60), [0.999, 1.0]))


def test_readings_stay_near_the_reference():
    found = closure.from_albedo(ALBEDOS, SIGMAS)
    expected = vcavity.reading_from_albedo(ALBEDOS, SIGMAS, slopes=SLOPES)
    # The requirement is 0.015; the fit reaches 0.0094.
    np.testing.assert_allclose(found, expected, rtol=closure.RING_ERROR)
    steeper = np.radians(np.linspace(50, 90, 30))
    expected = vcavity.reading_from_albedo(ALBEDOS, steeper, slopes=SLOPES)
    np.testing.assert_allclose(closure.from_albedo(ALBEDOS, steeper), expected, rtol=0.0131)


def test_white_facets_meet_the_reference():
    sigma = np.radians(np.linspace(0, 90, 181))
    white = vcavity.reading_from_albedo(np.ones(1), sigma, slopes=SLOPES)
    # The polynomial of r(1) is fitted to 8.4e-5.
    np.testing.assert_allclose(closure.from_albedo(np.ones(1), sigma), white, rtol=1e-4)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_level_surface_is_exact(dtype):
    albedo = ALBEDOS.astype(dtype)
    np.testing.assert_array_equal(closure.from_albedo(albedo, 0.0), albedo)
    found = closure.to_albedo(albedo, 0.0)
    np.testing.assert_allclose(found, albedo, rtol=2 * np.finfo(dtype).eps)
    geometry = np.radians([[0.0, 20, 80], [0, 60, 80], [0, 100, 10]]).astype(dtype)
    level = closure.reflectance(albedo, *geometry, dtype(0))
    # 1 - a/2 + a/2 with a = 0.
    np.testing.assert_array_equal(level, np.broadcast_to(albedo, level.shape))


@pytest.mark.parametrize(("dtype", "bound"), [(np.float64, 1e-12), (np.float32, 1e-5)])
def test_readings_round_trip(dtype, bound):
    sigma = np.array([0, 1e-300, 1e-8, 1e-4, 0.1, 0.5, 0.9, 1.3, np.pi / 2])
    albedo = np.concatenate(([1e-30, 1e-8], ALBEDOS, [1.2, 5.0])).astype(dtype)
    values = closure.from_albedo(albedo, sigma)
    assert np.all(np.diff(values) > 0)
    found = closure.to_albedo(values, sigma)
    np.testing.assert_allclose(found, np.broadcast_to(albedo, found.shape), rtol=bound)


def test_readings_outside_the_range():
    white = closure.from_albedo(np.ones(1), 0.8)
    np.testing.assert_allclose(closure.to_albedo(1.05 * white, 0.8), [1.05], rtol=1e-12)
    np.testing.assert_allclose(closure.from_albedo(np.array([1.05]), 0.8), 1.05 * white, rtol=1e-12)
    negative = np.array([-0.01, 0.2])
    values = closure.from_albedo(negative, 0.8)
    np.testing.assert_allclose(closure.to_albedo(values, 0.8), negative, rtol=1e-12)


def off_grid_geometries():
    """Geometries between the nodes of the fit, polar angles to 80°."""
    random = np.random.default_rng(3)
    light, view = np.degrees(np.arccos(random.uniform(np.cos(np.radians(80)), 1, (2, 60))))
    return np.radians(np.stack((light, view, random.uniform(0, 180, 60))))[..., np.newaxis]


def test_every_geometry_is_nearer_than_the_published_model():
    angles = off_grid_geometries()
    sigma = np.radians([2.0, 7, 12, 18, 27, 33, 42, 50])
    albedo = np.linspace(0.05, 1, 20)
    expected = vcavity.reflectance(albedo, *angles, sigma, slopes=SLOPES)
    ours = np.abs(closure.reflectance(albedo, *angles, sigma) / expected - 1)
    published = np.abs(oren_nayar.reflectance(albedo, *angles, sigma) / expected - 1)
    assert np.all(ours.max((1, 2)) < published.max((1, 2)))
    # At small σ both are near, and chance may favor either; the fit script finds 99.6 %.
    assert np.mean(ours.max(-1) < published.max(-1)) > 0.98
    assert np.quantile(ours.max(-1), 0.95) < 0.015
    assert np.mean(ours) < np.mean(published) / 10


def test_any_geometry_is_monotone_and_bounded():
    light, view = np.radians(np.meshgrid(np.linspace(0, 90, 19), np.linspace(0, 90, 19)))
    azimuth = np.radians([0.0, 40, 90, 180])[:, np.newaxis, np.newaxis, np.newaxis]
    sigma = np.radians([0.01, 5, 30, 60, 90])
    shape = (..., np.newaxis)
    r = closure.reflectance(ALBEDOS, light[shape], view[shape], azimuth, sigma)
    assert np.all(np.isfinite(r))
    assert np.all(r > 0)
    assert np.all(np.diff(r) > 0)


def test_reciprocity():
    light, view, azimuth = off_grid_geometries()
    forward = closure.factors(light, view, azimuth, 0.6)
    # Multiplication commutes, so swapping is exact.
    np.testing.assert_array_equal(forward, closure.factors(view, light, azimuth, 0.6))


def test_azimuth_has_no_meaning_along_the_normal():
    azimuth = np.linspace(0, np.pi, 7)
    for factor in closure.factors(0.9, 0.0, azimuth, 0.6):
        # Numpy's vectors and the few values left over may round differently, as 1.26 does.
        assert np.ptp(factor) <= 4 * np.spacing(factor.max())


def test_one_roughness_and_many_agree():
    light, view, azimuth = (angle[:, 0] for angle in off_grid_geometries())
    many = np.array(closure.factors(light, view, azimuth, np.full(light.size, 0.6)))
    # Two orders of the same sums, whose terms are at most a few hundred times the result.
    np.testing.assert_allclose(closure.factors(light, view, azimuth, 0.6), many, rtol=1e-11)


def test_shapes_nan_and_precision():
    single = np.full(2, 0.5, np.float32)
    assert closure.from_albedo(single, np.float64(0.3)).dtype == np.float32
    assert closure.to_albedo(single, np.full(3, 0.3)).shape == (3, 2)
    assert closure.reflectance(single, 0.5, 0.1, 0, 0.3).dtype == np.float32
    assert closure.coefficients(single)[0].dtype == np.float32
    assert closure.factors(single, single, single, single)[2].dtype == np.float32
    assert closure.from_albedo(np.ones((0, 3)), 0.3).shape == (0, 3)
    assert closure.reflectance(np.ones(3), np.zeros((0, 2)), 0, 0, 0.3).shape == (0, 2, 3)
    mixed = closure.from_albedo([[0.5, np.nan, 2.0]], [0.3, np.nan])
    np.testing.assert_array_equal(np.isnan(mixed), [[False, True, False], [True] * 3])
    assert mixed[0, 2] == pytest.approx(2 * closure.from_albedo(np.ones(1), 0.3)[0])
    with pytest.raises(DomainError, match="sigma"):
        closure.from_albedo(single, -0.1)
    with pytest.raises(DomainError, match="theta_i"):
        closure.reflectance(single, 45.0, 0, 0, 0.1)


def test_cost_against_two_bounces():
    # 31,000 float32 values: larger than a level-1 cache, smaller than a level-3 one. The ratio of
    # the fastest of many alternating runs; 1.5 to 2.7 was seen, and 3 is the requirement.
    albedo = np.random.default_rng(0).random((1000, 31), np.float32)
    fastest = np.full(4, np.inf)
    calls = (reading.from_albedo, closure.from_albedo, reading.to_albedo, closure.to_albedo)
    for _ in range(60):
        for index, call in enumerate(calls):
            start = time.perf_counter()
            call(albedo, 0.5)
            fastest[index] = min(fastest[index], time.perf_counter() - start)
    assert fastest[1] < 3 * fastest[0]
    assert fastest[3] < 3 * fastest[2]


def test_fit_can_be_run_again(monkeypatch):
    before = closure.from_albedo(ALBEDOS, SIGMAS)
    names = ("RING_WHITE", "RING_WALK", "RING_RATIO")
    for name, values in zip(names, fit_closure.fit_ring(), strict=True):
        monkeypatch.setattr(fitted, name, values)
    # Between versions of numpy the constants move by 1e-6 along a valley of equal errors.
    np.testing.assert_allclose(closure.from_albedo(ALBEDOS, SIGMAS), before, rtol=1e-5)
