# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The departure from linearity: share of light between facets, and the shift of chromaticity."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import interreflection, models, reading, vcavity
from core.color import chromaticity
from core.color.color_difference import xyz_to_lab

ALBEDO = np.linspace(0, 1, 21)
WHITE = np.array([0.9505, 1.0, 1.089])


@pytest.mark.parametrize("degrees", [0, 10, 45, 90])
def test_two_bounces_by_the_reports_coefficients(degrees):
    s2 = math.radians(degrees) ** 2
    f1 = 1 - 0.5 * s2 / (s2 + 0.33)
    f2 = 0.17 * s2 / (s2 + 0.13)
    found = interreflection.share(ALBEDO, math.radians(degrees), "two-bounce")
    np.testing.assert_allclose(found, f2 * ALBEDO / (f1 + f2 * ALBEDO), atol=1e-11)
    read = f1 * ALBEDO + f2 * ALBEDO**2
    weights = np.linspace(1, 3, 21)
    overall = interreflection.overall_share(
        ALBEDO, math.radians(degrees), weights, model="two-bounce"
    )
    expected = (f2 * ALBEDO**2 * weights).sum() / (read * weights).sum()
    assert overall == pytest.approx(expected, abs=1e-11)


def test_the_references_first_bounce_is_that_of_its_series():
    sigma = np.radians([10.0, 45.0])
    expected = vcavity.ring_coefficients(sigma, 1)[:, 0]
    found = interreflection.first_bounce(sigma, "reference")
    np.testing.assert_allclose(found, expected, rtol=1e-10)


@pytest.mark.parametrize("model", ["lambert", "first-order"])
def test_without_later_bounces_there_is_none(model):
    np.testing.assert_allclose(interreflection.share(ALBEDO, 0.8, model), 0, atol=1e-15)


@settings(max_examples=50, deadline=None)
@given(
    st.sampled_from([n for n in models.NAMES if n != "reference"]),
    st.floats(0, 1),
    st.sampled_from(["45a:0", "di:8"]),
)
def test_it_grows_with_the_albedo_and_weighs_up_to_the_whole(model, share, instrument):
    sigma = share * math.radians(models.find(model).largest_sigma)
    found = interreflection.share(ALBEDO, sigma, model, instrument)
    assert found[0] == 0
    assert (found >= -1e-12).all()
    assert (found < 1).all()
    assert (np.diff(found) >= -1e-12).all()
    read = reading.from_albedo(ALBEDO, sigma, model, instrument)
    overall = interreflection.overall_share(ALBEDO, sigma, None, model, instrument)
    assert overall == pytest.approx((found * read).sum() / read.sum(), abs=1e-12)


def test_black_and_single_precision():
    assert interreflection.overall_share(np.zeros(3), 0.5) == 0
    found = interreflection.share(ALBEDO.astype(np.float32), [0.2, 0.5])
    assert found.shape == (2, 21)
    assert found.dtype == np.float32


@settings(max_examples=50)
@given(
    st.lists(st.floats(0.01, 1), min_size=3, max_size=3).map(np.array),
    st.floats(0.05, 1),
)
def test_a_darker_color_of_the_same_chromaticity_is_not_shifted(xyz, scale):
    assert chromaticity.shift(xyz, scale * xyz, WHITE) == pytest.approx(0, abs=1e-9)


def test_the_shift_is_that_of_colors_made_equally_light():
    one, other = np.array([[0.2, 0.3, 0.1], [0.4, 0.35, 0.3]]), np.array([0.1, 0.12, 0.07])
    leveled = np.stack([other * (row[1] / other[1]) for row in one])
    lab, lab_leveled = xyz_to_lab(one, WHITE), xyz_to_lab(leveled, WHITE)
    np.testing.assert_allclose(lab[:, 0], lab_leveled[:, 0])
    expected = np.hypot(*(lab - lab_leveled)[:, 1:].T)
    np.testing.assert_allclose(chromaticity.shift(one, other, WHITE), expected)


def test_black_has_no_chromaticity():
    black, gray = np.zeros(3), 0.2 * WHITE
    assert chromaticity.shift(black, gray, WHITE) == 0  # scaled to black, all is black
    assert np.isnan(chromaticity.shift(gray, black, WHITE))
    assert chromaticity.shift(black, black, WHITE) == 0
