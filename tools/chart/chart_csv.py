# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The chart's numbers of one run, and the files of data that are made of them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from tools.chart.chart_work import GEOMETRIES, PANELS

TRUTHS = {
    "traced": "traced Gaussian height fields, sigma 15, 30 and 45 deg; light and view below 80 deg",
    "angles": (
        f"the V-cavity, sigma 10 to 50 deg; {GEOMETRIES} cosine-weighted geometries of light and "
        "view below 80 deg"
    ),
    "reading": "the V-cavity, sigma 10 to 50 deg; light at 45 deg, view along the normal",
    "peers": "traced Gaussian height fields and the V-cavity; all start from the 45/0 reading",
}


@dataclass(frozen=True)
class Numbers:
    """All that was measured in one run, as read from its JSON files."""

    rows: list[dict[str, Any]]
    truths: dict[str, Any]
    blender: dict[str, Any]
    speed: list[dict[str, Any]]
    conversions: list[dict[str, Any]]
    machine: dict[str, Any]

    def noise(self) -> float:
        """Mean ΔE00 that the traces of Gaussian fields are uncertain by."""
        pairs = zip(self.truths["surfaces"], self.truths["noise"], strict=True)
        return float(np.mean([noise for (kind, _), (noise, _) in pairs if kind == "gaussian"]))


def of_panel(numbers: Numbers, panel: str) -> list[dict[str, Any]]:
    """Rows of the methods that get albedo and roughness, cheapest first."""
    rows = [row for row in numbers.rows if not row.get("matched") and panel in row["errors"]]
    return by_cost(rows, PANELS[panel])


def matched(numbers: Numbers) -> list[dict[str, Any]]:
    """Rows of those that start from one reading, cheapest first."""
    rows = [row for row in numbers.rows if row.get("matched") and "errors" in row]
    return by_cost(rows, "angles")


def methods_csv(rows: list[dict[str, Any]], name: str, panel: str, front: list[str]) -> str:
    """One line a method; of those that start from a reading, errors against both truths."""
    both = name == "peers"
    header = [
        "key", "label", "group", "on_front", "mostly", "nanoseconds", "ratio_to_copy",
        "ratio_median", "ratio_upper_quartile", "delta_e_mean", "delta_e_95", "delta_e_max",
        "relative_mean", "relative_95", "relative_max", "ends_in", "threads", "version", "about",
    ]  # fmt: skip
    if both:
        header += ["cavity_delta_e_mean", "cavity_delta_e_95", "cavity_delta_e_max"]
    lines = []
    for row in rows:
        kind, found = PANELS[panel], row["errors"][panel]
        line = [row["key"], row["label"], row["group"], int(row["key"] in front), row["overhead"]]
        line += [f"{value:.7g}" for value in (row["cost"][kind][0], *row["ratio"][kind])]
        line += [f"{value:.7g}" for value in found["delta_e"]]
        line += [f"{value:.4g}" for value in found["relative"] or []] or [""] * 3
        line += [row["ends_in"], row["threads"], row["version"], row["about"]]
        if both:
            line += [f"{value:.7g}" for value in row["errors"]["angles"]["delta_e"]]
        lines.append(line)
    return _csv(
        "Cost of one spectrum (31 bands) in one geometry, float32, against CIEDE2000 (D65, CIE "
        "1931 2 deg) and relative reflectance error; ColorChecker N Ohta as the albedo, against "
        f"{TRUTHS[name]}",
        header,
        lines,
    )


def truths_csv(truths: dict[str, Any]) -> str:
    """One line a model and surface."""
    lines = []
    for key, pairs in {**truths["models"], "noise of the traces": truths["noise"]}.items():
        for (kind, degrees), (angles, ring) in zip(truths["surfaces"], pairs, strict=True):
            lines.append([key, kind, degrees, f"{angles:.7g}", f"{ring:.7g}"])
    return _csv(
        "Mean CIEDE2000 (D65, CIE 1931 2 deg) of each model against each surface, 24 patches as "
        "the albedo; all geometries below 80 deg, and 45/0",
        ["model", "surface", "sigma_degrees", "delta_e_any_angle", "delta_e_45_0"],
        lines,
    )


def blender_csv(numbers: dict[str, Any]) -> str:
    """Render time and error of both materials, over all σ and at each."""
    lines = []
    for label, sigma, ratio, errors in blender_rows(numbers):
        times = [f"{value:.4g}" for value in ratio]
        lines.append([label, sigma, *times, *(f"{value:.4g}" for value in errors)])
    return _csv(
        f"{numbers['version']}, Cycles CPU on one thread; CIEDE2000 between renders and the traced "
        "Gaussian height fields whose 45/0 reading was assigned, D65, CIE 1931 2 deg; patches "
        "within Rec.709",
        [
            "material", "sigma_degrees", "ratio_lower_quartile", "ratio_median",
            "ratio_upper_quartile", "delta_e_mean", "delta_e_95", "delta_e_max",
        ],
        lines,
    )  # fmt: skip


def blender_rows(numbers: dict[str, Any]) -> Iterator[tuple[str, Any, list[float], list[float]]]:
    """Label, σ, render times and errors of each line."""
    for key, label in (("lambert", "Lambert"), ("rough", "rough Diffuse, matched")):
        found = numbers[key]
        degrees = ["all", *numbers["sigmas"]]
        for sigma, errors in zip(degrees, [found["delta_e"], *found["by_sigma"]], strict=True):
            yield label, sigma, found["ratio"], errors


def speed_csv(numbers: Numbers) -> str:
    """Put the core beside plain numpy, and spectra to XYZ three ways."""
    lines = [[r["what"], f"{r['ratio']:.3g}", r["bound"], r["accuracy"]] for r in numbers.speed]
    lines += [
        [
            f"to XYZ: {r['key']} / copy",
            f"{r['ratio']:.3g}",
            "",
            f"XYZ within {r['apart']:.0e}, mean CIEDE2000 {r['delta_e'][0]:.1g}",
        ]
        for r in numbers.conversions
    ]
    about = "Ratios of times and of memory within one run, one thread"
    return _csv(about, ["what", "ratio", "bound", "accuracy"], lines)


def by_cost(rows: list[dict[str, Any]], kind: str) -> list[dict[str, Any]]:
    """Sort rows, cheapest first."""
    return sorted(rows, key=lambda row: float(row["ratio"][kind][0]))


def _csv(about: str, header: list[str], lines: list[list[Any]]) -> str:
    out = io.StringIO()
    out.write(f"# {about}\n")
    csv.writer(out, lineterminator="\n").writerows([header, *lines])
    return out.getvalue()
