# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which instruments there are, and how far apart they read: tables, data and figure of the manual.

    python3 -m tools.manual.instruments_table

runs itself where colour-science is, to write docs/data/instruments.csv and the two tables of
docs/instruments.md, and then where matplotlib is, for the figure. Equal numbers give equal bytes.
"""

from __future__ import annotations

import csv
import io
import sys
from typing import Any

from tools.manual import figure_style
from tools.manual.figure_style import GRAY, ORANGE, SKY, VERMILION
from tools.run.run_command_line import ROOT, load_extension

PAGE = ROOT / "docs" / "instruments.md"
DATA = ROOT / "docs" / "data" / "instruments.csv"
FIGURE = ROOT / "docs" / "images" / "instruments"

SIGMAS = (15, 30, 45)
"""Degrees."""
START, END = "<!-- table: instruments -->\n", "<!-- end -->"
WHICH = "<!-- table: which -->\n"
FIELDS = ("instrument", "title", "sigma_degrees", "mean_lightness", "mean", "maximum", "patch")
NOTE = (
    "# CIEDE2000 between the reading of each instrument and that at 45a:0; ColorChecker N Ohta as "
    "the albedo, V-cavity reference, D65, CIE 1931 2 deg. mean_lightness: mean difference of L*"
)


def rows() -> list[dict[str, Any]]:
    """Compare every instrument with 45a:0; needs an environment with colour-science."""
    load_extension()
    import numpy as np
    from rough_spectra.addon.colorimetry import tristimulus
    from rough_spectra.addon.samples import presets
    from rough_spectra.core import instruments, reading
    from rough_spectra.core.color import color_difference

    samples = [sample for sample in presets.load_all("colorchecker") if sample.kind == "albedo"]
    albedos = np.stack([sample.values for sample in samples])

    def lab(name: str, degrees: float) -> Any:
        read = reading.from_albedo(albedos, np.radians(degrees), "reference", name)
        return tristimulus.spectrum_to_lab(read, samples[0].wavelengths)

    found = []
    for degrees in SIGMAS:
        usual = lab("45a:0", degrees)
        for name, instrument in instruments.REGISTRY.items():
            here = lab(name, degrees)
            apart = color_difference.delta_e(usual, here)
            most = int(np.argmax(apart))
            values = (
                name,
                instrument.title,
                degrees,
                # Adding 0 turns a rounded -0 into 0.
                round(float(np.mean(here[:, 0] - usual[:, 0])), 3) + 0.0,
                round(float(np.mean(apart)), 3) + 0.0,
                round(float(apart[most]), 3) + 0.0,
                samples[most].name if apart[most] > 0 else "",
            )
            found.append(dict(zip(FIELDS, values, strict=True)))
    return found


def described() -> str:
    """Give the table of what there is: name, light and view of every record."""
    load_extension()
    from rough_spectra.core import instruments

    lines = ["| name | light | view |", "| --- | --- | --- |"]
    for name, of in instruments.REGISTRY.items():
        light = words(of.light)
        if of.trap:
            cut = f"a cone of half-angle {of.trap:g}° in the mirror direction"
            light += f" but {cut} (specular excluded)"
        elif of.light == instruments.HEMISPHERE:
            light += " (sphere, specular included)"
        elif not of.light.is_symmetric:
            light += ", from one side"
        view = words(of.view)
        if not of.light.is_symmetric and not of.view.is_symmetric:
            far = of.azimuth > 90
            beyond = far and of.view.tilt > of.light.tilt
            view += (
                ", beyond the mirror direction"
                if beyond
                else f" on the side of the {'mirror direction' if far else 'light'}"
            )
        lines.append(f"| `{name}` | {light} | {view} |")
    return "\n".join(lines) + "\n"


def words(beam: Any) -> str:
    """Say where a beam is."""
    inner, outer = beam.tilt - beam.half_angle, beam.tilt + beam.half_angle
    if beam.all_around:
        if outer >= 90 and inner <= 0:
            return "whole hemisphere"
        return (
            f"ring from {inner:g}° to {outer:g}°" if beam.half_angle else f"ring at {beam.tilt:g}°"
        )
    axis = f"{beam.tilt:g}°" if beam.tilt else "the normal"
    if beam.half_angle:
        return f"cone of half-angle {beam.half_angle:g}° around {axis}"
    return axis if beam.tilt else "along the normal"


def csv_text(found: list[dict[str, Any]]) -> str:
    """Give the rows as CSV under a line that says what they are."""
    text = io.StringIO()
    text.write(NOTE + "\n")
    writer = csv.DictWriter(text, FIELDS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(found)
    return text.getvalue()


def markdown(found: list[dict[str, Any]]) -> str:
    """Give the rows as a table with one line an instrument."""
    heads = "".join(f" σ = {degrees}° |" for degrees in SIGMAS)
    lines = [f"| instrument |{heads} L\\* at {SIGMAS[-1]}° |", "| --- |" + " --: |" * 4]
    for name in dict.fromkeys(row["instrument"] for row in found):
        own = [row for row in found if row["instrument"] == name]
        cells = "".join(f" {row['mean']:.2f} / {row['maximum']:.2f} |" for row in own)
        lines.append(
            f"| `{name}` |{cells} {own[-1]['mean_lightness']:+.2f} |".replace("+0.00", "0")
        )
    return "\n".join(lines) + "\n"


def fill(page: str, table: str, start: str = START) -> str:
    """Put the table between its marks in the page."""
    before, rest = page.split(start)
    return before + start + "\n" + table + "\n" + END + rest.split(END, 1)[1]


def draw() -> None:
    """Draw mean and maximum of every instrument; needs matplotlib."""
    import matplotlib as mpl

    mpl.use("agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 11, "svg.hashsalt": "rough-spectra"})
    with DATA.open(encoding="utf-8", newline="") as file:
        next(file)
        found = list(csv.DictReader(file))
    names = [n for n in dict.fromkeys(r["instrument"] for r in found) if n != "45a:0"]
    figure, axes = plt.subplots(figsize=(8, 5.6), layout="constrained")
    # Okabe and Ito's colors, told apart by color-blind readers too; so are the marks.
    looks = ((15, SKY, "o", -0.24), (30, ORANGE, "s", 0.0), (45, VERMILION, "D", 0.24))
    for degrees, color, marker, shift in looks:
        chosen = {r["instrument"]: r for r in found if int(r["sigma_degrees"]) == degrees}
        places = [place + shift for place in range(len(names))]
        mean = [float(chosen[name]["mean"]) for name in names]
        most = [float(chosen[name]["maximum"]) for name in names]
        axes.hlines(places, mean, most, color=color, linewidth=2.2)
        axes.plot(
            mean,
            places,
            marker,
            color=color,
            markeredgecolor="black",
            markeredgewidth=0.5,
            label=f"σ = {degrees}°",
            zorder=3,
        )
    axes.axvline(1, color=GRAY, linestyle=":", linewidth=1.5)
    axes.text(1.06, -0.62, "ΔE00 1: just seen", color="#555555", va="center")
    axes.set_xscale("symlog", linthresh=0.1, linscale=0.6)
    axes.set_xlim(-0.01, 30)
    ticks = (0, 0.1, 0.3, 1, 3, 10, 30)
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -1)
    axes.grid(axis="y", color="#e4e4e4")
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_xlabel(
        "ΔE00 from the reading at 45a:0: mark = mean of 24 patches, line = to the largest"
    )
    axes.set_title("Directions matter; apertures hardly do")
    axes.legend(loc="upper right", frameon=True, edgecolor="none")
    figure_style.save(figure, FIGURE, dpi=120)


def main(arguments: list[str]) -> int:
    """Run one part, or both in their environments; returns the exit status."""
    if arguments == ["--numbers"]:
        found = rows()
        DATA.write_text(csv_text(found), encoding="utf-8", newline="\n")
        page = fill(PAGE.read_text("utf-8"), markdown(found))
        page = fill(page, described(), WHICH)
        PAGE.write_text(page, encoding="utf-8", newline="\n")
        return 0
    if arguments == ["--draw"]:
        draw()
        return 0
    from tools.manual import two_pythons

    name = "tools/manual/instruments_table.py"
    return two_pythons.run((name, "--numbers"), (name, "--draw"))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
