# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What SCI, SCE and gloss units say of gloss, against Fresnel's formulas in his own words."""

import math

import numpy as np
import pytest

from core import gloss_readings
from core.errors import DomainError
from core.gloss_readings import GlossReadings


def fresnel(index, degrees):
    """Squares of sines and tangents of sums and differences of the angles."""
    angle = math.radians(degrees)
    inside = math.asin(math.sin(angle) / index)
    across = math.sin(angle - inside) / math.sin(angle + inside)
    along = math.tan(angle - inside) / math.tan(angle + inside)
    return (across**2 + along**2) / 2


@pytest.mark.parametrize("index", [1.05, 1.33, 1.5, 1.567, 1.8, 2.42])
@pytest.mark.parametrize("angle", [20, 60, 85])
def test_a_smooth_dielectric_is_found_again(index, angle):
    units = 100 * fresnel(index, angle) / fresnel(1.567, angle)
    found = gloss_readings.of_units(units, angle)
    assert found.reflectance == pytest.approx(fresnel(index, angle), rel=1e-9)
    if angle == 85 and index > 2:
        # From 1.93 on, more of the index reflects less at 85°: two indices read the same.
        assert found.index < index
        assert fresnel(found.index, 85) == pytest.approx(fresnel(index, 85), rel=1e-6)
    else:
        assert found.index == pytest.approx(index, abs=2e-5)
        assert found.f0 == pytest.approx(((index - 1) / (index + 1)) ** 2, abs=2e-6)


def test_black_glass_of_the_standard():
    """ISO 2813's table for 1.567, in percent: 4.908, 10.006, 61.914."""
    found = [gloss_readings.of_units(100, angle).reflectance for angle in (20, 60, 85)]
    assert [100 * each for each in found] == pytest.approx([4.908, 10.006, 61.914], abs=0.002)


def test_what_no_dielectric_reflects_has_no_index():
    assert math.isnan(gloss_readings.of_units(1500, 60).f0)
    silver = gloss_readings.of_units(1900, 20)  # reflects 93 %, near the normal as at it
    assert math.isnan(silver.index)
    assert silver.f0 == pytest.approx(0.9325, abs=1e-4)
    assert gloss_readings.of_units(0, 60).f0 == 0


@pytest.mark.parametrize(("units", "angle"), [(-1, 60), (math.nan, 60), (5, 0), (5, 90), (5, -20)])
def test_units_that_cannot_be_are_refused(units, angle):
    with pytest.raises(DomainError):
        gloss_readings.of_units(units, angle)


def test_a_sphere_sees_f0():
    """From 8° a dielectric reflects within 0.2 % what it does at the normal."""
    below = np.linspace(0.1, 0.6, 31)
    for index in (1.33, 1.5, 1.8):
        found = gloss_readings.of_sphere(below + fresnel(index, 8), below)
        assert found.doubt == ""
        assert found.index == pytest.approx(index, abs=1e-4)
        assert found.f0 == pytest.approx(((index - 1) / (index + 1)) ** 2, rel=1e-3)
        assert found.reflectance == pytest.approx(found.f0, rel=2e-3)


@pytest.mark.parametrize(
    ("difference", "words"),
    [
        (-0.03, "taken for each other"),
        (0.001, "matte"),
        (0.0, "matte"),
        (np.linspace(0.3, 0.9, 31), "metals"),
        (np.linspace(0.037, 0.043, 31), ""),
    ],
)
def test_what_speaks_against_gloss_is_said(difference, words):
    found = gloss_readings.of_sphere(0.05 + np.broadcast_to(difference, 31), np.full(31, 0.05))
    assert words in found.doubt
    assert bool(words) == bool(found.doubt)
    assert found.lowest == pytest.approx(np.min(difference))
    assert found.highest == pytest.approx(np.max(difference))


@pytest.mark.parametrize(
    ("sci", "sce"), [([0.1], [0.1, 0.2]), ([], []), ([math.nan], [0.1]), ([[0.1]], [[0.1]])]
)
def test_readings_that_cannot_be_compared_are_refused(sci, sce):
    with pytest.raises(DomainError):
        gloss_readings.of_sphere(sci, sce)


def test_the_readings_of_one_surface_stand_together():
    sphere = gloss_readings.of_sphere([0.13, 0.13], [0.1, 0.1])
    found = GlossReadings(sphere, {60.0: 8.0, 20.0: 1.0})
    assert [each.angle for each in found.told] == [8.0, 20.0, 60.0]
    assert found.least_f0 == sphere.f0 == pytest.approx(0.03, rel=2e-3)
    assert math.isnan(GlossReadings().least_f0)
