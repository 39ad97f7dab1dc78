# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lobes of other renderers, against their own code written down anew with vectors.

MaterialX: libraries/pbrlib/genglsl/lib/mx_microfacet_diffuse.glsl of 1.39. Mitsuba 3:
src/bsdfs/principled.cpp. LuxCore: src/slg/materials/roughmatte.cpp. tools/checks/check_exports.py
holds them to the renderers themselves.
"""

import numpy as np
import pytest

from core import lobes
from core.color.color_difference import xyz_to_lab
from core.numerics import direction_grid

COUNT = 300
COLOR = np.array([0.05, 0.4, 0.95])
SQUARE = np.array([[0.41, 0.36, 0.18], [0.21, 0.72, 0.07], [0.02, 0.12, 0.95]])
"""Near to sRGB's; it only has to be a space in which colors differ."""


def directions():
    return direction_grid.hemisphere(COUNT)


def vectors(light, view, azimuth):
    """Unit vectors to light and view, shape (3, n); the normal is z."""
    zero = np.zeros_like(light)
    to_light = np.array([np.sin(light) * np.cos(azimuth), np.sin(light) * np.sin(azimuth), zero])
    to_light[2] = np.cos(light)
    return to_light, np.array([np.sin(view), zero, np.cos(view)])


def materialx(color, roughness, angles):
    to_light, to_view = vectors(*angles)
    n_l, n_v, l_v = to_light[2], to_view[2], (to_light * to_view).sum(axis=0)
    one, two = 0.5 - 2 / (3 * np.pi), 2 / 3 - 28 / (15 * np.pi)
    s = l_v - n_l * n_v
    stinv = np.where(s > 0, s / np.maximum(n_l, n_v), s)
    a = 1 / (1 + one * roughness)

    def albedo(cos):
        sin = np.sqrt(1 - cos * cos)
        g = sin * (np.arccos(cos) - sin * cos) + 2 * (sin / cos * (1 - sin**3) - sin) / 3
        return a + roughness * a * g / np.pi

    mean = a * (1 + two * roughness)
    c = color[:, np.newaxis]
    again = c * c * mean / (1 - c * (1 - mean))
    lost = (1 - albedo(n_v)) * (1 - albedo(n_l)) / (1 - mean) if roughness else 0
    return (c * a * (1 + roughness * stinv) + again * lost).T


def mitsuba(color, roughness, angles):
    to_light, to_view = vectors(*angles)
    half = to_light + to_view
    half /= np.linalg.norm(half, axis=0)
    cos_d = (half * to_light).sum(axis=0)
    at_light, at_view = (1 - to_light[2]) ** 5, (1 - to_view[2]) ** 5
    plain = (1 - 0.5 * at_light) * (1 - 0.5 * at_view)
    rr = 2 * roughness * cos_d**2
    retro = rr * (at_view + at_light + at_view * at_light * (rr - 1))
    return (color[:, np.newaxis] * (plain + retro)).T


def luxcore(color, sigma, angles):
    to_light, to_view = vectors(*angles)
    a = 1 - sigma**2 / (2 * (sigma**2 + 0.33))
    b = 0.45 * sigma**2 / (sigma**2 + 0.09)
    sin_i, sin_o = (np.hypot(*each[:2]) for each in (to_light, to_view))
    cosine = (to_light[:2] * to_view[:2]).sum(axis=0) / (sin_i * sin_o)
    steeper = to_light[2] < to_view[2]
    sin_alpha = np.where(steeper, sin_i, sin_o)
    tan_beta = np.where(steeper, sin_o / to_view[2], sin_i / to_light[2])
    return (color[:, np.newaxis] * (a + b * np.maximum(0, cosine) * sin_alpha * tan_beta)).T


@pytest.mark.parametrize(
    ("lobe", "theirs", "roughnesses"),
    [
        (lobes.EON, materialx, (0.0, 0.3, 1.0)),
        (lobes.DISNEY, mitsuba, (0.0, 0.5, 1.0)),
        (lobes.QUALITATIVE, luxcore, (0.0, 0.4, 1.2)),
        (lobes.LAMBERT, lambda color, _, angles: np.tile(color, (angles[0].size, 1)), (0.0,)),
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
