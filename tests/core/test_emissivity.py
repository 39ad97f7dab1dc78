# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Emissivity against the solver's own reflectance, rays, energy, and black bodies in tables."""

import sys
from pathlib import Path

import numpy as np
import pytest

from core import emissivity, oren_nayar, reading, surface, vcavity
from core.emissivity import planck, random_surface
from core.errors import DomainError
from core.instruments import curves
from core.vcavity import bounce_series, hemisphere

sys.path.insert(0, str(Path(__file__).parent))
import emissivity_monte_carlo

ALBEDOS = np.array([0.1, 0.5, 0.7, 0.9, 0.95])
LAWS = ("gaussian", "oren-nayar")
INFRARED = np.array([8000.0, 14000.0])
BAND = (8000.0, 14000.0)


def reflected(theta, sigma, albedo):
    """Integrate the solver's reflectance over the view: all that the surface sends back."""
    points, weights = np.polynomial.legendre.leggauss(12)
    # cos² of the view is uniform under the weight cos θ / π.
    theta_r = np.arccos(np.sqrt((points + 1) / 2))[:, np.newaxis]
    delta_phi = (points + 1) / 2 * np.pi
    r = vcavity.reflectance(albedo, theta, theta_r, delta_phi, sigma)
    return np.einsum("i,j,ijb->b", weights / 2, weights / 2, r)


@pytest.mark.parametrize(("theta", "sigma"), [(0.0, 45.0), (75.0, 30.0)])
def test_what_is_not_reflected_is_emitted(theta, sigma):
    theta, sigma = np.radians([theta, sigma])
    albedo = np.append(ALBEDOS, 1.0)
    total = reflected(theta, sigma, albedo) + emissivity.directional(albedo, theta, sigma)
    np.testing.assert_allclose(total, 1, atol=2e-4)


@pytest.mark.parametrize("slopes", LAWS)
@pytest.mark.parametrize("sigma", [10.0, 30.0, 50.0])
def test_a_sphere_reads_what_the_surface_does_not_emit(sigma, slopes):
    # Kirchhoff and Helmholtz: all around light, view at 8°, over the quadrature of instruments.
    read = bounce_series.evaluate(curves.series("di:8", slopes).rows(np.radians(sigma)), ALBEDOS)
    found = emissivity.directional(ALBEDOS, np.radians(8.0), np.radians(sigma), slopes=slopes)
    # At 50° the rest is what the cone of the view misses of the rise toward the normal.
    np.testing.assert_allclose(found, 1 - read, atol=2e-4 if sigma < 50 else 5e-4)


@pytest.mark.parametrize(
    ("sigma", "normal"), [(30.0, (0.573, 0.373, 0.142)), (45.0, (0.627, 0.437, 0.194))]
)
def test_numbers_of_the_design_along_the_normal(sigma, normal):
    facets = np.array([0.5, 0.3, 0.1])
    found = emissivity.directional(1 - facets, 0.0, np.radians(sigma), slopes="oren-nayar")
    np.testing.assert_allclose(found, normal, atol=0.001)


@pytest.mark.parametrize("slopes", LAWS)
@pytest.mark.parametrize(("theta", "sigma"), [(0.0, 45.0), (80.0, 50.0), (60.0, 15.0)])
def test_ray_tracing_agrees(theta, sigma, slopes):
    theta, sigma = np.radians([theta, sigma])
    paths = 1 << 18
    met = emissivity_monte_carlo.arrivals(theta, sigma, slopes, paths=paths, seed=3)
    expected = emissivity_monte_carlo.emissivity(met, ALBEDOS)
    found = emissivity.directional(ALBEDOS, theta, sigma, slopes=slopes)
    # Three standard errors: a path is absorbed or not, √(ε (1 - ε) / paths) at most.
    bound = 3 * np.sqrt(expected * (1 - expected) / paths)
    assert np.all(np.abs(found - expected) < bound + hemisphere.ERROR_BOUND / 10)


def test_white_facets_emit_nothing_and_lose_nothing():
    theta, sigma = np.radians([[0.0], [45.0], [89.0], [90.0]]), np.radians([1.0, 30.0, 60.0, 90.0])
    white = emissivity.directional(np.ones(1), theta, sigma)
    np.testing.assert_allclose(white, 0, atol=1e-11)
    np.testing.assert_allclose(emissivity.hemispherical(np.ones(1), sigma[:, None]), 0, atol=1e-12)


def test_smooth_surface_is_exact():
    theta = np.radians([0.0, 45.0, 90.0])
    found = emissivity.directional(ALBEDOS, theta, 0.0)
    np.testing.assert_array_equal(found, np.broadcast_to(1 - ALBEDOS, found.shape))
    np.testing.assert_array_equal(emissivity.hemispherical(ALBEDOS, 0.0), 1 - ALBEDOS)


@pytest.mark.parametrize("sigma", [1e-300, 1e-160, 1e-8, 1e-4])
def test_roughness_goes_to_zero_smoothly(sigma):
    found = emissivity.directional(ALBEDOS, 0.5, sigma)
    np.testing.assert_allclose(found, 1 - ALBEDOS, atol=max(1e-15, 2 * sigma))


def test_roughness_raises_emissivity_and_keeps_it_below_one():
    sigma = np.radians(np.linspace(0, 90, 31))
    theta = np.radians([0.0, 30.0, 60.0, 80.0, 90.0])[:, np.newaxis]
    found = emissivity.directional(ALBEDOS, theta, sigma)
    assert found.shape == (5, 31, 5)
    assert np.all(np.diff(found, axis=1) > 0)
    assert np.all((found >= 1 - ALBEDOS) & (found < 1))
    assert np.all(np.diff(found, axis=2) < 0)


def test_grazing_is_a_limit():
    angles = np.pi / 2 - np.array([1e-2, 1e-4, 1e-6, 1e-9, 0.0])
    found = emissivity.directional(ALBEDOS, angles, np.radians(30))
    steps = np.abs(np.diff(found, axis=0)).max(axis=1)
    # Each step is as large as the angle that is left, and the last is nothing.
    assert np.all(steps < [2e-2, 2e-4, 2e-6, 2e-9])
    single = emissivity.directional(ALBEDOS, np.float32(np.pi / 2), np.radians(30))
    np.testing.assert_allclose(single, found[-1], atol=1e-6)


@pytest.mark.parametrize(
    ("slopes", "sigma", "share"),
    # What is stated to 50°, and where steeper grooves take part.
    [
        *(("gaussian", 10.0, 0.1), ("gaussian", 50.0, 0.1), ("gaussian", 80.0, 2.0)),
        *(("oren-nayar", 30.0, 0.2), ("oren-nayar", 50.0, 1.0), ("oren-nayar", 90.0, 2.0)),
    ],
)
def test_stated_error_bound(slopes, sigma, share):
    theta, sigma = np.radians([0.0, 1.0, 60.0, 85.0]), np.radians(sigma)
    albedo = np.array([0.3, 0.9, 0.99])
    fine = vcavity.Resolution(slopes=8, panels=128, table=256)
    # Twice the panels leave half of the error or less, so the difference is the other half.
    rows = hemisphere.series(theta, sigma, slopes=slopes, resolution=fine)
    exact = 1 - bounce_series.evaluate(rows, albedo)
    found = emissivity.directional(albedo, theta, sigma, slopes=slopes)
    np.testing.assert_allclose(found, exact, atol=share * hemisphere.ERROR_BOUND / 2)


def test_hemisphere_is_the_mean_over_directions():
    sigma = np.radians(40)
    # Trapezoids over sin² θ, of which all parts of the hemisphere's projection weigh the same.
    square = np.linspace(0, 1, 301)
    of_each = emissivity.directional(ALBEDOS, np.arcsin(np.sqrt(square)), sigma)
    expected = (of_each[:-1] + of_each[1:]).sum(axis=0) / 2 / 300
    np.testing.assert_allclose(emissivity.hemispherical(ALBEDOS, sigma), expected, atol=2e-5)


def test_inverse():
    sigma, theta = np.radians([0.0, 5.0, 30.0, 60.0]), 0.3
    albedo = np.array([0.0, 1e-6, 0.2, 0.9, 0.999, 1.0])
    seen = emissivity.directional(albedo, theta, sigma)
    back = emissivity.albedo_from_directional(seen, theta, sigma)
    np.testing.assert_allclose(back, np.broadcast_to(albedo, back.shape), atol=1e-9)
    noisy = emissivity.albedo_from_directional([1.01, -0.02], theta, 0.5)
    assert noisy[0] < 0
    assert noisy[1] > 1


def test_no_wavelength_and_no_precision_is_special():
    albedo = np.array([[0.2, 0.6], [0.4, 0.8]], np.float32)
    found = emissivity.directional(albedo, 0.2, np.array([0.3, 0.6]))
    assert found.dtype == np.float32
    double = emissivity.directional(albedo.astype(float), 0.2, np.array([0.3, 0.6]))
    np.testing.assert_allclose(found, double, atol=1e-7)
    nan = emissivity.directional([np.nan, 0.5], [0.2, np.nan], 0.3)
    assert np.isnan(nan).tolist() == [[True, False], [True, True]]


@pytest.mark.parametrize(
    ("model", "reason"),
    [
        ("two-bounce", "loses the light of all bounces after the second"),
        ("first-order", "leaves out the light between facets"),
        ("closure", "up to 0.001"),
        ("lambert", "knows no roughness"),
        ("no-such", "not known"),
    ],
)
@pytest.mark.parametrize("function", [emissivity.directional, emissivity.albedo_from_directional])
def test_models_that_lose_light_are_refused(function, model, reason):
    with pytest.raises(DomainError, match=reason):
        function([0.5], 0.0, 0.5, model=model)


def test_why_two_bounces_are_refused():
    points, weights = np.polynomial.legendre.leggauss(24)
    theta_r = np.arccos(np.sqrt((points + 1) / 2))[:, np.newaxis]
    delta_phi = (points + 1) / 2 * np.pi
    albedo = np.array([0.5, 1.0])

    def one_minus_reflected(theta, sigma):
        r = oren_nayar.reflectance(albedo, theta, theta_r, delta_phi, sigma)
        return 1 - np.einsum("i,j,ijb->b", weights / 2, weights / 2, r)

    # White facets would emit at 0° what they lose, and less than nothing at grazing.
    assert one_minus_reflected(0.0, np.radians(30))[1] > 0.05
    assert one_minus_reflected(np.radians(80), np.radians(20))[1] < 0


def test_constants_define_the_units():
    # Of the ninth SI brochure, and what follows: Stefan-Boltzmann and Wien (CODATA 2018).
    stefan = 2 * np.pi**5 * planck.BOLTZMANN**4 / (15 * planck.PLANCK**3 * planck.LIGHT_SPEED**2)
    assert stefan == pytest.approx(5.670374419e-8, rel=1e-10)
    nm = np.linspace(2800, 3000, 200_001)
    peak = nm[np.argmax(emissivity.radiance(nm, 1000.0))]
    assert peak == pytest.approx(2897.771955, abs=2e-3)


def test_radiance_adds_up_to_stefan_boltzmann():
    nm = np.geomspace(300, 3e7, 40_001)
    light = emissivity.radiance(nm, 300.0)
    total = np.pi * np.sum((light[1:] + light[:-1]) / 2 * np.diff(nm)) * 1e-3
    assert total == pytest.approx(5.670374419e-8 * 300**4, rel=1e-5)


def share_below(product):
    """Part of a black body's light below λT (µm K): the series in tables of heat transfer."""
    z = 14387.768775 / product
    n = np.arange(1, 200)
    terms = np.exp(-n * z) / n * (z**3 + 3 * z**2 / n + 6 * z / n**2 + 6 / n**3)
    return 15 / np.pi**4 * terms.sum()


def test_band_is_the_tables_of_black_bodies():
    assert share_below(2897.77) == pytest.approx(0.25, abs=1e-4)  # a quarter below Wien's peak
    nm = np.array([50.0, 7999.999, 8000.0, 14000.0, 14000.001, 2e8])
    step = np.array([0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
    share = emissivity.band_emissivity(step, nm, 300.0, (50.0, 2e8))
    expected = share_below(14 * 300) - share_below(8 * 300)
    assert share == pytest.approx(expected, abs=1e-7)


def test_band_emissivity_of_a_gray_body_is_its_own():
    gray = np.full((2, 3, 2), 0.73)
    found = emissivity.band_emissivity(gray, INFRARED, np.array([30.0, 300.0, 3000.0]), BAND)
    np.testing.assert_allclose(found, np.full((2, 3), 0.73), rtol=1e-14)


def test_band_weighs_by_temperature():
    rising = np.array([0.0, 1.0])
    cold, warm, hot = emissivity.band_emissivity(rising, INFRARED, [100.0, 300.0, 3000.0], BAND)
    # A cold body sends the long end, a hot one the short end: λ⁻⁴ at last, whose mean is known.
    assert cold > warm > hot
    a, b = INFRARED
    mean = 1.5 * (a**-2.0 - b**-2.0) / (a**-3.0 - b**-3.0)
    limit = emissivity.band_emissivity(rising, INFRARED, 1e8, BAND)
    assert limit == pytest.approx((mean - a) / (b - a), abs=1e-5)


def test_band_does_not_depend_on_the_grid():
    fine = np.linspace(7000, 15000, 801)
    curve = 0.9 - 0.2 * np.exp(-(((fine - 9500) / 800) ** 2))
    coarse = fine[::4]
    response = emissivity.Filter(np.linspace(7500, 13500, 7), [0, 0.5, 1, 1, 0.9, 0.4, 0])
    on_fine = emissivity.band_emissivity(np.interp(fine, coarse, curve[::4]), fine, 290.0, response)
    on_coarse = emissivity.band_emissivity(curve[::4], coarse, 290.0, response)
    assert on_fine == pytest.approx(on_coarse, rel=1e-10)
    # A plain sum over 0.1 nm, with nothing of the rule in it.
    nm = np.linspace(7500, 13500, 60_001)
    light = emissivity.radiance(nm, 290.0) * np.interp(nm, response.wavelengths, response.response)
    plain = np.sum(light * np.interp(nm, coarse, curve[::4])) / np.sum(light)
    assert on_coarse == pytest.approx(plain, rel=1e-7)


def test_filter_may_end_where_the_spectrum_does():
    wide = emissivity.Filter([1000, 7000, 8000, 9000, 10000, 20000], [0, 0, 0, 1, 0, 0])
    assert wide.wavelengths.tolist() == [8000, 9000, 10000]
    assert emissivity.band_emissivity([0.8, 0.8], INFRARED, 300.0, wide) == pytest.approx(0.8)


@pytest.mark.parametrize(
    ("call", "fault"),
    [
        (lambda: emissivity.band_emissivity([1, 1], INFRARED, 300, (7000, 9000)), "covers 8000"),
        (lambda: emissivity.band_emissivity([1, 1], INFRARED, 300, (9000, 8000)), "first and last"),
        (lambda: emissivity.band_emissivity([1, 1], INFRARED, 0, BAND), "0 K"),
        (lambda: emissivity.band_emissivity([1, 1], INFRARED, -3, BAND), "-3 K"),
        (lambda: emissivity.band_emissivity([1, 1, 1], INFRARED, 300, BAND), "against 3 bands"),
        (lambda: emissivity.band_emissivity([1, 1], INFRARED[::-1], 300, BAND), "increasing"),
        (lambda: emissivity.apparent_temperature([1, 1], INFRARED, 300, BAND, -1), "background"),
        (lambda: emissivity.Filter([1, 2], [0, 0]), "above 0"),
        (lambda: emissivity.Filter([2, 1], [1, 1]), "increase"),
        (lambda: emissivity.Filter([1, 2, 3], [1, 1]), "at least two"),
        (lambda: emissivity.radiance([0.0], 300), "above 0"),
    ],
)
def test_faults_are_named(call, fault):
    with pytest.raises(DomainError, match=fault):
        call()


def test_apparent_temperature_in_a_narrow_band_is_a_closed_form():
    # Of one wavelength, exp(x/T_a) = 1 + (exp(x/T) - 1)/ε without surroundings.
    band = (9999.9, 10000.1)
    x = planck.PLANCK * planck.LIGHT_SPEED / (planck.BOLTZMANN * 1e-5)
    epsilon = np.array([0.05, 0.5, 0.95])
    for kelvin in (30.0, 300.0, 3000.0):
        found = emissivity.apparent_temperature(
            epsilon[:, np.newaxis] * [1, 1], INFRARED, kelvin, band
        )
        expected = x / np.log1p(np.expm1(x / kelvin) / epsilon)
        np.testing.assert_allclose(found, expected, rtol=1e-8)


def test_apparent_temperature_meets_its_limits():
    half = np.array([0.5, 0.6])
    black, mirror = np.ones(2), np.zeros(2)
    call = emissivity.apparent_temperature
    assert call(half, INFRARED, 293.0, BAND, 293.0) == pytest.approx(293.0, rel=1e-12)
    assert call(black, INFRARED, 293.0, BAND, 3.0) == pytest.approx(293.0, rel=1e-12)
    assert call(mirror, INFRARED, 293.0, BAND, 250.0) == pytest.approx(250.0, rel=1e-12)
    assert call(half, INFRARED, 0.0, BAND, 0.0) == 0
    between = call(half, INFRARED, 293.0, BAND, np.array([3.0, 250.0, 350.0]))
    assert np.all(np.diff(between) > 0)
    assert 250 < between[1] < 293 < between[2] < 350
    # Noise: an emissivity a little above 1 makes it warmer than it is, and below 0 dark.
    assert 293 < call(black * 1.02, INFRARED, 293.0, BAND, 3.0) < 296
    assert np.isnan(call(-half, INFRARED, 293.0, BAND))


def test_apparent_temperature_sends_what_was_there():
    nm = np.linspace(7000, 15000, 9)
    epsilon = np.linspace(0.4, 0.9, 9)
    response = emissivity.Filter([7500, 10000, 13500], [0, 1, 0])
    kelvin = emissivity.apparent_temperature(epsilon, nm, 320.0, response, 280.0)
    fine = np.linspace(7500, 13500, 60_001)
    through = np.interp(fine, response.wavelengths, response.response)
    e = np.interp(fine, nm, epsilon)
    own, around, seen = (emissivity.radiance(fine, t) for t in (320.0, 280.0, kelvin))
    expected = np.sum(through * (e * own + (1 - e) * around))
    assert np.sum(through * seen) == pytest.approx(expected, rel=1e-8)


def traced():
    """Other surfaces than those of the table, at angles and σ between its nodes."""
    rows = np.loadtxt(Path(__file__).parent / "emission_traced.csv", delimiter=",", skiprows=1)
    return {sigma: rows[rows[:, 0] == sigma].T for sigma in np.unique(rows[:, 0])}


@pytest.mark.parametrize(
    ("sigma", "bound"), [(7.5, 4e-4), (22.5, 4e-4), (37.5, 4e-4), (52.5, 2e-3)]
)
def test_random_surface_against_held_out_traces(sigma, bound):
    _, theta, albedo, expected, error = traced()[sigma]
    theta, spread = np.radians(theta), np.radians(sigma)
    found = emissivity.directional(albedo[:, np.newaxis], theta, spread, model="surface")[:, 0]
    assert bound <= random_surface.ERROR_BOUND
    np.testing.assert_allclose(found, expected, atol=bound)
    assert error.max() < 1.1 * bound  # or the traces could not tell


def test_random_surface_keeps_its_limits():
    sigma = np.radians([[0.0], [5.0], [30.0], [65.0]])
    theta = np.radians([0.0, 45.0, 89.0, 90.0])
    call = emissivity.directional
    white = call(np.ones(1), theta, sigma, model="surface")
    np.testing.assert_array_equal(white, 0)
    smooth = call(ALBEDOS, theta, 0.0, model="surface")
    np.testing.assert_array_equal(smooth, np.broadcast_to(1 - ALBEDOS, smooth.shape))
    found = call(ALBEDOS, theta, sigma, model="surface")
    assert np.all((found >= 1 - ALBEDOS) & (found < 1))
    assert np.all(np.diff(found, axis=0) > 0)
    with pytest.raises(DomainError, match=r"ends at 65°; that of 'reference' goes on"):
        call(ALBEDOS, 0.0, np.radians(70), model="surface")
    with pytest.raises(DomainError, match="has gaussian slopes; 'oren-nayar' is for 'reference'"):
        call(ALBEDOS, 0.0, 0.5, model="surface", slopes="oren-nayar")


def test_random_surface_and_its_inverse():
    sigma, theta = np.radians([0.0, 5.0, 30.0, 60.0]), 0.3
    albedo = np.array([0.0, 1e-6, 0.2, 0.9, 0.999, 1.0])
    seen = emissivity.directional(albedo, theta, sigma, model="surface")
    back = emissivity.albedo_from_directional(seen, theta, sigma, model="surface")
    np.testing.assert_allclose(back, np.broadcast_to(albedo, back.shape), atol=1e-9)
    noisy = emissivity.albedo_from_directional([1.01, -0.02, np.nan], theta, 0.5, model="surface")
    assert noisy[0] < 0
    assert noisy[1] > 1
    assert np.isnan(noisy[2])


def test_random_surface_emits_what_its_reflectance_leaves():
    # The same kind of surface, traced for `core.surface` in single directions: other fields, other
    # walks, another way to count. That table's own noise makes white facets return 0.2 % too much.
    points, weights = np.polynomial.legendre.leggauss(24)
    theta_r = np.arccos(np.sqrt((points + 1) / 2))[:, np.newaxis]
    delta_phi = (points + 1) / 2 * np.pi
    r = surface.reflectance(ALBEDOS, np.radians(30), theta_r, delta_phi, np.radians(30))
    left = 1 - np.einsum("i,j,ijb->b", weights / 2, weights / 2, r)
    found = emissivity.directional(ALBEDOS, np.radians(30), np.radians(30), model="surface")
    np.testing.assert_allclose(found, left, atol=4e-3)


@pytest.mark.parametrize("model", list(emissivity.MODELS))
def test_a_reading_and_the_emissivity_of_one_surface_agree(model):
    sigma = np.radians(25)
    read = {
        "reference": lambda: bounce_series.evaluate(curves.series("45a:0").rows(sigma), ALBEDOS),
        "surface": lambda: reading.from_albedo(ALBEDOS, sigma, "surface"),
    }[model]()
    found = emissivity.albedo_from_reading(read, sigma, model=model)
    np.testing.assert_allclose(found, ALBEDOS, atol=1e-9)
