# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 2007 report: numbers of docs/report-2007.md against the design notes and colour-science."""

import csv
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.support.colour_science import colour

from tools.manual import report_2007 as report

ROOT = Path(__file__).resolve().parents[2]
AGAIN = "The page is out of date: run python3 -m tools.manual.report_2007_figures"


@pytest.fixture(scope="module")
def rows():
    return report.rows()


@pytest.fixture(scope="module")
def green(rows):
    return {(row.observer, row.model): row for row in rows if row.patch == "14 Green"}


def lab(values, observer, scale=1.0):
    """CIELAB under D65 by colour-science's own integration, without any code of ours."""
    science = colour()
    name = {2: "CIE 1931 2 Degree Standard Observer", 10: "CIE 1964 10 Degree Standard Observer"}
    settings = {
        "cmfs": science.MSDS_CMFS[name[observer]],
        "illuminant": science.SDS_ILLUMINANTS["D65"],
        "method": "ASTM E308",
    }
    bands = np.arange(380, 781, 5)

    def xyz(spectrum):
        sd = science.SpectralDistribution(spectrum, bands)
        return science.sd_to_XYZ(sd, **settings) / 100

    white = science.XYZ_to_xy(xyz(np.ones(bands.size)))
    return science.XYZ_to_Lab(scale * xyz(values), white), xyz(values)[1]


# The design notes of this project, to their digits.
@pytest.mark.parametrize(("observer", "as_is", "equal"), [(2, 4.37, 1.6), (10, 3.96, 1.4)])
def test_patch_14_as_the_design_notes_and_colour_science_have_it(green, observer, as_is, equal):
    row = green[observer, "two-bounce"]
    assert round(row.ab, 2) == as_is
    assert round(row.ab_equal, 1) == equal

    patch = colour().SDS_COLOURCHECKERS["ColorChecker N Ohta"]["green"]
    rho = np.array(patch.values)
    s2 = (math.pi / 4) ** 2
    read = (1 - 0.5 * s2 / (s2 + 0.33)) * rho + 0.17 * s2 / (s2 + 0.13) * rho**2
    before, light = lab(rho, observer)
    after, dimmer = lab(read, observer)
    leveled, _ = lab(read, observer, light / dimmer)
    # 1e-9: the same weights summed in another order.
    assert row.ab == pytest.approx(np.hypot(*(after - before)[1:]), abs=1e-9)
    assert row.ab_equal == pytest.approx(np.hypot(*(leveled - before)[1:]), abs=1e-9)
    assert leveled[0] == pytest.approx(before[0], abs=1e-9)
    assert row.de00 == pytest.approx(colour().delta_E(before, after), abs=1e-9)


def test_without_later_bounces_only_darkening_is_left(rows):
    for row in rows:
        if row.model == "first-order":
            # 1e-6: cube roots of numbers that differ by rounding, times 500.
            assert row.ab_equal == pytest.approx(0, abs=1e-6)
            assert row.duv_equal == pytest.approx(0, abs=1e-12)
            assert row.ab == pytest.approx(row.ab_darkening, abs=1e-6)


def test_steps_relate_by_the_cube_root_of_luminance(green):
    for row in green.values():
        # Green has no tristimulus value in CIELAB's linear part, so this is exact.
        assert row.ab_interreflection == pytest.approx(np.cbrt(row.k) * row.ab_equal, abs=1e-6)
        length = np.hypot(row.a, row.b)
        assert row.ab_darkening == pytest.approx((1 - np.cbrt(row.k)) * length, abs=1e-6)


def test_interreflection_works_against_darkening(rows):
    colorful = [r for r in rows if np.hypot(r.a, r.b) > 10 and r.model != "first-order"]
    assert len(colorful) > 100
    for row in colorful:
        # Not along one line for every hue, so it shortens the distance by less than its length.
        assert row.ab_interreflection > 0
        assert row.ab < row.ab_darkening


def test_numbers_at_the_largest_roughness():
    s2 = Fraction(math.pi / 2) ** 2
    f1 = 1 - s2 / (2 * (s2 + Fraction(33, 100)))
    f2 = Fraction(17, 100) * s2 / (s2 + Fraction(13, 100))
    assert [round(float(f), 4) for f in (f1, f2, f1 + f2)] == [0.5590, 0.1615, 0.7205]
    for text in ("0.5590", "0.1615", "0.7205"):
        assert report.known_table().count(text) == 2, AGAIN


@pytest.mark.parametrize(("peak", "degrees"), [(0.8, 48.9), (0.9, 28.0), (0.95, 19.5)])
def test_bounds_on_roughness(peak, degrees):
    assert round(report.largest_sigma(peak, "two-bounce"), 1) == degrees
    assert report.largest_sigma(peak, "closure") == 90
    assert report.largest_sigma(peak, "reference") == 90


def test_tables_of_the_page_and_files_are_those_of_this_code(rows):
    for name, text in (
        ("report-2007.csv", report.colors_csv(rows)),
        ("report-2007-curves.csv", report.curves_csv()),
        ("report-2007-variations.csv", report.variations_csv(report.variations())),
    ):
        kept, fresh = (
            list(csv.reader(lines))
            for lines in ((report.DATA / name).read_text("utf-8").splitlines(), text.splitlines())
        )
        assert len(kept) == len(fresh), AGAIN
        for before, after in zip(kept, fresh, strict=True):
            for old, new in zip(before, after, strict=True):
                # The last digit may round either way on another machine.
                assert old == new or float(old) == pytest.approx(float(new), abs=2e-6), AGAIN


def test_sentences_of_the_page_quote_what_is_computed(rows, green):
    page = report.PAGE.read_text("utf-8")
    text = " ".join(report.fill(page, dict.fromkeys(report_tables(page), "")).split())
    two, ten = green[2, "two-bounce"], green[10, "two-bounce"]
    all_2, all_10 = green[2, "reference"], green[10, "reference"]
    white = report.white_curve("reference")
    yellow = {r.model: r for r in rows if r.patch == "16 Yellow" and r.observer == 2}
    bright = {r.model: r for r in rows if r.patch.startswith("19 White") and r.observer == 2}
    some = [r for r in rows if r.observer == 2]
    mean = {
        model: np.mean([r.de00_equal for r in some if r.model == model]) for model in report.MODELS
    }
    quoted = (
        f"**{two.ab:.2f}** (2° observer) or **{ten.ab:.2f}** (10° observer)",
        f"**{two.ab_equal:.2f}** (2°) or **{ten.ab_equal:.2f}** (10°)",
        f"{all_2.ab_equal:.2f} (2°) or {all_10.ab_equal:.2f} (10°)",
        f"between {white.min():.4f} and {white.max():.4f} at every σ",
        f"would move it by {two.ab_darkening:.2f} (2°)",
        f"takes {two.ab_interreflection:.2f} back",
        f"{two.ab_darkening:.3f} − {two.ab_interreflection:.3f} = "
        f"{two.ab_darkening - two.ab_interreflection:.3f}, and the distance is {two.ab:.3f}",
        f"{two.ab_interreflection:.2f}/{np.cbrt(two.k):.3f} = {two.ab_equal:.2f}",
        f"alone it would be {green[2, 'first-order'].ab:.2f}",
        f"takes away {two.ab - ten.ab:.2f} of the {two.ab - report.REPORTED:.2f}",
        f"the rest, {ten.ab - report.REPORTED:.2f}",
        f"gives {all_10.ab:.2f} for the 10° observer",
        f"by {all_2.de00:.2f} ΔE00 in the reference and by {two.de00:.2f} with two bounces",
        f"shift by {mean['reference']:.2f} ΔE00 on average",
        f"two bounces say {mean['two-bounce']:.2f}",
        f"by {yellow['reference'].de00_equal:.2f} where they say "
        f"{yellow['two-bounce'].de00_equal:.2f}",
        f"by {bright['reference'].de00:.1f} ΔE00, with two bounces by "
        f"{bright['two-bounce'].de00:.1f}",
        f"miss white by {bright['two-bounce'].de00_from_reference:.1f} ΔE00",
    )
    missing = [sentence for sentence in quoted if sentence not in text]
    assert not missing, AGAIN


def report_tables(page):
    return [part.split(" -->")[0] for part in page.split("<!-- table: ")[1:]]
