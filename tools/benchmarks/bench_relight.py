# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a step costs of a lamp that is changed in a picture of 1920 × 1080 pixels.

    .venv/bpy-5.2/bin/python -m tools.benchmarks.bench_relight [--lamps 3] [--bands 12]

Milliseconds of the processor, on one thread, medians: an intensity, a spectrum that was there
before, and one that is new, whose weights have to be fitted. Then the same of the panel *Lamps*,
with the pixels in the image of Blender.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import time
from collections.abc import Callable

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: see docs/development.md

import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.picture import relight, relit

ROWS, COLUMNS = 1080, 1920
SURFACES = 24
ROUNDS = 7


def lights(lamps: int, bands: int) -> relight.Lights:
    """Make a picture of noise."""
    chance, grid = np.random.default_rng(1), illuminant_spectra.GRID
    waves = np.cos(np.linspace(0, 3, grid.size) * chance.uniform(0, 4, (SURFACES, 1)))
    return relight.Lights(
        tuple(f"Lamp {number}" for number in range(lamps)),
        np.stack([illuminant_spectra.cie("D65")] * lamps),
        chance.random((lamps, bands, ROWS, COLUMNS), np.float32),
        np.ones((ROWS, COLUMNS), np.float32),
        grid[np.linspace(8, 64, bands).astype(int)],
        0.5 + 0.4 * waves,
        "Linear Rec.709",
    )


def milliseconds(step: Callable[[int], None], then: Callable[[], object]) -> float:
    """Give the median of a step and of the picture after it."""
    found = []
    for number in range(ROUNDS):
        start = time.process_time()
        step(number)
        then()
        found.append(1e3 * (time.process_time() - start))
    return statistics.median(found)


def main() -> None:
    """Print what steps cost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lamps", type=int, default=3)
    parser.add_argument("--bands", type=int, default=12)
    options = parser.parse_args()
    desk = relight.Desk(lights(options.lamps, options.bands))
    desk.xyz()
    known = ("A", "F11")
    for name in known:
        desk.set_light("Lamp 0", name)
        desk.xyz()
    intensity = milliseconds(lambda n: desk.set_intensity("Lamp 0", 1 + n / 10), desk.xyz)
    before = milliseconds(lambda n: desk.set_light("Lamp 0", known[n % 2]), desk.xyz)
    new = milliseconds(
        lambda n: desk.set_light("Lamp 0", illuminant_spectra.planck(3000.0 + 100 * n)), desk.xyz
    )
    print(f"{options.lamps} lamps, {options.bands} bands, {COLUMNS} × {ROWS}:")
    print(f"intensity {intensity:.0f} ms, spectrum {before:.0f} ms, new spectrum {new:.0f} ms")

    in_image(options.lamps, options.bands)


def in_image(lamps: int, bands: int) -> None:
    """Print the same of the image that the panel changes."""
    shown = relit.Relit(lights(lamps, bands), working_space.current().from_xyz)
    relit.put(shown)
    names = ("A", "F11", "D50", "LED-B3")
    intensity = milliseconds(lambda n: shown.set_intensity(0, 1 + n / 10), relit.changed)
    spectrum = milliseconds(lambda n: shown.set_light(0, names[n % 4]), relit.changed)
    other = milliseconds(lambda n: shown.set_intensity(n % lamps, 1 + n / 10), relit.changed)
    print("the image of the panel:")
    print(
        f"intensity {intensity:.0f} ms, of another lamp {other:.0f} ms, spectrum {spectrum:.0f} ms"
    )


if __name__ == "__main__":
    main()
