# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of docs/report-2007.md and CSV files in docs/data.

Needs colour-science, so `report_2007_figures.py` starts this file in an environment that has bpy
and draws the figures afterwards in one that has matplotlib.
"""

from __future__ import annotations

import csv
import io
import re
import sys
from collections.abc import Iterable, Sequence
from dataclasses import fields

import numpy as np

# `report_2007` has loaded the extension.
from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.support import atomic_files
from rough_spectra.core import feasible, models, reading, vcavity
from rough_spectra.core.limits import LARGEST_SIGMA

from tools.manual import report_2007
from tools.manual.report_2007 import (
    BEYOND_FIRST,
    DATA_SETS,
    GREEN,
    OBSERVERS,
    REPORTED,
    SIGMA,
    Candidate,
    Row,
    Variation,
    largest_sigma,
    white_curve,
)

DOCS = ROOT / "docs"
PAGE = DOCS / "report-2007.md"
DATA = DOCS / "data"
PEAKS = (0.7205, 0.8, 0.9, 0.95, 0.99, 1.0)
NEAREST = 6
"""Candidates for the report's patch that are not green, named on the page."""


# Files -------------------------------------------------------------------------------------------

CONDITIONS = (
    "ColorChecker N Ohta as the albedo, sigma = 45 deg, 45a:0, D65, CIE 1931 2 deg and CIE 1964 "
    "10 deg observer; k, L, a, b and distances as docs/report-2007.md defines them"
)


def colors_csv(table: Iterable[Row]) -> str:
    """Give docs/data/report-2007.csv."""
    names = [field.name for field in fields(Row)]
    return _csv(CONDITIONS, names, ([getattr(row, name) for name in names] for row in table))


def curves_csv() -> str:
    """Give docs/data/report-2007-curves.csv: all that depends on σ alone."""
    sigma = np.radians(np.arange(91))
    f1, f2 = reading.coefficients(sigma)
    a1 = vcavity.ring_coefficients(sigma, 1)[:, 0]
    # A model that ends before 90° has no cells there.
    white = [
        np.concatenate((curve[::100], np.full(91 - curve[::100].size, np.nan)))
        for curve in map(white_curve, BEYOND_FIRST)
    ]
    names = ["sigma_deg", "f1", "f2", *(f"white_{m}" for m in BEYOND_FIRST), "a1_reference"]
    about = "45a:0; f1 and f2 weigh albedo and its square; white_* is the reading of white facets"
    return _csv(about, names, zip(np.arange(91), f1, f2, *white, a1, strict=True))


def variations_csv(found: Iterable[Variation]) -> str:
    """Give docs/data/report-2007-variations.csv."""
    names = [field.name for field in fields(Variation)]
    about = (
        "patch 14 at sigma = 45 deg, 45a:0, two-bounce; a*b* distance for the 2 and 10 deg observer"
    )
    return _csv(about, names, ([getattr(row, name) for name in names] for row in found))


def candidates_csv(found: Iterable[Candidate]) -> str:
    """Give docs/data/report-2007-candidates.csv."""
    names = [field.name for field in fields(Candidate)]
    about = (
        "every patch as the report's albedo: sigma = 45 deg, 45a:0, D65, two-bounce; a*b* distance"
    )
    return _csv(about, names, ([getattr(row, name) for name in names] for row in found))


def _csv(about: str, names: Sequence[str], lines: Iterable[Iterable[object]]) -> str:
    text = io.StringIO()
    text.write(f"# {about}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for line in lines:
        writer.writerow([f"{v:.6f}" if isinstance(v, float) else v for v in line])
    return text.getvalue()


# Tables of the page ------------------------------------------------------------------------------


def printed_table(table: Sequence[Row]) -> str:
    """Put every number that the report prints beside what this code gives."""
    level, rough = 0.0, LARGEST_SIGMA
    (f1_level, f2_level), (f1_rough, f2_rough) = (
        tuple(float(f) for f in reading.coefficients(sigma)) for sigma in (level, rough)
    )
    half, third, weight, width = _constants_of_the_weights()
    unbounded = f1_rough + f2_rough
    [two, ten] = (
        row for row in table if row.patch.startswith(f"{GREEN + 1} ") and row.model == "two-bounce"
    )
    lines = [
        ("(1)", "f1 = 1 − **0.5** σ²/(σ² + 0.33)", "0.5", f"{half:.4f}"),
        ("(1)", "f1 = 1 − 0.5 σ²/(σ² + **0.33**)", "0.33", f"{third:.4f}"),
        ("(1)", "f2 = **0.17** σ²/(σ² + 0.13)", "0.17", f"{weight:.4f}"),
        ("(1)", "f2 = 0.17 σ²/(σ² + **0.13**)", "0.13", f"{width:.4f}"),
        ("1.2.1", "largest σ", "π/2", f"{rough / np.pi:g} π"),
        ("1.2.1", "largest f1, at σ = 0", "1", f"{f1_level:.4f}"),
        ("1.2.1", "smallest f1, at σ = π/2", "0.5590", f"{f1_rough:.4f}"),
        ("1.2.1", "largest f2, at σ = π/2", "0.1615", f"{f2_rough:.4f}"),
        ("1.2.1", "smallest f2, at σ = 0", "0", f"{f2_level:.4f}"),
        ("1.2.1", "r of ρ = 1 at σ = 0", "1", f"{float(reading.white_reading(level)):.4f}"),
        ("1.2.1", "r of ρ = 1 at σ = π/2", "0.7205", f"{float(reading.white_reading(rough)):.4f}"),
        ("1.2.1", "peak above which σ is bounded", "0.7205", f"{unbounded:.4f}"),
        ("1.2.1", "σ of the example", "π/4", f"{SIGMA / np.pi:g} π"),
        (
            "1.2.1",
            "a\\*b\\* distance of the example",
            f"{REPORTED}",
            f"{two.ab:.2f} (2°), {ten.ab:.2f} (10°)",
        ),
    ]
    return _markdown(("where", "what", "report", "here"), lines)


def _constants_of_the_weights() -> tuple[float, float, float, float]:
    """Take 0.5, 0.33, 0.17 and 0.13 back out of the core's f1 and f2.

    A σ²/(σ² + B) = w is σ²/w = (σ² + B)/A: a line, which two roughnesses fix.
    """
    s2 = np.array([0.1, 1.0])
    f1, f2 = reading.coefficients(np.sqrt(s2))
    found = []
    for weight in (1 - f1, f2):
        slope = float(np.diff(s2 / weight)[0] / np.diff(s2)[0])
        found += [1 / slope, float((s2 / weight)[0] / slope - s2[0])]
    first, second, third, fourth = found
    return first, second, third, fourth


def ranges_table() -> str:
    """Give the albedos that a reading of patch #14 and a bright one leave open."""
    lines = []
    for name, values in (
        ("green, 0.35 at most", (0.05, 0.2, 0.35)),
        ("bright, 0.8 at most", (0.05, 0.4, 0.8)),
    ):
        for model in ("two-bounce", "closure"):
            found = feasible.albedo_range(np.array(values), model)
            spans = (
                f"{low:.3f} to {high:.3f}"
                for low, high in zip(found.lowest, found.highest, strict=True)
            )
            cells = (f"{value:g}: {span}" for value, span in zip(values, spans, strict=True))
            lines.append((name, model, f"{np.degrees(found.sigma_max):.1f}°", *cells))
    return _markdown(("reading", "model", "σmax", "dark band", "middle", "peak"), lines)


def candidates_table(found: Sequence[Candidate]) -> str:
    """Name the greens, and the nearest of all others."""
    greens = {4: "foliage", 6: "bluish green", 11: "yellow green", 14: "green"}
    others = dict.fromkeys(c.number for c in found if c.number not in greens)
    kept = [*sorted(greens, key=lambda number: number != GREEN + 1), *list(others)[:NEAREST]]
    lines = []
    for number in kept:
        of_patch = {(c.data_set, c.observer): c for c in found if c.number == number}
        numbers = (of_patch[s, o].ab for s in DATA_SETS for o in OBSERVERS)
        name = next(iter(of_patch.values())).patch
        lines.append((f"#{number} {name}", *(f"{x:.2f}" for x in numbers)))
    head = ("patch", *(f"{short}, {o}°" for short in DATA_SETS for o in OBSERVERS))
    return _markdown(head, lines)


def green_table(table: Sequence[Row]) -> str:
    """Take the a*b* distance of patch #14 apart."""
    lines = []
    for observer in OBSERVERS:
        for row in _of(table, observer):
            if row.patch.startswith("14 "):
                numbers = (row.ab_darkening, row.ab_interreflection, row.ab, row.ab_equal)
                cells = (f"{number:.2f}" for number in numbers)
                lines.append((f"{observer}°", row.model, f"{row.k:.3f}", *cells))
    head = (
        "observer",
        "model",
        "k",
        "darkening",
        "interreflection",
        "in all",
        "at equal luminance",
    )
    return _markdown(head, lines)


def all_table(table: Sequence[Row]) -> str:
    """Tell what each model makes of patch #14 and of the 24 patches."""
    lines = []
    for observer in OBSERVERS:
        for model in BEYOND_FIRST:
            some = [row for row in _of(table, observer) if row.model == model]
            green = some[GREEN]
            cells = [f"{green.de00:.2f}", f"{green.de00_equal:.2f}"]
            for name in ("ab", "ab_equal", "de00", "de00_equal", "de00_from_reference"):
                numbers = np.array([getattr(row, name) for row in some])
                cells.append(f"{numbers.mean():.2f} / {numbers.max():.2f}")
            lines.append((f"{observer}°", model, *cells))
    head = (
        "observer",
        "model",
        "#14 ΔE00",
        "#14 ΔE00, equal Y",
        "a\\*b\\*",
        "a\\*b\\*, equal Y",
        "ΔE00",
        "ΔE00, equal Y",
        "ΔE00 from reference",
    )
    return _markdown(head, lines)


def variations_table(found: Iterable[Variation]) -> str:
    """Tell what moves the distance of patch #14."""
    lines = [
        (v.changed, *(f"{x:.2f}" for x in (v.ab_2, v.ab_10, v.ab_equal_2, v.ab_equal_10)))
        for v in found
    ]
    head = ("changed", "2°", "10°", "2°, equal luminance", "10°, equal luminance")
    return _markdown(head, lines)


def bounds_table() -> str:
    """Give σmax of peak readings under each model."""
    lines = []
    for peak in PEAKS:
        found = (largest_sigma(peak, model) for model in BEYOND_FIRST)
        ends = (models.find(model).largest_sigma - 0.5 for model in BEYOND_FIRST)
        cells = (
            "no bound" if s >= end else f"{s:.1f}°" for s, end in zip(found, ends, strict=True)
        )
        lines.append((f"{peak:g}", *cells))
    return _markdown(("peak reading", *BEYOND_FIRST), lines)


def white_table() -> str:
    """Compare the readings of white facets."""
    lines = []
    for degrees in (10, 20, 30, 45, 60, 90):
        place = 100 * degrees
        curves = (white_curve(model) for model in BEYOND_FIRST)
        cells = (f"{curve[place]:.4f}" if place < curve.size else "–" for curve in curves)
        lines.append((f"{degrees}°", *cells))
    return _markdown(("σ", *BEYOND_FIRST), lines)


def _of(table: Iterable[Row], observer: int) -> list[Row]:
    return [row for row in table if row.observer == observer]


def _markdown(head: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    rule = ["---"] + ["--:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (head, rule, *lines))


def fill(page: str, tables: dict[str, str]) -> str:
    """Put each table between its two comments in the page.

    Raises
    ------
    KeyError
        If the page asks for a table that isn't there.
    """

    def put(match: re.Match[str]) -> str:
        return f"{match[1]}\n\n{tables[match[2]]}\n\n{match[3]}"

    return re.sub(r"(<!-- table: ([\w-]+) -->).*?(<!-- end -->)", put, page, flags=re.DOTALL)


def main() -> int:
    """Write the CSV files and renew the tables of the page; returns the exit status."""
    colors, varied = report_2007.rows(), report_2007.variations()
    tried = report_2007.candidates()
    tables = {
        "printed": printed_table(colors),
        "ranges": ranges_table(),
        "candidates": candidates_table(tried),
        "green": green_table(colors),
        "variations": variations_table(varied),
        "bounds": bounds_table(),
        "white": white_table(),
        "all": all_table(colors),
    }
    with atomic_files.publication() as files:
        files.write(DATA / "report-2007.csv", colors_csv(colors).encode())
        files.write(DATA / "report-2007-curves.csv", curves_csv().encode())
        files.write(DATA / "report-2007-variations.csv", variations_csv(varied).encode())
        files.write(DATA / "report-2007-candidates.csv", candidates_csv(tried).encode())
        files.write(PAGE, fill(PAGE.read_text("utf-8"), tables).encode())
    return 0


if __name__ == "__main__":
    sys.exit(main())
