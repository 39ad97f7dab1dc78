# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lobes of other renderers, against their own code written down anew with vectors."""

import numpy as np
import pytest

from core import lobes
from core.color.color_difference import xyz_to_lab
from core.numerics import direction_grid
from tests import their_lobes

COUNT = 300
COLOR = np.array([0.05, 0.4, 0.95])
SQUARE = np.array([[0.41, 0.36, 0.18], [0.21, 0.72, 0.07], [0.02, 0.12, 0.95]])
"""Near to sRGB's; it only has to be a space in which colors differ."""


def directions():
    return direction_grid.hemisphere(COUNT)


@pytest.mark.parametrize(
    ("lobe", "theirs", "roughnesses"),
    [
        (lobes.EON, their_lobes.materialx, (0.0, 0.3, 1.0)),
        (lobes.DISNEY, their_lobes.mitsuba, (0.0, 0.5, 1.0)),
        (lobes.QUALITATIVE, their_lobes.luxcore, (0.0, 0.4, 1.2)),
        (lobes.LAMBERT, their_lobes.lambert, (0.0,)),
    ],
)
def test_a_lobe_is_what_the_renderer_computes(lobe, theirs, roughnesses):
    angles = directions()
    for roughness in roughnesses:
        ours = lobe.reflectance(COLOR, np.full(COUNT, roughness), *angles)
        np.testing.assert_allclose(ours, theirs(COLOR, roughness, angles), rtol=1e-9)


@pytest.mark.parametrize("lobe", lobes.ALL, ids=lambda lobe: lobe.name)
@pytest.mark.parametrize("instrument", ["45a:0", "di:8"])
def test_a_color_reads_what_it_was_made_for(lobe, instrument):
    terms = lobe.at(lobe.largest / 2, instrument)
    color = lobes.color_for(COLOR / 2, terms)
    np.testing.assert_allclose(lobes.reflected(color, terms), COLOR / 2, rtol=1e-12)


def test_an_instrument_reads_the_mean_of_its_directions():
    """A sphere all around reads a white EON of any roughness as white: no energy is lost."""
    for roughness in (0.2, 1.0):
        read = lobes.reflected(np.ones(1), lobes.EON.at(roughness, "di:8"))
        assert read[0] == pytest.approx(1, abs=0.002)


def perceive(rgb):
    return xyz_to_lab(np.maximum(rgb, 0) @ SQUARE.T, SQUARE.sum(axis=1))


@pytest.mark.parametrize("lobe", lobes.ALL, ids=lambda lobe: lobe.name)
def test_a_match_finds_its_own_color_and_roughness(lobe):
    angles = direction_grid.hemisphere(32)
    made = 0.6 * min(lobe.largest, 1.0)
    color = COLOR / 2
    read = lobes.reflected(color, lobe.at(made, "45a:0"))
    targets = lobe.reflectance(color, np.full(32, made), *angles)
    found, roughness = lobes.match(lobe, read, targets, angles, perceive)
    np.testing.assert_allclose(found, color, atol=0.002)
    assert roughness == pytest.approx(made, abs=0.005)


def test_no_roughness_is_taken_that_a_bright_color_cannot_have():
    """The qualitative model darkens: beside σ = 0.5 white paper would need a color above 1."""
    angles = direction_grid.hemisphere(32)
    read = np.full(3, 0.9)
    targets = lobes.QUALITATIVE.reflectance(read / 0.78, np.full(32, 0.5), *angles)
    color, roughness = lobes.match(lobes.QUALITATIVE, read, targets, angles, perceive)
    assert 0 < roughness < 0.5
    assert color.max() <= 1
    terms = lobes.QUALITATIVE.at(roughness, "45a:0")
    np.testing.assert_allclose(lobes.reflected(color, terms), read, rtol=1e-12)
