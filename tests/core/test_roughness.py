# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ from a profilometer's slopes, against a surface whose heights are known."""

import math

import numpy as np
import pytest

from core import roughness
from core.errors import DomainError

SLOPES = np.array([0.0, 1e-9, 0.05, 0.35, 1.0, math.sqrt(3)])


@pytest.fixture(scope="module")
def heights():
    """A surface of waves, each with one at a right angle to it, over a square of side 1.

    So slopes are the same both ways. Whole waves fit, so that differences need no edge.
    """
    rng = np.random.default_rng(3)
    x, y = np.meshgrid(*2 * [np.arange(256) / 256], indexing="ij")
    z = np.zeros_like(x)
    for a, b in ((3, 4), (7, 2), (11, 5), (8, 9)):
        for across, along in ((a, b), (-b, a)):
            z += np.cos(2 * math.pi * (across * x + along * y) + rng.uniform(0, 2 * math.pi))
    return z * 1e-2


def test_slopes_of_heights_are_those_of_profile_and_area(heights):
    """What a profilometer does: differences along a line, and both ways over an area."""
    step = 1 / 256
    across = (np.roll(heights, -1, 0) - np.roll(heights, 1, 0)) / (2 * step)
    along = (np.roll(heights, -1, 1) - np.roll(heights, 1, 1)) / (2 * step)
    rdq = math.sqrt((across**2).mean())
    sdq = math.sqrt((across**2 + along**2).mean())
    assert float(roughness.sigma_from_rdq(rdq)) == pytest.approx(math.atan(rdq))
    assert float(roughness.sigma_from_sdq(sdq)) == pytest.approx(math.atan(rdq))


def test_known_angles():
    assert float(roughness.sigma_from_rdq(math.sqrt(3))) == pytest.approx(math.radians(60))
    assert float(roughness.sigma_from_rdq(1 / math.sqrt(3))) == pytest.approx(math.radians(30))
    assert float(roughness.sigma_from_sdq(math.sqrt(2))) == pytest.approx(math.radians(45))


def test_there_and_back():
    back = roughness.rdq_from_sigma(roughness.sigma_from_rdq(SLOPES))
    np.testing.assert_allclose(back, SLOPES, rtol=4e-16, atol=0)
    back = roughness.sdq_from_sigma(roughness.sigma_from_sdq(SLOPES))
    np.testing.assert_allclose(back, SLOPES, rtol=6e-16, atol=0)


def test_a_missing_slope_stays_missing():
    found = roughness.sigma_from_rdq([math.nan, 1.0])
    assert np.isnan(found).tolist() == [True, False]


@pytest.mark.parametrize("bad", [-0.1, math.inf, -math.inf])
def test_what_is_no_slope_is_refused(bad):
    with pytest.raises(DomainError, match="Rdq is an rms slope"):
        roughness.sigma_from_rdq([0.1, bad])
    with pytest.raises(DomainError, match="Sdq is an rms slope"):
        roughness.sigma_from_sdq(bad)


@pytest.mark.parametrize("bad", [-0.1, math.pi / 2, 3.0])
def test_a_wall_has_no_slope(bad):
    with pytest.raises(DomainError, match="below π/2"):
        roughness.rdq_from_sigma(bad)
