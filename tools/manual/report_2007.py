# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of docs/report-2007.md: tables of the page and CSV files in docs/data.

Needs colour-science, so `report_2007_figures.py` starts this file in an environment that has bpy
and draws the figures afterwards in one that has matplotlib.
"""

from __future__ import annotations

import csv
import io
import re
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.samples import presets
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support import atomic_files
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import reading, vcavity
from rough_spectra.core.color import color_difference

Array = NDArray[np.float64]

DOCS = ROOT / "docs"
PAGE = DOCS / "report-2007.md"
DATA = DOCS / "data"

SIGMA = np.pi / 4
"""Roughness of the report's example."""
GREEN = 13
"""Place of patch #14 among the presets."""
REPORTED = 3.83
"""The report's distance in the a*b* plane."""
OBSERVERS = (2, 10)
MODELS = ("first-order", "two-bounce", "closure", "reference")
BEYOND_FIRST = MODELS[1:]
PEAKS = (0.7205, 0.8, 0.9, 0.95, 0.99, 1.0)


@dataclass(frozen=True)
class Row:
    """What roughness does to the color of one patch, read at 45°/0°.

    Attributes
    ----------
    srgb
        The albedo under D65 as a screen shows it.
    k
        Luminance of the reading over that of the albedo.
    L, a, b, L_reading, a_reading, b_reading
        CIELAB of the albedo and of the reading.
    ab
        Distance of the two in the a*b* plane.
    ab_darkening
        The same from the albedo to the albedo scaled by k: no change but of luminance.
    ab_interreflection
        From there on to the reading: no change but of the spectrum's shape.
    ab_equal
        From the albedo to the reading scaled by 1/k: the luminance held equal.
    de00, de00_equal
        CIEDE2000 of the steps `ab` and `ab_equal`.
    duv_equal
        Distance in the CIE 1976 u'v' diagram, to which luminance does not matter.
    de00_from_reference
        CIEDE2000 from the reading that the reference predicts.
    """

    patch: str
    observer: int
    model: str
    srgb: str
    k: float
    L: float
    a: float
    b: float
    L_reading: float
    a_reading: float
    b_reading: float
    ab: float
    ab_darkening: float
    ab_interreflection: float
    ab_equal: float
    de00: float
    de00_equal: float
    duv_equal: float
    de00_from_reference: float


def predict(albedo: Array, sigma: float, model: str) -> Array:
    """Give the 45°/0° readings (..., bands) of one of `MODELS`."""
    if model == "reference":
        return vcavity.reading_from_albedo(albedo, sigma)
    return reading.from_albedo(albedo, sigma, model)


def ab_distance(first: Array, second: Array) -> Array:
    """Distance in the a*b* plane of Lab (..., 3)."""
    return np.asarray(np.linalg.norm((first - second)[..., 1:], axis=-1))


def uv(xyz: Array) -> Array:
    """CIE 1976 u', v' of XYZ (..., 3)."""
    denominator = xyz @ np.array([1.0, 15.0, 3.0])
    return np.stack((4 * xyz[..., 0] / denominator, 9 * xyz[..., 1] / denominator), axis=-1)


@lru_cache(maxsize=1)
def chart() -> tuple[list[Sample], Array, Array]:
    """Give the 24 patches, their wavelengths (bands,) and albedos (24, bands)."""
    samples = presets.load_all("colorchecker")
    return samples, samples[0].wavelengths, np.array([sample.values for sample in samples])


def rows() -> list[Row]:
    """Give a row for each patch, observer and model, under D65 at σ = π/4."""
    samples, wavelengths, albedo = chart()
    names = [sample.name.removeprefix("ColorChecker ") for sample in samples]
    screen = [_hex(xyz) for xyz in albedo @ tristimulus.weights(wavelengths)]
    found = []
    for observer in OBSERVERS:
        weights = tristimulus.weights(wavelengths, "D65", observer)
        white = weights.sum(axis=0)
        before = albedo @ weights
        lab = color_difference.xyz_to_lab(before, white)
        target = predict(albedo, SIGMA, "reference") @ weights
        for model in MODELS:
            after = predict(albedo, SIGMA, model) @ weights
            k = after[:, 1:2] / before[:, 1:2]
            lab_after, lab_darkened, lab_equal, lab_target = (
                color_difference.xyz_to_lab(xyz, white)
                for xyz in (after, k * before, after / k, target)
            )
            columns = (
                k[:, 0],
                *lab.T,
                *lab_after.T,
                ab_distance(lab, lab_after),
                ab_distance(lab, lab_darkened),
                ab_distance(lab_darkened, lab_after),
                ab_distance(lab, lab_equal),
                color_difference.delta_e(lab, lab_after),
                color_difference.delta_e(lab, lab_equal),
                np.linalg.norm(uv(before) - uv(after), axis=-1),
                color_difference.delta_e(lab_target, lab_after),
            )
            table = np.stack(columns, axis=-1).tolist()
            found += [
                Row(name, observer, model, color, *numbers)
                for name, numbers, color in zip(names, table, screen, strict=True)
            ]
    return found


@dataclass(frozen=True)
class Variation:
    """Patch #14 with one assumption changed: a*b* distances for the 2° and the 10° observer."""

    changed: str
    ab_2: float
    ab_10: float
    ab_equal_2: float
    ab_equal_10: float


def variations() -> list[Variation]:
    """Change one assumption of patch #14 at a time, to see what 3.83 could come from."""
    _, wavelengths, patches = chart()
    albedo = patches[GREEN]
    average = colour().SDS_COLOURCHECKERS["BabelColor Average"]["green"]
    coarse = (wavelengths >= 400) & (wavelengths <= 700) & (wavelengths % 10 == 0)
    behind = reading.to_albedo(albedo, SIGMA)
    lighter = _scale_that_gives(REPORTED, albedo, wavelengths)
    return [
        _variation("as above: Ohta's spectrum, D65", albedo, wavelengths),
        _variation(
            "another measured chart: BabelColor's average",
            np.asarray(average.values),
            np.asarray(average.wavelengths),
        ),
        _variation("400 to 700 nm by 10 nm only", albedo[coarse], wavelengths[coarse]),
        _variation("illuminant D50 in place of D65", albedo, wavelengths, "D50"),
        _variation("spectrum taken as the reading, albedo computed", behind, wavelengths),
        _variation("albedo 10 % higher in every band", 1.1 * albedo, wavelengths),
        _variation(
            f"albedo {lighter - 1:.0%} higher in every band".replace("%", " %"),
            lighter * albedo,
            wavelengths,
        ),
    ]


def _variation(
    changed: str, albedo: Array, wavelengths: Array, illuminant: str = "D65"
) -> Variation:
    pairs = np.array([_distances(albedo, wavelengths, illuminant, o) for o in OBSERVERS])
    return Variation(changed, *pairs.T.ravel().tolist())


def _distances(
    albedo: Array, wavelengths: Array, illuminant: str, observer: int
) -> tuple[float, float]:
    """Distance in the a*b* plane of the two-bounce reading: as it is, at equal luminance."""
    weights = tristimulus.weights(wavelengths, illuminant, observer)
    before, after = albedo @ weights, predict(albedo, SIGMA, "two-bounce") @ weights
    lab, as_is, equal = color_difference.xyz_to_lab(
        np.stack((before, after, after * before[1] / after[1])), weights.sum(axis=0)
    )
    return float(ab_distance(lab, as_is)), float(ab_distance(lab, equal))


def _scale_that_gives(distance: float, albedo: Array, wavelengths: Array) -> float:
    """Factor on the albedo at which the 10° observer sees `distance`, by bisection."""
    low, high = 1.0, 1.5
    for _ in range(40):
        middle = (low + high) / 2
        found, _equal = _distances(middle * albedo, wavelengths, "D65", 10)
        low, high = (middle, high) if found > distance else (low, middle)
    return low


def largest_sigma(peak: float, model: str) -> float:
    """Largest σ in degrees at which white facets still reach a peak reading; NaN if none does."""
    if model == "two-bounce":
        return float(np.degrees(reading.sigma_max(peak)))
    degrees = np.linspace(0, 90, 9001)
    # Energy is conserved to rounding by the closure.
    reached = degrees[white_curve(model) >= peak - 1e-12]
    return float(reached.max()) if reached.size else float("nan")


@lru_cache(maxsize=4)
def white_curve(model: str) -> Array:
    """Give the reading of white facets at σ = 0, 0.01 … 90°."""
    sigma = np.radians(np.linspace(0, 90, 9001))
    if model == "reference":
        return vcavity.reading_from_albedo(np.ones((sigma.size, 1)), sigma)[:, 0]
    return reading.white_reading(sigma, model)


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
    white = [white_curve(model)[::100] for model in BEYOND_FIRST]
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


def _csv(about: str, names: Sequence[str], lines: Iterable[Iterable[object]]) -> str:
    text = io.StringIO()
    text.write(f"# {about}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for line in lines:
        writer.writerow([f"{v:.6f}" if isinstance(v, float) else v for v in line])
    return text.getvalue()


def _hex(xyz: Array) -> str:
    encoded = np.clip(colour().XYZ_to_sRGB(xyz), 0, 1)
    return "#" + "".join(f"{round(255 * float(part)):02x}" for part in encoded)


# Tables of the page ------------------------------------------------------------------------------


def known_table() -> str:
    """Put f1, f2, r and σmax beside the values that the design notes give."""
    f1, f2 = (float(f) for f in reading.coefficients(np.pi / 2))
    lines = [
        ("f1(90°)", "0.5590", f"{f1:.4f}"),
        ("f2(90°)", "0.1615", f"{f2:.4f}"),
        ("r(ρ = 1, σ = 90°)", "0.7205", f"{f1 + f2:.4f}"),
    ]
    for peak, expected in ((0.8, "48.9°"), (0.9, "28.0°"), (0.95, "19.5°")):
        lines.append(
            (f"σmax of r = {peak:g}", expected, f"{largest_sigma(peak, 'two-bounce'):.1f}°")
        )
    return _markdown(("quantity", "design notes", "computed here"), lines)


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
        cells = ("no bound" if s >= 89.5 else f"{s:.1f}°" for s in found)
        lines.append((f"{peak:g}", *cells))
    return _markdown(("peak reading", *BEYOND_FIRST), lines)


def white_table() -> str:
    """Compare the readings of white facets."""
    lines = []
    for degrees in (10, 20, 30, 45, 60, 90):
        place = 100 * degrees
        cells = (f"{white_curve(model)[place]:.4f}" for model in BEYOND_FIRST)
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
    colors, varied = rows(), variations()
    tables = {
        "known": known_table(),
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
        files.write(PAGE, fill(PAGE.read_text("utf-8"), tables).encode())
    return 0


if __name__ == "__main__":
    sys.exit(main())
