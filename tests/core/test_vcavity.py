# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cavity reference against ray tracing, energy, reciprocity and its own limits."""

import sys
from pathlib import Path

import numpy as np
import pytest

from core import vcavity
from core.errors import DomainError
from core.instruments import curves
from core.vcavity import (
    bounce_series,
    sigma_tables,
    slope_law,
    surface,
)

sys.path.insert(0, str(Path(__file__).parent))
import vcavity_monte_carlo

ALBEDOS = np.array(vcavity_monte_carlo.ALBEDOS)
LAWS = vcavity_monte_carlo.LAWS
RING, *OBLIQUE = vcavity_monte_carlo.GEOMETRIES

by_law = pytest.mark.parametrize("slopes", LAWS)


@by_law
def test_ray_tracing_agrees(slopes):
    """With the file of traces; the bounds are those the reference has to meet, noise included."""
    found = {geometry: [] for geometry in vcavity_monte_carlo.GEOMETRIES}
    for law, geometry, sigma, expected, noise in vcavity_monte_carlo.traced():
        if law != slopes:
            continue
        bound = 0.004 if geometry == RING else 0.008
        assert np.all(noise < bound / 4 * expected)
        r = vcavity.reflectance(ALBEDOS, *np.radians([*geometry, sigma]), slopes=law)
        np.testing.assert_allclose(r, expected, rtol=bound)
        found[geometry].append(sigma)
    assert list(found.values()) == [list(vcavity_monte_carlo.SIGMAS)] * 5


@by_law
@pytest.mark.parametrize("geometry", [RING, OBLIQUE[1]])
def test_the_file_of_traces_can_be_traced_again(geometry, slopes):
    [expected] = [
        row[3] for row in vcavity_monte_carlo.traced() if row[:3] == (slopes, geometry, 40)
    ]
    a = vcavity_monte_carlo.bounce_coefficients(
        *np.radians([*geometry, 40]), slopes, paths=1 << 18, seed=99
    )
    # With so few paths the noise is up to 0.3 %, and the laws are 2 to 15 % apart.
    np.testing.assert_allclose(vcavity_monte_carlo.reflectance(a, ALBEDOS), expected, rtol=0.01)


@by_law
def test_ray_tracing_agrees_bounce_by_bounce(slopes):
    angles = np.radians([60.0, 45.0, 120.0, 40.0])
    traced = vcavity_monte_carlo.bounce_coefficients(*angles, slopes, paths=1 << 19, seed=2)[:8]
    # Three standard errors, 3 √(a_k · the largest single contribution of about 2 / paths).
    bound = 3 * np.sqrt(traced * 2 / (1 << 19))
    found = vcavity.bounce_coefficients(*angles, bounces=8, slopes=slopes)
    assert np.all(np.abs(found - traced) < bound)


def test_first_bounce_landmark():
    angles = np.pi / 4, 0, 0, np.radians(30)
    # Stated to two digits; other slope distributions give 0.87 or 0.90.
    assert vcavity.bounce_coefficients(*angles, slopes="oren-nayar")[0] == pytest.approx(
        0.78, abs=0.005
    )
    assert vcavity.bounce_coefficients(*angles)[0] == pytest.approx(0.81, abs=0.005)


def test_gaussian_slopes_are_the_default_and_read_what_an_independent_trace_reads():
    expected = [0.0824, 0.2564, 0.4450, 0.6516, 0.8819, 1.0087]
    angles = np.pi / 4, 0, 0, np.radians(30)
    for read in (
        vcavity.reflectance(ALBEDOS, *angles),
        vcavity.reading_from_albedo(ALBEDOS, angles[-1], slopes="gaussian"),
    ):
        np.testing.assert_allclose(read, expected, rtol=0, atol=0.0004)


def test_slopes_have_the_moments_that_their_laws_promise():
    slope = slope_law.nodes(6)
    for degrees in (10, 30, 45, 60):
        sigma = np.radians([degrees])
        shares = slope_law.weights(sigma, 6)[0]
        # tan²θ / 2m² is distributed like the logarithm of an even number below 1.
        steps = (np.arange(200_000) + 0.5) / 200_000
        tangent = np.tan(sigma) * np.sqrt(-2 * np.log1p(-steps))
        assert shares @ np.cos(slope) ** 2 == pytest.approx(np.mean(1 / (1 + tangent**2)), abs=2e-5)
        assert shares @ slope == pytest.approx(np.mean(np.arctan(tangent)), abs=2e-5)
    # Of the other law at 30°: mean 35.5°, root mean square 39.8°, standard deviation 18.0°.
    shares = slope_law.weights(np.radians([30]), 6, "oren-nayar")[0]
    mean, square = shares @ slope, shares @ slope**2
    found = np.degrees([mean, np.sqrt(square), np.sqrt(square - mean**2)])
    np.testing.assert_allclose(found, [35.5, 39.8, 18.0], atol=0.05)


@pytest.mark.parametrize(
    "call",
    [
        lambda law: vcavity.bounce_coefficients(0.5, 0.1, 0, 0.3, slopes=law),
        lambda law: vcavity.reflectance([0.5], 0.5, 0.1, 0, 0.3, slopes=law),
        lambda law: vcavity.series(0.5, 0.1, 0, 0.3, slopes=law),
        lambda law: vcavity.ring_coefficients(0.3, slopes=law),
        lambda law: vcavity.reading_from_albedo([0.5], 0.3, slopes=law),
        lambda law: vcavity.albedo_from_reading([0.5], 0.3, slopes=law),
        lambda law: curves.series("di:8", law),
    ],
)
def test_an_unknown_slope_law_is_refused_with_the_names(call):
    with pytest.raises(DomainError, match=r"'beckmann'.*: gaussian, oren-nayar\."):
        call("beckmann")


@pytest.mark.filterwarnings("error")
def test_gaussian_slopes_go_over_into_slots():
    sigma = np.radians([80, 89, 89.9, 89.999, 90])
    tops = np.append(sigma, np.float64(np.float32(np.pi / 2)))  # which lies above 90°
    for angles in np.radians([[45, 0, 0], [60, 30, 180], [75, 75, 0], [85, 40, 10]]):
        rows = vcavity.series(*angles, tops)
        r = bounce_series.evaluate(rows, np.linspace(0, 1, 501))
        assert np.all(np.isfinite(rows))
        assert np.all(np.diff(r) > 0)
        np.testing.assert_array_equal(r[-1], r[-2])
    # Seen along the normal a slot shows its bottom, which no light reaches.
    a_1 = vcavity.bounce_coefficients(np.pi / 4, 0, 0, sigma)[:, 0]
    # The first bounce of steep grooves is the mean of cot θ there: √(π/2) / m.
    assert a_1[1] == pytest.approx(np.sqrt(np.pi / 2) / np.tan(sigma[1]), rel=0.02)
    assert np.all(np.diff(a_1) < 0)
    assert a_1[-1] < 0.002
    np.testing.assert_allclose(
        vcavity.ring_coefficients(sigma), vcavity.series(np.pi / 4, 0, 0, sigma)[:, :6], atol=5e-4
    )


@pytest.mark.parametrize("theta_i", [0.0, 45.0, 75.0])
def test_white_furnace(theta_i):
    points, weights = np.polynomial.legendre.leggauss(16)
    # cos²θ is uniform under the weight cos θ / π.
    theta_r = np.arccos(np.sqrt((points + 1) / 2))[:, np.newaxis, np.newaxis]
    delta_phi = ((points + 1) / 2 * np.pi)[:, np.newaxis]
    sigma = np.radians([5.0, 10, 20, 30, 40, 50])
    angles = np.radians(theta_i), theta_r, delta_phi
    for slopes in LAWS:
        r = vcavity.reflectance(np.ones(1), *angles, sigma, slopes=slopes)[..., 0]
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


@by_law
def test_error_falls_with_nodes(slopes):
    angles = np.radians([60.0, 45.0, 60.0])
    sigma = np.radians([20.0, 50.0])
    albedo = np.array([0.5, 0.9])

    def error(**nodes):
        resolution = vcavity.Resolution(**{**fine, **nodes})
        r = vcavity.reflectance(albedo, *angles, sigma, resolution=resolution, slopes=slopes)
        return np.abs(r / exact - 1).max()

    fine = {"slopes": 7, "azimuths": 8, "panels": 80, "table": 256}
    exact = vcavity.reflectance(
        albedo, *angles, sigma, resolution=vcavity.Resolution(**fine), slopes=slopes
    )
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


@pytest.mark.parametrize(
    ("slopes", "sigmas"), [("gaussian", [5, 30, 50, 80]), ("oren-nayar", [5, 30, 50, 90])]
)
@pytest.mark.parametrize("geometry", [RING, *OBLIQUE])
def test_stated_error_bound(geometry, slopes, sigmas):
    angles = np.radians(geometry)
    sigma = np.radians(sigmas)
    fine = vcavity.Resolution(slopes=9, azimuths=12, panels=128, table=256)
    expected = vcavity.reflectance(ALBEDOS, *angles, sigma, resolution=fine, slopes=slopes)
    found = vcavity.reflectance(ALBEDOS, *angles, sigma, slopes=slopes)
    # Twice the panels leave half of the error, so the difference is the other half.
    np.testing.assert_allclose(found, expected, rtol=vcavity.ERROR_BOUND / 2)


@by_law
def test_tail_is_the_sum_of_later_bounces(slopes):
    angles = np.radians([60.0, 30.0, 50.0, 50.0])
    coefficients = vcavity.bounce_coefficients(*angles, bounces=400, slopes=slopes)
    albedo = np.array([0.3, 0.8, 0.95])
    expected = albedo[:, np.newaxis] ** np.arange(1, 401) @ coefficients
    # 0.95^400 is 1e-9; the tail's fit is good to 2e-6.
    np.testing.assert_allclose(
        vcavity.reflectance(albedo, *angles, slopes=slopes), expected, rtol=3e-6
    )


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
@by_law
def test_roughness_goes_to_zero_smoothly(slopes, sigma):
    r = vcavity.reflectance(ALBEDOS, 1.0, 0.3, 1.0, sigma, slopes=slopes)
    # What a small slope changes is of the order σ², with a factor of 2 tan θi tan θr here.
    np.testing.assert_allclose(r, ALBEDOS, rtol=max(1e-14, 4 * sigma**2))


@by_law
def test_weights_of_any_roughness_add_up(slopes):
    sigma = np.array([0.0, 1e-300, 1e-8, 0.01, 0.1, 0.5, 1.0, np.pi / 2])
    weights = slope_law.weights(sigma, 6, slopes)
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


@by_law
@pytest.mark.filterwarnings("error")
def test_grazing_angles_are_finite(slopes):
    half_pi = np.float32(np.pi / 2)
    for theta_i in (np.pi / 2, half_pi, np.array([half_pi])):
        a = vcavity.bounce_coefficients(
            theta_i, 0.6, np.radians([0, 90, 180]), np.pi / 2, slopes=slopes
        )
        assert np.all(np.isfinite(a))
        assert np.all(a >= 0)
    np.testing.assert_allclose(
        vcavity.bounce_coefficients(np.pi / 2, 0.6, 1.0, 0.5, slopes=slopes),
        vcavity.bounce_coefficients(np.pi / 2 - 1e-7, 0.6, 1.0, 0.5, slopes=slopes),
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


@by_law
def test_ring_table_matches_the_solver(slopes):
    # Between the table's nodes, and closely where panels of σ and shadows begin.
    end = np.pi / 2 if slopes == "oren-nayar" else np.radians(89.2)
    sigma = np.concatenate((np.linspace(0, end, 200), np.radians([2.999, 3.001, 38.1])))
    solved = vcavity.series(np.pi / 4, 0, 0, sigma, slopes=slopes)
    interpolated = sigma_tables.ring(slopes).rows(sigma)
    np.testing.assert_allclose(interpolated, solved, rtol=0, atol=sigma_tables.INTERPOLATION_ERROR)
    np.testing.assert_array_equal(
        vcavity.ring_coefficients(sigma, slopes=slopes), interpolated[:, :6]
    )


_SIGMAS = [0, 1e-300, 1e-8, 1e-3, 0.1, 0.5, 0.9, 1.3]
# Slots are black along the normal: there no reading tells the albedo.
SIGMAS_TO_THE_LIMIT = {
    "gaussian": np.array([*_SIGMAS, 1.4]),
    "oren-nayar": np.array([*_SIGMAS, np.pi / 2]),
}


@by_law
@pytest.mark.parametrize(("dtype", "bound"), [(np.float64, 1e-12), (np.float32, 1e-5)])
def test_readings_round_trip(dtype, bound, slopes):
    below_one = 1 - np.geomspace(1e-6, 0.5, 60)
    albedo = np.concatenate(([1e-30, 1e-8], np.linspace(0.01, 1, 100), below_one)).astype(dtype)
    sigma = SIGMAS_TO_THE_LIMIT[slopes]
    reading = vcavity.reading_from_albedo(albedo, sigma, slopes=slopes)
    assert np.all(np.diff(reading[:, :102]) > 0)
    found = vcavity.albedo_from_reading(reading, sigma, slopes=slopes)
    np.testing.assert_allclose(found, np.broadcast_to(albedo, found.shape), rtol=bound)


@by_law
def test_readings_outside_the_range_are_not_clipped(slopes):
    albedo = np.array([-0.2, -1e-9, 1 + 1e-9, 1.3, np.inf])
    sigma = SIGMAS_TO_THE_LIMIT[slopes]
    reading = vcavity.reading_from_albedo(albedo[np.newaxis], sigma, slopes=slopes)
    assert np.all(np.diff(reading) > 0)
    found = vcavity.albedo_from_reading(reading, sigma, slopes=slopes)
    np.testing.assert_allclose(found, np.broadcast_to(albedo, found.shape), rtol=1e-12)
    # The two ways to evaluate, one spectrum under many σ and many spectra, go on alike.
    np.testing.assert_allclose(
        vcavity.reading_from_albedo(albedo[:-1], sigma, slopes=slopes),
        reading[:, :-1],
        rtol=1e-12,
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
