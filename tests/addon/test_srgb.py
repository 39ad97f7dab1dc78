# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""sRGB against colour-science's."""

import numpy as np
import pytest
from rough_spectra.addon.colorimetry import srgb, tristimulus
from rough_spectra.addon.samples import swatches
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core.color import color_difference

LINEAR = np.concatenate((np.linspace(0, 0.01, 21), np.linspace(0.01, 1, 40), [1.5]))


def test_curve_is_that_of_colour_science():
    encoded = srgb.encode(LINEAR)
    assert encoded == pytest.approx(colour().models.eotf_inverse_sRGB(LINEAR), abs=1e-12)
    assert srgb.decode(encoded) == pytest.approx(LINEAR, abs=1e-7)
    assert (srgb.encode([-0.5, -0.001]) < 0).all()


def test_white_is_white_and_colors_are_those_of_colour_science():
    white = tristimulus.white("D65")
    matrix = srgb.from_xyz(white)
    assert matrix @ white == pytest.approx(np.ones(3), abs=1e-14)
    xyz = np.random.default_rng(1).uniform(0.05, 0.9, (50, 3))
    expected = colour().XYZ_to_sRGB(
        xyz, illuminant=colour().XYZ_to_xy(white), apply_cctf_encoding=False
    )
    # The standard's matrix is rounded to four places; these colors go far beyond the gamut.
    assert xyz @ matrix.T == pytest.approx(expected, abs=2e-3)


def test_lab_of_a_picked_color_is_that_of_colour_science(colorchecker):
    rgb, lab = swatches.of_samples(colorchecker)
    inside = ((rgb > 0) & (rgb < 1)).all(axis=1)
    assert inside.sum() > 20
    science, white = colour(), tristimulus.white("D65")
    xyz = science.sRGB_to_XYZ(rgb[inside], illuminant=science.XYZ_to_xy(white))
    apart = color_difference.delta_e(color_difference.xyz_to_lab(xyz, white), lab[inside])
    assert apart.max() < 0.05
    assert color_difference.delta_e(swatches.to_lab(rgb[inside]), lab[inside]).max() < 1e-9
