# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings at 45°/0° and their inverse, against published numbers and exact arithmetic."""

import math
from decimal import Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest

from core import models, oren_nayar, reading
from core.errors import DomainError

HALF_PI = math.pi / 2
SIGMAS = np.array([0.0, 1e-12, 1e-8, 1e-4, 0.01, 0.1, *np.linspace(0.2, HALF_PI, 30)])
FORMULAS = {
    "first-order": lambda rho, sigma: reading.from_albedo(rho, sigma, "first-order"),
    "two-bounce": reading.from_albedo,
    "geometric": reading.geometric_closure,
}
"""What is one line of algebra with published constants."""
ALBEDOS = np.concatenate(([0.0, 1e-6, 1e-3], np.linspace(0.01, 1, 60)))


def exact_reading(rho, sigma, model):
    """Evaluate the model in rational numbers: no rounding at all."""
    rho, s2 = Fraction(float(rho)), Fraction(float(sigma)) ** 2
    f1 = 1 - Fraction(1, 2) * s2 / (s2 + Fraction(33, 100))
    f2 = Fraction(17, 100) * s2 / (s2 + Fraction(13, 100))
    if model == "first-order":
        return f1 * rho
    if model == "two-bounce":
        return f1 * rho + f2 * rho**2
    # f2 ρ² + f2 ρ² gρ + f2 ρ² (gρ)² + …, the ratio chosen so that white facets lose nothing.
    g = 1 - Fraction(34, 100) * (s2 + Fraction(33, 100)) / (s2 + Fraction(13, 100))
    return f1 * rho + f2 * rho**2 / (1 - g * rho)


def test_coefficients_at_the_largest_roughness():
    # With σ = π/2 in equations 30 and 31 of Oren and Nayar (1994), to the digits that
    # Zuffi and Gagliardi (2007) need.
    f1, f2 = reading.coefficients(HALF_PI)
    assert round(float(f1), 4) == 0.5590
    assert round(float(f2), 4) == 0.1615
    assert round(float(reading.from_albedo([1.0], HALF_PI)[0]), 4) == 0.7205
    assert round(float(reading.white_reading(HALF_PI)), 4) == 0.7205


def test_coefficients_are_the_model_at_45_0_whatever_the_azimuth():
    for azimuth in np.linspace(0, math.pi, 9):
        for given, seen in zip(
            reading.coefficients(SIGMAS),
            oren_nayar.factors(math.pi / 4, 0.0, azimuth, SIGMAS),
            strict=True,
        ):
            np.testing.assert_array_equal(given, seen)


@pytest.mark.parametrize("model", FORMULAS)
def test_readings_agree_with_rational_arithmetic(model):
    expected = [[float(exact_reading(rho, s, model)) for rho in ALBEDOS] for s in SIGMAS]
    # 2e-15: about ten roundings.
    np.testing.assert_allclose(FORMULAS[model](ALBEDOS, SIGMAS), expected, rtol=2e-15, atol=0)


@pytest.mark.parametrize("model", models.NAMES)
@pytest.mark.parametrize(("dtype", "tolerance"), [(np.float64, 1e-12), (np.float32, 1e-5)])
def test_albedo_comes_back_from_its_reading(model, dtype, tolerance):
    rho = ALBEDOS.astype(dtype)
    sigma = SIGMAS[np.radians(models.find(model).largest_sigma) >= SIGMAS]
    read = reading.from_albedo(rho, sigma, model)
    back = reading.to_albedo(read, sigma, model)
    assert read.dtype == back.dtype == dtype
    assert back.shape == (sigma.size, rho.size)
    np.testing.assert_allclose(back, np.broadcast_to(rho, back.shape), rtol=tolerance, atol=0)


def test_inverse_agrees_with_50_digits():
    """The inverse on its own: not only as the counterpart of a forward model."""
    with localcontext() as context:
        context.prec = 50
        for sigma in (1e-8, 1e-3, 0.2, 0.8, HALF_PI):
            s2 = Decimal(sigma) ** 2
            f1 = 1 - s2 / 2 / (s2 + Decimal("0.33"))
            f2 = Decimal("0.17") * s2 / (s2 + Decimal("0.13"))
            for r in (1e-6, 0.05, 0.4, 0.7):
                d = Decimal(r)
                expected = (-f1 + (f1 * f1 + 4 * f2 * d).sqrt()) / (2 * f2)
                found = reading.to_albedo([r], sigma)[0]
                assert found == pytest.approx(float(expected), rel=5e-15)


def test_tiny_roughness_does_not_cancel():
    # The textbook root (-f1 + √(f1² + 4 f2 r)) / 2 f2 gives 0 here: f2 = 1.3e-16.
    assert reading.to_albedo([0.5], 1e-8)[0] == pytest.approx(0.5, rel=1e-15)


def test_smooth_surface_reads_its_albedo():
    for formula in FORMULAS.values():
        np.testing.assert_allclose(formula(ALBEDOS, 0.0), ALBEDOS, rtol=2e-16)
    for model in models.NAMES:
        np.testing.assert_allclose(reading.from_albedo(ALBEDOS, 0.0, model), ALBEDOS, rtol=2e-16)
        np.testing.assert_allclose(reading.to_albedo(ALBEDOS, 0.0, model), ALBEDOS, rtol=4e-16)


def test_geometric_closure_conserves_energy_and_keeps_two_bounces_for_dark():
    white = reading.geometric_closure([1.0], SIGMAS)[:, 0]
    np.testing.assert_allclose(white, 1.0, rtol=1e-15)
    # The third bounce and later ones are of order ρ³: f2 g ρ³ / (1 - gρ) with f2 g ≤ 0.11.
    rho = np.array([1e-3])
    np.testing.assert_allclose(
        reading.geometric_closure(rho, SIGMAS),
        reading.from_albedo(rho, SIGMAS, "two-bounce"),
        atol=0.11e-9,
        rtol=0,
    )


def test_formulas_are_ordered_by_the_bounces_they_count():
    first, second, all_of_them = (f(ALBEDOS[1:], SIGMAS[2:]) for f in FORMULAS.values())
    # ≥ within one rounding, where f2 ρ is below it.
    assert (second >= first).all()
    assert (all_of_them >= second * (1 - 4e-16)).all()
    assert (first[-1, -1], second[-1, -1]) < (0.56, 0.73)


def test_closure_is_the_nearest_to_the_reference():
    sigma = np.radians(np.linspace(1, 50, 40))
    rho = ALBEDOS[1:]
    reference = reading.from_albedo(rho, sigma, "reference")
    fitted = reading.from_albedo(rho, sigma, "closure")
    error, geometric, two_bounce = (
        np.max(np.abs(values / reference - 1))
        for values in (
            fitted,
            reading.geometric_closure(rho, sigma),
            reading.from_albedo(rho, sigma),
        )
    )
    # Measured: 0.05 %, 8.5 % and 20 %.
    assert error < 0.001 < 0.08 < geometric < 0.09 < 0.19 < two_bounce


@pytest.mark.parametrize(("peak", "degrees"), [(0.8, 48.9), (0.9, 28.0), (0.95, 19.5)])
def test_sigma_max_of_bright_readings(peak, degrees):
    assert round(math.degrees(reading.sigma_max(peak)), 1) == degrees


def test_sigma_max_is_where_white_facets_give_the_reading():
    peaks = np.concatenate((np.linspace(0.7206, 0.9999, 400), [0.98, 1 - 1e-9, 1 - 1e-13]))
    sigma = reading.sigma_max(peaks)
    assert (np.diff(reading.sigma_max(np.sort(peaks))) <= 0).all()
    # Back through the model in rational numbers. 4e-16: σ² below 1 - r is rounded relatively.
    for peak, bound in zip(peaks, sigma, strict=True):
        assert float(exact_reading(1, bound, "two-bounce")) == pytest.approx(peak, rel=4e-16)
    # 1e-12 of σ, found by bisection with 50 digits.
    for peak in (0.75, 0.9, 0.98, 0.999999):
        low, high = Decimal(0), Decimal(2)
        with localcontext() as context:
            context.prec = 50
            for _ in range(120):
                middle = (low + high) / 2
                s2 = middle * middle
                white = 1 - s2 / 2 / (s2 + Decimal("0.33"))
                white += Decimal("0.17") * s2 / (s2 + Decimal("0.13"))
                low, high = (middle, high) if white > Decimal(peak) else (low, middle)
        # r = 1 - 1e-6 stands for 1 - r to 1e-10 only.
        assert float(reading.sigma_max(peak)) == pytest.approx(float(low), rel=1e-10)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_sigma_max_at_its_limits(dtype):
    peaks = np.array([0.0, 0.5, 0.67, 0.72, 1.0, 1.01, np.nan], dtype)
    sigma = reading.sigma_max(peaks)
    assert sigma.dtype == dtype
    np.testing.assert_array_equal(sigma[:4], dtype(HALF_PI))
    assert sigma[4] == 0
    assert np.isnan(sigma[5:]).all()
    assert reading.sigma_max(np.zeros((0, 3), dtype)).shape == (0, 3)
    # What it gives is a valid roughness again.
    reading.coefficients(sigma[:5])


def test_sigma_max_in_float32():
    peaks = np.linspace(0.73, 0.999, 50)
    # 1 - r loses up to ten of float32's 24 bits at r = 0.999, and σ² is proportional to it.
    np.testing.assert_allclose(
        reading.sigma_max(peaks.astype(np.float32)), reading.sigma_max(peaks), rtol=1e-4
    )


@pytest.mark.parametrize("model", models.NAMES)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_broadcasting_precision_and_nan(model, dtype):
    values = np.array([[[0.1, np.nan, 0.3]], [[0.4, 0.5, 0.6]]], dtype)
    sigma = np.array([0.1, np.nan, 0.3, 0.4])
    for function in (reading.from_albedo, reading.to_albedo):
        result = function(values, sigma, model)
        assert result.dtype == dtype
        assert result.shape == (2, 4, 3)
        np.testing.assert_array_equal(
            np.isnan(result),
            np.isnan(values) | np.isnan(sigma)[:, np.newaxis],
        )
        assert function(values[0, 0], 0.2, model).shape == (3,)
        assert function(values[0, 0], 0.2, model).dtype == dtype
        assert function(np.zeros((0, 3), dtype), 0.2, model).shape == (0, 3)
        assert function(np.zeros((2, 0), dtype), [0.1, 0.2], model).shape == (2, 0)
        assert function(np.zeros((4, 1, 3), dtype), np.zeros(0), model).shape == (4, 0, 3)
        np.testing.assert_array_equal(function(np.zeros(2, dtype), sigma[[0, 2]], model), 0)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("shape", [(), (3,), (0, 2)])
def test_functions_of_sigma_keep_its_precision(dtype, shape):
    sigma = np.full(shape, 0.4, dtype)
    scalar = dtype(0.4)
    for function in (
        lambda s: reading.coefficients(s)[0],
        lambda s: reading.coefficients(s)[1],
        reading.bounce_ratio,
        reading.white_reading,
        lambda s: reading.white_reading(s, "closure"),
        reading.sigma_max,
    ):
        assert function(sigma).dtype == dtype
        assert function(sigma).shape == shape
        assert function(scalar).dtype == dtype


def test_float32_right_angle_is_a_valid_roughness():
    sigma = np.array([HALF_PI], np.float32)
    np.testing.assert_allclose(reading.white_reading(sigma), 0.7205, atol=5e-5)
    np.testing.assert_allclose(reading.white_reading(np.float32(HALF_PI)), 0.7205, atol=5e-5)


@pytest.mark.parametrize("model", ["two-bounce", "closure", "reference"])
def test_infeasible_readings_are_reported_not_clipped(model):
    limit = float(reading.white_reading(0.8, model))
    rho = reading.to_albedo(np.array([limit, limit * 1.05]), 0.8, model)
    assert rho[0] == pytest.approx(1.0, rel=1e-14)
    assert rho[1] > 1.01
    np.testing.assert_allclose(
        reading.from_albedo(rho, 0.8, model), [limit, limit * 1.05], rtol=1e-14
    )


def test_a_reading_below_every_albedo_is_nan_without_a_warning(recwarn):
    assert np.isnan(reading.to_albedo([-5.0], 1.0)[0])
    assert not recwarn.list


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: reading.from_albedo([0.5], 0.1, "two bounce"), "Model 'two bounce' is not known"),
        (
            lambda: reading.to_albedo([0.5], 0.1, "x"),
            "choose one of: lambert, first-order, two-bounce, ",
        ),
        (lambda: reading.coefficients(0.1, "d:8"), "Instrument 'd:8' is not known; choose one of"),
        (lambda: reading.from_albedo([0.5], 0.1, instrument="d:8"), "Instrument 'd:8' is not"),
        (lambda: reading.from_albedo([0.5], 30), "the roughness sigma holds 30 rad (1719°)"),
        (lambda: reading.to_albedo([0.5], -0.1), "the roughness sigma holds -0.1 rad"),
        (lambda: reading.to_albedo(0.5, 0.1), "the reading is a single number"),
    ],
)
def test_bad_arguments_are_refused_in_a_sentence(call, sentence):
    with pytest.raises(DomainError) as caught:
        call()
    assert sentence in str(caught.value)
    assert str(caught.value).endswith(".")
