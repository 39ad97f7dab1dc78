# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The albedos that a reading leaves open, against a plain search and the report's closed form."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import feasible, models, reading
from core.errors import DomainError

QUICK = [name for name in models.NAMES if name != "reference"]
SIGMAS = np.radians(np.linspace(0, 90, 2001))
READINGS = st.lists(st.floats(0, 1.02), min_size=1, max_size=6).map(np.array)


def searched(values, model, instrument="45a:0"):
    """Every roughness that keeps all albedos at or below 1, one by one; and their albedos."""
    sigmas = SIGMAS[math.radians(models.find(model).largest_sigma) >= SIGMAS]
    rho = reading.to_albedo(values, sigmas, model, instrument)
    # 1e-12: the white of a level surface is inverted with a rounding.
    fits = (rho <= 1 + 1e-12).all(axis=-1)
    return rho[fits], sigmas[fits]


@pytest.mark.parametrize("peak", [0.8, 0.9, 0.95, 0.999])
def test_it_is_the_reading_to_the_albedo_at_the_largest_roughness(peak):
    """The report's range for its model: r at σ = 0, and ρ(r; σmax), which it calls r(σmax)."""
    values = np.array([0.01, 0.3, peak])
    found = feasible.albedo_range(values, "two-bounce")
    largest = reading.sigma_max(peak)
    assert found.sigma_min == 0
    assert found.sigma_max == pytest.approx(float(largest), abs=1e-9)
    np.testing.assert_allclose(found.lowest, values, rtol=1e-15)
    expected = reading.to_albedo(values, largest)
    np.testing.assert_allclose(found.highest, expected, rtol=1e-8)
    assert found.highest[-1] == pytest.approx(1, abs=1e-8)


def test_dark_readings_leave_every_roughness_open():
    found = feasible.albedo_range([0.1, 0.72], "two-bounce")
    assert found.sigma_max == math.pi / 2
    # f1 ρ + f2 ρ² = 0.1 with the report's f1 = 0.5590 and f2 = 0.1615.
    root = (-0.5590 + math.sqrt(0.5590**2 + 4 * 0.1615 * 0.1)) / (2 * 0.1615)
    assert found.highest[0] == pytest.approx(root, abs=2e-5)


@settings(max_examples=60, deadline=None)
@given(READINGS, st.sampled_from(QUICK), st.sampled_from(["45a:0", "di:8", "45as110"]))
def test_it_spans_what_a_plain_search_finds(values, model, instrument):
    found = feasible.albedo_range(values, model, instrument)
    rho, sigmas = searched(values, model, instrument)
    if not sigmas.size:
        return  # a roughness between two steps of the search may still fit
    assert (found.lowest <= found.highest).all()
    assert found.sigma_min <= sigmas[0] + 1e-12
    assert found.sigma_max >= sigmas[-1] - 1e-12
    assert found.sigma_max - sigmas[-1] < 2 * SIGMAS[1]
    # What lies between steps of either search.
    assert (found.lowest <= rho.min(axis=0) + 1e-4).all()
    assert (found.highest >= rho.max(axis=0) - 1e-4).all()
    assert (found.highest <= 1 + 1e-7).all()


@settings(max_examples=60, deadline=None)
@given(READINGS, st.sampled_from(QUICK), st.floats(0, 1))
def test_the_albedo_behind_a_reading_is_within(albedo, model, share):
    # Of white facets a rounding may be too much, at the one roughness where they read most.
    rho, sigma = np.minimum(albedo, 0.999), share * math.radians(models.find(model).largest_sigma)
    found = feasible.albedo_range(reading.from_albedo(rho, sigma, model), model)
    slack = 1e-4  # between nodes
    assert (found.lowest <= rho + slack).all()
    assert (found.highest >= rho - slack).all()
    assert found.sigma_min <= sigma + 1e-7
    assert found.sigma_max >= sigma - 1e-7


def test_a_rough_white_surface_may_read_more_than_a_level_one():
    """With all bounces: a peak above 1 asks for roughness, and for one that is not too large."""
    for model in ("closure", "reference"):
        found = feasible.albedo_range([0.2, 1.003], model)
        low, high = np.degrees([found.sigma_min, found.sigma_max])
        assert 5 < low < 29 < high
        np.testing.assert_allclose(reading.white_reading([found.sigma_min], model), 1.003)
        assert found.lowest[1] < 1.003


def test_what_no_facet_reflects_fits_no_roughness():
    found = feasible.albedo_range([[0.2, 1.2], [0.2, 0.5], [np.nan, np.nan]], "two-bounce")
    assert np.isnan([found.lowest[[0, 2]], found.highest[[0, 2]]]).all()
    assert np.isnan(found.sigma_max).tolist() == [True, False, True]
    assert found.lowest[1].tolist() == [0.2, 0.5]


def test_bands_without_a_number_stay_so_and_touch_no_other():
    whole = feasible.albedo_range([0.2, 0.8])
    holed = feasible.albedo_range([0.2, np.nan, 0.8])
    assert np.isnan(holed.highest).tolist() == [False, True, False]
    np.testing.assert_array_equal(holed.highest[[0, 2]], whole.highest)


def test_many_spectra_are_as_each_alone():
    values = np.random.default_rng(3).uniform(0, 1, (4, 5, 7)).astype(np.float32)
    together = feasible.albedo_range(values)
    assert together.lowest.shape == (4, 5, 7)
    assert together.sigma_max.shape == (4, 5)
    assert together.lowest.dtype == together.highest.dtype == np.float32
    alone = feasible.albedo_range(values[2, 3])
    np.testing.assert_allclose(together.highest[2, 3], alone.highest, rtol=1e-6)
    np.testing.assert_allclose(together.sigma_max[2, 3], alone.sigma_max, rtol=1e-6)


def test_unknown_names_are_refused():
    for arguments in (("three-bounce",), ("closure", "60:60")):
        with pytest.raises(DomainError):
            feasible.albedo_range([0.5], *arguments)


def test_it_asks_for_all_roughnesses_of_one_reading_at_once(monkeypatch):
    """A bake asks it of each material: one call a roughness took 17 ms, as against 1 ms."""
    asked, to_albedo = [], reading.to_albedo

    def counting(values, sigma, *rest):
        asked.append(np.size(sigma))
        return to_albedo(values, sigma, *rest)

    monkeypatch.setattr(reading, "to_albedo", counting)
    feasible.albedo_range(np.linspace(0.2, 0.6, 31), "surface")
    assert asked == [1, 1, 91]
    # Of many, as many roughnesses at once as stay in the processor's cache.
    asked.clear()
    feasible.albedo_range(np.full((200, 31), 0.5), "surface")
    assert asked[:2] == [200, 200]
    assert sum(asked[2:]) == 91
    assert 1 < max(asked[2:]) * 200 * 31 <= 2**17
