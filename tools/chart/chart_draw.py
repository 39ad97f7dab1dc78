# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the chart from its numbers and write its tables: `python -m tools.chart.chart_draw FOLDER`.

Needs matplotlib. The numbers are those that tools.chart.chart left in FOLDER.
"""

from __future__ import annotations

import itertools
import os
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.transforms import Bbox

from tools.chart import chart_csv, chart_labels, chart_tables
from tools.chart.chart_figures import FIGURES, Figure
from tools.chart.chart_work import COST_NOISE, PANELS, pareto_front, read_json
from tools.run.run_command_line import ROOT

mpl.use("Agg")
from matplotlib import pyplot as plt

IMAGES = ROOT / "docs" / "images"

# Okabe and Ito's colors; shapes back them up for readers who see fewer.
BLACK, BLUE, VERMILION, GREEN, GRAY = "#000000", "#0072B2", "#C04F00", "#007A5A", "#767676"
STYLES: dict[str, dict[str, Any]] = {
    "rung": {"color": BLUE, "marker": "o", "markersize": 9},
    "naive": {"color": VERMILION, "marker": "s", "markersize": 7},
    "peer": {"color": GREEN, "marker": "D", "markersize": 7.5},
}
GROUPS = {"rung": "this project", "naive": "common shortcut", "peer": "other renderers"}

FLOOR = 0.02
"""Below this mean ΔE00 the axis ends: nobody sees it, and a truth is the zero of its own figure."""
TOLERANCE = 1.0
TICKS = (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20)

HARD_TO_SEE = "shaded: below 1, hard to see side by side"
ON_THE_LINE = "broad line, bold: nothing is cheaper and closer"
SPREADS = "thin lines: up to 95 % of errors, up to the median cost"

plt.rcParams.update(
    {
        "figure.dpi": 110,
        "font.family": "DejaVu Sans",
        "font.size": 10.5,
        "axes.titlesize": 13,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.axisbelow": True,
        "svg.hashsalt": "rough-spectra",
    }
)


def save(figure: Any, name: str) -> None:
    """Write SVG and PNG, each whole or not at all."""
    IMAGES.mkdir(parents=True, exist_ok=True)
    for ending, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
        part = IMAGES / f".{name}.{ending}.part"
        figure.savefig(part, format=ending, metadata=metadata)
        os.replace(part, IMAGES / f"{name}.{ending}")
    plt.close(figure)


def front_of(rows: list[dict[str, Any]], panel: str) -> list[dict[str, Any]]:
    """Rows that nothing beats in both cost and mean ΔE00, cheapest first."""
    # Equal errors of methods that compute the same differ in the last digits of a float.
    points = [
        (row["ratio"][PANELS[panel]][0], round(row["errors"][panel]["delta_e"][0], 6))
        for row in rows
    ]
    return [rows[index] for index in pareto_front(points, COST_NOISE)]


def cost_against_error(figure_of: Figure, rows: list[dict[str, Any]], noise: float) -> None:
    """One point a method: cost to the right, error upwards, both logarithmic.

    Parameters
    ----------
    figure_of
        What to draw.
    rows
        Of its methods.
    noise
        Mean ΔE00 that the traces themselves are uncertain by; drawn where it can be seen.
    """
    panel, cost = figure_of.panel, PANELS[figure_of.panel]
    figure, axes = plt.subplots(figsize=(8.6, 5.6), layout="constrained")
    axes.set(xscale="log", yscale="log")
    axes.set_title(figure_of.title, fontweight="bold", pad=24)
    axes.text(0, 1.02, figure_of.truth, transform=axes.transAxes, color=GRAY, va="bottom")
    costs = [row["ratio"][cost][0] for row in rows]
    axes.set_xlim(min(costs) / 2.5, max(costs) * 4)
    least, most = (limit(_shown(row, panel) for row in rows) for limit in (min, max))
    floor = FLOOR / 1.35 if least < 10 * FLOOR else least / 3
    axes.set_ylim(floor, 4.5 * most)
    axes.set_xlabel("cost of a spectrum in one geometry (copying its 31 bands = 1)")
    axes.set_ylabel("color error ΔE00")
    axes.set_yticks([tick for tick in TICKS if floor < tick < 4.5 * most])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_minor_locator(mpl.ticker.NullLocator())
    axes.xaxis.set_major_formatter(lambda value, _: _count(value))
    axes.grid(axis="y", color="#ececec")
    axes.axhspan(floor, TOLERANCE, color="#f3f7fa", zorder=0)
    front = front_of(rows, panel)
    line = [(row["ratio"][cost][0], _shown(row, panel)) for row in front]
    axes.step(*zip(*line, strict=True), where="post", color=BLUE, alpha=0.22, linewidth=7, zorder=1)
    _key(figure, rows)
    order = {row["key"]: place for place, row in enumerate(front)}
    figure.draw_without_rendering()
    labels, obstacles = [], []
    for row in sorted(
        rows, key=lambda row: (order.get(row["key"], len(order)), -_shown(row, panel))
    ):
        obstacles += _mark(axes, row, panel)
        bold = row["key"] in order
        text = row["label"]
        if row["key"] == "reference" and panel != "traced":
            text += "\n(zero by definition)"
        style = {"color": STYLES[row["group"]]["color"], "fontsize": 10}
        style["fontweight"] = "bold" if bold else "normal"
        # Below the line there is nothing, by what the line is.
        prefer = -120 if bold and _shown(row, panel) > FLOOR else 20
        labels.append((row["ratio"][cost][0], _shown(row, panel), text, prefer, style))
    for (x0, y0), (x1, y1) in itertools.pairwise(line):
        (left, level), (right, down) = axes.transData.transform([(x0, y0), (x1, y1)])
        obstacles.append(Bbox.from_extents(left, level - 4, right, level + 4))
        obstacles.append(Bbox.from_extents(right - 4, down, right + 4, level))
    texts = []
    if panel == "traced" and noise > FLOOR / 1.3:
        texts.append(_noise(axes, noise))
        (left, level), (right, _) = axes.transData.transform([(x, noise) for x in axes.get_xlim()])
        obstacles.append(Bbox.from_extents(left, level - 1, right, level + 1))
    chart_labels.write(axes, labels, obstacles, texts)
    save(figure, f"chart-{figure_of.name}")


def _shown(row: dict[str, Any], panel: str) -> float:
    return float(max(row["errors"][panel]["delta_e"][0], FLOOR))


def _mark(axes: Axes, row: dict[str, Any], panel: str) -> list[Bbox]:
    """Draw one method with its spreads; returns what the lines cover, pixels."""
    style = STYLES[row["group"]]
    x, slow, _ = row["ratio"][PANELS[panel]]
    y, high = _shown(row, panel), row["errors"][panel]["delta_e"][1]
    face = "white" if row["overhead"] else style["color"]
    axes.plot([x], [y], **style, markerfacecolor=face, markeredgewidth=1.8, zorder=4)
    thin = {"color": style["color"], "alpha": 0.4, "linewidth": 1.5, "zorder": 2}
    axes.plot([x, slow], [y, y], **thin)
    (px, low), (far, _) = axes.transData.transform([(x, y), (slow, y)])
    covered = [Bbox.from_extents(px, low - 1, far, low + 1)]
    if high > FLOOR:
        axes.plot([x, x], [y, high], **thin)
        _, top = axes.transData.transform((x, high))
        covered.append(Bbox.from_extents(px - 1, low, px + 1, top))
    else:
        arrow = {"arrowstyle": "->", "color": style["color"]}
        axes.annotate("", (x, FLOOR / 1.3), (x, FLOOR), arrowprops=arrow)
    return covered


def _noise(axes: Axes, noise: float) -> Bbox:
    """Say below what the traces can't tell; returns the place the words take."""
    axes.axhline(noise, color=GRAY, linewidth=1, linestyle=(0, (4, 3)), zorder=1)
    words = axes.text(0.995, noise * 1.06, "noise of the traces", color=GRAY, ha="right")
    words.set(transform=axes.get_yaxis_transform(), fontsize=9)
    return words.get_window_extent().padded(3)


def _key(figure: Any, rows: list[dict[str, Any]]) -> None:
    """Say under the axes what the marks that are there mean."""

    def mark(style: dict[str, Any], words: str) -> Line2D:
        return Line2D([], [], linestyle="none", markeredgewidth=1.8, label=words, **style)

    groups = [group for group in STYLES if any(row["group"] == group for row in rows)]
    handles: list[Any] = [mark(STYLES[group], GROUPS[group]) for group in groups]
    opened = sorted({row["overhead"] for row in rows if row["overhead"]})
    if opened:
        style = {"color": GRAY, "marker": "D", "markersize": 7.5, "markerfacecolor": "white"}
        handles.append(mark(style, f"open: cost is mostly {' or '.join(opened)}"))
    handles.append(Patch(color="#e4edf4", label=HARD_TO_SEE))
    handles.append(Line2D([], [], color=BLUE, alpha=0.3, linewidth=7, label=ON_THE_LINE))
    cross = {"color": GRAY, "marker": "+", "markersize": 13}
    handles.append(mark(cross, SPREADS))
    figure.legend(handles=handles, loc="outside lower left", ncols=2, frameon=False, fontsize=9)
    figure.draw_without_rendering()


def _count(value: float) -> str:
    """Write 10000 as 10,000 and a million in words."""
    return f"{value / 1e6:g} million" if value >= 1e6 else f"{value:,g}"


def blender(numbers: dict[str, Any]) -> None:
    """Render time against error: a line from Lambert to rough Diffuse for each roughness."""
    figure, axes = plt.subplots(figsize=(8.2, 5.2), layout="constrained")
    low, ratio, slow = numbers["rough"]["ratio"]
    room = max(abs(ratio - 1), 0.05)
    axes.set(xlim=(1 - 0.75 * room, max(1, slow) + 0.75 * room), ylim=(0, None))
    axes.axhspan(0, TOLERANCE, color="#f3f7fa", zorder=0)
    spread = _apart([row[0] for row in numbers["lambert"]["by_sigma"]], 0.17)
    for index, sigma in enumerate(numbers["sigmas"]):
        lambert = numbers["lambert"]["by_sigma"][index][0]
        rough = numbers["rough"]["by_sigma"][index][0]
        axes.plot([1, ratio], [lambert, rough], color="#b9c6cf", linewidth=1.2, zorder=1)
        axes.plot([1], [lambert], **STYLES["naive"], zorder=3)
        axes.plot([ratio], [rough], **STYLES["rung"], zorder=3)
        axes.plot([low, slow], [rough, rough], color=BLUE, alpha=0.4, linewidth=1.5)
        axes.annotate(
            f"σ = {sigma:.0f}°",
            (1, spread[index]),
            (-9, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            color=VERMILION,
        )
    top = max(row[0] for row in numbers["lambert"]["by_sigma"])
    axes.annotate(
        "Lambert",
        (1, top),
        (0, 12),
        textcoords="offset points",
        ha="center",
        color=VERMILION,
        fontweight="bold",
    )
    best = max(row[0] for row in numbers["rough"]["by_sigma"])
    axes.annotate(
        f"rough Diffuse, matched\n{numbers['rough']['delta_e'][0]:.2f} in the mean",
        (ratio, best),
        (12, 0),
        textcoords="offset points",
        va="center",
        color=BLUE,
        fontweight="bold",
    )
    words = HARD_TO_SEE
    axes.text(0.99, 0.015, words, color=GRAY, ha="right", transform=axes.transAxes)
    title = "In Cycles: what does a rough material cost, and gain?"
    axes.set_title(title, fontweight="bold", pad=24)
    truth = "rendered, against traced Gaussian height fields, light and view below 80°"
    axes.text(0, 1.02, truth, transform=axes.transAxes, color=GRAY, va="bottom")
    axes.set_xlabel("render time (Lambert = 1; line: middle half of the turns)")
    axes.set_ylabel("mean color error ΔE00")
    axes.set_ylim(0, top * 1.16)
    axes.set_xticks(sorted({1.0, round(ratio, 2)}))
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.grid(axis="y", color="#ececec")
    save(figure, "chart-blender")


def _apart(values: list[float], least: float) -> list[float]:
    """Heights for labels of rising values that keep a distance."""
    out: list[float] = []
    for value in values:
        out.append(value if not out else max(value, out[-1] + least))
    return out


def main(folder: Path) -> None:
    """Draw all figures, then write all tables."""
    numbers = chart_csv.Numbers(
        *(
            read_json(folder / f"{name}.json")
            for name in ("measured", "truths", "blender", "speed", "conversions", "machine")
        )
    )
    noise = numbers.noise()
    for figure in FIGURES:
        known = {row["key"]: row for row in numbers.rows if figure.panel in row.get("errors", ())}
        rows = [known[key] for key in figure.keys if key in known]
        cost_against_error(figure, rows, noise)
    blender(numbers.blender)
    parts = {panel: chart_csv.of_panel(numbers, panel) for panel in PANELS}
    parts["peers"] = chart_csv.matched(numbers)
    chart_tables.write(
        numbers,
        {
            panel: [row["key"] for row in front_of(rows, "traced" if panel == "peers" else panel)]
            for panel, rows in parts.items()
        },
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
