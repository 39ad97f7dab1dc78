# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the figures of spectral.md: cost against ΔE00, and a room.

    python -m tools.manual.picture_figures [ROOM.npz]

Needs matplotlib and numpy; the numbers and the room's pixels come from
tools/benchmarks/bench_picture.py.
"""

import csv
import sys

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt

from core.color import color_difference
from tools.manual import figure_style
from tools.manual.emissivity_figures import IMAGES, STYLE
from tools.manual.figure_style import BLACK, BLUE, GRAY, ORANGE, VERMILION
from tools.run.run_command_line import ROOT

DATA = ROOT / "docs" / "data" / "picture.csv"
LIGHTS = {"D65": BLUE, "A": VERMILION, "F11": ORANGE}
SMALLEST = 0.005
MARKS = {"RGB": "s", "RGB, matched to the light": "D", "RGB, matched, Rec.2020": "^"}
D65 = np.array((0.95047, 1.0, 1.08883))
TO_REC709 = np.array(
    ((3.2404542, -1.5371385, -0.4985314), (-0.969266, 1.8760108, 0.041556),
     (0.0556434, -0.2040259, 1.0572252))
)  # fmt: skip
"""From XYZ to linear Rec.709 (IEC 61966-2-1)."""


def chart() -> None:
    """Draw cost against how far colors are off."""
    with DATA.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    with plt.rc_context(STYLE | {"figure.figsize": (7.6, 4.6)}):
        figure, axes = plt.subplots()
        for light, color in LIGHTS.items():
            of = [row for row in rows if row["light"] == light]
            for label, mark in MARKS.items():
                for row in of:
                    if row["picture"] == label:
                        axes.plot(1, float(row["mean"]), mark, color=color, markersize=7)
            for apart, dash in ((False, "-"), (True, ":")):
                line = [
                    (float(row["cost"]), float(row["mean"]))
                    for row in of
                    if "bands" in row["picture"]
                    and ("apart" in row["picture"]) == apart
                    and float(row["mean"]) > 0
                ]
                label = f"bands under {light}" + ", direct light apart" * apart
                axes.plot(*zip(*line, strict=True), dash, marker="o", color=color, label=label)
            for row in of:
                if row["picture"].startswith("Mitsuba"):
                    axes.axvline(float(row["cost"]), color=color, linestyle="--", linewidth=1)
        for label, mark in MARKS.items():
            axes.plot([], [], mark, color=GRAY, label=label)
        axes.plot([], [], "--", color=BLACK, label="Mitsuba, spectral, as little noise")
        axes.set_xscale("log")
        axes.set_yscale("log")
        ticks = (1, 2, 3, 5, 10, 20, 50)
        axes.set_xticks(ticks, [str(tick) for tick in ticks])
        axes.minorticks_off()
        axes.set_xlabel("time, in ordinary renders")
        axes.set_ylabel("mean ΔE00 from 36 bands")
        axes.set_title("A closed room of ColorChecker patches, rendered")
        axes.legend(loc="upper right", fontsize=7, frameon=True, framealpha=1, edgecolor="none")
        figure_style.save(figure, IMAGES / "picture-cost", dpi=120)
        plt.close(figure)


def room(path: str) -> None:
    """Draw a room: RGB, spectral, and how far they are apart."""
    found = np.load(path)
    adapted = color_difference.adaptation(found["white"], D65)
    shown = [found[name] @ adapted.T @ TO_REC709.T for name in ("ordinary", "spectral")]
    bright = np.quantile(shown[1], 0.97)
    labs = [color_difference.xyz_to_lab(found[n], found["white"]) for n in ("ordinary", "spectral")]
    apart = color_difference.delta_e(*labs)
    with plt.rc_context(STYLE | {"figure.figsize": (11, 3.2)}):
        figure, axes = plt.subplots(1, 3, layout="constrained")
        for each, pixels, title in zip(
            axes, shown, ("RGB, one render", "Spectral, nine bands in three renders"), strict=False
        ):
            each.imshow(to_srgb(pixels / bright), interpolation="bilinear")
            each.set_title(title)
        drawn = axes[2].imshow(apart, cmap="magma", vmin=0, vmax=np.ceil(np.quantile(apart, 0.99)))
        axes[2].set_title(f"ΔE00 between them, {apart.mean():.1f} on average")
        figure.colorbar(drawn, ax=axes[2])
        for each in axes:
            each.set_axis_off()
        figure.savefig(IMAGES / "spectral-room.png", dpi=120, metadata={"Software": None})
        plt.close(figure)


def to_srgb(linear: np.ndarray) -> np.ndarray:
    """Encode linear values (IEC 61966-2-1)."""
    value = np.clip(linear, 0, 1)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


if __name__ == "__main__":
    chart()
    for each in sys.argv[1:]:
        room(each)
