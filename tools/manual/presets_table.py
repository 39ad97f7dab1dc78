# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the manual's table of everyday presets: swatch, σ and what it matters, gloss, source.

    python -m tools.manual.presets_table [FILE]

Needs the packages that the extension bundles, and no Blender.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import srgb, tristimulus
from rough_spectra.addon.samples import presets
from rough_spectra.core import ladder, reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import direction_grid

FILE = ROOT / "docs" / "presets-table.md"
COLLECTION = "everyday"

HEAD = "| | id | name | σ, estimated | ΔE00 of ±10° | because | gloss, estimated | spectrum |"
RULE = "|---|---|---|---|---|---|---|---|"

STEP = np.radians(10)
"""One step of the estimates."""
DIRECTIONS = 100


def difference_of_a_step(sample: Any) -> float:
    """Return the larger mean ΔE00 of σ one step lower and one higher, the reading kept.

    Over `DIRECTIONS` of light and view below 80°, all bounces counted, under D65.
    """
    weights = tristimulus.weights(sample.wavelengths, "D65", 2)
    directions = direction_grid.hemisphere(DIRECTIONS)

    def seen(sigma: float) -> Any:
        albedo = reading.to_albedo(sample.reflectance, sigma, "closure", sample.instrument)
        spectra = ladder.reflectance("closure", np.minimum(albedo, 1), *directions, sigma)
        return color_difference.xyz_to_lab(spectra @ weights, weights.sum(axis=0))

    sigma = np.radians(sample.sigma_degrees)
    return max(
        float(color_difference.delta_e(seen(sigma + step), seen(sigma)).mean())
        for step in (-STEP, STEP)
    )


def row(name: str, sample: Any, hexadecimal: str) -> str:
    """Return one line of the table."""
    swatch = (
        f'<span style="background:{hexadecimal};display:inline-block;width:2.5em;height:1.4em">'
        "</span>"
    )
    file = re.search(r"'([^']+)'$", sample.source)
    origin = "Physically Based" if sample.license == "CC0-1.0" else "USGS splib07"
    why = sample.sigma_source.partition("because ")[2]
    gloss = "none"
    if sample.gloss:
        [(angle, units)] = sample.gloss
        shine = sample.gloss_source.partition("because ")[2]
        gloss = f"{units:g} GU at {angle:g}°: {shine}"
    return (
        f"| {swatch} | `{name.partition('/')[2]}` | {sample.name} | {sample.sigma_degrees:g}° | "
        f"{difference_of_a_step(sample):.1f} | {why} | {gloss} | "
        f"{origin}: `{file[1] if file else ''}` |"
    )


def swatches(samples: list[Any]) -> list[str]:
    """Return the samples' colors under D65 for the 2° observer, as ``#rrggbb``."""
    found = []
    for sample in samples:
        xyz = sample.reflectance @ tristimulus.weights(sample.wavelengths, "D65", 2)
        encoded = srgb.encode(np.clip(srgb.FROM_XYZ @ xyz, 0, 1))
        found.append("#" + "".join(f"{round(255 * value):02x}" for value in encoded))
    return found


def main(arguments: list[str]) -> int:
    """Write the table and say where."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("file", type=Path, nargs="?", default=FILE)
    file = parser.parse_args(arguments).file
    names = presets.names_of(COLLECTION)
    samples = presets.load_all(COLLECTION)
    lines = [HEAD, RULE]
    rows = zip(names, samples, swatches(samples), strict=True)
    lines += [row(*one) for one in rows]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(names)} presets in {file}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
