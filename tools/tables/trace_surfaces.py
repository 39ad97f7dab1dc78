# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Trace Gaussian height fields over directions and roughness, for `make_surface_table`.

    python3 dev.py tables trace_surfaces FOLDER [--processes 2] [--fields 24] [--walks 40000]

Every σ and field is a file of its own in the folder, so that an interrupted run goes
on where it was. Random numbers start from fixed seeds: the same files come out again.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import time
from pathlib import Path

import numpy as np

from core.numerics.arrays import Array

from . import height_field_tracer, height_fields
from .surface_nodes import ORDERS, SIGMA, polar_angles

POINTS = 2048
CORRELATION = 10.0


def trace(sigma: float, field: int, walks: int) -> Array:
    """a_1 … of one field at roughness σ, degrees: (orders, polar, azimuths, ratios)."""
    seed = [20261129, round(sigma * 10), field]
    rng = np.random.default_rng(seed)
    heights = height_fields.gaussian(POINTS, CORRELATION, np.tan(np.radians(sigma)), rng)
    highest = height_field_tracer.tiles(heights)
    start = int(rng.integers(2**31))
    return height_field_tracer.walk(heights, highest, polar_angles(), walks, start, ORDERS)


def _one(task: tuple[Path, float, int, int]) -> float:
    folder, sigma, field, walks = task
    target = folder / f"{sigma:g}-{field}.npy"
    start = time.perf_counter()
    if not target.exists():
        found = trace(sigma, field, walks).astype(np.float32)
        # Light that turns left or right is the same: azimuths 0 to 180°.
        half = height_field_tracer.AZIMUTHS // 2
        folded = found[:, :, : half + 1].copy()
        folded[:, :, 1:half] += found[:, :, :half:-1]
        folded[:, :, 1:half] /= 2
        part = target.with_suffix(".part.npy")
        np.save(part, folded)
        part.replace(target)
    return time.perf_counter() - start


def main() -> int:
    """Trace what is not in the folder yet."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--fields", type=int, default=24)
    parser.add_argument("--walks", type=int, default=40_000, help="a field; a square is best")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    tasks = [
        (options.folder, sigma, field, options.walks)
        for field in range(options.fields)
        for sigma in SIGMA
    ]
    begun = time.perf_counter()
    with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
        for done, _ in enumerate(pool.imap_unordered(_one, tasks), start=1):
            spent = time.perf_counter() - begun
            left = spent / done * (len(tasks) - done)
            sys.stderr.write(f"\r{done} of {len(tasks)} fields, {left:.0f} s left ")
    sys.stderr.write("\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
