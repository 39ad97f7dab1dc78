# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with a spectrum is named; what is nearly wrong is not."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.matching import solve
from rough_spectra.addon.samples import presets, quality, readers
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core.color import color_difference

from tests import pace

NIX = sorted((Path(__file__).parents[1] / "fixtures" / "nix").glob("*.csv"))


@pytest.mark.parametrize("path", NIX, ids=lambda path: path.stem)
def test_device_lab_agrees_under_the_files_own_light(path, monkeypatch):
    # 0.02: the files print nine digits; what is left is the interpolation of the weights.
    monkeypatch.setattr(quality, "DISAGREEMENT", 0.02)
    (sample,) = readers.read(path)
    assert quality.check([sample]) == [()]


def test_brick_only_seems_to_disagree_when_its_light_is_ignored():
    (brick,) = readers.read(next(path for path in NIX if path.stem == "brick"))
    assert (brick.illuminant, brick.observer) == ("D50", 2)
    misread = replace(brick, illuminant="D65", observer=10)
    [[sentence]] = quality.check([misread])
    assert round(float(re.search(r"ΔE00 ([\d.]+)", sentence)[1]), 1) == 1.7


def test_contradiction_reaches_the_user_with_the_solution():
    (sample,) = readers.read(NIX[0])
    lightness, a, b = sample.lab
    wrong = replace(sample, lab=(lightness, a + 5, b))
    (solution,) = solve.solve([solve.Request(wrong, math.radians(10))], working_space.current())
    assert any("differs from its own spectrum" in warning for warning in solution.warnings)
    (solution,) = solve.solve([solve.Request(sample, math.radians(10))], working_space.current())
    assert not any("own spectrum" in warning for warning in solution.warnings)


def test_without_a_stated_light_nothing_is_claimed():
    (sample,) = readers.read(NIX[0])
    lightness, a, b = sample.lab
    wrong = replace(sample, lab=(lightness, a + 5, b), xyz=None)
    assert quality.check([wrong]) != [()]
    assert quality.check([replace(wrong, illuminant="")]) == [()]
    assert quality.check([replace(wrong, lab=None)]) == [()]


NM = np.arange(400.0, 701.0, 10.0)
SMOOTH = 0.4 + 0.2 * np.sin(NM / 60)


def sentences(values=SMOOTH, nm=NM, kind="reading", **fields):
    return quality.check([Sample("it", nm, values, kind, **fields)])[0]


def changed(values, band, value):
    values = np.array(values)
    values[band] = value
    return values


def test_a_plain_reading_gets_no_sentence():
    assert sentences() == ()


def test_presets_get_no_sentence():
    everything = presets.load_all()
    assert [s for s in quality.check(everything) if s] == []


def shifted(delta_e):
    """The Lab of the smooth spectrum, made lighter by about this ΔE00."""
    lab = tristimulus.spectrum_to_lab(SMOOTH, NM, "D50", 2)
    other = lab
    while color_difference.delta_e(lab, other) < delta_e:
        other = other + np.array([0.001, 0, 0])
    return other


@pytest.mark.parametrize(("delta_e", "count"), [(0.49, 0), (0.51, 1)])
def test_own_lab_or_xyz_above_the_limit_is_a_contradiction(delta_e, count):
    light = {"illuminant": "D50", "observer": 2}
    lab = shifted(delta_e)
    found = sentences(lab=tuple(lab), **light)
    assert len(found) == count
    # XYZ by hand: Y from L* alone, X and Z from it and a*, b*, CIE 15:2018 eq. 8.3 inverted.
    white = tristimulus.white("D50", 2)
    fy = (lab[0] + 16) / 116
    xyz = white * np.array([fy + lab[1] / 500, fy, fy - lab[2] / 200]) ** 3
    found = sentences(xyz=tuple(xyz), **light)
    assert len(found) == count
    assert all("has XYZ in its file" in sentence for sentence in found)


def test_a_lab_under_no_known_light_or_of_too_few_bands_is_not_compared():
    assert sentences(lab=(1.0, 2.0, 3.0), illuminant="Shop", observer=2) == ()
    short = sentences(SMOOTH[:9], NM[:9], lab=(1.0, 2.0, 3.0), illuminant="D50", observer=2)
    assert len(short) == 1
    assert "unmeasured" in short[0]


def test_above_white_is_fluorescence_or_gloss():
    assert sentences(changed(SMOOTH, 4, 1.0)) == ()
    (sentence,) = sentences(changed(SMOOTH, 4, 1.03))
    assert "'it' reads 1.03 at 440 nm, more than white" in sentence
    nm = np.append(NM, 1000.0)
    assert sentences(np.append(SMOOTH, 1.5), nm) == ()  # no color sees it
    (sentence,) = sentences(changed(SMOOTH, 4, 1.03), kind="albedo")
    assert "counts as 1" in sentence


def test_noise_below_zero_is_named_with_its_depth():
    assert sentences(changed(SMOOTH, 2, 0.0)) == ()
    (sentence,) = sentences(changed(changed(SMOOTH, 2, -0.002), 3, -0.001))
    assert "below 0 in 2 bands, down to -0.002 at 420 nm" in sentence
    assert "counts as 0" in sentence


def test_a_curve_cut_off_at_its_top_is_saturation():
    peak = 0.9 + 0.2 * np.exp(-(((NM - 550) / 40) ** 2))

    def saturated(values, **fields):
        return [s for s in sentences(values, **fields) if "stays at exactly" in s]

    assert saturated(np.minimum(peak, 1.0)) != []
    assert saturated(np.minimum(peak, 1.0), kind="albedo") != []
    assert saturated(np.minimum(peak, 0.98)) == []  # flat below white: a sample may be so
    assert saturated(peak) == []
    two = changed(changed(np.minimum(peak, 1.2), 15, 1.2), 16, 1.2)
    assert saturated(two) == []
    assert saturated(changed(two, 17, 1.2)) != []
    for digits in (2, 3, 4):  # a smooth top, level only because the table is rounded
        gentle = 1.01 - 1e-6 * (NM - 560) ** 2
        assert saturated(np.round(gentle, digits)) == []
    assert sentences(np.ones(NM.size), kind="albedo") == ()  # a perfect white by definition


@pytest.mark.parametrize(
    ("left_out", "word"), [([14], ""), ([14, 15], "gap from 530 to 560 nm"), ([30], "")]
)
def test_bands_left_out_of_the_grid_are_a_gap(left_out, word):
    nm = np.delete(np.append(NM, [710.0]), left_out)
    found = sentences(np.full(nm.size, 0.3), nm)
    assert len(found) == bool(word)
    assert all(word in sentence for sentence in found)


def test_a_gap_too_narrow_to_matter_is_not_named():
    fine = np.arange(380.0, 781.0)
    assert sentences(np.full(397, 0.3), np.delete(fine, range(100, 104))) == ()
    (sentence,) = sentences(np.full(395, 0.3), np.delete(fine, range(100, 106)))
    assert "gap from 479 to 486 nm" in sentence


@pytest.mark.parametrize(("step", "count"), [(20.0, 0), (25.0, 1)])
def test_steps_that_are_too_coarse(step, count):
    nm = np.arange(400.0, 701.0, step)
    found = sentences(np.full(nm.size, 0.3), nm)
    assert len(found) == count
    assert all("follows from interpolation" in sentence for sentence in found)


@pytest.mark.parametrize("step", [1, 2, 5, 10, 20, 40])
@pytest.mark.parametrize("bands", [2, 3, 4, 5, 6, 7])
def test_few_bands_on_any_grid_are_a_sentence_and_no_failure(step, bands):
    for start in (340, 380, 500, 700, 770):
        nm = start + step * np.arange(float(bands))
        light = {"lab": (50.0, 0.0, 0.0), "illuminant": "D50", "observer": 2}
        found = sentences(np.full(bands, 0.3), nm, **light)
        assert any("no material can be made" in sentence for sentence in found)


def test_a_range_that_is_too_short():
    inner = slice(1, -1)
    (sentence,) = sentences(SMOOTH[inner], NM[inner])
    assert "covers 410 to 690 nm and not all of 400 to 700 nm; the end values are held" in sentence
    assert sentences(nm=np.append(400.4, NM[1:])) == ()
    (sentence,) = sentences(nm=NM + 60)
    assert "no material can be made" in sentence


@pytest.mark.parametrize("kind", ["reading", "albedo"])
@pytest.mark.parametrize("nm", [NM + 1000, NM / 2 - 1])
def test_what_the_eye_does_not_see_has_no_color(kind, nm):
    (sentence,) = sentences(nm=nm, kind=kind)
    assert f"covers {nm[0]:g} to {nm[-1]:g} nm, where the eye sees nothing" in sentence
    assert "it has no color" in sentence
    assert "it serves for emissivity" in sentence


def test_an_emissivity_has_no_color_and_its_noise_is_named():
    nm = NM * 20
    assert len(sentences(SMOOTH, nm, kind="emissivity")) == 1
    noisy = changed(changed(SMOOTH, 2, 1.002), 7, -0.01)
    color, above, below = sentences(noisy, nm, kind="emissivity")
    assert "holds emissivity, of 8000 to 14000 nm: it has no color" in color
    assert "is above 1 in one band, 1.002 at 8400 nm" in above
    assert above.endswith("counts as 1 in computing.")
    assert "is below 0 in one band, -0.01" in below
    assert below.endswith("counts as 0 in computing.")
    # Also where its bands are visible, and beside readings with the same bands.
    one = Sample("Warm", NM, SMOOTH, "emissivity")
    other = Sample("White", NM, changed(SMOOTH, 2, 1.002), "albedo")
    (of_warm,), (of_white,) = quality.check([one, other])
    assert "has no color" in of_warm
    assert "has an albedo of 1.002" in of_white


def test_specular_light_in_the_reading():
    (sentence,) = sentences(specular="SCI")
    assert "use the SCE reading" in sentence
    assert sentences(specular="SCE") == ()


@pytest.mark.parametrize(("excess", "named"), [(0.009, False), (0.012, True)])
def test_fluorescence_between_two_conditions_names_both_samples(excess, named):
    def sample(name, condition, values, nm=NM):
        return Sample(name, nm, values, "reading", condition=condition)

    brighter = changed(SMOOTH, 4, SMOOTH[4] + excess)
    found = quality.check(
        [
            sample("paper", "M0", SMOOTH),
            sample("other", "M1", SMOOTH + 0.2),
            sample("paper", "M1", brighter),
            sample("third", "", SMOOTH - 0.1),
        ]
    )
    assert [bool(each) for each in found] == [named, False, named, False]
    if named:
        assert found[0] == found[2]
        assert "'paper' differs by 0.012 at 440 nm between M0 and M1" in found[0][0]
    told_apart = [sample("paper (M0)", "M0", SMOOTH), sample("paper (M1)", "M1", brighter)]
    assert [bool(each) for each in quality.check(told_apart)] == [named, named]
    finer = np.arange(380.0, 731.0, 5.0)
    either = sample("paper", "M1", np.interp(finer, NM, brighter), finer)
    assert bool(quality.check([sample("paper", "M2", SMOOTH), either])[0]) is named


def test_ten_thousand_samples_are_judged_in_one_go():
    values = np.random.default_rng(1).uniform(0.2, 0.6, (10_000, NM.size))
    lab = tristimulus.spectrum_to_lab(values, NM, "D50", 2)
    samples = [
        Sample(
            str(i // 2), NM, values[i], "reading", illuminant="D50", observer=2, lab=tuple(lab[i])
        )
        for i in range(len(values))
    ]
    # Seen: 5 paces; one by one it would be far more.
    with pace.at_most(100):
        assert not any(quality.check(samples))
