# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ from readings: found back, with an interval that keeps its promise, or said to be unknown."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from core import estimate, ladder, reading
from core.errors import DomainError
from core.estimate import Reading, models_of_sigma

ROOT = Path(__file__).parents[2]
ALBEDO = 0.15 + 0.6 * np.exp(-(((np.linspace(0, 1, 16) - 0.6) / 0.2) ** 2))
"""An orange: from .15 to .75."""

MULTI_ANGLE = ("45as15", "45as25", "45as45", "45as75", "45as110")
LAWS = ("reference", *models_of_sigma.OTHER_LAWS)
"""The V-cavity with each slope law."""

NEAR_RADIANS = math.radians(0.01)


def patch(number):
    """Give every fifth band of a ColorChecker patch: 20 nm steps."""
    [path] = ROOT.glob(f"presets/colorchecker/{number:02d}-*.json")
    return np.array(json.loads(path.read_text(encoding="utf-8"))["values"])[::5]


def pair(albedo, degrees, model=estimate.MODEL, material="", instrument="45a:0"):
    rough = models_of_sigma.predict(albedo, np.array(math.radians(degrees)), model, instrument)
    return [
        Reading(albedo, rough=False, material=material),
        Reading(rough, instrument=instrument, material=material),
    ]


def noisy(readings, count, seed=0):
    """Draw readings with the noise that they state."""
    values = np.array([reading.values for reading in readings])
    random = np.random.default_rng(seed).standard_normal((count, *values.shape))
    return values + estimate.repeatability(values) * random


def one_draw(readings, seed=0):
    """Give the readings as measured once."""
    drawn = noisy(readings, 1, seed)[0]
    return [
        Reading(values, of.rough, of.instrument, of.material)
        for of, values in zip(readings, drawn, strict=True)
    ]


@pytest.mark.parametrize("model", ["first-order", *estimate.SPREAD])
@pytest.mark.parametrize("degrees", [5, 15, 30, 45])
def test_a_pair_gives_back_its_roughness_in_every_model(model, degrees):
    found = estimate.sigma(pair(ALBEDO, degrees, model), model, others=())
    assert math.degrees(found.sigma) == pytest.approx(degrees, abs=0.01)
    assert found.is_told
    np.testing.assert_allclose(found.albedo[""], ALBEDO, atol=1e-6)
    assert np.abs(found.residuals).max() < 1e-6


@pytest.mark.parametrize("instrument", ["di:8", "0:45a", "45as25", "45x:0-iso"])
def test_a_pair_is_read_by_any_instrument(instrument):
    found = estimate.sigma(pair(ALBEDO, 25, instrument=instrument), others=())
    assert found.sigma == pytest.approx(math.radians(25), abs=NEAR_RADIANS)


@pytest.mark.parametrize("degrees", [15, 30, 45])
def test_several_angles_tell_roughness_and_albedo_without_a_smooth_reading(degrees):
    readings = [
        Reading(
            reading.from_albedo(ALBEDO, math.radians(degrees), estimate.MODEL, instrument),
            instrument=instrument,
        )
        for instrument in MULTI_ANGLE
    ]
    found = estimate.sigma(readings, others=())
    assert found.sigma == pytest.approx(math.radians(degrees), abs=NEAR_RADIANS)
    np.testing.assert_allclose(found.albedo[""], ALBEDO, atol=1e-4)
    assert found.freedom == 4 * ALBEDO.size - 1


def test_angles_of_a_goniometer_do_so_too():
    sigma = math.radians(30)
    angles = [(0.8, view, azimuth) for view in (0.2, 0.9) for azimuth in (0.0, 3.0)]
    readings = [
        Reading(ladder.reflectance(estimate.MODEL, ALBEDO, *where, sigma), instrument=where)
        for where in angles
    ]
    found = estimate.sigma(readings, others=())
    assert found.sigma == pytest.approx(sigma, abs=NEAR_RADIANS)


def test_several_albedos_share_one_roughness():
    albedos = {str(level): np.full(16, level) for level in (0.2, 0.5, 0.9)}
    readings = [of for name, albedo in albedos.items() for of in pair(albedo, 30, material=name)]
    together = estimate.sigma(one_draw(readings), others=())
    alone = [estimate.sigma(one_draw(readings[k : k + 2]), others=()) for k in (0, 2, 4)]
    assert together.sigma == pytest.approx(math.radians(30), abs=math.radians(0.2))
    # Information adds up: 1 over the variance is the sum of those of the pairs.
    added = sum(each.standard_error**-2 for each in alone) ** -0.5
    assert together.standard_error == pytest.approx(added, rel=0.04)
    for name, albedo in albedos.items():
        np.testing.assert_allclose(together.albedo[name], albedo, atol=5e-3)


@pytest.mark.parametrize("level", [0.2, 0.5, 0.9])
@pytest.mark.parametrize("degrees", [15, 30, 45])
def test_a_gray_from_dark_to_bright_tells(level, degrees):
    found = estimate.sigma(one_draw(pair(np.full(31, level), degrees)), others=())
    assert math.degrees(found.sigma) == pytest.approx(degrees, abs=1.5)


@pytest.mark.parametrize("degrees", [3, 15, 30, 45])
@pytest.mark.parametrize("number", [2, 13, 22])
def test_the_interval_holds_the_truth_as_often_as_it_says(number, degrees):
    readings = pair(patch(number), degrees)
    found, interval = estimate.of_draws(readings, noisy(readings, 400, seed=number))
    truth = math.radians(degrees)
    held = np.mean((interval[:, 0] <= truth) & (truth <= interval[:, 1]))
    # Of 400 draws the share scatters by 1.1 %: three times that.
    assert abs(held - estimate.CONFIDENCE) < 0.033
    if degrees >= 15:
        assert np.quantile(np.abs(found - truth), 0.95) < math.radians(0.3)


def test_the_interval_of_a_smooth_surface_begins_at_0():
    readings = pair(patch(22), 0)
    found, interval = estimate.of_draws(readings, noisy(readings, 400))
    assert (interval[:, 0] == 0).mean() == pytest.approx(0.975, abs=0.024)
    assert (found == 0).mean() == pytest.approx(0.5, abs=0.08)  # the other half is brighter
    assert interval[:, 1].max() < math.radians(5)


def test_the_interval_is_the_likelihoods_own():
    """χ² at its ends, computed here by a scan over albedos, is 3.84 above the least."""
    readings = one_draw(pair(ALBEDO[:2], 12, "two-bounce"))
    found = estimate.sigma(readings, "two-bounce", others=())
    scan = np.linspace(0.1, 0.4, 60001)

    def chi_square(sigma):
        f1, f2 = reading.coefficients(sigma)
        smooth, rough = (np.asarray(of.values) for of in readings)
        total = 0.0
        for band in range(2):
            of_smooth = (smooth[band] - scan) / estimate.repeatability(smooth[band])
            of_rough = (rough[band] - f1 * scan - f2 * scan**2) / estimate.repeatability(
                rough[band]
            )
            total += np.min(of_smooth**2 + of_rough**2)
        return total

    least = chi_square(found.sigma)
    assert least == pytest.approx(found.chi_square, abs=1e-3)
    for end in found.interval:
        assert chi_square(end) - least == pytest.approx(1.96**2, abs=0.01)


def test_the_standard_error_is_what_draws_scatter_by():
    readings = pair(patch(13), 30)
    found, _ = estimate.of_draws(readings, noisy(readings, 500))
    expected = estimate.sigma(readings, others=()).standard_error
    assert np.std(found) == pytest.approx(expected, rel=0.1)


def test_draws_are_what_one_at_a_time_gives():
    readings = pair(ALBEDO, 20)
    draws = noisy(readings, 3)
    found, interval = estimate.of_draws(readings, draws)
    for k, drawn in enumerate(draws):
        single = estimate.sigma(
            [
                Reading(values, of.rough, deviation=estimate.repeatability(of.values))
                for of, values in zip(readings, drawn, strict=True)
            ],
            others=(),
        )
        assert single.sigma == pytest.approx(found[k], abs=1e-9)
        assert single.interval == pytest.approx(interval[k], abs=1e-9)


def test_what_models_leave_open_is_told_apart_from_noise():
    found = estimate.sigma(one_draw(pair(ALBEDO, 20, "reference")), "closure")
    assert set(found.by_model) == set(estimate.SPREAD)
    low, high = found.spread
    assert math.degrees(high - low) > 2  # two bounces lose light, and take less σ for it
    assert np.diff(found.interval)[0] < math.radians(1)
    assert found.by_model["closure"] == found.sigma
    assert math.degrees(abs(np.subtract(*(found.by_model[law] for law in LAWS)))) > 1
    assert found.by_model["reference"] == pytest.approx(math.radians(20), abs=math.radians(0.2))


CANNOT = {
    "one reading": [Reading(ALBEDO)],
    "another material": [Reading(ALBEDO, False, material="a"), Reading(ALBEDO, material="b")],
    "white": pair(np.ones(16), 30),
    "nearly white": pair(np.full(16, 0.985), 15),
    "black": pair(np.zeros(16), 30),
    "one angle twice": [Reading(ALBEDO), Reading(ALBEDO)],
}
CAUSES = {
    "one reading": "from one reading",
    "another material": "share no material and band",
    "white": "white reads the same",
    "black": "black reads the same",
    "one angle twice": "an albedo explains as well",
}
for _degrees in (0, 15, 30, 45):
    CANNOT[f"45°/0° and sphere at {_degrees}°"] = [
        Reading(
            reading.from_albedo(ALBEDO, math.radians(_degrees), estimate.MODEL, name),
            instrument=name,
        )
        for name in ("45a:0", "di:8")
    ]


@pytest.mark.parametrize("model", [estimate.MODEL, "two-bounce"])
@pytest.mark.parametrize("case", CANNOT)
def test_what_cannot_be_told_is_not_told(case, model):
    for seed in range(3):
        found = estimate.sigma(one_draw(CANNOT[case], seed), model, others=())
        assert not found.is_told
        assert math.isnan(found.sigma)
        assert found.reason.startswith("σ can't be told")
        # To another model than the readings' own, white may as well be too bright.
        assert CAUSES.get(case, "") in found.reason or model != estimate.MODEL
        assert found.reason.endswith(".")
        low, high = found.interval
        assert high - low >= estimate.TOO_OPEN or "brighter" in found.reason


def test_with_the_smooth_reading_45_0_and_a_sphere_do_tell():
    case = [Reading(ALBEDO, rough=False), *CANNOT["45°/0° and sphere at 30°"]]
    found = estimate.sigma(one_draw(case), others=())
    assert found.sigma == pytest.approx(math.radians(30), abs=math.radians(0.2))


def test_two_bounces_take_whites_loss_for_roughness_and_are_not_believed():
    """The published model loses light even of white: its own information is no evidence."""
    found = estimate.sigma(pair(np.ones(16), 30, "two-bounce"), "two-bounce", others=())
    assert found.standard_error < math.radians(0.1)
    assert not found.is_told


def test_a_rough_reading_as_bright_as_the_smooth_one_is_sigma_0_within_noise():
    found = estimate.sigma([Reading(ALBEDO, rough=False), Reading(ALBEDO)], others=())
    assert found.is_told
    assert found.sigma == 0
    assert found.interval[0] == 0 < found.interval[1] < math.radians(5)
    assert found.reason.startswith("σ = 0 within noise")
    assert math.isinf(found.standard_error)


def test_one_brighter_by_more_than_any_error_contradicts_every_roughness():
    found = estimate.sigma([Reading(ALBEDO, rough=False), Reading(1.04 * ALBEDO)], others=())
    assert not found.is_told
    assert "brighter than the smooth one" in found.reason


def test_readings_of_two_materials_are_not_taken_for_one():
    found = estimate.sigma([Reading(ALBEDO, rough=False), Reading(ALBEDO[::-1] * 0.8)], others=())
    assert not found.is_told
    assert "the wrong sample" in found.reason


def test_one_brighter_by_little_leaves_what_the_model_may_miss():
    found = estimate.sigma([Reading(ALBEDO, rough=False), Reading(1.004 * ALBEDO)], others=())
    assert found.is_told
    assert found.sigma == 0
    assert found.interval[1] > math.radians(3)  # noise alone would leave 0.3°
    assert "times as far from the model" in found.notes[0]


def test_bands_that_say_nothing_are_left_out_and_told():
    smooth, rough = (np.array(of.values) for of in pair(ALBEDO, 30))
    smooth[1], rough[3], rough[5], smooth[7] = np.nan, np.inf, -0.02, 1.02
    found = estimate.sigma(
        [Reading(smooth, rough=False, name="Tile"), Reading(rough, name="Blasted")], others=()
    )
    assert found.sigma == pytest.approx(math.radians(30), abs=NEAR_RADIANS)
    assert found.notes == (
        "Tile: 2 of 16 bands were left out, no number, above white.",
        "Blasted: 2 of 16 bands were left out, no number, below 0 by more than noise.",
    )
    assert np.isnan(found.residuals[0]).tolist() == [k in (1, 7) for k in range(16)]
    assert found.freedom == 16 - 4 - 1
    np.testing.assert_allclose(found.albedo[""], ALBEDO, atol=1e-6)  # from the one that is left


def test_a_saturated_reading_is_left_out_where_it_is_cut():
    bright = np.concatenate((ALBEDO + 0.2, [1.0, 1.0, 1.0, 1.0]))
    readings = pair(bright, 30)
    found = estimate.sigma(readings, others=())
    assert found.notes[0].endswith("4 of 20 bands were left out, saturated.")
    assert found.sigma == pytest.approx(math.radians(30), abs=NEAR_RADIANS)


def test_nothing_but_bad_bands_is_no_reading():
    found = estimate.sigma([Reading(ALBEDO, rough=False), Reading(np.full(16, np.nan))])
    assert not found.is_told
    assert np.isnan(list(found.by_model.values())).all()


@pytest.mark.parametrize(
    ("readings", "words"),
    [
        ([], "None of the readings is of a rough surface"),
        ([Reading(ALBEDO, rough=False)], "None of the readings is of a rough surface"),
        (
            [Reading(ALBEDO), Reading(ALBEDO[1:])],
            "reading 1 has 16 bands and reading 2 15; export both",
        ),
        ([Reading(0.5)], "give one value a band"),
        ([Reading(ALBEDO, wavelengths=[400, 500])], "2 wavelengths and 16 values"),
        (
            [
                Reading(ALBEDO, wavelengths=np.arange(16)),
                Reading(ALBEDO, wavelengths=np.arange(16) * 1.1, name="Sphere"),
            ],
            "Band 2 is 1 nm in reading 1 and 1.1 nm in Sphere; export both",
        ),
        ([Reading(ALBEDO, instrument="46:0")], "Instrument '46:0' is not known"),
        ([Reading(ALBEDO, deviation=0)], "not above 0"),
        ([Reading(ALBEDO, deviation=[0.1, np.nan])], "2 standard deviations and 16"),
        ([Reading(ALBEDO, deviation=np.full(16, np.nan))], "not above 0"),
    ],
)
def test_readings_that_do_not_fit_together_are_refused(readings, words):
    with pytest.raises(DomainError, match=words.replace("(", r"\(")):
        estimate.sigma(readings)


@pytest.mark.parametrize(("model", "words"), [("lambert", "does not know"), ("x", "not known")])
def test_models_without_roughness_are_refused(model, words):
    with pytest.raises(DomainError, match=words):
        estimate.sigma(pair(ALBEDO, 10), model)


def test_a_rougher_surface_than_any_ends_where_thinking_does():
    found = estimate.sigma(pair(ALBEDO, 70, "two-bounce"), "two-bounce", others=())
    assert found.interval[1] == pytest.approx(estimate.LARGEST)
    assert "may be larger" in found.reason
