# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast the main computations are, beside a copy, a plain product or the peer in the same run.

A ratio within one run says more of another machine than seconds do. Each line also says how
exact the result is. Writes docs/data/benchmark.csv and docs/benchmark-table.md with --write, and
prints the table in any case. Needs an environment with bpy:

    python -m tools.benchmarks.bench [--write]
"""

from __future__ import annotations

import argparse
import platform
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any
from unittest import mock

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive
from rough_spectra.addon.samples import presets
from rough_spectra.addon.support import atomic_files
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import oren_nayar, reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import direction_grid

MATERIALS = 1000
ROWS = 100_000
BANDS = 31
FEW_PAIRS = 66
"""As many as a step of σ asks for at once: two materials in 33 directions."""
PEER_SPECTRA = 50
"""The peer takes most of a millisecond for each, so it gets fewer; times are a spectrum's."""
SIGMA = np.pi / 6

DOCS = ROOT / "docs"
TABLE = DOCS / "benchmark-table.md"
DATA = DOCS / "data" / "benchmark.csv"


@dataclass(frozen=True)
class Row:
    """One measured task.

    Attributes
    ----------
    task, baseline
        What was timed, and what stands beside it.
    milliseconds, baseline_milliseconds
        Shortest of the repetitions; the baseline's is None where there is none.
    rate
        What of the task is done in a second, with its unit.
    accuracy
        The largest error of the result, with what it is compared to.
    """

    task: str
    milliseconds: float
    baseline: str
    baseline_milliseconds: float | None
    rate: str
    accuracy: str

    @property
    def ratio(self) -> str:
        """Time of the task over that of its baseline."""
        if self.baseline_milliseconds is None:
            return ""
        ratio = self.milliseconds / self.baseline_milliseconds
        return f"{ratio:.2g}" if ratio < 1 else f"{ratio:.1f}"


def best_milliseconds(*tasks: Callable[[], object], repetitions: int = 40) -> list[float]:
    """Time tasks in turns and give the shortest of each: what other processes take is left out."""
    times: list[list[float]] = [[] for _ in tasks]
    for _ in range(repetitions + 1):
        for found, task in zip(times, tasks, strict=True):
            start = time.perf_counter()
            task()
            found.append(1000 * (time.perf_counter() - start))
    return [min(found[1:]) for found in times]


def largest_relative_error(found: Any, exact: Any) -> float:
    """Return the largest |found - exact| / |exact|."""
    return float(np.max(np.abs(found.astype(np.float64) - exact) / np.abs(exact)))


def reflectance_row() -> Row:
    """One spectrum in many geometries, beside the bare product that is left of it."""
    light, view, azimuth = (angle.astype(np.float32) for angle in direction_grid.hemisphere(ROWS))
    albedo = np.linspace(0.05, 0.95, BANDS, dtype=np.float32)
    pairs = np.stack(oren_nayar.factors(light, view, azimuth, SIGMA), axis=-1)
    rows = np.stack((albedo, albedo * albedo))

    def task() -> Any:
        return oren_nayar.reflectance(albedo, light, view, azimuth, SIGMA)

    took, beside = best_milliseconds(task, lambda: pairs @ rows)
    spectrum, *angles = (values.astype(np.float64) for values in (albedo, light, view, azimuth))
    factors = oren_nayar.factors(angles[0], angles[1], angles[2], float(np.float32(SIGMA)))
    exact = np.stack(factors, axis=-1) @ np.stack((spectrum, spectrum * spectrum))
    # Opposite grazing, where the published model passes through zero, has no relative error.
    error = float(np.max(np.abs(task() - exact)))
    return Row(
        f"two-bounce reflectance of {ROWS:,} geometries × {BANDS} bands, float32",
        took,
        "product (N, 2) @ (2, 31) alone",
        beside,
        f"{ROWS * BANDS / took / 1e3:,.0f} million values/s",
        f"{error:.1e} absolute, from float64",
    )


def to_albedo_row() -> Row:
    """Invert many readings, beside a copy of them."""
    rng = np.random.default_rng(1)
    albedo = rng.uniform(0.02, 1, (ROWS, BANDS))
    readings = reading.from_albedo(albedo, SIGMA).astype(np.float32)
    exact = reading.to_albedo(readings.astype(np.float64), SIGMA)

    def task() -> Any:
        return reading.to_albedo(readings, SIGMA)

    took, beside = best_milliseconds(task, readings.copy)
    return Row(
        f"albedo behind {ROWS:,} readings × {BANDS} bands, float32",
        took,
        "copy of the same bytes",
        beside,
        f"{ROWS / took / 1e3:,.1f} million spectra/s",
        f"{largest_relative_error(task(), exact):.1e} relative, from float64",
    )


def xyz_row() -> Row:
    """Turn spectra into XYZ by one matrix, beside colour-science spectrum by spectrum."""
    science = colour()
    samples = presets.load_all("colorchecker")
    values = np.stack([sample.values for sample in samples])
    wavelengths = samples[0].wavelengths
    many = np.tile(values, (ROWS // len(values), 1))
    matrix = tristimulus.weights(wavelengths)
    chosen = many[:PEER_SPECTRA]

    def peer() -> Any:
        return np.stack(
            [
                science.sd_to_XYZ(
                    science.SpectralDistribution(row, wavelengths),
                    cmfs=science.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"],
                    illuminant=science.SDS_ILLUMINANTS["D65"],
                    method="ASTM E308",
                )
                for row in chosen
            ]
        )

    with warnings.catch_warnings():
        # The peer tells of every table that it aligns.
        warnings.simplefilter("ignore")
        took, beside = best_milliseconds(lambda: many @ matrix, peer, repetitions=5)
        white = matrix.sum(axis=0)
        labs = (color_difference.xyz_to_lab(xyz, white) for xyz in (chosen @ matrix, peer() / 100))
    error = float(color_difference.delta_e(*labs).max())
    return Row(
        f"XYZ of a spectrum of {wavelengths.size} bands, ASTM E308, float64",
        took / len(many),
        "`colour.sd_to_XYZ` for each",
        beside / PEER_SPECTRA,
        f"{len(many) / took / 1e3:,.1f} million spectra/s",
        f"ΔE00 {error:.0e}, from the peer",
    )


def delta_e_rows() -> list[Row]:
    """Color differences of many pairs and of a slider's few, beside the peer and in one block."""
    rng = np.random.default_rng(2)
    rows = []
    for count, repetitions in ((ROWS, 15), (FEW_PAIRS, 400)):
        lab = rng.uniform((0, -60, -60), (100, 60, 60), (count, 3))
        other = lab + rng.normal(0, 3, lab.shape)

        def task(lab: Any = lab, other: Any = other) -> Any:
            return color_difference.delta_e(lab, other)

        def peer(lab: Any = lab, other: Any = other) -> Any:
            return colour().delta_E(lab, other, method="CIE 2000")

        error = f"{float(np.max(np.abs(task() - peer()))):.0e}, from the peer"
        took, beside = best_milliseconds(task, peer, repetitions=repetitions)
        named = f"ΔE00 of {count:,} pairs, float64"
        rate = f"{count / took / 1e3:,.1f} million pairs/s"
        rows.append(Row(named, took, "`colour.delta_E`", beside, rate, error))

        def whole(task: Callable[[], Any] = task, count: int = count) -> Any:
            with mock.patch.object(color_difference, "_PAIRS", count):
                return task()

        if count == ROWS:
            took, beside = best_milliseconds(task, whole, repetitions=repetitions)
            rows.append(Row(named, took, "the same in one block", beside, rate, error))
    return rows


def assign_row() -> Row:
    """Assign presets to many materials of one file."""
    samples = presets.load_all("colorchecker")
    requests = [
        solve.Request(samples[i % len(samples)], float(np.radians(45 * i / MATERIALS)))
        for i in range(MATERIALS)
    ]
    materials = [bpy.data.materials.new(f"Bench {i}") for i in range(MATERIALS)]
    pairs = list(zip(materials, requests, strict=True))
    solutions = derive.assign(pairs)

    def task() -> None:
        derive.assign(pairs)

    (took,) = best_milliseconds(task, repetitions=4)
    met = [s.delta_e_instrument for s in solutions if not any("gamut" in w for w in s.warnings)]
    return Row(
        f"assign {MATERIALS:,} materials: match, write nodes, store",
        took,
        "",
        None,
        f"{1000 * MATERIALS / took:,.0f} materials/s",
        f"ΔE00 {max(met):.0e} at 45°/0°, predicted",
    )


def compute() -> list[Row]:
    """Run all benchmarks; the extension has to be registered."""
    return [reflectance_row(), to_albedo_row(), xyz_row(), *delta_e_rows(), assign_row()]


def environment() -> str:
    """Say in which software, on what kind of machine."""
    versions = f"Blender {bpy.app.version_string}, Python {platform.python_version()}"
    return f"{versions}, numpy {np.__version__}, {platform.system()} {platform.machine()}"


def csv_text(rows: list[Row]) -> str:
    """Give the rows as CSV with a comment line that says what they are."""
    return "\n".join(
        [
            f"# Shortest of repeated runs in turns, one process; {environment()}",
            "task,milliseconds,baseline,baseline_milliseconds,ratio,rate,accuracy",
            *(
                f'"{row.task}",{row.milliseconds:.6g},"{row.baseline}",'
                f"{'' if row.baseline_milliseconds is None else f'{row.baseline_milliseconds:.6g}'}"
                f',{row.ratio},"{row.rate}","{row.accuracy}"'
                for row in rows
            ),
            "",
        ]
    )


def markdown(rows: list[Row]) -> str:
    """Give the rows as a Markdown table."""
    return "\n".join(
        [
            "<!-- Made by tools/benchmarks/bench.py -->",
            "",
            "| task | beside | time over that | rate | largest error |",
            "|---|---|---|---|---|",
            *(
                f"| {row.task} | {row.baseline or '—'} | {row.ratio or '—'} | {row.rate} | "
                f"{row.accuracy} |"
                for row in rows
            ),
            "",
            f"Shortest of repeated runs in turns, one process; {environment()}. Rates are of one "
            "machine; ratios differ less between machines, by how fast memory is beside the core.",
            "",
        ]
    )


def main(arguments: list[str]) -> int:
    """Run, print, and write the files if asked; returns the exit status."""
    parser = argparse.ArgumentParser(prog="dev.py bench", description=__doc__.partition("\n")[0])
    parser.add_argument("--write", action="store_true", help="replace the manual's table by this")
    options = parser.parse_args(arguments)
    extension: Any = sys.modules["rough_spectra"]
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.register()
    try:
        rows = compute()
    finally:
        # Blender trips over classes that are still registered when it ends.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        extension.unregister()
    if options.write:
        with atomic_files.publication() as files:
            files.write(DATA, csv_text(rows).encode())
            files.write(TABLE, markdown(rows).encode())
    print(markdown(rows), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
