# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The 2007 report: numbers of docs/report-2007.md against what it prints and colour-science."""

import csv
import math
import re
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import reading

from tools.manual import report_2007 as report
from tools.manual import report_2007_tables as tables

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


@pytest.mark.parametrize("observer", [2, 10])
def test_patch_14_as_colour_science_has_it(green, observer):
    row = green[observer, "two-bounce"]
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


PRINTED = {
    "f1 = 1 − **0.5** σ²/(σ² + 0.33)": Fraction(1, 2),
    "f1 = 1 − 0.5 σ²/(σ² + **0.33**)": Fraction(33, 100),
    "f2 = **0.17** σ²/(σ² + 0.13)": Fraction(17, 100),
    "f2 = 0.17 σ²/(σ² + **0.13**)": Fraction(13, 100),
    "largest f1, at σ = 0": 1,
    "smallest f1, at σ = π/2": 0.5590,
    "largest f2, at σ = π/2": 0.1615,
    "smallest f2, at σ = 0": 0,
    "r of ρ = 1 at σ = 0": 1,
    "r of ρ = 1 at σ = π/2": 0.7205,
    "peak above which σ is bounded": 0.7205,
}
"""The report's numbers that follow from its formula."""


def test_every_number_of_the_formula_is_as_printed(rows):
    s2 = Fraction(math.pi / 2) ** 2
    f1 = 1 - s2 / (2 * (s2 + Fraction(33, 100)))
    f2 = Fraction(17, 100) * s2 / (s2 + Fraction(13, 100))
    assert [round(float(f), 4) for f in (f1, f2, f1 + f2)] == [0.5590, 0.1615, 0.7205]
    lines = (line.strip("| ").split(" | ") for line in tables.printed_table(rows).splitlines()[2:])
    found = {what: (report_says, here) for _, what, report_says, here in lines}
    for what, number in PRINTED.items():
        report_says, here = found.pop(what)
        assert float(report_says) == float(number)
        # Four digits are given here of each, so as many as the report ever prints.
        assert float(here) == pytest.approx(float(number), abs=5e-5)
    assert found.keys() == {"largest σ", "σ of the example", "a\\*b\\* distance of the example"}
    assert found["largest σ"] == ("π/2", "0.5 π")
    assert found["σ of the example"] == ("π/4", "0.25 π")
    assert found["a\\*b\\* distance of the example"] == ("3.83", "4.37 (2°), 3.96 (10°)")


def test_the_product_of_a_column_and_a_row_stands_for_the_square_of_each_band():
    """The report's f2 ρρᵀ is a matrix; on its diagonal are the squares of the bands."""
    _, _, patches = report.chart()
    rho = patches[report.GREEN]
    f1, f2 = reading.coefficients(report.SIGMA)
    matrix = f2 * np.outer(rho, rho)
    expected = f1 * rho + np.diag(matrix)
    np.testing.assert_allclose(report.predict(rho, report.SIGMA, "two-bounce"), expected)


def test_none_of_the_96_candidates_gives_what_the_report_prints():
    found = report.candidates()
    assert len(found) == 24 * 2 * 2
    assert all(round(candidate.ab, 2) != report.REPORTED for candidate in found)
    nearest = found[0]
    greens = [c for c in found if c.patch in ("green", "yellow green", "bluish green", "foliage")]
    yellow_green = sorted(c.ab for c in greens if c.number == 11)
    purple = sorted(c.ab for c in found if c.number == 10)
    text = " ".join(tables.PAGE.read_text("utf-8").split())
    assert f"The nearest of all 96 is the {nearest.patch} patch, {nearest.ab:.2f}" in text
    assert (greens[0].number, greens[0].data_set, greens[0].observer) == (14, "Ohta", 10)
    assert f"with Ohta's spectrum and the 10° observer, {greens[0].ab:.2f}" in text
    assert f"gives {yellow_green[0]:.2f} to {yellow_green[-1]:.2f}" in text
    assert f"is purple, {purple[0]:.1f} to {purple[-1]:.1f}" in text


def test_colors_of_equal_lightness_have_the_chromaticities_of_each(green):
    """Figure 4: read back from what a screen shows, to the half level that it rounds to."""
    row = green[2, "two-bounce"]
    science = colour()
    white = science.XYZ_to_xy(np.array([0.95047, 1.0, 1.08883]))
    for shown, wanted in (
        (row.srgb, (row.L, row.a, row.b)),
        (row.srgb_reading, (row.L, row.a_reading, row.b_reading)),
    ):
        levels = [int(shown[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        seen = science.XYZ_to_Lab(science.sRGB_to_XYZ(levels), white)
        assert np.linalg.norm(seen - wanted) < 0.5


def test_albedos_of_a_reading_begin_at_the_reading_itself():
    for line in tables.ranges_table().splitlines()[2:]:
        for value, low, high in re.findall(r"([\d.]+): ([\d.]+) to ([\d.]+)", line):
            # r(σmax), where the report begins its range, would be below the reading.
            assert float(low) == float(value) < float(high)


def test_the_report_is_cited_as_it_is_signed():
    pages = {p.name: p.read_text("utf-8") for p in sorted((ROOT / "docs").glob("*.md"))}
    citing = {name for name, text in pages.items() if "Gagliardi" in text}
    assert {"physics.md", "report-2007.md"} <= citing
    for name in citing:
        assert "M. Gagliardi" not in pages[name]
        assert re.search(r"(Isabella|I\.|and)\s+Gagliardi", pages[name])
        assert "design notes" not in pages[name]


@pytest.mark.parametrize(("peak", "degrees"), [(0.8, 48.9), (0.9, 28.0), (0.95, 19.5)])
def test_bounds_on_roughness(peak, degrees):
    assert round(report.largest_sigma(peak, "two-bounce"), 1) == degrees
    assert report.largest_sigma(peak, "closure") == 65  # where the model ends
    assert report.largest_sigma(peak, "reference") == 80


def test_tables_of_the_page_and_files_are_those_of_this_code(rows):
    for name, text in (
        ("report-2007.csv", tables.colors_csv(rows)),
        ("report-2007-curves.csv", tables.curves_csv()),
        ("report-2007-variations.csv", tables.variations_csv(report.variations())),
        ("report-2007-candidates.csv", tables.candidates_csv(report.candidates())),
    ):
        kept, fresh = (
            list(csv.reader(lines))
            for lines in ((tables.DATA / name).read_text("utf-8").splitlines(), text.splitlines())
        )
        assert len(kept) == len(fresh), AGAIN
        for before, after in zip(kept, fresh, strict=True):
            for old, new in zip(before, after, strict=True):
                # The last digit may round either way on another machine.
                assert old == new or float(old) == pytest.approx(float(new), abs=2e-6), AGAIN


def test_sentences_of_the_page_quote_what_is_computed(rows, green):
    page = tables.PAGE.read_text("utf-8")
    text = " ".join(tables.fill(page, dict.fromkeys(report_tables(page), "")).split())
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
