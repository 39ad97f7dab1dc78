# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the figure of estimate.md: what each kind of readings tells of σ.

    python -m tools.manual.estimate_figures

Needs matplotlib and numpy. Grays of 31 bands, read without noise; the interval is what noise of
0.1 % of the reading leaves open. Dots stand where σ can't be told.
"""

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from core import estimate, reading
from core.estimate import Reading
from tools.manual import figure_style
from tools.manual.figure_style import BLUE, ORANGE, TEAL, VERMILION
from tools.run.run_command_line import ROOT

IMAGES = ROOT / "docs" / "images"
COLORS = {5: ORANGE, 15: TEAL, 30: BLUE, 45: VERMILION}
BANDS = 31
ALBEDOS = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98, 1])
KINDS = {
    "A smooth and a rough reading": (None, "45a:0"),
    "Three angles, no smooth reading": ("45as25", "45as45", "45as75"),
    "45°/0° and a sphere": ("45a:0", "di:8"),
}
STYLE = {
    "figure.figsize": (9.6, 3.7),
    "figure.constrained_layout.use": True,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "legend.frameon": False,
    "svg.hashsalt": "rough-spectra",
    "svg.fonttype": "none",
    "font.size": 9,
}


def read(albedo, degrees, instruments):
    gray = np.full(BANDS, albedo)
    return [
        Reading(gray, rough=False)
        if instrument is None
        else Reading(
            reading.from_albedo(gray, np.radians(degrees), estimate.MODEL, instrument),
            instrument=instrument,
        )
        for instrument in instruments
    ]


def widths(degrees, instruments):
    """Half the interval of each albedo, degrees, and whether σ can be told."""
    half, told = [], []
    for albedo in ALBEDOS:
        readings = read(albedo, degrees, instruments)
        draws = np.array([[of.values for of in readings]])
        _, [(low, high)] = estimate.of_draws(readings, draws)
        half.append(np.degrees(high - low) / 2)
        told.append(estimate.sigma(readings, others=()).is_told)
    return np.array(half), np.array(told)


def main():
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(1, len(KINDS), sharey=True)
    for axis, (title, instruments) in zip(axes, KINDS.items(), strict=True):
        for degrees, color in COLORS.items():
            half, told = widths(degrees, instruments)
            shown = np.where(told, half, np.nan)
            axis.plot(ALBEDOS, shown, color=color, lw=2, marker="o", ms=3, label=f"σ = {degrees}°")
            axis.plot(ALBEDOS[~told], half[~told], ".", color=color, ms=4, alpha=0.35)
        axis.set(title=title, yscale="log", ylim=(0.005, 40), xlim=(0, 1.02), xlabel="albedo")
    axes[0].set_ylabel("σ is told to ± degrees (95 %)")
    axes[0].set_yticks([0.01, 0.1, 1, 10], ["0.01", "0.1", "1", "10"])
    axes[0].legend(ncols=2, loc="lower center", fontsize=8)
    axes[-1].text(0.5, 0.012, "dots: can't be told", ha="center", color="#555555")
    figure_style.save(figure, IMAGES / "estimate", dpi=120)


if __name__ == "__main__":
    main()
