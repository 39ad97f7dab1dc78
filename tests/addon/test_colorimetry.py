# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""XYZ, Lab and ΔE00 against colour-science called directly, instruments, and published data."""

import warnings

import numpy as np
import pytest
from rough_spectra.addon.colorimetry import cie_tables, tristimulus
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.errors import DomainError

OBSERVERS = {
    2: "CIE 1931 2 Degree Standard Observer",
    10: "CIE 1964 10 Degree Standard Observer",
}
TABLES = {"F2": "FL2", "F7": "FL7", "F11": "FL11"}


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
@pytest.mark.parametrize("illuminant", tristimulus.ILLUMINANTS)
def test_weights_are_e308_for_every_illuminant_and_observer(illuminant, observer):
    rng = np.random.default_rng(308)
    for step in (5, 10, 20):
        wavelengths = np.arange(380.0, 781.0, step)
        values = rng.uniform(0, 1, (1, wavelengths.size))
        expected = [peer_xyz(v, wavelengths, illuminant, observer) for v in values]
        found = values @ tristimulus.weights(wavelengths, illuminant, observer)
        # E308 is linear, so only the order of the sums differs.
        np.testing.assert_allclose(found, expected, rtol=1e-13)


@pytest.mark.parametrize("step", [5, 10, 20])
@pytest.mark.parametrize(("first", "last"), [(400.0, 700.0), (360.0, 740.0), (360.0, 780.0)])
def test_weights_are_e308_where_ends_are_missing(step, first, last):
    wavelengths = np.arange(first, last + 1, step)
    values = smooth(wavelengths)
    np.testing.assert_allclose(
        values @ tristimulus.weights(wavelengths),
        peer_xyz(values, wavelengths, "D65", 2),
        rtol=1e-13,
    )


def test_tables_are_those_of_colour_science():
    """To the bit with the numpy that the file was written with."""
    science = colour()
    grid = cie_tables.GRID
    shape = science.SpectralShape(grid[0], grid[-1], 1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for observer, name in OBSERVERS.items():
            expected = science.MSDS_CMFS[name].copy().align(shape).values
            np.testing.assert_allclose(cie_tables.observer(observer), expected, atol=1e-14)
        for illuminant in (*cie_tables.ILLUMINANTS, *cie_tables.LAMPS):
            table = science.SDS_ILLUMINANTS[TABLES.get(illuminant, illuminant)]
            expected = table.copy().align(shape).values
            np.testing.assert_allclose(cie_tables.illuminant(illuminant), expected, rtol=1e-12)
    # CIE 15, table T.2: S0, S1 and S2 at 560 nm.
    np.testing.assert_array_equal(cie_tables.daylight_parts()[:, 200], [100.0, 0.0, 0.0])


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
        white = tristimulus.white(illuminant, observer)
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
    matrix = tristimulus.weights(wavelengths, illuminant)
    found = tristimulus.spectrum_to_lab(smooth(wavelengths), wavelengths, illuminant)
    # 0.002 is what the 5 nm weights themselves differ by from the 1 nm sum.
    assert color_difference.delta_e(found, color_difference.xyz_to_lab(expected, white)) < 0.003
    assert matrix.shape == (wavelengths.size, 3)
    assert not matrix.flags.writeable


def test_bands_beyond_the_visible_do_not_matter():
    visible = np.arange(360.0, 781.0, 10.0)
    wide = np.arange(300.0, 2501.0, 10.0)
    values = np.where((wide >= 360) & (wide <= 780), smooth(wide), 0.99)
    np.testing.assert_allclose(
        values @ tristimulus.weights(wide),
        smooth(visible) @ tristimulus.weights(visible),
        rtol=1e-14,
    )


def test_unmeasured_ends_are_told_and_too_much_of_them_is_refused():
    assert tristimulus.held_share(np.arange(360.0, 781.0, 10)) == 0
    assert 0 < tristimulus.held_share(np.arange(400.0, 701.0, 10)) < 0.01
    tristimulus.weights(np.arange(400.0, 701.0, 10))
    for wavelengths in (np.arange(450.0, 781.0, 10), np.arange(800.0, 2500.0, 10), [550.0]):
        with pytest.raises(DomainError, match=r"nm leave|have no color") as caught:
            tristimulus.weights(wavelengths)
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
        tristimulus.weights(np.arange(400.0, 701.0, 10), *arguments)
    assert str(caught.value).startswith(sentence)


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
    # 1e-12: what rounding leaves; both are CIEDE2000 in double precision.
    np.testing.assert_allclose(color_difference.delta_e(lab, other), expected, rtol=0, atol=1e-12)
    white = tristimulus.white("A")
    xyz = np.random.default_rng(31).uniform(-0.1, 1.2, (500, 3))
    expected = colour().XYZ_to_Lab(xyz, colour().XYZ_to_xy(white))
    np.testing.assert_allclose(color_difference.xyz_to_lab(xyz, white), expected, rtol=0, atol=1e-9)


def test_adaptation_agrees_with_colour_science():
    whites = tristimulus.white("A"), tristimulus.white("D65")
    expected = colour().adaptation.matrix_chromatic_adaptation_VonKries(
        *whites, transform="Bradford"
    )
    np.testing.assert_allclose(
        color_difference.adaptation(*whites), expected, rtol=1e-12, atol=1e-15
    )


def test_lab_of_white_gray_and_black():
    white = tristimulus.white("D50", 10)
    np.testing.assert_allclose(color_difference.xyz_to_lab(white, white), [100, 0, 0], atol=1e-12)
    np.testing.assert_allclose(color_difference.xyz_to_lab(0 * white, white), 0, atol=1e-12)
    # L* = 116 (Y)^(1/3) - 16
    np.testing.assert_allclose(
        color_difference.xyz_to_lab(0.125 * white, white), [42, 0, 0], atol=1e-12
    )


def test_nix_device_and_spectrum_agree(nix):
    """The instrument's own Lab, for the illuminant and the observer that the file states."""
    assert len(nix) == 6
    stated = {(s.illuminant, s.observer) for s in nix.values()}
    assert stated == {("D65", 10), ("D50", 2)}
    for sample in nix.values():
        light = sample.illuminant, sample.observer
        lab = tristimulus.spectrum_to_lab(sample.values, sample.wavelengths, *light)
        # 0.0073 at most: the device integrates in its own way and prints nine digits.
        assert color_difference.delta_e(lab, sample.lab) <= 0.02
        xyz = sample.values @ tristimulus.weights(sample.wavelengths, *light)
        np.testing.assert_allclose(xyz, sample.xyz, rtol=2e-4)


def test_brick_does_not_agree_under_another_light(nix):
    """The file is of D50, 2°: read as D65, 10° like the others it would be off."""
    brick = nix["brick"]
    lab = tristimulus.spectrum_to_lab(brick.values, brick.wavelengths, "D65", 10)
    assert color_difference.delta_e(lab, brick.lab) > 1


@pytest.mark.parametrize(("observer", "apart", "same_luminance"), [(2, 4.37, 1.6), (10, 3.96, 1.4)])
def test_patch_14_of_the_2007_report(colorchecker, observer, apart, same_luminance):
    """ColorChecker 14, green, as the albedo at σ = π/4 under D65: how far the reading moves.

    Zuffi and Gagliardi (2007) print 3.83 in the a*b* plane and do not say of whose spectrum; these
    are the numbers for Ohta's. Luminance held equal means: the rough reading, times the one
    number that gives it the Y of the smooth patch, is what a rough surface under more light looks
    like; what then is left in a*b* is the change of the spectrum's shape by interreflection.
    """
    green = next(sample for sample in colorchecker if sample.name == "green")
    matrix = tristimulus.weights(green.wavelengths, "D65", observer)
    smooth_xyz = green.values @ matrix
    rough_xyz = reading.from_albedo(green.values, np.pi / 4) @ matrix
    white = matrix.sum(axis=0)

    def distance(xyz):
        pair = (color_difference.xyz_to_lab(x, white)[1:] for x in (smooth_xyz, xyz))
        return float(np.linalg.norm(np.subtract(*pair)))

    assert round(distance(rough_xyz), 2) == apart
    assert round(distance(rough_xyz * smooth_xyz[1] / rough_xyz[1]), 1) == same_luminance


@pytest.mark.parametrize("name", ["Linear Rec.709", "Linear Rec.2020", "ACEScg"])
def test_standard_spaces_are_blenders_own(name, set_working_space):
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.colorimetry import standard_spaces

    if name != "Linear Rec.709":
        set_working_space(name)
    blenders, ours = working_space.current(), standard_spaces.SPACES
    assert blenders.name == name
    # Blender's matrices have the digits of its configuration: 4.5 has 3.2404 for 3.2410.
    assert ours[name].from_xyz == pytest.approx(blenders.from_xyz, abs=6e-4)
    assert standard_spaces.of_rgb((1, 1, 1), blenders)[name] == pytest.approx((1, 1, 1), abs=1e-6)
