# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Metamerism against colour-science's own index, and pairs made to be metameric."""

import numpy as np
import pytest
from rough_spectra.addon.colorimetry import illuminant_spectra, tristimulus
from rough_spectra.addon.matching import metamerism
from rough_spectra.addon.matching.request import Request
from rough_spectra.addon.matching.scene_view import make_light
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core.color import metamerism as formula

NM = np.arange(400.0, 701.0, 10.0)
SMOOTH = 0.4 + 0.2 * np.sin(NM / 60)


def request(values, sigma=0.0):
    return Request(Sample("A", NM, values, "reading"), sigma)


def metamer(seed=15, light="D65"):
    """A reading of the same XYZ under a light: what is added to it has none there."""
    weights = tristimulus.weights(NM, light)
    other = np.random.default_rng(seed).normal(size=NM.size)
    black = other - weights @ np.linalg.lstsq(weights, other, rcond=None)[0]
    return SMOOTH + 0.15 * black / np.abs(black).max()


def test_index_is_that_of_colour_science():
    science = colour()
    rng = np.random.default_rng(18314)
    white = tristimulus.white("A", 2)
    for _ in range(10):
        first, second, first_there, second_there = rng.uniform(0.05, 0.9, (4, 3))
        expected = science.difference.XYZ_to_metamerism_index(
            *(first_there, second_there, first, second),
            correction="Multiplicative",
            method="CIE 2000",
            illuminant=science.XYZ_to_xy(white),
        )
        found = formula.index((second, first), (second_there, first_there), white)
        assert found == pytest.approx(float(expected), abs=1e-9)


def test_a_metamer_matches_in_one_light_and_not_in_others():
    here, lamp, fluorescent, led = metamerism.compare(request(SMOOTH), request(metamer()))
    assert (here.light, lamp.light, fluorescent.light, led.light) == ("D65", "A", "F11", "LED-B3")
    # What colors of D65 and its white differ by between the tables of 5 and 10 nm.
    assert here.delta_e_00 < 0.01
    assert here.index == pytest.approx(0, abs=1e-9)
    for there in (lamp, fluorescent, led):
        assert there.index > 0.2
        assert there.index == pytest.approx(there.delta_e_00, abs=0.02)


def test_a_darker_one_of_the_same_spectrum_is_no_metamer():
    for light in metamerism.compare(request(SMOOTH), request(0.8 * SMOOTH)):
        assert light.delta_e_00 > 5
        assert light.index == pytest.approx(0, abs=1e-9)


def test_lights_of_a_scene_are_as_illuminants():
    spectrum = illuminant_spectra.planck(2856)
    lamp = make_light("Lamp", "blackbody", spectrum / illuminant_spectra.to_xyz(spectrum)[1], 1.0)
    pair = request(SMOOTH), request(metamer())
    [_, of_scene] = metamerism.compare(*pair, [lamp])
    [_, of_cie] = metamerism.compare(*pair, ["A"])
    assert of_scene.light == "Lamp"
    assert of_scene.index == pytest.approx(of_cie.index, abs=0.02)


def test_roughness_alone_hardly_is_metamerism():
    """Light between facets changes the color, and the reading of each is its own."""
    found = metamerism.compare(request(SMOOTH), request(SMOOTH, 0.5))
    assert max(each.delta_e_00 for each in found) < 1e-6  # both are readings: printed as they are
