# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The chart's numbers as the tables of docs/chart.md. No matplotlib here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from tools.chart.chart_csv import (
    Numbers,
    blender_csv,
    blender_rows,
    matched,
    methods_csv,
    of_panel,
    speed_csv,
    truths_csv,
)
from tools.chart.chart_work import PANELS
from tools.run.run_command_line import ROOT

PAGE = ROOT / "docs" / "chart.md"
DATA = ROOT / "docs" / "data"
BEGIN = "<!-- Made by python3 dev.py chart -->"
END = "<!-- End of what python3 dev.py chart made -->"
HEADINGS = {
    "traced": "Any angle, traced Gaussian height fields",
    "angles": "Any angle, the V-cavity",
    "reading": "One reading at 45°/0°, the V-cavity",
}
SURFACES = {
    "V-cavity": "V-cavity",
    "gaussian": "Gaussian",
    "multi-scale": "multi-scale",
    "grains": "grains",
}


def write(numbers: Numbers, fronts: dict[str, list[str]]) -> None:
    """Write every CSV and the part of the page between the markers.

    Parameters
    ----------
    numbers
        What was measured.
    fronts
        Keys of the methods on each table's Pareto front.
    """
    DATA.mkdir(parents=True, exist_ok=True)
    for panel in PANELS:
        text = methods_csv(of_panel(numbers, panel), panel, panel, fronts[panel])
        _replace(DATA / f"chart-{panel}.csv", text)
    text = methods_csv(matched(numbers), "peers", "traced", fronts["peers"])
    _replace(DATA / "chart-peers.csv", text)
    _replace(DATA / "chart-truths.csv", truths_csv(numbers.truths))
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


def tables(numbers: Numbers, fronts: dict[str, list[str]]) -> str:
    """Everything between the page's markers, as Markdown."""
    parts = [_machine(numbers)]
    parts += ["### Every model, every surface", _truths(numbers.truths)]
    for panel, heading in HEADINGS.items():
        table = _methods(of_panel(numbers, panel), panel, fronts[panel])
        parts += [f"### {heading}", table]
    parts += ["### From one reading", _matched(matched(numbers), fronts["peers"])]
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
        f"{', '.join(versions)}, {numbers.blender['version']}. Took {machine['seconds']} s, "
        f"{machine['processor_seconds']} s of a processor."
    ]
    lines += [f"{row['label']} is missing: {row['missing']}." for row in missing]
    return "\n\n".join(lines)


def _methods(rows: list[dict[str, Any]], panel: str, front: list[str]) -> str:
    head = (
        "| method | cost (copy = 1) | median | ns | ΔE00 mean | 95 % | max "
        "| reflectance off by, mean | 95 % | max |\n|---|---|---|---|---|---|---|---|---|---|"
    )
    lines = []
    for row in rows:
        found = row["errors"][panel]
        relative = [_percent(value) for value in found["relative"] or []]
        cells = [*_named(row, PANELS[panel], front), *map(_small, found["delta_e"])]
        lines.append(_line([*cells, *(relative or [f"in {row['ends_in']}", "", ""])]))
    return "\n".join([head, *lines])


def _matched(rows: list[dict[str, Any]], front: list[str]) -> str:
    head = (
        "| who | cost (copy = 1) | median | ns | traced: ΔE00 mean | 95 % | max "
        "| V-cavity: mean | 95 % | max |\n|---|---|---|---|---|---|---|---|---|---|"
    )
    lines = []
    for row in rows:
        both = [*row["errors"]["traced"]["delta_e"], *row["errors"]["angles"]["delta_e"]]
        lines.append(_line([*_named(row, "angles", front), *map(_small, both)]))
    return "\n".join([head, *lines])


def _named(row: dict[str, Any], kind: str, front: list[str]) -> list[str]:
    """Name and costs of a method."""
    name = f"**{row['label']}**" if row["key"] in front else row["label"]
    best, middle, _ = row["ratio"][kind]
    mostly = f"; mostly {row['overhead']}" if row["overhead"] else ""
    costs = map(_rounded, (best, middle, row["cost"][kind][0]))
    return [f"{name}: {row['about']}{mostly}", *costs]


def _truths(truths: dict[str, Any]) -> str:
    """Mean ΔE00 over all angles and, behind the stroke, at 45°/0°."""
    names = [f"{SURFACES[kind]} {degrees}°" for kind, degrees in truths["surfaces"]]
    lines = [_line(["model", *names]), _line(["---"] * (1 + len(names)))]
    for key, pairs in {**truths["models"], "*noise of the traces*": truths["noise"]}.items():
        lines.append(_line([key, *(f"{_small(a)} / {_small(b)}" for a, b in pairs)]))
    return "\n".join(lines)


def _blender(numbers: dict[str, Any]) -> str:
    lines = ["| material | render time | σ | ΔE00 mean | 95 % | max |", "|---|---|---|---|---|---|"]
    for label, sigma, (low, middle, high), errors in blender_rows(numbers):
        time = "1" if low == high else f"{middle:.2f} ({low:.2f} to {high:.2f})"
        degrees = sigma if sigma == "all" else f"{sigma}°"
        lines.append(_line([label, time, degrees, *map(_small, errors)]))
    return "\n".join(lines)


def _line(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _speed(rows: list[dict[str, Any]]) -> str:
    lines = ["| what | measured | bound | accuracy |", "|---|---|---|---|"]
    for row in rows:
        lines.append(
            f"| {row['what']} | {row['ratio']:.2f} | {row['bound']:g} | {row['accuracy']} |"
        )
    return "\n".join(lines)


def _conversions(rows: list[dict[str, Any]]) -> str:
    lines = [
        "| how | cost (copy = 1) | ns a spectrum | XYZ off by | ΔE00 mean | max |",
        "|---|---|---|---|---|---|",
    ]
    names = {"matrix": "weights matrix after ASTM E308, one product for all"}
    for row in rows:
        name = names.get(row["key"], f"colour-science, {row['key']}")
        mean, _, most = row["delta_e"]
        cells = [name, _rounded(row["ratio"]), _rounded(row["ns"]), f"{row['apart']:.0e}"]
        lines.append(_line([*cells, _small(mean), _small(most)]))
    return "\n".join(lines)


def _rounded(value: float) -> str:
    """Two digits, without an exponent."""
    digits = max(0, 1 - int(np.floor(np.log10(value))))
    return f"{round(value, 1 - int(np.floor(np.log10(value)))):,.{digits}f}"


def _small(value: float) -> str:
    return f"{value:.2f}" if value >= 0.005 else "< 0.005"


def _percent(value: float) -> str:
    return f"{value:.2%}" if value >= 5e-5 else "< 0.005%"


def _replace(path: Path, text: str) -> None:
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)
