# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What bands cost in a closed room of ColorChecker patches, and how far colors are off with them.

    .venv/bpy-5.2/bin/python -m tools.benchmarks.bench_bands [--write]

Predicted ΔE00 of plain RGB, of RGB matched to the light, of the same in Rec.2020, and of 3 to 12
bands, under three lights. --write puts the table into docs/bands-table.md and docs/data/bands.csv,
which tools/manual/bands_figures.py draws.
"""

from __future__ import annotations

import argparse
import csv
import os
import statistics
import sys
import time
from collections.abc import Iterator
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: see docs/development.md

import numpy as np

from core import bands
from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.samples import presets
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import wavelength_grid

LIGHTS = ("D65", "A", "F11")
COUNTS = (3, 6, 9, 12)
ROUNDS = 9
REC709 = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
REC2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046))
"""Chromaticities of their primaries (ITU-R BT.709 and BT.2020)."""
TABLE, DATA = ROOT / "docs" / "bands-table.md", ROOT / "docs" / "data" / "bands.csv"


def to_xyz(primaries: Any) -> Any:
    """Matrix from linear RGB to XYZ with D65 as white."""
    columns = np.array([[x / y, 1, (1 - x - y) / y] for x, y in primaries]).T
    white = illuminant_spectra.to_xyz(illuminant_spectra.cie("D65"))
    return columns * np.linalg.solve(columns, white)


def matched(albedos: Any, light: Any, eye: Any, matrix: Any) -> Any:
    """RGB in which surfaces have their color under a light."""
    colors = (albedos * light) @ eye @ np.linalg.inv(matrix).T
    return np.clip(colors / (light @ eye @ np.linalg.inv(matrix).T), 0, 1)


def plain(albedos: Any, eye: Any, matrix: Any) -> Any:
    """RGB in which they have their color under D65."""
    light = illuminant_spectra.cie("D65")
    adapted = color_difference.adaptation(light @ eye, matrix @ np.ones(3))
    colors = (albedos * light) @ eye @ (np.linalg.inv(matrix) @ adapted).T
    return np.clip(colors / (light @ eye)[1], 0, 1)


def rows() -> Iterator[tuple[str, str, int, bands.Error, float | None]]:
    """Name, light, passes, error and milliseconds."""
    samples = [presets.load(name) for name in presets.names() if name.startswith("colorchecker/")]
    nm, eye = illuminant_spectra.GRID, illuminant_spectra.observer()
    albedos = np.stack(
        [wavelength_grid.resample(s.reflectance, s.wavelengths, nm, ends="hold") for s in samples]
    )
    per_nm, eye = eye, eye * np.gradient(nm)[:, np.newaxis]
    narrow, wide = to_xyz(REC709), to_xyz(REC2020)
    for name in LIGHTS:
        light = illuminant_spectra.cie(name)
        for label, colors, space in (
            ("RGB", plain(albedos, eye, narrow), narrow),
            ("RGB, matched to the light", matched(albedos, light, eye, narrow), narrow),
            ("RGB, matched, Rec.2020", matched(albedos, light, eye, wide), wide),
        ):
            error = bands.rgb(nm, albedos, [light], per_nm, colors, space)
            yield label, name, 1, error, None
        for direct in (False, True):
            for count in COUNTS:
                seconds = []
                for _ in range(ROUNDS):
                    start = time.perf_counter()
                    found = bands.choose(
                        nm, albedos, [light], per_nm, 0.0, most=count, direct=direct
                    )
                    seconds.append(time.perf_counter() - start)
                label = f"{count} bands" + ", direct light apart" * direct
                yield (
                    label,
                    name,
                    count // 3 + direct,
                    found.error,
                    1e3 * statistics.median(seconds),
                )


def main() -> None:
    """Print the table, and write it if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    found = list(rows())
    names = list(dict.fromkeys(row[0] for row in found))
    of = {(label, light): (passes, error, took) for label, light, passes, error, took in found}
    lines = [f"| picture | renders | {' | '.join(LIGHTS)} | chosen in |", "|---|---|" + "---|" * 4]
    for label in names:
        passes, _, took = of[label, LIGHTS[0]]
        cells = [of[label, light][1] for light in LIGHTS]
        told = [f"{e.mean:.2f} / {e.usual:.2f} / {e.largest:.1f}" for e in cells]
        chosen = "" if took is None else f"{took:.0f} ms"
        lines.append(f"| {label} | {passes} | {' | '.join(told)} | {chosen} |")
    print("\n".join(lines))
    if options.write:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")
        with DATA.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(("picture", "renders", "light", "mean", "percentile_95", "largest"))
            for label, light, passes, error, _ in found:
                figures = (f"{x:.4f}" for x in (error.mean, error.usual, error.largest))
                writer.writerow((label, passes, light, *figures))


if __name__ == "__main__":
    main()
