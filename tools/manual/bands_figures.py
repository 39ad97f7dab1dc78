# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the figure of bands.md: renders against predicted ΔE00.

    python -m tools.manual.bands_figures

Needs matplotlib and numpy; the numbers are those of tools/benchmarks/bench_bands.py.
"""

import csv

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt

from tools.manual import figure_style
from tools.manual.emissivity_figures import IMAGES, STYLE
from tools.manual.figure_style import BLUE, GRAY, ORANGE, VERMILION
from tools.run.run_command_line import ROOT

DATA = ROOT / "docs" / "data" / "bands.csv"
LIGHTS = {"D65": BLUE, "A": VERMILION, "F11": ORANGE}
MARKS = {"RGB": "s", "RGB, matched to the light": "D", "RGB, matched, Rec.2020": "^"}


def main() -> None:
    """Draw it."""
    with DATA.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    with plt.rc_context(STYLE | {"figure.figsize": (7.6, 4.2)}):
        figure, axes = plt.subplots()
        for light, color in LIGHTS.items():
            of = [row for row in rows if row["light"] == light]
            for label, mark in MARKS.items():
                [row] = (row for row in of if row["picture"] == label)
                axes.plot(1, float(row["mean"]), mark, color=color, markersize=7)
            for apart, dash in ((False, "-"), (True, ":")):
                line = [
                    (int(row["renders"]), float(row["mean"]))
                    for row in of
                    if "bands" in row["picture"] and ("apart" in row["picture"]) == apart
                ]
                label = f"bands under {light}" + ", direct light apart" * apart
                axes.plot(*zip(*line, strict=True), dash, marker="o", color=color, label=label)
        for label, mark in MARKS.items():
            axes.plot([], [], mark, color=GRAY, label=label)
        axes.set_yscale("log")
        axes.set_xticks(range(1, 6))
        axes.set_xlabel("renders")
        axes.set_ylabel("mean ΔE00, predicted")
        axes.set_title("A closed room of ColorChecker patches")
        axes.legend(loc="upper right", fontsize=8)
        figure_style.save(figure, IMAGES / "bands", dpi=120)
        plt.close(figure)


if __name__ == "__main__":
    main()
