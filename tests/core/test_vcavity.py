# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cavity reference against ray tracing, energy, reciprocity and its own limits."""

import sys
from pathlib import Path

import numpy as np
import pytest

from core import vcavity
from core.errors import DomainError
from core.vcavity import (
    bounce_series,
    sigma_tables,
    slope_law,
    surface,
)

sys.path.insert(0, str(Path(__file__).parent))
import vcavity_monte_carlo

ALBEDOS = np.array([0.1, 0.3, 0.5, 0.7, 0.9, 1.0])
RING = (45.0, 0.0, 0.0)
OBLIQUE = ((60.0, 30.0, 0.0), (60.0, 30.0, 180.0), (75.0, 45.0, 90.0))
SIGMAS = (10.0, 20.0, 30.0, 40.0, 50.0)


@pytest.mark.parametrize("sigma", SIGMAS)
@pytest.mark.parametrize("geometry", [RING, *OBLIQUE])
def test_ray_tracing_agrees(geometry, sigma):
    angles = np.radians([*geometry, sigma])
    # Standard error of the simulation with these path counts, from 8 seeds: up to 0.07 % at 45/0
    # and 0.21 % elsewhere. The bounds are those the reference has to meet.
    paths, bound = (1 << 20, 0.004) if geometry == RING else (1 << 19, 0.008)
    traced = vcavity_monte_carlo.bounce_coefficients(*angles, paths=paths, seed=1)
    expected = vcavity_monte_carlo.reflectance(traced, ALBEDOS)
    np.testing.assert_allclose(vcavity.reflectance(ALBEDOS, *angles), expected, rtol=bound)


def test_ray_tracing_agrees_bounce_by_bounce():
    angles = np.radians([60.0, 45.0, 120.0, 40.0])
    traced = vcavity_monte_carlo.bounce_coefficients(*angles, paths=1 << 19, seed=2)[:8]
    # Three standard errors, 3 √(a_k · the largest single contribution of about 2 / paths).
    bound = 3 * np.sqrt(traced * 2 / (1 << 19))
    assert np.all(np.abs(vcavity.bounce_coefficients(*angles, bounces=8) - traced) < bound)


def test_first_bounce_landmark():
    a_1 = vcavity.bounce_coefficients(np.pi / 4, 0, 0, np.radians(30))[0]
    # Stated to two digits; other slope distributions give 0.87 or 0.90.
    assert a_1 == pytest.approx(0.78, abs=0.005)


@pytest.mark.parametrize("theta_i", [0.0, 45.0, 75.0])
def test_white_furnace(theta_i):
    points, weights = np.polynomial.legendre.leggauss(16)
    # cos²θ is uniform under the weight cos θ / π.
    theta_r = np.arccos(np.sqrt((points + 1) / 2))[:, np.newaxis, np.newaxis]
    delta_phi = ((points + 1) / 2 * np.pi)[:, np.newaxis]
    sigma = np.radians([5.0, 10, 20, 30, 40, 50])
    r = vcavity.reflectance(np.ones(1), np.radians(theta_i), theta_r, delta_phi, sigma)[..., 0]
    returned = np.einsum("i,j,ijs->s", weights / 2, weights / 2, r)
    np.testing.assert_allclose(returned, 1, atol=0.0005)


def test_reciprocity_of_the_solver():
    # `series` orders light and view, which hides any asymmetry; `response` does not.
    angles = np.radians([[45, 60, 80, 88], [10, 75, 30, 85], [20, 180, 90, 3]])
    forward = surface.response(*angles, bounces=6)
    backward = surface.response(angles[1], angles[0], -angles[2], bounces=6)
    # Rounding; a_1 reaches 40 in the last geometry.
    np.testing.assert_allclose(forward, backward, rtol=1e-9, atol=1e-11)


def test_reciprocity_and_mirror_to_the_last_bit():
    forward = vcavity.bounce_coefficients(0.3, 1.1, 2.0, 0.6)
    np.testing.assert_array_equal(forward, vcavity.bounce_coefficients(1.1, 0.3, 2.0, 0.6))
    np.testing.assert_array_equal(forward, vcavity.bounce_coefficients(0.3, 1.1, -2.0, 0.6))


def test_error_falls_with_nodes():
    angles = np.radians([60.0, 45.0, 60.0])
    sigma = np.radians([20.0, 50.0])
    albedo = np.array([0.5, 0.9])

    def error(**nodes):
        resolution = vcavity.Resolution(**{**fine, **nodes})
        r = vcavity.reflectance(albedo, *angles, sigma, resolution=resolution)
        return np.abs(r / exact - 1).max()

    fine = {"slopes": 7, "azimuths": 8, "panels": 80, "table": 256}
    exact = vcavity.reflectance(albedo, *angles, sigma, resolution=vcavity.Resolution(**fine))
    panels = [error(panels=count) for count in (8, 16, 32)]
    # Square of the count: a factor of 4, down to 2.5 where steep grooves take part.
    assert panels[0] > 2.5 * panels[1] > 2.5**2 * panels[2]
    assert error(panels=vcavity.STANDARD.panels) < 1e-4
    assert error(azimuths=2) > 4 * error(azimuths=4)
    assert error(azimuths=vcavity.STANDARD.azimuths) < 1e-4
    assert error(slopes=2) > 4 * error(slopes=4)
    assert error(slopes=vcavity.STANDARD.slopes) < 2e-5
    assert error(table=8) > 4 * error(table=32)
    assert error(table=vcavity.STANDARD.table) < 2e-5


@pytest.mark.parametrize("geometry", [RING, *OBLIQUE])
def test_stated_error_bound(geometry):
    angles = np.radians(geometry)
    sigma = np.radians([5.0, 30, 50, 90])
    fine = vcavity.Resolution(slopes=9, azimuths=12, panels=128, table=256)
    expected = vcavity.reflectance(ALBEDOS, *angles, sigma, resolution=fine)
    found = vcavity.reflectance(ALBEDOS, *angles, sigma)
    # Twice the panels leave half of the error, so the difference is the other half.
    np.testing.assert_allclose(found, expected, rtol=vcavity.ERROR_BOUND / 2)


def test_tail_is_the_sum_of_later_bounces():
    angles = np.radians([60.0, 30.0, 50.0, 50.0])
    coefficients = vcavity.bounce_coefficients(*angles, bounces=400)
    albedo = np.array([0.3, 0.8, 0.95])
    expected = albedo[:, np.newaxis] ** np.arange(1, 401) @ coefficients
    # 0.95^400 is 1e-9; the tail's fit is good to 2e-6.
    np.testing.assert_allclose(vcavity.reflectance(albedo, *angles), expected, rtol=3e-6)


def test_bounces_do_not_depend_on_how_many_are_asked():
    few = vcavity.bounce_coefficients(1.0, 0.5, 0.2, 0.7, bounces=3)
    many = vcavity.bounce_coefficients(1.0, 0.5, 0.2, 0.7, bounces=20)
    np.testing.assert_allclose(few, many[:3], rtol=1e-13)
    assert np.all(many > 0)


def test_level_surface_is_exact():
    level = vcavity.bounce_coefficients(np.radians([0.0, 45, 85]), 0.3, 1.0, 0.0)
    np.testing.assert_array_equal(level, np.broadcast_to(np.eye(1, vcavity.BOUNCES), level.shape))
    np.testing.assert_array_equal(vcavity.reflectance(ALBEDOS, 1.0, 0.3, 1.0, 0.0), ALBEDOS)
    np.testing.assert_array_equal(vcavity.reading_from_albedo(ALBEDOS, 0.0), ALBEDOS)


@pytest.mark.parametrize("sigma", [1e-300, 1e-160, 1e-8, 1e-4])
def test_roughness_goes_to_zero_smoothly(sigma):
    r = vcavity.reflectance(ALBEDOS, 1.0, 0.3, 1.0, sigma)
    # What a small slope changes is of the order σ², with a factor of 2 tan θi tan θr here.
    np.testing.assert_allclose(r, ALBEDOS, rtol=max(1e-14, 4 * sigma**2))


def test_weights_of_any_roughness_add_up():
    sigma = np.array([0.0, 1e-300, 1e-8, 0.01, 0.1, 0.5, 1.0, np.pi / 2])
    weights = slope_law.weights(sigma, 6)
    np.testing.assert_allclose(weights.sum(axis=-1), 1, rtol=1e-14)
    # Mean of θ² under the distribution: 2σ² for small σ.
    mean_square = weights @ slope_law.nodes(6) ** 2
    np.testing.assert_allclose(mean_square[3], 2 * sigma[3] ** 2, rtol=1e-3)


def test_shapes_broadcast():
    a = vcavity.bounce_coefficients(np.full((3, 1), 0.5), np.full(2, 0.2), 0.1, 0.4, bounces=5)
    assert a.shape == (3, 2, 5)
    assert vcavity.bounce_coefficients(np.zeros((0, 2)), 0, 0, 0.4).shape == (0, 2, 16)
    assert vcavity.reflectance(np.ones((0, 4)), 0.5, 0, 0, 0.4).shape == (0, 4)
    assert vcavity.reflectance(np.ones(0), 0.5, 0, 0, [0.4, 0.5]).shape == (2, 0)
    many = vcavity.reflectance(np.full((2, 1, 3), 0.5), 0.5, [0.1, 0.2], 0, 0.4)
    assert many.shape == (2, 2, 3)
    one = vcavity.reflectance(np.full(3, 0.5), 0.5, 0.2, 0, 0.4)
    np.testing.assert_allclose(many[0, 1], one, rtol=1e-14)


def test_nan_stays_where_it_was():
    a = vcavity.bounce_coefficients([0.5, np.nan, 0.5], [0.1, 0.1, 0.2], 0, [0.3, 0.3, np.nan])
    np.testing.assert_array_equal(np.isnan(a), [[False] * 16, [True] * 16, [True] * 16])
    r = vcavity.reflectance([0.5, np.nan], 0.5, 0.1, 0, 0.3)
    np.testing.assert_array_equal(np.isnan(r), [False, True])
    rho = vcavity.albedo_from_reading([[0.5, np.nan], [0.5, 0.4]], [0.3, np.nan])
    np.testing.assert_array_equal(np.isnan(rho), [[False, True], [True, True]])


@pytest.mark.parametrize(
    ("angles", "what"),
    [
        ((0.5, 0.5, 0.0, -0.1), "sigma"),
        ((0.5, 0.5, 0.0, 1.7), "sigma"),
        ((45.0, 0.0, 0.0, 0.3), "theta_i"),
        ((0.5, -0.1, 0.0, 0.3), "theta_r"),
    ],
)
def test_domain_errors_name_the_argument(angles, what):
    with pytest.raises(DomainError, match=what):
        vcavity.bounce_coefficients(*angles)


def test_fewer_than_two_bounces_are_refused():
    with pytest.raises(DomainError, match="bounces"):
        vcavity.bounce_coefficients(0, 0, 0, 0.3, bounces=1)


@pytest.mark.filterwarnings("error")
def test_grazing_angles_are_finite():
    half_pi = np.float32(np.pi / 2)
    for theta_i in (np.pi / 2, half_pi, np.array([half_pi])):
        a = vcavity.bounce_coefficients(theta_i, 0.6, np.radians([0, 90, 180]), np.pi / 2)
        assert np.all(np.isfinite(a))
        assert np.all(a >= 0)
    np.testing.assert_allclose(
        vcavity.bounce_coefficients(np.pi / 2, 0.6, 1.0, 0.5),
        vcavity.bounce_coefficients(np.pi / 2 - 1e-7, 0.6, 1.0, 0.5),
        rtol=1e-5,
    )


def test_precision_follows_the_arguments():
    single = np.full(2, 0.5, np.float32)
    assert vcavity.bounce_coefficients(single, single, single, single).dtype == np.float32
    assert vcavity.bounce_coefficients(single, 0.1, 0, 0.3).dtype == np.float32
    assert vcavity.bounce_coefficients(0.5, 0.1, 0, 0.3).dtype == np.float64
    assert vcavity.reflectance(single, 0.5, 0.1, 0, 0.3).dtype == np.float32
    assert vcavity.reading_from_albedo(single, np.float64(0.3)).dtype == np.float32
    assert vcavity.albedo_from_reading(single[np.newaxis], np.full(3, 0.3)).dtype == np.float32
    assert vcavity.ring_coefficients(np.float32(0.3)).dtype == np.float32


def test_ring_table_matches_the_solver():
    # Between the table's nodes, and closely where panels of σ and shadows begin.
    sigma = np.concatenate((np.linspace(0, np.pi / 2, 200), np.radians([2.999, 3.001, 38.1])))
    solved = vcavity.series(np.pi / 4, 0, 0, sigma)
    interpolated = sigma_tables.ring().rows(sigma)
    np.testing.assert_allclose(interpolated, solved, rtol=0, atol=sigma_tables.INTERPOLATION_ERROR)
    np.testing.assert_array_equal(vcavity.ring_coefficients(sigma), interpolated[:, :6])


SIGMAS_TO_THE_LIMIT = np.array([0, 1e-300, 1e-8, 1e-3, 0.1, 0.5, 0.9, 1.3, np.pi / 2])


@pytest.mark.parametrize(("dtype", "bound"), [(np.float64, 1e-12), (np.float32, 1e-5)])
def test_readings_round_trip(dtype, bound):
    below_one = 1 - np.geomspace(1e-6, 0.5, 60)
    albedo = np.concatenate(([1e-30, 1e-8], np.linspace(0.01, 1, 100), below_one)).astype(dtype)
    reading = vcavity.reading_from_albedo(albedo, SIGMAS_TO_THE_LIMIT)
    assert np.all(np.diff(reading[:, :102]) > 0)
    found = vcavity.albedo_from_reading(reading, SIGMAS_TO_THE_LIMIT)
    np.testing.assert_allclose(found, np.broadcast_to(albedo, found.shape), rtol=bound)


def test_readings_outside_the_range_are_not_clipped():
    albedo = np.array([-0.2, -1e-9, 1 + 1e-9, 1.3, np.inf])
    reading = vcavity.reading_from_albedo(albedo[np.newaxis], SIGMAS_TO_THE_LIMIT)
    assert np.all(np.diff(reading) > 0)
    found = vcavity.albedo_from_reading(reading, SIGMAS_TO_THE_LIMIT)
    np.testing.assert_allclose(found, np.broadcast_to(albedo, found.shape), rtol=1e-12)
    # The two ways to evaluate, one spectrum under many σ and many spectra, go on alike.
    np.testing.assert_allclose(
        vcavity.reading_from_albedo(albedo[:-1], SIGMAS_TO_THE_LIMIT), reading[:, :-1], rtol=1e-12
    )


def test_tail_shares_reproduce_ratios_between_the_nodes():
    ratio = np.array([-0.99, -0.5, 0.1, 0.6, 0.9, 0.97, 0.995, 0.9999])
    bounces = sigma_tables.SERIES_BOUNCES
    rho = np.linspace(0, 1, 101)[:, np.newaxis]
    fitted = 1 / (1 - rho * bounce_series.TAIL_RATIOS)
    fitted = fitted @ bounce_series.tail_shares(ratio, bounces).T * rho ** (bounces + 1)
    exact = rho ** (bounces + 1) / (1 - rho * ratio)
    # In units of the tail of white facets, which the fit meets exactly. 7e-4 is seen at g = 0.9999;
    # no surface has more than 1 % of its light there.
    np.testing.assert_allclose(fitted / exact[-1], exact / exact[-1], rtol=0, atol=1e-3)
    np.testing.assert_allclose(fitted[-1], exact[-1], rtol=1e-7)
