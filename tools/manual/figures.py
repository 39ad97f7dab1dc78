# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the figures of the manual into docs/images, as SVG and PNG:

    python3 dev.py figures

Needs matplotlib and numpy, no Blender and no colour-science. Equal numbers give equal bytes.
"""

from __future__ import annotations

import csv
import json
import sys

import matplotlib as mpl
import numpy as np

from core import reading
from tools.manual import figure_style
from tools.manual.figure_style import BLACK, BLUE, GRAY, ORANGE, TEAL, VERMILION
from tools.run.run_command_line import ROOT, load_extension

mpl.use("Agg")
from matplotlib import pyplot as plt

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import srgb

IMAGES = ROOT / "docs" / "images"
HEMISPHERE = ROOT / "docs" / "data" / "hemisphere.csv"
GREEN = ROOT / "presets" / "colorchecker" / "14-green.json"

SIGMAS = (0, 15, 30, 45)

plt.rcParams.update(
    {
        "figure.dpi": 100,
        "font.family": "DejaVu Sans",
        "font.size": 11,
        "axes.titlesize": 12,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e4e4e4",
        "lines.linewidth": 2,
        "legend.frameon": False,
        "svg.hashsalt": "rough-spectra",
    }
)


def main():
    IMAGES.mkdir(parents=True, exist_ok=True)
    coefficients()
    models()
    green()
    if HEMISPHERE.is_file():
        hemisphere()
    else:
        missing = f"{HEMISPHERE} is missing, so its figure is left out"
        print(f"{missing}; run python -m tools.manual.hemisphere_table.")


def save(figure, name):
    figure_style.save(figure, IMAGES / name)
    plt.close(figure)
    print(f"{IMAGES / name}.svg and .png")


def sigma_axis(axes):
    axes.set(xlim=(0, 90), xticks=range(0, 91, 15), xlabel="roughness σ (degrees)")


def coefficients():
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    degrees = np.linspace(0, 90, 361)
    f1, f2 = reading.coefficients(np.radians(degrees))
    left.plot(degrees, f1 + f2, color=BLACK, linestyle=(0, (5, 2)))
    left.plot(degrees, f1, color=BLUE)
    left.plot(degrees, f2, color=VERMILION)
    for label, values, color, lift in (
        ("f1 + f2: white facets", f1 + f2, BLACK, 0.11),
        ("f1: light that meets one facet", f1, BLUE, -0.08),
        ("f2: light that meets two", f2, VERMILION, 0.04),
    ):
        left.text(88, values[-1] + lift, label, color=color, ha="right")
    sigma_axis(left)
    left.set(ylim=(0, 1.05), ylabel="share of the reading (1 = perfect white)")
    left.set_title("What roughness does to a reading, r = f1 ρ + f2 ρ²")

    peak = np.linspace(0.65, 1, 701)
    right.plot(peak, np.degrees(reading.sigma_max(peak)), color=BLACK)
    for value in (0.8, 0.9, 0.95):
        bound = float(np.degrees(reading.sigma_max(value)))
        right.plot(value, bound, "o", color=VERMILION)
        right.annotate(
            f"{value:g}: {bound:.1f}°",
            (value, bound),
            (-8, -6),
            textcoords="offset points",
            ha="right",
            va="top",
        )
    right.axvspan(0.65, 0.7205, color="#f2f2f2", linewidth=0)
    right.text(0.685, 45, "no bound", ha="center", va="center", color=GRAY, rotation=90)
    right.set(xlim=(0.65, 1), ylim=(0, 95), yticks=range(0, 91, 15))
    right.set(xlabel="highest value of the reading", ylabel="largest possible σ (degrees)")
    right.set_title("How rough a bright sample can be")
    save(figure, "coefficients")


def models():
    figure, axes = plt.subplots(figsize=(7, 4.6), layout="constrained")
    albedo = np.linspace(0, 1, 201)
    sigma = np.radians(45)
    axes.plot(albedo, albedo, color=GRAY, linewidth=1, linestyle=(0, (2, 2)), label="smooth: r = ρ")
    axes.plot(
        albedo,
        reading.from_albedo(albedo, sigma, model="reference"),
        color=BLACK,
        linewidth=5,
        alpha=0.25,
        label="reference (simulated grooves)",
    )
    for model, color, dash in (
        ("surface", BLACK, (0, (6, 1, 1, 1))),
        ("closure", TEAL, (0, (1, 1))),
        ("two-bounce", BLUE, "-"),
        ("first-order", VERMILION, (0, (5, 2))),
    ):
        values = reading.from_albedo(albedo, sigma, model=model)
        axes.plot(albedo, values, color=color, linestyle=dash, label=model)
    axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="albedo ρ of one facet", ylabel="reading r at 45°/0°")
    axes.set_title("The models at σ = 45°")
    axes.legend(loc="upper left")
    save(figure, "models")


def green():
    preset = json.loads(GREEN.read_text(encoding="utf-8"))
    nm, albedo = np.array(preset["wavelengths"]), np.array(preset["values"])
    figure, (axes, chips) = plt.subplots(
        1, 2, figsize=(9, 4.4), layout="constrained", width_ratios=(5, 1)
    )
    dashes = ("-", (0, (6, 1.5)), (0, (3, 1.5)), (0, (1, 1)))
    colors = (BLACK, BLUE, VERMILION, TEAL)
    for place, (degrees, color, dash) in enumerate(zip(SIGMAS, colors, dashes, strict=True)):
        values = reading.from_albedo(albedo, np.radians(degrees))
        label = "σ = 0°: the albedo itself" if degrees == 0 else f"σ = {degrees}°"
        axes.plot(nm, values, color=color, linestyle=dash, label=label)
        chips.add_patch(plt.Rectangle((0, -place), 1, 1, color=swatch(values, nm), linewidth=0))
        chips.text(1.12, 0.5 - place, f"{degrees}°", va="center")
    axes.set(xlim=(380, 780), ylim=(0, 0.4), xlabel="wavelength (nm)")
    axes.set_ylabel("reading r at 45°/0° (1 = perfect white)")
    axes.set_title("ColorChecker 14 Green, two-bounce model")
    axes.legend()
    chips.set(xlim=(0, 1.6), ylim=(-len(SIGMAS) + 1, 1))
    chips.axis("off")
    save(figure, "green")


def hemisphere():
    with HEMISPHERE.open(encoding="utf-8", newline="") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        rows = [row for row in table if row["truth"] == "surface"]
    figure, axes = plt.subplots(figsize=(8, 3.6), layout="constrained")
    names = list(dict.fromkeys(row["material"] for row in rows))
    sigmas = sorted({float(row["sigma_degrees"]) for row in rows})
    height = 0.34
    styles = (("Diffuse", BLUE), ("Lambert", ORANGE))
    for name in names:
        rank = 0 if styles[0][0] in name else 1
        members = sorted(
            (row for row in rows if row["material"] == name),
            key=lambda row: float(row["sigma_degrees"]),
        )
        means = [float(row["mean"]) for row in members]
        tails = [float(row["percentile_95"]) for row in members]
        at = np.array([sigmas.index(float(row["sigma_degrees"])) for row in members])
        at = at + (rank - 0.5) * 1.1 * height
        axes.barh(at, means, height, color=styles[rank][1], label=name)
        axes.hlines(at, means, tails, color=styles[rank][1], linewidth=1.5)
        axes.plot(tails, at, "|", color=styles[rank][1], markersize=11, markeredgewidth=2)
        for y, mean, tail in zip(at, means, tails, strict=True):
            axes.text(tail + 0.15, y, f"{mean:.2f}, 95 %: {tail:.2f}", va="center")
    axes.set_yticks(range(len(sigmas)), [f"σ = {sigma:g}°" for sigma in sigmas])
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.set_xlim(0, 1.28 * max(float(row["percentile_95"]) for row in rows))
    axes.set_xlabel("ΔE00 to the rough surface: bar the mean, tick the 95th percentile")
    axes.set_title("All angles of light and view below 80°, 23 ColorChecker patches")
    axes.legend(loc="upper right")
    save(figure, "hemisphere")


def swatch(values, nm):
    """Color for the screen: D65, 2°, from Wyman, Sloan and Shirley's fits (JCGT 2013)."""

    def lobe(middle, below, above):
        width = np.where(nm < middle, below, above)
        return np.exp(-0.5 * ((nm - middle) * width) ** 2)

    matching = np.stack(
        (
            0.362 * lobe(442.0, 0.0624, 0.0374)
            + 1.056 * lobe(599.8, 0.0264, 0.0323)
            - 0.065 * lobe(501.1, 0.0490, 0.0382),
            0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
            1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725),
        ),
        axis=-1,
    )
    # Equal energy, scaled to D65's white: a swatch in a figure, not a measurement.
    xyz = values @ matching / matching.sum(axis=0) * (0.9505, 1.0, 1.089)
    linear = np.clip(srgb.FROM_XYZ @ xyz, 0, 1)
    return tuple(srgb.encode(linear).tolist())


if __name__ == "__main__":
    main()
