# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo's contact sheet and its closing summary, from the readings that `demo.py` wrote.

Needs matplotlib and no Blender:

    python -m tools.demo.contact_sheet FOLDER
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import numpy.typing as npt

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

READINGS = "readings.json"
SHEET = "contact-sheet.png"

COLUMNS = 6
_PIXELS_PER_INCH = 100
_CARD = (3.0, 3.08)  # inches
_HEAD, _FOOT = 0.98, 0.14
_SCALES = (0.05, 0.1, 0.2, 0.5, 1.0)
"""Ends of the reflectance axis; a card takes the smallest that holds its curves."""
_LINES: tuple[dict[str, Any], ...] = (
    {"color": "#1a1a1a", "linestyle": "-"},
    {"color": "#0072b2", "linestyle": (0, (6, 1.5))},
    {"color": "#d55e00", "linestyle": (0, (3, 1.5))},
    {"color": "#009e73", "linestyle": (0, (1, 1))},
)
"""Told apart by color (Okabe and Ito's, safe for color-blind people) and by dash."""

Group = tuple[str, list[dict[str, Any]]]


def main(folder: Path) -> int:
    """Draw the sheet, then say what the demo made."""
    document = json.loads((folder / READINGS).read_text(encoding="utf-8"))
    entries = document["readings"]
    figure = draw(groups(entries), document["working_space"])
    part = folder / f".{SHEET}.part"
    figure.savefig(part, format="png", dpi=_PIXELS_PER_INCH, metadata={"Software": None})
    plt.close(figure)
    os.replace(part, folder / SHEET)
    summarize(folder, entries)
    return 0


def groups(entries: list[dict[str, Any]]) -> list[Group]:
    """Gather the readings of each patch, in the order of the file, with σ increasing."""
    found: dict[str, list[dict[str, Any]]] = {}
    for entry in entries:
        found.setdefault(entry["material"].rpartition(" ")[0], []).append(entry)
    for members in found.values():
        members.sort(key=lambda entry: entry["predicted"]["sigma_degrees"])
    return list(found.items())


def draw(cards: list[Group], space: str) -> Figure:
    """Lay the cards out as on the chart."""
    rows = -(-len(cards) // COLUMNS)
    width, height = COLUMNS * _CARD[0], rows * _CARD[1] + _HEAD + _FOOT
    plt.rcParams.update({"font.size": 9.5, "font.family": "DejaVu Sans"})
    figure = plt.figure(figsize=(width, height), facecolor="white")
    _heading(figure, cards[0][1], space, height)
    for index, (name, members) in enumerate(cards):
        left = (index % COLUMNS) * _CARD[0]
        top = height - _HEAD - (index // COLUMNS) * _CARD[1]
        _card(figure, name, members, left, top)
    return figure


def _heading(figure: Figure, members: list[dict[str, Any]], space: str, height: float) -> None:
    width = COLUMNS * _CARD[0]
    left, top = 0.2 / width, height

    def at(inches: float) -> float:
        return (top - inches) / height

    figure.text(left, at(0.38), "Readings at 45°/0° under D65, 2° observer", fontsize=17)
    figure.text(
        left,
        at(0.72),
        "Each swatch: left of the tick the target that the core predicts, right of it what Cycles "
        f"was measured to show ({space}, shown as sRGB); above it σ, below it ΔE00.  Curves: "
        "predicted reflectance factor over wavelength, nm.",
        fontsize=11,
    )
    handles = [Line2D([], [], linewidth=2.2, **style) for style in _LINES]
    labels = [f"σ = {entry['predicted']['sigma_degrees']:g}°" for entry in members]
    figure.legend(
        handles,
        labels,
        loc="upper right",
        bbox_to_anchor=(1 - left, at(0.12)),
        ncols=4,
        frameon=False,
        fontsize=12,
        handlelength=3.2,
        borderaxespad=0,
    )


def _card(
    figure: Figure, name: str, members: list[dict[str, Any]], left: float, top: float
) -> None:
    def box(x: float, y: float, wide: float, high: float) -> Axes:
        """Axes at inches from the card's upper left corner."""
        total_width, total_height = figure.get_size_inches()
        at = (
            (left + x) / total_width,
            (top - y - high) / total_height,
            wide / total_width,
            high / total_height,
        )
        return figure.add_axes(at)

    title = box(0.2, 0.02, 2.66, 0.22)
    title.axis("off")
    title.text(0, 0.1, name, fontsize=12.5, fontweight="bold", va="bottom")
    if any(entry["warnings"] for entry in members):
        title.text(
            1, 0.1, "outside the gamut", fontsize=10, color="#a03000", ha="right", va="bottom"
        )
    for place, entry in enumerate(members):
        pair = box(0.2 + place * 0.675, 0.46, 0.635, 0.5)
        _swatches(pair, entry)
        pair.set_title(f"{entry['predicted']['sigma_degrees']:g}°", fontsize=10, pad=3)
        pair.set_xlabel(f"{entry['delta_e_00']:.2f}", fontsize=10.5, labelpad=1)
    _curves(box(0.5, 1.3, 2.36, 1.4), members)


def _swatches(axes: Axes, entry: dict[str, Any]) -> None:
    for left, rgb in ((0.0, entry["predicted"]["preview"]), (0.5, entry["measured"]["rgb"])):
        axes.add_patch(Rectangle((left, 0), 0.5, 1, color=srgb(rgb), linewidth=0))
    axes.set(xlim=(0, 1), ylim=(0, 1), xticks=[0.5], xticklabels=[], yticks=[])
    axes.tick_params(length=4, color="#404040")  # where target and measurement meet
    for spine in axes.spines.values():
        spine.set(color="#808080", linewidth=0.6)


def _curves(axes: Axes, members: list[dict[str, Any]]) -> None:
    peak = max(max(entry["predicted"]["values"]) for entry in members)
    end = next(scale for scale in (*_SCALES, peak) if scale >= peak)
    for entry, style in zip(members, _LINES, strict=False):
        part = entry["predicted"]
        axes.plot(part["wavelengths"], part["values"], linewidth=1.5, **style)
    axes.set(xlim=(380, 780), ylim=(0, end), xticks=(400, 500, 600, 700))
    axes.set_yticks((0, end / 2, end), (f"{tick:g}" for tick in (0, end / 2, end)))
    axes.tick_params(labelsize=9.5, length=3, color="#808080")
    axes.grid(color="#e0e0e0", linewidth=0.6)
    for side, spine in axes.spines.items():
        spine.set(color="#808080", visible=side in ("left", "bottom"))


def srgb(linear: npt.ArrayLike) -> tuple[float, float, float]:
    """Encode linear Rec.709 (3,) for the screen; what a screen cannot show is clipped."""
    values = np.clip(np.asarray(linear, np.float64), 0, 1)
    encoded = np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)
    red, green, blue = encoded.tolist()
    return red, green, blue


def summarize(folder: Path, entries: list[dict[str, Any]]) -> None:
    """Print what the demo made, where, and the largest ΔE00."""
    print(f"\nMade in {folder}:")
    for path in sorted(folder.iterdir()):
        if not path.name.startswith(".") and path.suffix != ".blend1":
            print(f"  {path.stat().st_size / 1000:9.1f} kB  {path.name}")
    sound = [entry for entry in entries if not entry["warnings"]]
    for words, chosen in (("all", entries), ("those inside the gamut", sound)):
        worst = max(chosen, key=lambda entry: entry["delta_e_00"])
        print(
            f"Largest ΔE00 at 45°/0° of {words}, {len(chosen)} materials: "
            f"{worst['delta_e_00']:.4f} ({worst['material']})"
        )


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
