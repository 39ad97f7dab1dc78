# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether materials read their target at every virtual instrument, rendered.

Assigns 12 ColorChecker presets at four roughnesses to each of the core's instruments, renders that
instrument's lights and apertures in Cycles, and compares with what the model "surface" says that
it reads of the albedo. Writes docs/data/instruments-measured.csv and docs/instruments-measured.md,
which the page of the instruments includes; ends with 1 where a bound is missed. Needs an
environment with bpy:

    python -m tools.checks.check_instruments
"""

from __future__ import annotations

import sys
from dataclasses import astuple, dataclass, fields
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.matching import outside
from rough_spectra.addon.samples import presets
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support import atomic_files
from rough_spectra.core import instruments, reading
from rough_spectra.core.color import color_difference

SIGMAS = (0, 15, 30, 45)
"""Degrees."""
MODEL = "surface"
EXACT, ESTIMATED = 0.05, 0.1
"""Largest ΔE00 where each render is one direction, and where there are apertures or a sphere."""

DOCS = ROOT / "docs"
TABLE = DOCS / "instruments-measured.md"
DATA = DOCS / "data" / "instruments-measured.csv"


@dataclass(frozen=True)
class Row:
    """One material at one instrument.

    Attributes
    ----------
    instrument, sample, sigma_degrees
        Which.
    within
        Whether the matching says that a color within 0 to 1 meets the target.
    delta_e
        Between target and render, CIEDE2000, D65, 2°.
    predicted
        The same as the matching predicts it: how far a color misses that is out of gamut or
        beyond white.
    """

    instrument: str
    sample: str
    sigma_degrees: int
    within: bool
    delta_e: float
    predicted: float


def check(samples: list[Sample], sigmas: tuple[int, ...], names: list[str]) -> list[Row]:
    """Assign, render and compare; the extension has to be registered."""
    keys = [(name, sample, s) for name in names for sample in samples for s in sigmas]
    materials = [bpy.data.materials.new(sample.name) for _, sample, _ in keys]
    requests = [
        api.request(sample, float(np.radians(degrees)), kind="albedo", read_at=name)
        for name, sample, degrees in keys
    ]
    solutions = api.assign(zip(materials, requests, strict=True), gloss="none")
    entries = api.bake(materials).entries
    rows = []
    for (name, sample, degrees), solution, entry in zip(keys, solutions, entries, strict=True):
        if entry.measured is None:
            raise RuntimeError(entry.fault)
        seen = reading.from_albedo(sample.values, np.radians(degrees), MODEL, name)
        lab = tristimulus.spectrum_to_lab(seen, sample.wavelengths, "D65", observer=2)
        apart = float(color_difference.delta_e(lab, np.array(entry.measured.lab)))
        within = not any(outside.MISSES in warning for warning in solution.warnings)
        told = (name, sample.name, degrees, within, apart, solution.delta_e_instrument)
        rows.append(Row(*told))
    return rows


def limit(name: str) -> float:
    """Largest ΔE00 that an instrument may miss by."""
    return ESTIMATED if instruments.has_apertures(name) else EXACT


def table(rows: list[Row]) -> str:
    """Give the table of the manual."""
    lines = [
        "<!-- Made by tools/checks/check_instruments.py -->",
        "",
        "| instrument | materials | mean ΔE00 | largest ΔE00 | bound | beyond gamut or white |",
        "|---|--:|--:|--:|--:|--:|",
    ]
    for name in dict.fromkeys(row.instrument for row in rows):
        mine = [row for row in rows if row.instrument == name]
        met = np.array([row.delta_e for row in mine if row.within])
        out = len(mine) - met.size
        lines.append(
            f"| `{name}` | {met.size} | {met.mean():.4f} | {met.max():.4f} | {limit(name):g} "
            f"| {out} |"
        )
    return "\n".join(lines) + "\n"


def data(rows: list[Row]) -> str:
    """Give all rows as CSV."""
    lines = [
        "# CIEDE2000 between the surface model's reading of ColorChecker albedos at an instrument "
        "and a render of it, D65, 2 deg",
        ",".join(field.name for field in fields(Row)),
    ]
    for row in rows:
        cells = (f"{cell:.5f}" if isinstance(cell, float) else str(cell) for cell in astuple(row))
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def main() -> int:
    """Check everything and write it; 1 where a bound is missed."""
    extension: Any = sys.modules["rough_spectra"]
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.register()
    rows: list[Row] = []
    try:
        samples = presets.load_all("colorchecker")[::2]
        for name in instruments.REGISTRY:
            rows += check(samples, SIGMAS, [name])
            print(table(rows).splitlines()[-1], flush=True)
    finally:
        # Blender trips over classes that are still registered when it ends.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        extension.unregister()
    with atomic_files.publication() as files:
        files.write(TABLE, table(rows).encode())
        files.write(DATA, data(rows).encode())
    missed = [row for row in rows if row.within and row.delta_e > limit(row.instrument)]
    for row in missed:
        print(f"{row.instrument}: {row.sample} at {row.sigma_degrees}°: ΔE00 {row.delta_e:.3f}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
