# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every check of this folder raises when the remedy is taken out.

Each entry runs the check that a test of test_stability.py runs on the core, on a form without the
remedy. A check that lets such a form pass would protect nothing.
"""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, settings

from core import oren_nayar, reading, vcavity
from tests.stability import checks, test_stability, textbook

PAGE = Path(__file__).resolve().parents[2] / "docs" / "stability.md"


def first_order_white(albedo, sigma):
    return reading.from_albedo(albedo, sigma, "first-order")


WITHOUT_REMEDY = {
    "test_albedo_survives_a_vanishing_roughness": [
        lambda: checks.check_small_roughness(textbook.root),
    ],
    "test_denormal_readings_and_roughness": [lambda: checks.check_denormals(textbook.root)],
    "test_factors_are_exact_below_grazing": [
        # 0.57 belongs to the paper's qualitative model.
        lambda: checks.check_geometry(textbook.factors_with_qualitative_constant),
    ],
    "test_grazing_stays_positive_and_finite": [lambda: checks.check_grazing(textbook.factors)],
    "test_float32_right_angle_is_an_angle": [
        lambda: checks.check_right_angle(textbook.factors_refusing_rounding),
    ],
    "test_grazing_away_from_the_light": [lambda: checks.check_grazing_away(textbook.factors)],
    "test_azimuth_along_the_normal": [
        lambda: checks.check_normal(textbook.factors_from_vectors),
    ],
    "test_azimuth_at_the_branch": [
        lambda: checks.check_right_azimuth(textbook.factors_branching_on_angle),
    ],
    "test_reference_and_cycles_are_never_negative": [
        lambda: checks.check_not_negative(oren_nayar.reflectance),
    ],
    "test_published_model_is_left_as_published": [
        lambda: checks.check_left_as_published(textbook.clipped_reflectance),
    ],
    "test_matching_asks_for_nothing_negative": [
        lambda: checks.check_targets(
            textbook.targets(0.05, checks.opposite_geometries(), np.radians(70.0))
        ),
    ],
    "test_white_furnace_of_reference_and_cycles": [
        lambda: checks.check_energy(oren_nayar.reflectance, np.radians(10.0)),
    ],
    "test_no_bounce_is_cut_off_at_white": [
        lambda: checks.check_white(textbook.cut_series, np.radians([50.0])),
    ],
    "test_closure_at_white_as_roughness_vanishes": [
        lambda: checks.check_white_limit(textbook.closure),
    ],
    "test_white_beyond_50_degrees": [
        lambda: checks.check_white(reading.from_albedo, np.radians([60.0])),
        lambda: checks.check_white(first_order_white, np.radians([60.0])),
    ],
    "test_gaussian_slopes_as_roughness_vanishes": [
        lambda: checks.check_shallow(textbook.gaussian_slopes),
    ],
    "test_gaussian_slopes_become_slots": [
        lambda: checks.check_slots(textbook.drawn_slopes),
        lambda: checks.check_slots(textbook.extrapolated_slopes),
    ],
    "test_degrees_are_refused": [lambda: checks.check_unit(textbook.coefficients_of_anything)],
    "test_readings_above_white_are_kept": [
        lambda: checks.check_infeasible(textbook.clipped_root),
    ],
    "test_sigma_max_near_white": [lambda: checks.check_sigma_max(textbook.sigma_max)],
    "test_noise_below_black_averages_out": [
        lambda: checks.check_noise(textbook.clipped_root),
        lambda: checks.check_noise(textbook.root_of_clipped),
    ],
    "test_socket_colors_out_of_range_come_back": [
        lambda: checks.check_color_noise(
            textbook.color_of_clipped, test_stability.cycles.reflectance
        ),
    ],
    "test_readings_far_below_black": [
        lambda: checks.check_far_below_black(textbook.root_with_warnings),
    ],
    "test_nan_and_infinity_stay_in_their_band": [
        lambda: checks.check_bad_band(textbook.reading_with_warnings),
        lambda: checks.check_bad_band(textbook.root_without_nan),
    ],
    "test_nan_angles_stay_nan": [
        lambda: checks.check_bad_angle(textbook.factors_ignoring_nan),
    ],
    "test_nan_reaches_no_other_wavelength": [
        lambda: checks.check_bad_neighbor(textbook.resample),
    ],
    "test_cycles_lobe_without_roughness": [
        lambda: checks.check_cycles_smooth(textbook.cycles_reflectance),
    ],
    "test_cycles_lobe_at_grazing": [
        lambda: checks.check_cycles_grazing(textbook.cycles_reflectance),
    ],
}

CASES = [
    pytest.param(run, id=f"{name.removeprefix('test_')}-{i}")
    for name, runs in WITHOUT_REMEDY.items()
    for i, run in enumerate(runs)
]


@pytest.fixture
def _without_shrinking(monkeypatch):
    """A counterexample is wanted, not the smallest one."""
    for name in ("repeatable", "few"):
        short = settings(getattr(checks, name), phases=[Phase.explicit, Phase.generate])
        monkeypatch.setattr(checks, name, short)


@pytest.mark.usefixtures("_without_shrinking")
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("run", CASES)
def test_without_the_remedy_the_same_check_fails(run):
    with pytest.raises(AssertionError):
        run()


def test_every_stability_test_has_a_counterpart_without_its_remedy():
    tests = {name for name in vars(test_stability) if name.startswith("test_")}
    assert tests == set(WITHOUT_REMEDY)


def test_the_page_names_every_test_and_no_other():
    named = set(re.findall(r"`(test_\w+)`", PAGE.read_text(encoding="utf-8")))
    assert named == set(WITHOUT_REMEDY)


def test_the_page_shows_every_figure_and_no_other():
    shown = set(re.findall(r"images/(stability-[\w-]+)\.svg", PAGE.read_text(encoding="utf-8")))
    drawn = {path.stem for path in (PAGE.parent / "images").glob("stability-*.svg")}
    assert shown == drawn
    assert drawn == {path.stem for path in (PAGE.parent / "images").glob("stability-*.png")}


def test_reference_series_cut_at_16_bounces_is_what_the_core_returns_by_that_name():
    """The cut form of the figure is the core's own coefficients, so only the cut differs."""
    assert textbook.cut_series(np.full(1, 0.1), 0.5) == pytest.approx(
        vcavity.reading_from_albedo(np.full(1, 0.1), 0.5, slopes="oren-nayar"), rel=1e-6
    )
