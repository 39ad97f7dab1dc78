# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The chart's numbers as CSV and as the tables of docs/chart.md. No matplotlib here."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tools.chart.chart_work import GEOMETRIES, PANELS, SIGMAS
from tools.run.run_command_line import ROOT

PAGE = ROOT / "docs" / "chart.md"
DATA = ROOT / "docs" / "data"
BEGIN = "<!-- Made by python3 dev.py chart -->"
END = "<!-- End of what python3 dev.py chart made -->"
DEGREES = [round(float(sigma)) for sigma in np.degrees(SIGMAS)]
HEADINGS = {"angles": "Any angle below 80°", "reading": "One reading at 45°/0°"}


@dataclass(frozen=True)
class Numbers:
    """All that was measured in one run, as read from its JSON files."""

    rows: list[dict[str, Any]]
    blender: dict[str, Any]
    speed: list[dict[str, Any]]
    conversions: list[dict[str, Any]]
    machine: dict[str, Any]


def write(numbers: Numbers, fronts: dict[str, list[str]]) -> None:
    """Write every CSV and the part of the page between the markers.

    Parameters
    ----------
    numbers
        What was measured.
    fronts
        Keys of the methods on each panel's Pareto front.
    """
    DATA.mkdir(parents=True, exist_ok=True)
    for panel in PANELS:
        _replace(DATA / f"chart-{panel}.csv", methods_csv(numbers, panel, fronts[panel]))
    _replace(DATA / "chart-blender.csv", blender_csv(numbers.blender))
    _replace(DATA / "chart-speed.csv", speed_csv(numbers))
    page = PAGE.read_text(encoding="utf-8")
    _replace(PAGE, between_markers(page, tables(numbers, fronts)))


def between_markers(page: str, new: str) -> str:
    """Put `new` between the two markers of a page, each on its own line.

    Raises
    ------
    ValueError
        If a marker is missing.
    """
    head, begin, rest = page.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"docs/chart.md needs the lines {BEGIN!r} and {END!r}.")
    return f"{head}{begin}\n\n{new.strip()}\n\n{end}{tail}"


def methods_csv(numbers: Numbers, panel: str, front: list[str]) -> str:
    """One line a method of one panel, cheapest first."""
    header = [
        "key", "label", "group", "on_front", "nanoseconds", "ratio_to_copy",
        "delta_e_mean", "delta_e_95", "delta_e_max",
        "relative_mean", "relative_95", "relative_max", "ends_in", "threads", "version", "about",
    ]  # fmt: skip
    lines = []
    for row in _by_cost(numbers.rows, panel):
        found = row[panel]
        relative = found["relative"] or ["", "", ""]
        lines.append(
            [row["key"], row["label"], row["group"], int(row["key"] in front)]
            + [f"{found['ns']:.4g}", f"{found['ratio']:.4g}"]
            + [f"{value:.4g}" for value in found["delta_e"]]
            + [f"{value:.4g}" if value != "" else "" for value in relative]
            + [row["ends_in"], row["threads"], row["version"], row["about"]]
        )
    return _csv(
        "Cost of one spectrum (31 bands) in one geometry, float32, against CIEDE2000 (D65, CIE "
        "1931 2 deg) and relative reflectance error to the V-cavity reference; ColorChecker N Ohta "
        f"as the albedo, sigma 10 to 50 deg; {_where(panel)}",
        header,
        lines,
    )


def _where(panel: str) -> str:
    if panel == "reading":
        return "light at 45 deg, view along the normal"
    return f"{GEOMETRIES} cosine-weighted geometries of light and view below 80 deg"


def blender_csv(numbers: dict[str, Any]) -> str:
    """Render time and error of both materials, over all σ and at each."""
    lines = []
    for key, label in (("lambert", "Lambert"), ("rough", "rough Diffuse")):
        found = numbers[key]
        for sigma, errors in zip(
            ["all", *DEGREES], [found["delta_e"], *found["by_sigma"]], strict=True
        ):
            values = [f"{value:.4g}" for value in errors]
            lines.append([label, sigma, f"{found['ratio']:.4g}", *values])
    return _csv(
        f"{numbers['version']}, Cycles CPU on one thread; CIEDE2000 between renders and the "
        "V-cavity reference whose 45a:0 reading was assigned, D65, CIE 1931 2 deg; patches within "
        "Rec.709",
        [
            "material",
            "sigma_degrees",
            "render_time_ratio",
            "delta_e_mean",
            "delta_e_95",
            "delta_e_max",
        ],
        lines,
    )


def speed_csv(numbers: Numbers) -> str:
    """Put the core beside plain numpy, and spectra to XYZ three ways."""
    lines = [[r["what"], f"{r['ratio']:.3g}", r["bound"], r["accuracy"]] for r in numbers.speed]
    lines += [
        [f"to XYZ: {r['key']} / copy", f"{r['ratio']:.3g}", "", f"XYZ within {r['apart']:.0e}"]
        for r in numbers.conversions
    ]
    about = "Ratios of times and of memory within one run, one thread"
    return _csv(about, ["what", "ratio", "bound", "accuracy"], lines)


def tables(numbers: Numbers, fronts: dict[str, list[str]]) -> str:
    """Everything between the page's markers, as Markdown."""
    parts = [_machine(numbers)]
    for panel in PANELS:
        parts += [f"### {HEADINGS[panel]}", _methods(numbers, panel, fronts[panel])]
    parts += ["### In Cycles", _blender(numbers.blender)]
    parts += ["### Speed of the core", _speed(numbers.speed)]
    parts += ["### Spectra to XYZ", _conversions(numbers.conversions)]
    return "\n\n".join(parts)


def _machine(numbers: Numbers) -> str:
    machine = numbers.machine
    versions = sorted({row["version"] for row in numbers.rows if "version" in row})
    missing = [row for row in numbers.rows if "missing" in row]
    lines = [
        f"Measured on one thread: {machine['processor']}, {machine['cores']} cores, "
        f"{machine['system']}, Python {machine['python']}, load up to {machine['load']:.1f}: "
        f"{', '.join(versions)}, {numbers.blender['version']}."
    ]
    lines += [f"{row['label']} is missing: {row['missing']}." for row in missing]
    return "\n\n".join(lines)


def _methods(numbers: Numbers, panel: str, front: list[str]) -> str:
    head = (
        "| method | cost (copy = 1) | ns | ΔE00 mean | 95 % | max | reflectance off by, mean "
        "| 95 % | max |\n|---|---|---|---|---|---|---|---|---|"
    )
    lines = []
    for row in _by_cost(numbers.rows, panel):
        found = row[panel]
        name = f"**{row['label']}**" if row["key"] in front else row["label"]
        relative = [_percent(value) for value in found["relative"] or []]
        cells = [f"{name}: {row['about']}", _rounded(found["ratio"]), _rounded(found["ns"])]
        cells += [_small(value) for value in found["delta_e"]]
        cells += relative or [f"in {row['ends_in']}", "", ""]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join([head, *lines])


def _blender(numbers: dict[str, Any]) -> str:
    lines = ["| material | render time | σ | ΔE00 mean | 95 % | max |", "|---|---|---|---|---|---|"]
    for key, label in (("lambert", "Lambert"), ("rough", "rough Diffuse, matched")):
        found = numbers[key]
        names = ["all", *(f"{sigma:.0f}°" for sigma in DEGREES)]
        for name, errors in zip(names, [found["delta_e"], *found["by_sigma"]], strict=True):
            cells = [label, f"{found['ratio']:.2f}", name, *(_small(value) for value in errors)]
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _speed(rows: list[dict[str, Any]]) -> str:
    lines = ["| what | measured | bound | accuracy |", "|---|---|---|---|"]
    for row in rows:
        lines.append(
            f"| {row['what']} | {row['ratio']:.2f} | {row['bound']:g} | {row['accuracy']} |"
        )
    return "\n".join(lines)


def _conversions(rows: list[dict[str, Any]]) -> str:
    lines = ["| how | cost (copy = 1) | ns a spectrum | XYZ off by |", "|---|---|---|---|"]
    names = {"matrix": "weights matrix, one product for all"}
    for row in rows:
        name = names.get(row["key"], f"colour-science, {row['key']}")
        lines.append(
            f"| {name} | {_rounded(row['ratio'])} | {_rounded(row['ns'])} | {row['apart']:.0e} |"
        )
    return "\n".join(lines)


def _by_cost(rows: list[dict[str, Any]], panel: str) -> list[dict[str, Any]]:
    return sorted((row for row in rows if panel in row), key=lambda row: float(row[panel]["ratio"]))


def _rounded(value: float) -> str:
    """Two digits, without an exponent."""
    digits = max(0, 1 - int(np.floor(np.log10(value))))
    return f"{round(value, 1 - int(np.floor(np.log10(value)))):,.{digits}f}"


def _small(value: float) -> str:
    return f"{value:.2f}" if value >= 0.005 else "< 0.005"


def _percent(value: float) -> str:
    return f"{value:.2%}" if value >= 5e-5 else "< 0.005%"


def _csv(about: str, header: list[str], lines: list[list[Any]]) -> str:
    out = io.StringIO()
    out.write(f"# {about}\n")
    csv.writer(out, lineterminator="\n").writerows([header, *lines])
    return out.getvalue()


def _replace(path: Path, text: str) -> None:
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)
