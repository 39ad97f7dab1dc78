# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavelength grids, against interpolation in rational numbers."""

from fractions import Fraction

import numpy as np
import pytest

from core.errors import DomainError
from core.numerics import wavelength_grid

UNEVEN = np.array([380.0, 391.5, 400.0, 407.0, 430.0, 431.0, 470.0])


def exact_lagrange(source, values, at, points):
    """Interpolate by the polynomial through the nearest  nodes around the interval."""
    right = sum(1 for x in source if x <= at)
    first = min(max(right - points // 2, 0), len(source) - points)
    xs = [Fraction(float(x)) for x in source[first : first + points]]
    ys = [Fraction(float(y)) for y in values[first : first + points]]
    total = Fraction(0)
    for j in range(points):
        term = ys[j]
        for k in range(points):
            if k != j:
                term *= (Fraction(float(at)) - xs[k]) / (xs[j] - xs[k])
        total += term
    return float(total)


@pytest.mark.parametrize(("method", "points"), [("linear", 2), ("cubic", 4)])
def test_resampling_agrees_with_rational_arithmetic(method, points):
    values = np.random.default_rng(5).uniform(0, 1, (3, UNEVEN.size))
    target = np.sort(np.append(np.linspace(380, 470, 57), [391.5, 430.0]))
    found = wavelength_grid.resample(values, UNEVEN, target, method)
    expected = [[exact_lagrange(UNEVEN, row, at, points) for at in target] for row in values]
    np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)


def test_linear_is_numpys_interpolation():
    values = np.random.default_rng(6).uniform(0, 1, UNEVEN.size)
    target = np.linspace(370, 480, 111)
    np.testing.assert_allclose(
        wavelength_grid.resample(values, UNEVEN, target, ends="hold"),
        np.interp(target, UNEVEN, values),
        rtol=1e-14,
    )


def test_cubic_is_exact_for_cubic_spectra():
    def cubic(nm):
        x = (nm - 425) / 50
        return 0.4 + 0.3 * x - 0.2 * x**2 + 0.1 * x**3

    target = np.linspace(380, 470, 91)
    np.testing.assert_allclose(
        wavelength_grid.resample(cubic(UNEVEN), UNEVEN, target, "cubic"), cubic(target), rtol=1e-13
    )


def test_own_grid_gives_the_same_bits():
    values = np.random.default_rng(7).uniform(0, 1, (2, UNEVEN.size))
    for method in ("linear", "cubic"):
        np.testing.assert_array_equal(
            wavelength_grid.resample(values, UNEVEN, UNEVEN, method), values
        )


def test_missing_ends_are_nan_unless_asked():
    target = np.array([370.0, 380.0, 470.0, 471.0])
    values = np.linspace(0.1, 0.7, 7)
    np.testing.assert_array_equal(
        wavelength_grid.resample(values, UNEVEN, target), [np.nan, values[0], values[-1], np.nan]
    )
    np.testing.assert_array_equal(
        wavelength_grid.resample(values, UNEVEN, target, "cubic", "hold"), values[[0, 0, -1, -1]]
    )
    np.testing.assert_array_equal(
        wavelength_grid.covered(UNEVEN, target), [False, True, True, False]
    )
    with pytest.raises(DomainError, match="370 nm lies outside the measured 380 to 470 nm; choose"):
        wavelength_grid.resample(values, UNEVEN, target, ends="error")


@pytest.mark.parametrize(("method", "reach"), [("linear", 1), ("cubic", 2)])
def test_nan_spreads_only_to_bands_that_lean_on_it(method, reach):
    source = np.arange(400.0, 500.0, 10.0)
    values = np.linspace(0, 1, 10)
    values[4] = np.nan  # 440 nm
    target = np.arange(400.0, 491.0, 5.0)
    found = wavelength_grid.resample(values, source, target, method)
    between = [nm for nm in target if nm % 10 and abs(nm - 440) < 10 * reach]
    expected = [nm == 440 or nm in between for nm in target]
    np.testing.assert_array_equal(np.isnan(found), expected)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_precision_leading_axes_and_nothing(dtype):
    values = np.ones((2, 1, UNEVEN.size), dtype)
    found = wavelength_grid.resample(values, UNEVEN, [390, 400, 410], "cubic")
    assert found.dtype == dtype
    assert found.shape == (2, 1, 3)
    np.testing.assert_allclose(found, 1, rtol=4 * np.finfo(dtype).eps)
    empty = wavelength_grid.resample(np.ones((0, UNEVEN.size), dtype), UNEVEN, [390.0])
    assert empty.dtype == dtype
    assert empty.shape == (0, 1)


@pytest.mark.parametrize("method", ["linear", "cubic"])
def test_one_two_and_three_bands(method):
    assert (
        wavelength_grid.resample([0.3], [550.0], [500.0, 550.0, 600.0], method, "hold").tolist()
        == [0.3] * 3
    )
    np.testing.assert_array_equal(
        wavelength_grid.resample([0.3], [550.0], [500.0, 550.0], method), [np.nan, 0.3]
    )
    assert wavelength_grid.resample([0.2, 0.4], [500, 600], [550.0], method)[0] == pytest.approx(
        0.3
    )
    parabola = wavelength_grid.resample([0.0, 0.25, 1.0], [500, 550, 600], [525.0], method)[0]
    assert parabola == pytest.approx(0.125 if method == "linear" else 0.0625)


def test_even_steps_are_told_from_uneven_ones():
    assert wavelength_grid.step(np.arange(380, 781, 5)) == 5
    # As files print a third of a nanometer.
    assert wavelength_grid.step([400, 403.3333, 406.6667, 410]) == pytest.approx(10 / 3)
    assert wavelength_grid.step([400, 403.3, 406.7, 410]) is None
    assert wavelength_grid.step(UNEVEN) is None
    assert wavelength_grid.step([550]) is None


@pytest.mark.parametrize(
    ("wavelengths", "sentence"),
    [
        ([], "Wavelengths must be a list of at least one number."),
        ([[400, 410]], "Wavelengths must be a list of at least one number."),
        ([400, np.nan, 420], "Wavelength number 2 is nan; give positive nanometers."),
        ([0, 400], "Wavelength number 1 is 0.0; give positive nanometers."),
        ([400, np.inf], "Wavelength number 2 is inf; give positive nanometers."),
        ([400, 420, 410], "Wavelengths must increase, but 420 nm is followed by 410 nm; sort"),
        ([400, 400], "Wavelengths must increase, but 400 nm is followed by 400 nm; sort"),
    ],
)
def test_bad_grids_are_refused_in_a_sentence(wavelengths, sentence):
    with pytest.raises(DomainError) as caught:
        wavelength_grid.check_wavelengths(wavelengths)
    assert str(caught.value).startswith(sentence)


def test_values_that_do_not_fit_their_grid_are_refused():
    with pytest.raises(DomainError, match="3 values do not fit 2 wavelengths"):
        wavelength_grid.resample([0.1, 0.2, 0.3], [400, 500], [450])
    with pytest.raises(DomainError, match="the spectrum is a single number"):
        wavelength_grid.resample(0.1, [400], [450])
