# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the figures of emissivity.md.

    python -m tools.manual.emissivity_figures

Needs matplotlib and numpy.
"""

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from core import emissivity, oren_nayar
from tools.manual import figure_style
from tools.manual.figure_style import BLUE, GRAY, ORANGE, TEAL, VERMILION
from tools.run.run_command_line import ROOT

IMAGES = ROOT / "docs" / "images"
STYLE = {
    "figure.figsize": (7.6, 3.5),
    "figure.constrained_layout.use": True,
    "axes.titlesize": 11,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "legend.frameon": False,
    "legend.fontsize": 9,
    "svg.hashsalt": "rough-spectra",
    "svg.fonttype": "none",
    "font.size": 10,
}
ROUGH = ((15, TEAL), (30, BLUE), (45, VERMILION), (60, ORANGE))
"""σ in degrees."""
FACETS = 0.5
BAND = (8000.0, 14000.0)
SURFACE, SKY = 300.0, 250.0
"""Kelvin."""
DEGREES = np.linspace(0, 88, 89)


def save(figure, name):
    figure_style.save(figure, IMAGES / f"emissivity-{name}", dpi=120)
    plt.close(figure)


def over_angle():
    """What a rough surface emits, and what a camera tells of it."""
    figure, (left, right) = plt.subplots(1, 2)
    theta = np.radians(DEGREES)
    nm, albedo = np.array(BAND), np.full(2, 1 - FACETS)
    for axes in (left, right):
        axes.set_xlabel("angle from the normal, degrees")
        axes.set_xticks(range(0, 91, 15))
    for sigma, color in ROUGH:
        for model, dashes in (("reference", (0, (3, 2))), ("surface", "-")):
            found = emissivity.directional(albedo, theta, np.radians(sigma), model=model)
            left.plot(DEGREES, found[:, 0], color=color, linestyle=dashes)
            seen = emissivity.apparent_temperature(found, nm, SURFACE, BAND, SKY)
            right.plot(DEGREES, seen, color=color, linestyle=dashes)
        left.annotate(
            f"σ {sigma}°",
            (DEGREES[0], found[0, 0]),
            (2, 4),
            textcoords="offset points",
            color=color,
            fontsize=9,
        )
    left.axhline(FACETS, color=GRAY)
    left.annotate("smooth", (0, FACETS), (2, 4), textcoords="offset points", color=GRAY, fontsize=9)
    smooth = emissivity.apparent_temperature(1 - albedo, nm, SURFACE, BAND, SKY)
    right.axhline(float(smooth), color=GRAY)
    left.set_title(f"Emissivity, facets {FACETS:g}")
    right.set_title(f"{SURFACE:g} K under {SKY:g} K, told at 8-14 µm")
    right.set_ylabel("K")
    left.plot([], [], color=GRAY, label="random surface")
    left.plot([], [], color=GRAY, linestyle=(0, (3, 2)), label="V-grooves")
    left.set_ylim(0.48, 0.78)
    left.legend(loc="upper right")
    save(figure, "angles")


def two_bounces():
    """What white facets would emit if lost light counted as emitted."""
    figure, axes = plt.subplots(figsize=(7.6, 3.0))
    points, weights = np.polynomial.legendre.leggauss(32)
    theta_r = np.arccos(np.sqrt((points + 1) / 2))[:, np.newaxis]
    delta_phi = (points + 1) / 2 * np.pi
    for sigma, color in ROUGH:
        found = []
        for degrees in DEGREES:
            angles = (np.radians(degrees), theta_r, delta_phi, np.radians(sigma))
            r = oren_nayar.reflectance(np.ones(1), *angles)[..., 0]
            found.append(1 - np.einsum("i,j,ij", weights / 2, weights / 2, r))
        axes.plot(DEGREES, found, color=color, label=f"σ {sigma}°")
    axes.axhline(0, color=GRAY)
    axes.annotate(
        "what white facets emit",
        (1, 0),
        (0, -11),
        textcoords="offset points",
        color=GRAY,
        fontsize=9,
    )
    axes.set_xlabel("angle from the normal, degrees")
    axes.set_xticks(range(0, 91, 15))
    axes.set_title("1 − reflectance of white facets, published two bounces")
    axes.legend(loc="upper right", ncols=4)
    axes.set_ylim(-0.06, 0.28)
    save(figure, "two-bounce")


def main():
    """Draw all of them."""
    with mpl.rc_context(STYLE):
        over_angle()
        two_bounces()


if __name__ == "__main__":
    main()
