# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a stable form has to do, one function a condition.

Each takes the function under test, passes on the core's and raises AssertionError on the
textbook's. Where the condition is a region and not a point, hypothesis looks for a counterexample.
"""

import contextlib
import math
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import cycles, estimate, oren_nayar, reading
from core.errors import DomainError
from tests.stability import exact

HALF_PI = math.pi / 2
PRECISIONS = (np.float32, np.float64)

repeatable = settings(
    deadline=None, derandomize=True, database=None, max_examples=100, report_multiple_bugs=False
)
few = settings(repeatable, max_examples=40)
precisions = st.sampled_from(PRECISIONS)


def magnitudes(low, high):
    """Numbers from 10^low to 10^high, each order of magnitude as likely as the next."""
    return st.floats(low, high).map(lambda power: 10.0**power)


def unit(low=0.0, high=1.0):
    return st.floats(low, high, allow_subnormal=False)


def silent(call):
    """Run a call that must not warn."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return call()
        except RuntimeWarning as warning:
            raise AssertionError(str(warning)) from warning


def check_small_roughness(to_albedo):
    """The root keeps its digits for every σ > 0, in both precisions."""

    @repeatable
    @given(precisions, magnitudes(-12, 0.19), magnitudes(-4, 0))
    def holds(dtype, sigma, r):
        sigma, r = dtype(sigma), np.array([r], dtype)
        expected = exact.albedo(r[0], sigma)
        found = to_albedo(r, sigma)
        assert found.dtype == dtype
        # Ten roundings: σ², two quotients, the root and the sums.
        assert abs(float(found[0]) - expected) <= 10 * np.finfo(dtype).eps * expected

    holds()


def check_denormals(to_albedo):
    """Readings of the smallest numbers there are come back as albedos of their size."""

    @repeatable
    @given(precisions, unit(0.0, 1.5), st.integers(1, 1 << 20), st.sampled_from([-1, 1]))
    def holds(dtype, sigma, steps, sign):
        smallest = np.finfo(dtype).smallest_subnormal
        r = np.array([sign * steps * smallest], dtype)
        f1, _ = reading.coefficients(dtype(sigma))
        found = silent(lambda: to_albedo(r, dtype(sigma)))[0]
        # f2 ρ² is below the smallest number. Two steps of the number line: one for each division.
        expected = float(r[0]) / float(f1)
        allowed = 2 * float(smallest) + 8 * np.finfo(dtype).eps * abs(expected)
        assert abs(float(found) - expected) <= allowed

    holds()
    # A roughness of that size is a smooth surface.
    for dtype in PRECISIONS:
        sigma = np.finfo(dtype).smallest_subnormal
        r = np.array([0.5], dtype)
        assert silent(lambda r=r, sigma=sigma: to_albedo(r, sigma))[0] == dtype(0.5)


def check_geometry(factors):
    """F1 and F2 are the paper's, wherever light and view are below 89.9°."""

    @few
    @given(
        precisions,
        unit(0, math.radians(89.9)),
        unit(0, math.radians(89.9)),
        unit(-2 * math.pi, 2 * math.pi),
        unit(0, HALF_PI),
    )
    def holds(dtype, light, view, delta_phi, sigma):
        geometry = [np.array([x], dtype) for x in (light, view, delta_phi, sigma)]
        f1, f2, scale = exact.factors(*(x[0] for x in geometry))
        found = factors(*geometry)
        # tan β magnifies the rounding of its neighbors in the sum up to 573-fold.
        steepest = math.tan(min(float(geometry[0][0]), float(geometry[1][0])))
        allowed = 10 * np.finfo(dtype).eps * (scale + 1 + steepest)
        assert abs(float(found[0][0]) - f1) <= allowed
        assert abs(float(found[1][0]) - f2) <= 10 * np.finfo(dtype).eps

    holds()


def check_grazing(factors):
    """Toward the light at grazing F1 grows and stays positive and finite, 90° included."""
    for dtype in PRECISIONS:
        gaps = np.array([1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 3e-7, 0], dtype)
        theta = dtype(HALF_PI) - gaps
        f1, f2 = factors(theta, theta, np.zeros_like(theta), np.full_like(theta, 0.5))
        assert np.isfinite(f1).all()
        assert np.isfinite(f2).all()
        assert (np.diff(f1) > 0).all(), f1
        for i in range(theta.size):
            expected, _, _ = exact.factors(theta[i], theta[i], dtype(0), dtype(0.5))
            assert abs(float(f1[i]) / expected - 1) <= 10 * np.finfo(dtype).eps


def check_right_angle(factors):
    """π/2 in float32 is an angle, also beside float64 values."""
    right = np.array([HALF_PI], np.float32)
    for arguments in (
        (right, np.array([0.3]), 0.0, 0.5),
        (np.array([0.3]), right, 0.0, 0.5),
        (np.array([0.3]), 0.2, 0.0, right),
    ):
        try:
            f1, f2 = factors(*arguments)
        except DomainError as error:
            raise AssertionError(str(error)) from error
        wide = [np.minimum(np.asarray(x, np.float64), HALF_PI) for x in arguments]
        expected = oren_nayar.factors(*wide)
        np.testing.assert_allclose((f1, f2), expected, rtol=1e-6)


def check_grazing_away(factors):
    """Away from the light at grazing sin α - (2β/π)³ is 0 where tan β is ∞: the product counts."""
    for dtype in PRECISIONS:
        gaps = np.array([1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 3e-7, 0], dtype)
        theta = dtype(HALF_PI) - gaps
        away = np.full_like(theta, np.pi)
        f1, _ = factors(theta, theta, away, np.full_like(theta, 0.7))
        for i in range(theta.size):
            expected, _, scale = exact.factors(theta[i], theta[i], away[i], dtype(0.7))
            assert abs(float(f1[i]) - expected) <= 10 * np.finfo(dtype).eps * scale


def check_normal(factors):
    """With light or view along the normal the azimuth has no meaning and no effect."""

    @repeatable
    @given(precisions, unit(0, HALF_PI), unit(-7, 7), unit(0, HALF_PI), st.booleans())
    def holds(dtype, theta, delta_phi, sigma, swap):
        steep, normal = np.array([theta], dtype), np.array([0.0], dtype)
        pair = (normal, steep) if swap else (steep, normal)
        f1, f2 = factors(*pair, np.array([delta_phi], dtype), np.array([sigma], dtype))
        expected = [float(f) for f in exact.coefficients(dtype(sigma))]
        tiny = np.finfo(dtype).smallest_normal
        np.testing.assert_allclose((f1[0], f2[0]), expected, 8 * np.finfo(dtype).eps, tiny)

    holds()


def check_right_azimuth(factors):
    """The branch at cos Δφ = 0 leaves no step, and a full turn changes nothing."""

    @repeatable
    @given(unit(0, 1.5), unit(0, 1.5), unit(0.05, HALF_PI), st.integers(-3, 3), magnitudes(-12, -2))
    def no_step(theta_i, theta_r, sigma, turns, gap):
        quarter = np.pi / 2 + turns * np.pi
        around = np.array([quarter - gap, quarter, quarter + gap])
        f1, f2 = factors(theta_i, theta_r, around, sigma)
        # dF1/dΔφ is at most C2 tan β + C3 tan((α + β)/2), and tan 1.5 = 14.2.
        slope = 0.5 * math.tan(1.5)
        assert np.ptp(f1) <= 2 * gap * slope + 1e-13
        assert np.ptp(f2) <= 2 * gap * 0.17 + 1e-13

    @repeatable
    @given(unit(0, 1.5), unit(0, 1.5), unit(-math.pi, math.pi), unit(0.05, HALF_PI))
    def full_turn(theta_i, theta_r, delta_phi, sigma):
        turned = np.array([delta_phi, delta_phi + 2 * np.pi, delta_phi - 2 * np.pi])
        for f in factors(theta_i, theta_r, turned, sigma):
            # Adding 2π rounds the azimuth by 1e-15, which tan 1.5 = 14 magnifies.
            assert np.ptp(f) <= 1e-13

    no_step()
    full_turn()
    # π/2 in float32 lies beyond π/2: the other branch, yet the same number.
    quarter = np.array([np.pi / 2], np.float32)
    f1, _ = factors(quarter * 0 + np.float32(1.2), quarter * 0 + 1, quarter, quarter * 0 + 0.5)
    expected, _, _ = exact.factors(np.float32(1.2), np.float32(1), quarter[0], np.float32(0.5))
    assert abs(float(f1[0]) - expected) <= 10 * np.finfo(np.float32).eps


def opposite_geometries():
    """Light and view steep and opposite, where the published model turns negative."""
    return np.radians([76.0, 80.0, 85.0]), np.radians([78.0, 80.0, 84.0]), np.full(3, np.pi)


def check_not_negative(reflectance):
    """No surface reflects less than nothing."""
    for sigma in np.radians([50.0, 70.0, 90.0]):
        for albedo in (0.05, 0.2, 0.9):
            r = reflectance(np.array([albedo]), *opposite_geometries(), sigma)
            assert np.isfinite(r).all()
            assert (r >= 0).all(), f"{r.min()} at σ = {np.degrees(sigma):.0f}°, ρ = {albedo}"


def check_left_as_published(reflectance):
    """What the model gives is returned, also where it is negative: the caller decides."""
    found = reflectance(np.array([0.05]), *opposite_geometries(), np.radians(70.0))[:, 0]
    for value, *angles in zip(found, *opposite_geometries(), strict=True):
        f1, f2, _ = exact.factors(*angles, np.radians(70.0))
        assert f1 * 0.05 + f2 * 0.05**2 < 0
        assert abs(value - (f1 * 0.05 + f2 * 0.05**2)) < 1e-15


def check_targets(targets):
    """What Blender is asked to match is not negative where the reading is not."""
    assert np.isfinite(targets).all()
    assert (targets >= 0).all(), targets.min()


def furnace(reflectance, theta, sigma, nodes=8):
    """Share of light that white facets return over the view hemisphere."""
    node, weight = np.polynomial.legendre.leggauss(nodes)
    cosine, weight = (node + 1) / 2, weight / 2
    azimuth = np.pi * (np.arange(nodes) + 0.5) / nodes
    view = np.arccos(cosine)[:, np.newaxis]
    r = reflectance(np.ones(1), theta, view, azimuth, sigma)[..., 0].mean(axis=1)
    return float((2 * cosine * weight * r).sum())


def check_energy(reflectance, sigma):
    """White facets return what they receive, and not more."""
    # 1e-3 for eight nodes a side, 2e-3 for Cycles' rounded average.
    share = furnace(reflectance, np.radians(80.0), sigma)
    assert abs(share - 1) <= 3e-3, share


def check_white(reading_of, sigmas):
    """White facets in a ring of light read 1 within a hundredth, whatever the roughness."""
    for sigma in sigmas:
        white = silent(lambda sigma=sigma: reading_of(np.ones(1), sigma))[0]
        assert np.isfinite(white)
        assert abs(white - 1) <= 0.01, f"{white} at σ = {np.degrees(sigma):.3g}°"


def check_shallow(slopes_of):
    """As σ → 0 the mean of Gaussian slopes is √(π/2) σ, however small σ is."""
    for sigma in (0.01, 1e-5, 1e-10, 1e-150, 1e-300):
        slope, share = silent(lambda sigma=sigma: slopes_of(sigma))
        assert share.sum() == pytest.approx(1)
        assert share @ slope / sigma == pytest.approx(np.sqrt(np.pi / 2), rel=1e-3)


def check_slots(slopes_of):
    """As σ → π/2 Gaussian slopes are steep, and no share of any exceeds the whole."""
    for sigma in (np.radians(89.99), np.pi / 2, np.float32(np.pi / 2)):
        slope, share = silent(lambda sigma=sigma: slopes_of(sigma))
        assert share.sum() == pytest.approx(1)
        assert np.degrees(share @ slope) == pytest.approx(89.95, abs=0.05)
        assert np.abs(share).max() < 1.01


def check_white_limit(reading_of):
    """The closure is finite, never falls, and reads 1 for white facets as σ → 0."""

    @repeatable
    @given(precisions, st.one_of(st.just(0.0), magnitudes(-12, -1)))
    def holds(dtype, sigma):
        albedo = np.linspace(0, 1, 21, dtype=dtype)
        r = silent(lambda: reading_of(albedo, dtype(sigma)))
        assert np.isfinite(r).all()
        assert (np.diff(r) > 0).all()
        # At σ ≤ 6° the light that leaves after the second bounce is below 5e-4.
        expected = reading.from_albedo(albedo.astype(float), sigma)
        assert np.max(np.abs(r - expected)) <= 0.012 * min(1, (sigma / 0.1) ** 2) + 1e-6

    holds()


def check_infeasible(to_albedo):
    """A reading above that of white facets comes back from its albedo: nothing was clipped."""

    @repeatable
    @given(precisions, unit(0, HALF_PI), unit(1.001, 1.5))
    def holds(dtype, sigma, excess):
        sigma = dtype(sigma)
        r = np.array([reading.white_reading(sigma)], dtype) * dtype(excess)
        rho = to_albedo(r, sigma)
        assert rho[0] > 1
        np.testing.assert_allclose(
            reading.from_albedo(rho, sigma), r, rtol=10 * np.finfo(dtype).eps
        )

    holds()


def check_sigma_max(sigma_max):
    """The largest roughness keeps its digits as the peak approaches 1."""

    @few
    @given(magnitudes(-13, math.log10(0.27)))
    def holds(below_white):
        peak = np.array([1 - below_white])
        expected = exact.largest_sigma(peak[0])
        # 0.67 - r is known to one rounding of r: a few times 1e-15 at the rough end.
        np.testing.assert_allclose(sigma_max(peak), expected, rtol=1e-13)

    holds()


def check_noise(to_albedo):
    """Readings of black below zero keep their sign, so that noise averages out."""

    @repeatable
    @given(precisions, unit(0, HALF_PI), magnitudes(-6, -1))
    def comes_back(dtype, sigma, noise):
        r = np.array([-noise], dtype)
        rho = silent(lambda: to_albedo(r, dtype(sigma)))
        np.testing.assert_allclose(
            reading.from_albedo(rho, dtype(sigma)), r, rtol=10 * np.finfo(dtype).eps
        )

    comes_back()
    noise = np.random.default_rng(1).normal(0, 0.003, 20_000)
    bias = np.mean(to_albedo(noise, 0.5))
    # Four standard errors of the mean.
    assert abs(bias) < 4 * 0.003 / math.sqrt(noise.size), bias


def check_color_noise(color_for_reading, reflectance):
    """The same for the socket color: noise and colors out of gamut come back."""

    @repeatable
    @given(unit(0, 1), magnitudes(-6, 1))
    def comes_back(roughness, size):
        r = np.array([-size, 1e-3, size])
        color = silent(lambda: color_for_reading(r, roughness))
        read = reflectance(color, roughness, np.pi / 4, 0.0, 0.0)
        np.testing.assert_allclose(read, r, rtol=1e-10)

    comes_back()


def check_far_below_black(to_albedo):
    """A reading that no albedo gives is NaN without a warning, and its neighbors stay."""
    r = np.array([0.4, -0.6, 0.4])
    rho = silent(lambda: to_albedo(r, HALF_PI))
    assert np.isnan(rho[1])
    assert rho[0] == rho[2] > 0.4


def check_unit(coefficients):
    """Degrees given for radians are refused: f1 = 0.5 would look like an answer."""

    @repeatable
    @given(st.one_of(unit(1.6, 90), unit(-90, -1e-6), st.just(math.inf)))
    def refused(sigma):
        answer = None
        with contextlib.suppress(DomainError):
            answer = coefficients(sigma)
        assert answer is None, f"σ = {sigma} rad gave {answer}"

    refused()


BAD = (math.nan, math.inf, -math.inf)


def check_bad_band(function):
    """A band that is NaN or infinite stays so, silently, and leaves the others to the last bit."""

    @repeatable
    @given(
        precisions,
        st.sampled_from(BAD),
        st.integers(0, 4),
        st.one_of(st.just(0.0), unit(1e-6, HALF_PI)),
    )
    def stays(dtype, bad, band, sigma):
        good = np.linspace(0.1, 0.7, 5, dtype=dtype)
        spoiled = good.copy()
        spoiled[band] = bad
        found = silent(lambda: function(spoiled, sigma))
        expected = function(good, sigma)
        assert found.dtype == dtype
        assert not np.isfinite(found[band])
        np.testing.assert_array_equal(np.delete(found, band), np.delete(expected, band))

    stays()


def check_bad_angle(factors):
    """An angle or a roughness that is NaN gives NaN there, and nothing elsewhere."""
    for position in range(4):
        geometry = [np.full(3, x) for x in (0.7, 0.3, 2.5, 0.5)]
        expected = factors(*geometry)
        geometry[position] = geometry[position].copy()
        geometry[position][1] = math.nan
        found = silent(lambda geometry=geometry: factors(*geometry))
        assert np.isnan(found[0][1]), "NaN became a number"
        for one, other in zip(found, expected, strict=True):
            np.testing.assert_array_equal(one[[0, 2]], other[[0, 2]])


def check_bad_neighbor(resample):
    """A NaN or infinite band reaches only the wavelengths that lean on it."""
    source = np.array([400.0, 410, 420, 430, 440])
    for bad in BAD:
        values = np.array([0.1, bad, 0.3, 0.4, 0.5])
        found = silent(lambda values=values: resample(values, source, [400.0, 405, 415, 420, 435]))
        np.testing.assert_allclose(found[[0, 3, 4]], [0.1, 0.3, 0.45], rtol=1e-15)
        assert not np.isfinite(found[[1, 2]]).any()


def check_cycles_smooth(reflectance):
    """Cycles' lobe at roughness 0 is Lambert's, where its closure is 0/0."""
    color = np.array([0.2, 0.9])
    for roughness in (0.0, 5e-324, 1e-300, 1e-12):
        for theta in (0.0, 0.7, HALF_PI):
            angles = (roughness, theta, 0.3, 1.0)
            smooth = silent(lambda angles=angles: reflectance(color, *angles))
            np.testing.assert_allclose(np.ravel(smooth), color, rtol=1e-11)


def check_cycles_grazing(reflectance):
    """(sin θ/cos θ)(1 - sin³ θ) keeps its digits toward 90°, where it is ∞ · 0."""
    color = np.array([0.2, 0.9])
    theta = np.float32(HALF_PI) - np.geomspace(1e-1, 1e-6, 40, dtype=np.float32)
    view, azimuth = np.float32(0.2), np.float32(3)
    single = reflectance(color.astype(np.float32), 1.0, theta, view, azimuth)
    wide = cycles.reflectance(color, 1.0, theta.astype(float), float(view), float(azimuth))
    # 20 float32 roundings of terms up to 1.
    assert np.max(np.abs(single - wide)) <= 20 * np.finfo(np.float32).eps


def check_white_emits_nothing(emissivity):
    """White facets absorb nothing, so they emit nothing: not even what a sum has lost."""
    theta, sigma = np.radians([[0.0], [45.0], [80.0], [89.9]]), np.radians([5.0, 30.0, 50.0])
    for t in theta.ravel():
        for s in sigma:
            assert abs(float(emissivity(np.ones(1), t, s)[..., 0])) <= 1e-12


def check_cold_band(band_emissivity):
    """A gray body is as gray when it is so cold that its light is below the smallest number."""
    nm = np.array([3000.0, 5000.0])
    found = silent(lambda: band_emissivity(np.full(2, 0.73), nm, 2.0, (3000.0, 5000.0)))
    assert abs(float(found) - 0.73) <= 1e-12


def check_long_waves(radiance):
    """Where hc/λkT is small, a black body goes over into Rayleigh and Jeans's 2ckT/λ⁴."""
    nm, kelvin = 1e6, np.array([1e5, 1e7, 1e9, 1e12])
    light_speed, boltzmann = 299_792_458.0, 1.380649e-23
    expected = 2 * light_speed * boltzmann * kelvin / (nm * 1e-9) ** 4 * 1e-6
    x = 14387.768775 * 1e3 / (nm * kelvin)
    # The next terms of the expansion, 1 - x/2 + x²/12; the constant in x has ten digits.
    expected *= 1 - x / 2 + x * x / 12
    np.testing.assert_allclose(silent(lambda: radiance(nm, kelvin)), expected, rtol=1e-11)


GRAYS = np.linspace(0.2, 0.6, 16)


def pair(albedo, sigma, seed=None, model=estimate.MODEL):
    """Give a smooth and a rough reading, with noise of 0.1 % where seeded."""
    values = np.array([albedo, reading.from_albedo(albedo, sigma, model)])
    if seed is not None:
        random = np.random.default_rng(seed).standard_normal(values.shape)
        values = values + estimate.repeatability(values) * random
    smooth, rough = values
    return [estimate.Reading(smooth, rough=False), estimate.Reading(rough)]


def check_nearly_smooth(estimate_of):
    """Near σ = 0 the interval stays above 0, is finite, and holds the truth as often as it says."""
    for degrees in (0.0, 1.0, 2.0):
        sigma, held = math.radians(degrees), 0
        for seed in range(40):
            low, high = estimate_of(pair(GRAYS, sigma, seed)).interval
            assert 0 <= low <= high < math.radians(6)
            held += low <= sigma <= high
        assert held >= 35, held  # 38 or more are expected; 34 happen once in 700


def check_not_told(estimate_of, albedo):
    """Readings of white and the like give no σ, whatever the draw of noise."""
    for degrees in (0, 15, 30, 45):
        for seed in range(5):
            found = estimate_of(pair(albedo, math.radians(degrees), seed))
            assert not found.is_told
            assert math.isnan(found.sigma)


def check_one_reading(estimate_of):
    """A reading alone is explained by every σ: none is an answer."""
    found = estimate_of(pair(GRAYS, 0.5)[1:])
    assert not found.is_told
    assert math.isnan(found.sigma)
    assert np.ptp(found.interval) > math.radians(50)


def check_brighter_than_smooth(estimate_of):
    """A rough reading a little too bright for any σ leaves what the model may miss, not nothing."""
    smooth, _ = pair(GRAYS, 0.0)
    found = estimate_of([smooth, estimate.Reading(1.004 * np.asarray(smooth.values))])
    assert found.interval[0] == 0
    assert found.interval[1] > math.radians(2.5)


def check_missing_band(estimate_of):
    """A band that is no number takes nothing from the others."""
    smooth, rough = (np.array(of.values) for of in pair(GRAYS, 0.5))
    rough[3], smooth[7] = np.nan, np.inf
    found = silent(
        lambda: estimate_of([estimate.Reading(smooth, rough=False), estimate.Reading(rough)])
    )
    assert abs(found.sigma - 0.5) < 1e-4
