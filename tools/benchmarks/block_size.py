# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure which block size suits the core: `python -m tools.benchmarks.block_size`.

Prints, for each block size, the time of a million geometries by 31 bands in float32 as a multiple
of the plain matmul and trigonometry, and of inverting a million spectra as a multiple of a copy.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from unittest import mock

import numpy as np

from core import oren_nayar, reading
from core.numerics import blocks

_GEOMETRIES = 10**6
_BANDS = 31
_REPEATS = 5


def best(work: Callable[[], object]) -> float:
    """Shortest of several runs, seconds: what the machine can do when nothing disturbs it."""
    times = []
    for _ in range(_REPEATS):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    """Print the table."""
    rng = np.random.default_rng(0)
    light, view = np.arcsin(np.sqrt(rng.random((2, _GEOMETRIES)))).astype(np.float32)
    azimuth = (np.pi * rng.random(_GEOMETRIES)).astype(np.float32)
    albedo = rng.random(_BANDS).astype(np.float32)
    readings = (0.8 * rng.random((_GEOMETRIES, _BANDS))).astype(np.float32)
    pairs = rng.random((_GEOMETRIES, 2)).astype(np.float32)
    basis = np.stack((albedo, albedo * albedo))

    def trigonometry() -> None:
        high, low = np.maximum(light, view), np.minimum(light, view)
        np.cos(azimuth), np.sin(high), np.tan(low), np.tan((high + low) / 2)

    print("block    evaluate / (matmul + trigonometry)    invert / copy")
    for exponent in range(10, 23, 2):
        # The default argument is bound at definition, hence the patch of it.
        with mock.patch.object(blocks.blocks, "__defaults__", (1 << exponent,)):
            plain = best(lambda: pairs @ basis) + best(trigonometry)
            evaluate = best(lambda: oren_nayar.reflectance(albedo, light, view, azimuth, 0.5))
            invert = best(lambda: reading.to_albedo(readings, 0.5)) / best(readings.copy)
        print(f"2^{exponent:<6} {evaluate / plain:12.2f} {invert:36.2f}")


if __name__ == "__main__":
    main()
