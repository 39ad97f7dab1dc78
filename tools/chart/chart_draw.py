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
from matplotlib.transforms import Bbox

from tools.chart import chart_labels, chart_tables
from tools.chart.chart_work import COST_NOISE, pareto_front, read_json
from tools.run.run_command_line import ROOT

mpl.use("Agg")
from matplotlib import pyplot as plt

IMAGES = ROOT / "docs" / "images"

# Okabe and Ito's colors; shapes back them up for readers who see fewer.
BLACK, BLUE, VERMILION, GREEN, GRAY = "#000000", "#0072B2", "#C04F00", "#007A5A", "#767676"
STYLES: dict[str, dict[str, Any]] = {
    "rung": {"color": BLUE, "marker": "o", "markersize": 8},
    "naive": {"color": VERMILION, "marker": "s", "markersize": 6},
    "peer": {"color": GREEN, "marker": "D", "markersize": 6.5},
}
GROUPS = {"rung": "● this project", "naive": "■ common shortcuts", "peer": "◆ other programs"}

FLOOR = 0.02
"""Below this mean ΔE00 the axis ends: nobody sees it, and the reference is the zero."""
TOLERANCE = 1.0

HARD_TO_SEE = "shaded: ΔE00 below 1, hard to see side by side"
KEY_TOP, KEY_LINE = 0.44, 0.042

TITLES = {
    "angles": "How wrong at what cost: any light and view below 80°",
    "reading": "How wrong at what cost: one instrument reading, 45°/0°",
}

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
    points = [(row[panel]["ratio"], round(row[panel]["delta_e"][0], 6)) for row in rows]
    return [rows[index] for index in pareto_front(points, COST_NOISE)]


def cost_against_error(rows: list[dict[str, Any]], panel: str) -> None:
    """One point a method: cost to the right, error upwards, both logarithmic."""
    figure, axes = plt.subplots(figsize=(9.6, 6.2), layout="constrained")
    axes.set(xscale="log", yscale="log", title=TITLES[panel])
    costs = [row[panel]["ratio"] for row in rows]
    axes.set_xlim(min(costs) / 6, max(costs) * 3.5)
    axes.set_ylim(FLOOR / 1.35, 16)
    axes.set_xlabel("cost of one spectrum in one geometry (copying its 31 bands = 1)")
    axes.set_ylabel("color error ΔE00 (mark: mean, line up to the 95th percentile)")
    axes.set_yticks([0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_minor_locator(mpl.ticker.NullLocator())
    axes.xaxis.set_major_formatter(lambda value, _: _count(value))
    axes.grid(axis="y", color="#ececec")
    axes.axhspan(FLOOR / 1.35, TOLERANCE, color="#f3f7fa", zorder=0)
    front = front_of(rows, panel)
    line = [(row[panel]["ratio"], max(row[panel]["delta_e"][0], FLOOR)) for row in front]
    axes.step(*zip(*line, strict=True), where="post", color=BLUE, alpha=0.22, linewidth=7, zorder=1)
    obstacles = []
    order = {id(row): place for place, row in enumerate(front)}
    figure.draw_without_rendering()
    labels = []
    for row in sorted(
        rows, key=lambda row: (order.get(id(row), len(order)), -row[panel]["delta_e"][0])
    ):
        style = STYLES[row["group"]]
        x, (mean, high, _) = row[panel]["ratio"], row[panel]["delta_e"]
        y = max(mean, FLOOR)
        on_front = id(row) in order
        axes.plot(
            [x],
            [y],
            **style,
            markerfacecolor=style["color"] if on_front else "white",
            markeredgewidth=1.6,
            zorder=4,
        )
        if high > FLOOR:
            axes.plot([x, x], [y, high], color=style["color"], alpha=0.35, linewidth=1.4, zorder=2)
            (px, low), (_, top) = axes.transData.transform([(x, y), (x, high)])
            obstacles.append(Bbox.from_extents(px - 1, low, px + 1, top))
        else:
            axes.annotate(
                "",
                (x, FLOOR / 1.3),
                (x, FLOOR),
                arrowprops={"arrowstyle": "->", "color": style["color"]},
            )
        text = row["label"].replace(", ", ",\n") if on_front else row["label"]
        if row["key"] == "reference":
            text += "\n(the zero of this axis)"
        weight = "bold" if on_front else "normal"
        style = {"color": style["color"], "fontweight": weight, "fontsize": 9.5}
        # Below the line there is nothing, by what the line is.
        labels.append((x, y, text, -120 if on_front and high > FLOOR else 20, style))
    for (x0, y0), (x1, y1) in itertools.pairwise(line):
        (left, level), (right, down) = axes.transData.transform([(x0, y0), (x1, y1)])
        obstacles.append(Bbox.from_extents(left, level - 4, right, level + 4))
        obstacles.append(Bbox.from_extents(right - 4, down, right + 4, level))
    chart_labels.write(axes, labels, obstacles, _key(figure, axes))
    save(figure, f"chart-{panel}")


def _key(figure: Any, axes: Any) -> list[Any]:
    """Say what shapes and the broad line mean; returns the place it takes."""
    boxes = []
    for line, (group, words) in enumerate(GROUPS.items()):
        color = STYLES[group]["color"]
        boxes.append(
            axes.text(0.995, KEY_TOP - KEY_LINE * line, words, color=color, ha="right", va="top")
        )
    words = "filled, on the broad line:\nnothing is cheaper and closer"
    boxes.append(
        axes.text(0.995, KEY_TOP - KEY_LINE * len(GROUPS), words, color=BLUE, ha="right", va="top")
    )
    top = KEY_TOP - KEY_LINE * (len(GROUPS) + 2)
    boxes.append(axes.text(0.995, top, HARD_TO_SEE, color=GRAY, ha="right", va="top"))
    for text in boxes:
        text.set_transform(axes.transAxes)
        text.set_fontsize(9.5)
    figure.draw_without_rendering()
    return [text.get_window_extent().padded(3) for text in boxes]


def _count(value: float) -> str:
    """Write 10000 as 10,000 and a million in words."""
    return f"{value / 1e6:g} million" if value >= 1e6 else f"{value:,g}"


def blender(numbers: dict[str, Any], degrees: list[int]) -> None:
    """Render time against error: a line from Lambert to rough Diffuse for each roughness."""
    figure, axes = plt.subplots(figsize=(8.2, 5.2), layout="constrained")
    ratio = numbers["rough"]["ratio"]
    room = max(abs(ratio - 1), 0.05)
    axes.set(xlim=(1 - 0.75 * room, max(1, ratio) + 0.75 * room), ylim=(0, None))
    axes.axhspan(0, TOLERANCE, color="#f3f7fa", zorder=0)
    spread = _apart([row[0] for row in numbers["lambert"]["by_sigma"]], 0.17)
    for index, sigma in enumerate(degrees):
        lambert = numbers["lambert"]["by_sigma"][index][0]
        rough = numbers["rough"]["by_sigma"][index][0]
        axes.plot([1, ratio], [lambert, rough], color="#b9c6cf", linewidth=1.2, zorder=1)
        axes.plot([1], [lambert], **STYLES["naive"], zorder=3)
        axes.plot([ratio], [rough], **STYLES["rung"], zorder=3)
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
    axes.text(0.99, 0.015, HARD_TO_SEE, color=GRAY, ha="right", transform=axes.transAxes)
    axes.set_title("In Cycles: what a rough material costs and gains")
    axes.set_xlabel("render time (Lambert = 1)")
    axes.set_ylabel("mean color error ΔE00 below 80°")
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
    rows = read_json(folder / "measured.json")
    for panel in TITLES:
        cost_against_error([row for row in rows if panel in row], panel)
    numbers = read_json(folder / "blender.json")
    blender(numbers, chart_tables.DEGREES)
    chart_tables.write(
        chart_tables.Numbers(
            rows,
            numbers,
            read_json(folder / "speed.json"),
            read_json(folder / "conversions.json"),
            read_json(folder / "machine.json"),
        ),
        {
            panel: [row["key"] for row in front_of([r for r in rows if panel in r], panel)]
            for panel in TITLES
        },
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
