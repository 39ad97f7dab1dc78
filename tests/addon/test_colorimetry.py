# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""XYZ, Lab and ΔE00, against colour-science called directly, instruments, and published data."""

import warnings

import numpy as np
import pytest
from rough_spectra.addon import colorimetry, e308
from rough_spectra.addon.science import colour
from rough_spectra.core import reading
from rough_spectra.core.errors import DomainError

OBSERVERS = {
    2: "CIE 1931 2 Degree Standard Observer",
    10: "CIE 1964 10 Degree Standard Observer",
}
TABLES = {"F2": "FL2", "F7": "FL7", "F11": "FL11"}

# G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000 color-difference formula: implementation notes,
# supplementary test data, and mathematical observations" (2005), table 1.
SHARMA = """
50.0000 2.6772 -79.7751 50.0000 0.0000 -82.7485 2.0425
50.0000 3.1571 -77.2803 50.0000 0.0000 -82.7485 2.8615
50.0000 2.8361 -74.0200 50.0000 0.0000 -82.7485 3.4412
50.0000 -1.3802 -84.2814 50.0000 0.0000 -82.7485 1.0000
50.0000 -1.1848 -84.8006 50.0000 0.0000 -82.7485 1.0000
50.0000 -0.9009 -85.5211 50.0000 0.0000 -82.7485 1.0000
50.0000 0.0000 0.0000 50.0000 -1.0000 2.0000 2.3669
50.0000 -1.0000 2.0000 50.0000 0.0000 0.0000 2.3669
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0009 7.1792
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0010 7.1792
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0011 7.2195
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0012 7.2195
50.0000 -0.0010 2.4900 50.0000 0.0009 -2.4900 4.8045
50.0000 -0.0010 2.4900 50.0000 0.0010 -2.4900 4.8045
50.0000 -0.0010 2.4900 50.0000 0.0011 -2.4900 4.7461
50.0000 2.5000 0.0000 50.0000 0.0000 -2.5000 4.3065
50.0000 2.5000 0.0000 73.0000 25.0000 -18.0000 27.1492
50.0000 2.5000 0.0000 61.0000 -5.0000 29.0000 22.8977
50.0000 2.5000 0.0000 56.0000 -27.0000 -3.0000 31.9030
50.0000 2.5000 0.0000 58.0000 24.0000 15.0000 19.4535
50.0000 2.5000 0.0000 50.0000 3.1736 0.5854 1.0000
50.0000 2.5000 0.0000 50.0000 3.2972 0.0000 1.0000
50.0000 2.5000 0.0000 50.0000 1.8634 0.5757 1.0000
50.0000 2.5000 0.0000 50.0000 3.2592 0.3350 1.0000
60.2574 -34.0099 36.2677 60.4626 -34.1751 39.4387 1.2644
63.0109 -31.0961 -5.8663 62.8187 -29.7946 -4.0864 1.2630
61.2901 3.7196 -5.3901 61.4292 2.2480 -4.9620 1.8731
35.0831 -44.1164 3.7933 35.0232 -40.0716 1.5901 1.8645
22.7233 20.0904 -46.6940 23.0331 14.9730 -42.5619 2.0373
36.4612 47.8580 18.3852 36.2715 50.5065 21.2231 1.4146
90.8027 -2.0831 1.4410 91.1528 -1.6435 0.0447 1.4441
90.9257 -0.5406 -0.9208 88.6381 -0.8985 -0.7239 1.5381
6.7747 -0.2908 -2.4247 5.8714 -0.0985 -2.2286 0.6377
2.0776 0.0795 -1.1350 0.9033 -0.0636 -0.5514 0.9082
"""


def peer_xyz(values, wavelengths, illuminant, observer, method="ASTM E308"):
    science = colour()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return (
            science.sd_to_XYZ(
                science.SpectralDistribution(values, wavelengths),
                cmfs=science.MSDS_CMFS[OBSERVERS[observer]],
                illuminant=science.SDS_ILLUMINANTS[TABLES.get(illuminant, illuminant)],
                method=method,
            )
            / 100
        )


def smooth(nm):
    """A reflectance that 20 nm are enough for."""
    return 0.45 + 0.3 * np.sin(nm / 60) - 0.1 * np.cos(nm / 35)


@pytest.mark.parametrize("observer", [2, 10])
@pytest.mark.parametrize("illuminant", colorimetry.ILLUMINANTS)
def test_weights_are_e308_for_every_illuminant_and_observer(illuminant, observer):
    rng = np.random.default_rng(308)
    for step in (5, 10, 20):
        wavelengths = np.arange(380.0, 781.0, step)
        values = rng.uniform(0, 1, (1, wavelengths.size))
        expected = [peer_xyz(v, wavelengths, illuminant, observer) for v in values]
        found = values @ colorimetry.weights(wavelengths, illuminant, observer)
        # E308 is linear, so only the order of the sums differs.
        np.testing.assert_allclose(found, expected, rtol=1e-13)


@pytest.mark.parametrize("step", [5, 10, 20])
@pytest.mark.parametrize(("first", "last"), [(400.0, 700.0), (360.0, 740.0), (360.0, 780.0)])
def test_weights_are_e308_where_ends_are_missing(step, first, last):
    wavelengths = np.arange(first, last + 1, step)
    values = smooth(wavelengths)
    np.testing.assert_allclose(
        values @ colorimetry.weights(wavelengths),
        peer_xyz(values, wavelengths, "D65", 2),
        rtol=1e-13,
    )


@pytest.mark.parametrize("step", [5, 10])
def test_usual_grids_need_no_import_of_colour_science(monkeypatch, step):
    """It takes half a second, in which a panel would stand still at its first use."""
    colorimetry._weights.cache_clear()
    monkeypatch.setattr(e308, "colour", None)
    wavelengths = np.arange(400.0, 701.0, step)
    assert colorimetry.weights(wavelengths, "F11", 10).shape == (wavelengths.size, 3)


def test_white_points_are_the_published_ones():
    # ASTM E308-01, table 5 (10 nm), X and Z of the perfect white diffuser.
    for illuminant, observer, x, z in (
        ("D65", 2, 0.95047, 1.08883),
        ("D65", 10, 0.94811, 1.07304),
        ("D50", 2, 0.96422, 0.82521),
        ("A", 2, 1.09850, 0.35585),
        ("A", 10, 1.11144, 0.35200),
        ("F11", 2, 1.00962, 0.64350),
        ("E", 2, 1.00000, 1.00000),
    ):
        white = colorimetry.white(illuminant, observer)
        # The tables of 5 nm and of 10 nm differ by 3e-4, for a lamp with lines by 1e-3.
        tolerance = 2e-3 if illuminant[0] == "F" else 5e-4
        np.testing.assert_allclose(white, [x, 1, z], atol=tolerance)


@pytest.mark.parametrize(
    "wavelengths",
    [
        np.arange(360.0, 781.0, 1.0),
        np.arange(360.0, 781.0, 3.0),
        np.linspace(380.0, 780.0, 37),
        np.arange(383.0, 781.0, 10.0),
        np.cumsum(np.r_[380.0, np.tile([5.0, 9.0, 11.0], 16)]),
        np.arange(300.0, 2501.0, 10.0),
        np.arange(360.0, 781.0, 0.5),
        np.arange(360.0, 781.0, 5.0) + 1e-6 * (np.arange(85) % 2),
    ],
)
@pytest.mark.parametrize("illuminant", ["D65", "A"])
def test_any_grid_comes_near_the_1_nm_sum(wavelengths, illuminant):
    fine = np.arange(360.0, 781.0)
    expected, white = (
        peer_xyz(values, fine, illuminant, 2, method="Integration")
        for values in (smooth(fine), np.ones(fine.size))
    )
    matrix = colorimetry.weights(wavelengths, illuminant)
    found = colorimetry.spectrum_to_lab(smooth(wavelengths), wavelengths, illuminant)
    # 0.002 is what the 5 nm weights themselves differ by from the 1 nm sum.
    assert colorimetry.delta_e(found, colorimetry.xyz_to_lab(expected, white)) < 0.003
    assert matrix.shape == (wavelengths.size, 3)
    assert not matrix.flags.writeable


def test_bands_beyond_the_visible_do_not_matter():
    visible = np.arange(360.0, 781.0, 10.0)
    wide = np.arange(300.0, 2501.0, 10.0)
    values = np.where((wide >= 360) & (wide <= 780), smooth(wide), 0.99)
    np.testing.assert_allclose(
        values @ colorimetry.weights(wide),
        smooth(visible) @ colorimetry.weights(visible),
        rtol=1e-14,
    )


def test_unmeasured_ends_are_told_and_too_much_of_them_is_refused():
    assert colorimetry.held_share(np.arange(360.0, 781.0, 10)) == 0
    assert 0 < colorimetry.held_share(np.arange(400.0, 701.0, 10)) < 0.01
    colorimetry.weights(np.arange(400.0, 701.0, 10))
    for wavelengths in (np.arange(450.0, 781.0, 10), np.arange(800.0, 2500.0, 10), [550.0]):
        with pytest.raises(DomainError, match=r"nm leave|have no color") as caught:
            colorimetry.weights(wavelengths)
        assert str(caught.value).endswith("a color needs about 400 to 700 nm.")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("D60", 2), "Illuminant 'D60' is not known; choose one of A, D50"),
        (("D65", 5), "Observer 5 is not known; choose 2 or 10 degrees."),
    ],
)
def test_unknown_light_or_observer_is_refused(arguments, sentence):
    with pytest.raises(DomainError) as caught:
        colorimetry.weights(np.arange(400.0, 701.0, 10), *arguments)
    assert str(caught.value).startswith(sentence)


def test_opposite_hues_are_half_a_turn_apart_and_not_more():
    """The formula then takes the hue halfway between the two angles: rounding must not turn it."""
    rng = np.random.default_rng(5)
    chroma = np.column_stack((rng.uniform(0.1, 60, 20000), rng.choice((1e-3, 1, 60), 20000)))
    one = np.column_stack((np.full(20000, 50.0), chroma * rng.choice((-1, 1), chroma.shape)))
    other = one * (1, -1, -1)
    # Less than half a turn without any doubt: the larger of the two angles, below, a hair smaller.
    below = np.where(one[:, 2:] < 0, one, other)
    above = -below * (-1, 1, 1)
    hair = below + 1e-7 * np.column_stack((np.zeros(20000), below[:, 2], -below[:, 1]))
    expected = colorimetry.delta_e(above, hair)
    np.testing.assert_allclose(colorimetry.delta_e(one, other), expected, rtol=1e-5)
    np.testing.assert_allclose(colorimetry.delta_e(other, one), expected, rtol=1e-5)


def test_delta_e_is_ciede2000_to_the_digits_published():
    table = np.array([[float(x) for x in line.split()] for line in SHARMA.split("\n") if line])
    assert table.shape == (34, 7)
    found = colorimetry.delta_e(table[:, :3], table[:, 3:6])
    np.testing.assert_array_equal(np.round(found, 4), table[:, 6])
    np.testing.assert_allclose(
        colorimetry.delta_e(table[:, 3:6], table[:, :3]), found, rtol=1e-9, atol=0
    )
    assert colorimetry.delta_e(table[:, :3].reshape(2, 17, 3), table[0, 3:6]).shape == (2, 17)


def random_labs():
    """Pairs far apart, close together and equal, grays and half grays among them."""
    rng = np.random.default_rng(2005)
    lab = rng.uniform([0, -128, -128], [100, 128, 128], (4000, 3))
    other = lab + rng.normal(0, 1, lab.shape) * np.repeat([0.01, 1, 30, 0], 1000)[:, np.newaxis]
    lab[:50, 1:], other[25:75, 1:] = 0, 0
    return lab, other


def test_delta_e_and_lab_agree_with_colour_science():
    lab, other = random_labs()
    expected = colour().delta_E(lab, other, method="CIE 2000")
    np.testing.assert_allclose(colorimetry.delta_e(lab, other), expected, rtol=0, atol=1e-9)
    white = colorimetry.white("A")
    xyz = np.random.default_rng(31).uniform(-0.1, 1.2, (500, 3))
    expected = colour().XYZ_to_Lab(xyz, colour().XYZ_to_xy(white))
    np.testing.assert_allclose(colorimetry.xyz_to_lab(xyz, white), expected, rtol=0, atol=1e-9)


def test_adaptation_agrees_with_colour_science():
    whites = colorimetry.white("A"), colorimetry.white("D65")
    expected = colour().adaptation.matrix_chromatic_adaptation_VonKries(
        *whites, transform="Bradford"
    )
    np.testing.assert_allclose(colorimetry.adaptation(*whites), expected, rtol=1e-12, atol=1e-15)


def test_lab_of_white_gray_and_black():
    white = colorimetry.white("D50", 10)
    np.testing.assert_allclose(colorimetry.xyz_to_lab(white, white), [100, 0, 0], atol=1e-12)
    np.testing.assert_allclose(colorimetry.xyz_to_lab(0 * white, white), 0, atol=1e-12)
    # L* = 116 (Y)^(1/3) - 16
    np.testing.assert_allclose(colorimetry.xyz_to_lab(0.125 * white, white), [42, 0, 0], atol=1e-12)


def test_nix_device_and_spectrum_agree(nix):
    """The instrument's own Lab, for the illuminant and the observer that the file states."""
    assert len(nix) == 6
    stated = {(s.illuminant, s.observer) for s in nix.values()}
    assert stated == {("D65", 10), ("D50", 2)}
    for sample in nix.values():
        light = sample.illuminant, sample.observer
        lab = colorimetry.spectrum_to_lab(sample.values, sample.wavelengths, *light)
        # 0.0073 at most: the device integrates in its own way and prints nine digits.
        assert colorimetry.delta_e(lab, sample.lab) <= 0.02
        xyz = sample.values @ colorimetry.weights(sample.wavelengths, *light)
        np.testing.assert_allclose(xyz, sample.xyz, rtol=2e-4)


def test_brick_does_not_agree_under_another_light(nix):
    """The file is of D50, 2°: read as D65, 10° like the others it would be off."""
    brick = nix["brick"]
    lab = colorimetry.spectrum_to_lab(brick.values, brick.wavelengths, "D65", 10)
    assert colorimetry.delta_e(lab, brick.lab) > 1


@pytest.mark.parametrize(("observer", "apart", "same_luminance"), [(2, 4.37, 1.6), (10, 3.96, 1.4)])
def test_patch_14_of_the_2007_report(colorchecker, observer, apart, same_luminance):
    """ColorChecker 14, green, as the albedo at σ = π/4 under D65: how far the reading moves.

    Zuffi and Gagliardi (2007) report 3.83 in the a*b* plane from a chart they measured; these are
    the numbers for Ohta's spectrum. Luminance held equal means: the rough reading, times the one
    number that gives it the Y of the smooth patch, is what a rough surface under more light looks
    like; what then is left in a*b* is the change of the spectrum's shape by interreflection.
    """
    green = next(sample for sample in colorchecker if sample.name == "green")
    matrix = colorimetry.weights(green.wavelengths, "D65", observer)
    smooth_xyz = green.values @ matrix
    rough_xyz = reading.from_albedo(green.values, np.pi / 4) @ matrix
    white = matrix.sum(axis=0)

    def distance(xyz):
        pair = (colorimetry.xyz_to_lab(x, white)[1:] for x in (smooth_xyz, xyz))
        return float(np.linalg.norm(np.subtract(*pair)))

    assert round(distance(rough_xyz), 2) == apart
    assert round(distance(rough_xyz * smooth_xyz[1] / rough_xyz[1]), 1) == same_luminance


def test_roots_lead_to_lab_and_have_its_slopes():
    relative = np.array((1e-4, 0.003, 0.008, 0.01, 0.2, 0.9, 1.3))
    bent, slope = colorimetry.roots(relative)
    gray = np.repeat(relative[:, np.newaxis], 3, axis=1) * (0.9, 1, 1.1)
    lab = colorimetry.LAB_FROM_ROOTS @ colorimetry.roots(gray)[0][..., np.newaxis]
    assert lab[..., 0] - (16, 0, 0) == pytest.approx(colorimetry.xyz_to_lab(gray, np.ones(3)))
    step = 1e-7
    rise = colorimetry.roots(relative + step)[0] - colorimetry.roots(relative - step)[0]
    assert slope == pytest.approx(rise / (2 * step), rel=1e-5)
    assert bent[-3:] == pytest.approx(np.cbrt(relative[-3:]))
