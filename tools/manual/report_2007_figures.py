# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers and figures of report-2007.md, all of them by one command in any Python from 3.9 on:

    python3 -m tools.manual.report_2007_figures

It runs tools/manual/report_2007_tables.py where colour-science is, then itself again where
matplotlib is. Equal numbers give equal bytes.
"""

from __future__ import annotations

import csv
import json
import sys

import numpy as np

from tools.manual import figure_style
from tools.manual.figure_style import (
    BLACK,
    BLUE,
    GRAY,
    ORANGE,
    SKY,
    VERMILION,
)
from tools.run.run_command_line import ROOT

DATA = ROOT / "docs" / "data"
IMAGES = ROOT / "docs" / "images"
GREEN = ROOT / "presets" / "colorchecker" / "14-green.json"

COLORS = {"first-order": GRAY, "two-bounce": BLUE, "closure": ORANGE, "reference": VERMILION}
MARKERS = {"two-bounce": "o", "closure": "s", "reference": "D"}

REPORTED = 3.83
SIGMA = 45


def table(name):
    """Give the lines of a CSV file under its comment, numbers as numbers."""
    with (DATA / name).open(encoding="utf-8", newline="") as file:
        next(file)
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def curves():
    import numpy as np

    lines = table("report-2007-curves.csv")
    return {key: np.array([line[key] for line in lines]) for key in lines[0]}


def sigma_axis(axes):
    axes.set_xlim(0, 90)
    axes.set_xticks(range(0, 91, 15))
    axes.set_xlabel("roughness σ (degrees)")


def albedo_axes(axes):
    """Albedo across and reading up, as the report has them."""
    axes.set_xlim(0, 1)
    axes.set_ylim(0, 1)
    axes.set_aspect("equal")
    axes.set_xlabel("albedo ρ")
    axes.set_ylabel("reading r at 45°/0°")


def limit_curves(axes, largest):
    """Fill what lies between the level surface and the roughest one, and give its curve."""
    import numpy as np

    from core import reading

    rho = np.linspace(0, 1, 201)
    lowest = reading.from_albedo(rho, largest)
    axes.fill_between(rho, lowest, rho, color=SKY, alpha=0.3, linewidth=0)
    axes.plot(rho, rho, color=BLACK, linewidth=2.2)
    axes.plot(rho, lowest, color=BLUE, linewidth=2.2)
    axes.plot([1, 1], [lowest[-1], 1], color=GRAY, linewidth=2.2, clip_on=False)
    axes.text(0.52, 0.55, "σ = 0: r = ρ", rotation=45, rotation_mode="anchor", ha="center")
    return rho, lowest


def limits(plt):
    """Figure 1: the limit curves over albedo and reading."""
    import numpy as np

    from core import reading

    figure, axes = plt.subplots(figsize=(5.6, 5.4))
    rho, _ = limit_curves(axes, np.pi / 2)
    for degrees in (20, 45):
        between = reading.from_albedo(rho, np.radians(degrees))
        axes.plot(rho, between, "--", color=BLUE, linewidth=1)
        axes.text(1.02, between[-1], f"σ = {degrees}°", color=BLUE, va="center")
    axes.text(
        0.63,
        0.36,
        "σ = π/2: r = 0.5590 ρ + 0.1615 ρ²",
        color=BLUE,
        rotation=36,
        rotation_mode="anchor",
        ha="center",
    )
    for value, name in ((1, "1"), (float(reading.white_reading(np.pi / 2)), "0.7205")):
        axes.text(1.02, value, name, va="center")
    axes.text(0.1, 0.8, "would need facets\nthat reflect less\nthan is read", color=GRAY)
    axes.set_title("Feasible curves lie in the triangle")
    albedo_axes(axes)
    return figure


def bright(plt):
    """Figure 2: the same for a reading with a high peak."""
    import numpy as np

    from core import reading

    peak = 0.9
    largest = float(reading.sigma_max(peak))
    figure, axes = plt.subplots(figsize=(5.6, 5.4))
    limit_curves(axes, largest)
    rho = np.linspace(0, 1, 201)
    axes.plot(rho, reading.from_albedo(rho, np.pi / 2), ":", color=GRAY, linewidth=1.6)
    axes.text(0.83, 0.5, "σ = π/2", color=GRAY, rotation=37, ha="center")
    axes.text(
        0.5,
        0.37,
        f"σ = σmax = {np.degrees(largest):.1f}°",
        color=BLUE,
        rotation=40,
        rotation_mode="anchor",
        ha="center",
    )
    axes.plot([0, 1], [peak, peak], "--", color=GRAY, linewidth=1.2)
    axes.text(0.02, peak + 0.015, f"highest value of the reading: {peak:g}", color="#444444")
    low = 0.5
    high = float(reading.to_albedo(np.array([low]), largest)[0])
    axes.annotate(
        "",
        (high, low),
        (low, low),
        arrowprops={"arrowstyle": "<->", "color": VERMILION, "shrinkA": 0, "shrinkB": 0},
    )
    axes.plot([low, low, high, high], [0, low, low, 0], ":", color=VERMILION, linewidth=1.2)
    axes.text(
        (low + high) / 2,
        0.15,
        "albedos behind r = 0.5:\nfrom r to ρ(r; σmax)",
        color=VERMILION,
        ha="center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 2},
    )
    axes.set_title("A bright reading cuts the triangle")
    albedo_axes(axes)
    return figure


def patch_14():
    """Give wavelengths, albedo and two-bounce reading of the patch."""
    import numpy as np

    from core import reading

    preset = json.loads(GREEN.read_text("utf-8"))
    rho = np.array(preset["values"])
    return np.array(preset["wavelengths"]), rho, reading.from_albedo(rho, np.radians(SIGMA))


def patch(plt):
    """Figure 3: albedo and reading of the patch."""
    band, rho, read = patch_14()
    row = green_rows()[2, "two-bounce"]
    figure, (axes, below) = plt.subplots(
        2, 1, figsize=(7, 5.6), sharex=True, gridspec_kw={"height_ratios": [2, 1]}
    )
    axes.plot(band, rho, color=BLACK, linewidth=2.2)
    axes.plot(band, read, color=BLUE, linewidth=2.2)
    axes.text(566, 0.335, "albedo ρ", color=BLACK)
    axes.text(566, 0.295, "reading r at σ = π/4", color=BLUE)
    axes.set_xlim(380, 780)
    axes.set_ylim(0, 0.4)
    axes.set_ylabel("reflectance factor")
    axes.set_title("ColorChecker #14: darker, and not a simple scaling")
    below.plot(band, read / rho, color=BLUE, linewidth=2.2)
    below.axhline(row["k"], color=VERMILION, linestyle="--", linewidth=1.6)
    below.text(776, row["k"] + 0.004, "of luminance", color=VERMILION, ha="right")
    below.set_ylim(0.67, 0.74)
    below.set_ylabel("r / ρ")
    below.set_xlabel("wavelength λ (nm)")
    return figure


def colors(plt):
    """Figure 4: two colors with the chromaticities of each and equal lightness; and the plane."""
    import numpy as np

    row = green_rows()[2, "two-bounce"]
    start = np.array([row["a"], row["b"]])
    end = np.array([row["a_reading"], row["b_reading"]])
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(11, 4.8), gridspec_kw={"width_ratios": [1, 1]}
    )
    for place, (name, key) in enumerate((("albedo", "srgb"), ("reading", "srgb_reading"))):
        left.add_patch(plt.Rectangle((place, 0), 1, 1, facecolor=row[key], edgecolor="none"))
        a, b = (start, end)[place]
        left.text(
            place + 0.5,
            -0.05,
            f"a*, b* of the {name}\n{a:.1f}, {b:.1f}".replace("-", "−"),
            ha="center",
            va="top",
        )
    left.set_xlim(0, 2)
    left.set_ylim(-0.22, 1)
    left.axis("off")
    left.set_title(f"Both at L* = {row['L']:.1f}, the albedo's")

    # a* and b* scale with the cube root of luminance far from black.
    dark = start * np.cbrt(row["k"])
    aside = np.array([0.22, 0.27])
    for tail, head, color, side in (
        (start, dark, BLACK, 0),
        (dark, end, VERMILION, 1),
        (start, end, BLUE, -1),
    ):
        right.annotate(
            "",
            head + side * aside,
            tail + side * aside,
            arrowprops={
                "arrowstyle": "-|>,head_width=0.35,head_length=0.7",
                "color": color,
                "linewidth": 2.2,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
    for place in (start, dark, end):
        right.plot(*place, "o", color=BLACK, markersize=6, zorder=3)
    right.text(start[0], start[1] + 0.55, "albedo ρ", ha="center")
    right.text(dark[0] + 0.1, dark[1] - 0.75, "albedo × k", ha="center")
    right.text(-39.1, 33.9, f"darkening {row['ab_darkening']:.2f}", color=BLACK)
    right.text(-37.2, 32.0, f"interreflection {row['ab_interreflection']:.2f}", color=VERMILION)
    right.text(-40.7, 32.5, f"in all {row['ab']:.2f}", color=BLUE, ha="right")
    right.text(end[0] - 0.6, end[1] - 0.75, "reading r", ha="right")
    right.set_xlim(-43.5, -33.8)
    right.set_ylim(29, 37)
    right.set_aspect("equal")
    right.set_xlabel("a* (← greener)")
    right.set_ylabel("b* (yellower →)")
    right.set_title("Where they lie, and why")
    figure.suptitle("ColorChecker #14, σ = π/4, two bounces, D65, 2° observer")
    return figure


def ranges(plt):
    """Figure 5: the albedos that a reading leaves open, band by band."""
    import numpy as np

    from core import feasible

    band, _, read = patch_14()
    figure, panels = plt.subplots(1, 2, figsize=(11, 4.4), sharex=True)
    for axes, values, title in zip(
        panels,
        (read, read * (0.9 / read.max())),
        ("The reading of figure 3", "The same shape with a peak of 0.9"),
        strict=True,
    ):
        for model, color, alpha in (("closure", ORANGE, 0.3), ("two-bounce", BLUE, 0.35)):
            found = feasible.albedo_range(values, model)
            largest = float(np.degrees(found.sigma_max))
            axes.fill_between(
                band,
                found.lowest,
                found.highest,
                color=color,
                alpha=alpha,
                linewidth=0,
                label=f"{model}, σ up to {largest:.1f}°",
            )
            axes.plot(band, found.highest, color=color, linewidth=1.5)
        axes.plot(band, values, color=BLACK, linewidth=2.2, label="reading r")
        axes.set_xlim(380, 780)
        axes.set_ylim(0, 1.02 if values.max() > 0.5 else 0.45)
        axes.set_xlabel("wavelength λ (nm)")
        axes.set_title(title)
        axes.legend(loc="upper right", frameon=False)
    panels[0].set_ylabel("albedo ρ")
    return figure


def green_rows():
    rows = table("report-2007.csv")
    return {(int(r["observer"]), r["model"]): r for r in rows if r["patch"].startswith("14 ")}


def apart(plt):
    """Figure 6: darkening and interreflection, model by model."""
    rows = green_rows()
    figure, panels = plt.subplots(1, 2, figsize=(11, 3.9), sharey=True, sharex=True)
    models = ("first-order", "two-bounce", "closure", "reference")
    names = ("first bounce only", "two bounces", "all: closure", "all: V-cavity reference")
    for axes, observer in zip(panels, (2, 10), strict=True):
        for place, model in enumerate(models):
            row = rows[observer, model]
            dark, back, total = row["ab_darkening"], row["ab_interreflection"], row["ab"]
            axes.barh(place + 0.19, dark, 0.36, color="#555555")
            axes.barh(place - 0.19, back, 0.36, left=dark - back, color=VERMILION, hatch="//")
            axes.plot([total] * 2, [place - 0.42, place + 0.42], color=BLUE, linewidth=3)
            axes.text(0.12, place + 0.19, f"darkening {dark:.2f}", color="white", va="center")
            if back:
                axes.text(dark + 0.1, place - 0.19, f"−{back:.2f}", color=VERMILION, va="center")
            paper = {"facecolor": "white", "edgecolor": "none", "pad": 1}
            left_of = {"ha": "right", "va": "center", "color": BLUE, "bbox": paper}
            axes.text(total - 0.1, place - 0.23, f"{total:.2f}", **left_of)
        axes.axvline(REPORTED, color=BLACK, linestyle=":", linewidth=1.5)
        axes.text(REPORTED - 0.08, -0.62, f"report: {REPORTED}", ha="right", va="center")
        axes.set_title(f"{observer}° observer")
        axes.set_xlabel("distance from the albedo in the a*b* plane")
        axes.set_xlim(0, 7.9)
    panels[0].set_yticks(range(len(models)), names)
    panels[0].set_ylim(3.6, -0.85)
    handles = [
        plt.Rectangle((0, 0), 1, 1, color="#555555"),
        plt.Rectangle((0, 0), 1, 1, facecolor=VERMILION, hatch="//"),
        plt.Line2D([], [], color=BLUE, linewidth=3),
    ]
    labels = ("darkening: away from the albedo", "interreflection: back", "what is left")
    figure.legend(
        handles, labels, loc="lower center", ncols=3, bbox_to_anchor=(0.5, -0.1), frameon=False
    )
    figure.suptitle(
        "Patch #14, σ = 45°, D65: interreflection takes back ¼ to ⅓ of what darkening does"
    )
    return figure


def all_bounces(plt):
    """Figure 7: the bound of figure 2 once every bounce counts."""
    data = curves()
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(11, 4.4), gridspec_kw={"width_ratios": [1.3, 1]}
    )
    names = {
        "two-bounce": "two bounces: white facets lose up to 28 %",
        "closure": "closure",
        "reference": "V-cavity reference, all bounces",
    }
    styles = {"two-bounce": "-", "closure": "--", "reference": "-"}
    for axes in (left, right):
        for model, name in names.items():
            axes.plot(
                data["sigma_deg"],
                data[f"white_{model}"],
                styles[model],
                color=COLORS[model],
                linewidth=2.2,
                label=name,
                # The closure lies on the reference: dashes on top leave both to be seen.
                zorder=4 if model == "closure" else 2,
            )
        sigma_axis(axes)
    left.fill_between(
        data["sigma_deg"],
        data["white_two-bounce"],
        1,
        facecolor="#fff4e5",
        edgecolor="#f3c58a",
        hatch="//",
        linewidth=0,
    )
    left.text(
        62,
        0.87,
        "ruled out by two bounces,\nreached by all bounces",
        ha="center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 2},
    )
    left.set_ylim(0.6, 1.03)
    left.set_ylabel("reading r of white facets (ρ = 1)")
    left.set_title("The bound on (σ, r) all but vanishes")
    left.legend(loc="lower left", frameon=False)
    peak = int(np.nanargmax(data["white_reference"]))
    last = int(np.flatnonzero(np.isfinite(data["white_reference"]))[-1])
    for place, height, across in ((peak, 0.0014, "center"), (last, -0.0022, "right")):
        value = data["white_reference"][place]
        right.plot(place, value, "o", color=VERMILION, clip_on=False)
        label = f"{value:.4f} at {place}°"
        right.text(place, value + height, label, color=VERMILION, ha=across, va="center")
    right.set_ylim(0.98, 1.02)
    right.set_yticks([0.98, 0.99, 1.0, 1.01, 1.02])
    right.set_title("The same, about 10 times enlarged")
    return figure


def patches(plt):
    """Figure 8: all 24 patches."""
    rows = [row for row in table("report-2007.csv") if row["observer"] == 2]
    names = list(dict.fromkeys(row["patch"] for row in rows))
    colors = {row["patch"]: row["srgb"] for row in rows}
    figure, panels = plt.subplots(1, 2, figsize=(11, 7.6), sharey=True)
    for axes, key, title in zip(
        panels,
        ("de00", "de00_equal"),
        ("As read: mostly darkening", "Luminance held equal: interreflection alone"),
        strict=True,
    ):
        for model, marker in MARKERS.items():
            values = {row["patch"]: row[key] for row in rows if row["model"] == model}
            axes.plot(
                [values[name] for name in names],
                range(len(names)),
                marker,
                color=COLORS[model],
                markeredgecolor="black",
                markeredgewidth=0.5,
                markersize=7,
                label={"two-bounce": "two bounces", "reference": "V-cavity reference"}.get(
                    model, model
                ),
                zorder=3,
            )
        axes.set_title(title)
        axes.set_xlabel("ΔE00 between the level and the rough surface")
        axes.grid(axis="y", color="#e4e4e4")
        axes.set_xlim(left=0)
    labels = [name.split(" (")[0] for name in names]
    panels[0].set_yticks(range(len(names)), labels)
    panels[0].tick_params(axis="y", pad=28, length=0)
    panels[0].set_ylim(len(names) - 0.4, -0.6)
    for place, name in enumerate(names):
        panels[0].add_patch(
            plt.Rectangle(
                (-0.065, place - 0.36),
                0.05,
                0.72,
                transform=panels[0].get_yaxis_transform(),
                facecolor=colors[name],
                edgecolor="#555555",
                linewidth=0.5,
                clip_on=False,
            )
        )
    panels[1].legend(loc="lower right", frameon=False)
    figure.suptitle("ColorChecker at σ = 45°, read at 45°/0° under D65, 2° observer")
    return figure


FIGURES = {
    "1-limits": limits,
    "2-bright": bright,
    "3-patch": patch,
    "4-colors": colors,
    "5-ranges": ranges,
    "6-apart": apart,
    "7-all-bounces": all_bounces,
    "8-patches": patches,
}


def draw():
    """Draw every figure as SVG and PNG."""
    import matplotlib as mpl

    mpl.use("agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update(
        {
            "font.size": 11,
            "axes.titlesize": 12,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "figure.constrained_layout.use": True,
            "hatch.linewidth": 0.6,
            "savefig.bbox": "tight",
            "svg.hashsalt": "rough-spectra",  # else every run names its clip paths anew
        }
    )
    IMAGES.mkdir(parents=True, exist_ok=True)
    for name, function in FIGURES.items():
        figure = function(plt)
        figure_style.save(figure, IMAGES / f"report-2007-{name}", dpi=120)
        plt.close(figure)


def main(arguments):
    if arguments == ["--draw"]:
        draw()
        return 0
    from tools.manual import two_pythons

    drawing = ("tools/manual/report_2007_figures.py", "--draw")
    return two_pythons.run(("tools/manual/report_2007_tables.py",), drawing)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
