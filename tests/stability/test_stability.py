# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The core at the places where methods fail; docs/stability.md tells of each."""

from functools import partial

import bpy  # noqa: F401, before mathutils, which comes with it
import numpy as np
import pytest
from rough_spectra.addon.colorimetry.rgb_space import WorkingSpace
from rough_spectra.addon.matching import solve
from rough_spectra.addon.samples.sample import Sample

from core import (
    cycles,
    emissivity,
    estimate,
    models,
    oren_nayar,
    reading,
    vcavity,
)
from core.cycles import matching
from core.numerics import wavelength_grid
from core.vcavity import slope_law
from tests.stability import checks

REC709_FROM_XYZ = np.linalg.inv(
    [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
)


def cycles_lobe(albedo, theta_i, theta_r, delta_phi, sigma):
    """Give Cycles' lobe at half of its roughness in the order of arguments of the models."""
    return cycles.reflectance(albedo, 0.5, theta_i, theta_r, delta_phi)


def within(sigma, model):
    """σ as a share of π/2, of what the model goes to."""
    return sigma * models.find(model).largest_sigma / 90


def closure(albedo, sigma):
    return reading.from_albedo(albedo, sigma, "closure")


def published_slopes(albedo, sigma):
    """Give the reference's reading with the slopes of the published formula."""
    return vcavity.reading_from_albedo(albedo, sigma, slopes="oren-nayar")


def gaussian_slopes(sigma):
    """Give slopes that the reference solves, and their shares of area."""
    return slope_law.nodes(6), slope_law.weights(np.array([sigma], float), 6)[0]


def geometric_series(albedo, sigma):
    """Sum the bounces of the published model with the core's ratio."""
    f1, f2 = reading.coefficients(sigma)
    return albedo * (f1 + f2 * albedo / (1 - reading.bounce_ratio(sigma) * albedo))


def test_albedo_survives_a_vanishing_roughness():
    checks.check_small_roughness(reading.to_albedo)


def test_denormal_readings_and_roughness():
    checks.check_denormals(reading.to_albedo)


def test_factors_are_exact_below_grazing():
    checks.check_geometry(oren_nayar.factors)


def test_grazing_stays_positive_and_finite():
    checks.check_grazing(oren_nayar.factors)


def test_float32_right_angle_is_an_angle():
    checks.check_right_angle(oren_nayar.factors)


def test_grazing_away_from_the_light():
    checks.check_grazing_away(oren_nayar.factors)


def test_azimuth_along_the_normal():
    checks.check_normal(oren_nayar.factors)


def test_azimuth_at_the_branch():
    checks.check_right_azimuth(oren_nayar.factors)


@pytest.mark.parametrize("reflectance", [vcavity.reflectance, cycles_lobe])
def test_reference_and_cycles_are_never_negative(reflectance):
    checks.check_not_negative(reflectance)


def test_published_model_is_left_as_published():
    checks.check_left_as_published(oren_nayar.reflectance)


def targets_of_matching(monkeypatch):
    """Targets that `addon.matching.solve` hands to the match for a dark surface seen steeply."""
    seen = []

    def match(readings, targets, *rest, **keywords):
        seen.append(targets)
        return np.clip(readings, 0, 1), np.zeros(len(readings))

    def hemisphere(count, *_):
        return tuple(np.resize(angle, count) for angle in checks.opposite_geometries())

    monkeypatch.setattr(solve.direction_grid, "hemisphere", hemisphere)
    monkeypatch.setattr(solve.matching, "match", match)
    wavelengths = np.arange(380.0, 731, 10)
    sample = Sample("Soot", wavelengths, np.full(wavelengths.size, 0.05), "albedo")
    request = solve.Request(sample, np.radians(60.0))
    solve.solve([request], WorkingSpace("Linear Rec.709", REC709_FROM_XYZ))
    return seen[0]


def test_matching_asks_for_nothing_negative(monkeypatch):
    checks.check_targets(targets_of_matching(monkeypatch))


@pytest.mark.parametrize("reflectance", [vcavity.reflectance, cycles_lobe])
def test_white_furnace_of_reference_and_cycles(reflectance):
    checks.check_energy(reflectance, np.radians(10.0))


def test_no_bounce_is_cut_off_at_white():
    checks.check_white(published_slopes, np.radians([20.0, 50.0, 90.0]))


@pytest.mark.parametrize("reading_of", [closure, geometric_series])
def test_closure_at_white_as_roughness_vanishes(reading_of):
    checks.check_white_limit(reading_of)


@pytest.mark.parametrize("reading_of", [published_slopes])
def test_white_beyond_50_degrees(reading_of):
    checks.check_white(reading_of, np.radians([50.0, 60.0, 75.0, 90.0]))


def test_gaussian_slopes_as_roughness_vanishes():
    checks.check_shallow(gaussian_slopes)


def test_gaussian_slopes_become_slots():
    checks.check_slots(gaussian_slopes)


def test_degrees_are_refused():
    checks.check_unit(reading.coefficients)


def test_readings_above_white_are_kept():
    checks.check_infeasible(reading.to_albedo)


def test_sigma_max_near_white():
    checks.check_sigma_max(reading.sigma_max)


def test_noise_below_black_averages_out():
    checks.check_noise(reading.to_albedo)


def test_socket_colors_out_of_range_come_back():
    checks.check_color_noise(matching.color_for_reading, cycles.reflectance)


def test_readings_far_below_black():
    checks.check_far_below_black(reading.to_albedo)


@pytest.mark.parametrize(
    "function",
    [
        *(lambda v, s, m=m: reading.from_albedo(v, within(s, m), m) for m in models.NAMES),
        *(lambda v, s, m=m: reading.to_albedo(v, within(s, m), m) for m in models.NAMES),
        lambda v, s: oren_nayar.reflectance(v, 0.7, 0.3, 2.0, s),
        lambda v, s: matching.color_for_reading(v, s / 2),
        lambda v, s: cycles.reflectance(v, s / 2, 0.7, 0.3, 2.0),
    ],
)
def test_nan_and_infinity_stay_in_their_band(function):
    checks.check_bad_band(function)


def test_nan_angles_stay_nan():
    checks.check_bad_angle(oren_nayar.factors)


def test_nan_reaches_no_other_wavelength():
    checks.check_bad_neighbor(wavelength_grid.resample)


def test_cycles_lobe_without_roughness():
    checks.check_cycles_smooth(cycles.reflectance)


def test_cycles_lobe_at_grazing():
    checks.check_cycles_grazing(cycles.reflectance)


@pytest.mark.parametrize("model", list(emissivity.MODELS))
def test_white_facets_emit_nothing(model):
    checks.check_white_emits_nothing(partial(emissivity.directional, model=model))


def test_band_of_a_cold_body():
    checks.check_cold_band(emissivity.band_emissivity)


def test_black_body_at_long_waves():
    checks.check_long_waves(emissivity.radiance)


def estimated(readings):
    return estimate.sigma(readings, others=())


def test_interval_of_a_nearly_smooth_surface():
    checks.check_nearly_smooth(estimated)


@pytest.mark.parametrize("albedo", [np.ones(16), np.zeros(16)])
def test_sigma_of_white_and_of_black_is_not_told(albedo):
    checks.check_not_told(estimated, albedo)


def test_one_reading_has_no_sigma():
    checks.check_one_reading(estimated)


def test_a_rough_reading_brighter_than_the_smooth_one():
    checks.check_brighter_than_smooth(estimated)


def test_a_missing_band_takes_no_sigma_away():
    checks.check_missing_band(estimated)
