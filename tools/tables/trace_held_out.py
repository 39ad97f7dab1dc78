# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Trace surfaces that no table was made from, for the tests and the manual to judge by.

    python3 dev.py tables trace_held_out [--processes 2] [KIND …]

Paths start at the eye, as those of the table do not; fields, grids and random numbers
are others. Written is tests/fixtures/traces/KIND-σ.csv: a line for each of 65 directions below 80°
with the reflectance factor at six albedos and its standard error.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys

import numpy as np

from core.numerics.arrays import Array

from . import height_field_tracer, height_fields, traces

CASES = (
    *(("gaussian", sigma) for sigma in (15, 30, 45)),
    *(("multi-scale", sigma) for sigma in (15, 30, 45)),
    ("band", 30),
    ("grooves", 30),
    ("grains", 30),
)
POINTS = 2048
FIELDS = 48
PATHS = 2_500
AT_THE_INSTRUMENT = 90_000
"""Paths of a field and direction; at 45°/0° more, since σ is inferred there from small changes."""
ORDERS = 64


def directions() -> Array:
    """45°/0°, and 64 directions that crowd as light over the hemisphere does: shape (65, 3)."""
    rng = np.random.default_rng(1994)
    polar = np.arcsin(np.sqrt(rng.random((2, 64))) * np.sin(np.radians(80)))
    others = np.stack((*polar, rng.uniform(0, np.pi, 64)), axis=-1)
    return np.concatenate(([[np.pi / 4, 0.0, 0.0]], others))


def field(kind: str, sigma: float, rng: np.random.Generator) -> Array:
    """Make one surface; σ in degrees."""
    rdq = float(np.tan(np.radians(sigma)))
    if kind == "gaussian":
        return height_fields.gaussian(POINTS, 14.0, rdq, rng)
    if kind == "multi-scale":
        return height_fields.power_law(POINTS, 3.6, (10.0, 320.0), rdq, rng)
    if kind == "band":
        return height_fields.power_law(POINTS, 0.0, (24.0, 48.0), rdq, rng)
    if kind == "grains":
        return height_fields.with_slope(height_fields.grains(POINTS, 16.0, 3.0, rng), rdq)
    # Slopes of a Gaussian surface, over the area seen from above: 1 - exp(-tan² θ / 2 m²).
    shares = (np.arange(128) + 0.5) / 128
    slopes = np.arctan(rdq * np.sqrt(-2 * np.log1p(-shares)))
    return height_fields.grooves(rng.permutation(slopes), POINTS, 8)


def trace(task: tuple[str, float, int]) -> Array:
    """Reflectance factors of one field: (directions, albedos)."""
    kind, sigma, number = task
    rng = np.random.default_rng([1994, number, round(sigma), *kind.encode()])
    heights = field(kind, sigma, rng)
    highest = height_field_tracer.tiles(heights)
    start = int(rng.integers(2**31))
    first, others = np.split(directions(), [1])
    parts = ((first, AT_THE_INSTRUMENT), (others, PATHS))
    series = np.concatenate(
        [
            height_field_tracer.looks(heights, highest, some, paths, start, ORDERS)
            for some, paths in parts
        ],
        axis=1,
    )
    powers = traces.ALBEDOS ** np.arange(1, ORDERS + 1)[:, np.newaxis]
    return np.asarray(series.T @ powers)


def main() -> int:
    """Trace and write."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("kinds", nargs="*", metavar="KIND", help="all unless named")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    traces.FOLDER.mkdir(parents=True, exist_ok=True)
    with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
        for kind, sigma in CASES:
            if options.kinds and kind not in options.kinds:
                continue
            found = np.stack(pool.map(trace, [(kind, sigma, i) for i in range(FIELDS)], 1))
            mean, error = found.mean(axis=0), found.std(axis=0, ddof=1) / np.sqrt(FIELDS)
            rows = np.concatenate((np.degrees(directions()), mean, error), axis=1)
            names = ["light", "view", "azimuth"]
            names += [f"r_{albedo:g}" for albedo in traces.ALBEDOS]
            names += [f"error_{albedo:g}" for albedo in traces.ALBEDOS]
            target = traces.path(kind, sigma)
            np.savetxt(target, rows, "%.6g", ",", header=",".join(names), comments="")
            sys.stdout.write(f"{target.name}: noise {np.median(error / mean):.2%} in the median\n")
            sys.stdout.flush()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
