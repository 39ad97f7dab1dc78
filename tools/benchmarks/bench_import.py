# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure reading 10,000 samples from one CGATS file and importing them into a library.

    python -m tools.benchmarks.bench_import

Needs numpy and no Blender. Wall and processor time, and the most memory that the process held.
"""

from __future__ import annotations

import resource
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from tools.run.run_command_line import load_extension

SAMPLES = 10_000
BANDS = range(380, 731, 10)

Found = TypeVar("Found")


def main() -> None:
    """Print a line for each step."""
    load_extension()
    from rough_spectra.addon.samples import importing

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "chart.txt"
        write(path)
        print(f"{SAMPLES} samples of {len(BANDS)} bands, {path.stat().st_size / 1e6:.1f} MB")
        print(f"{'before':>10}  most memory {memory():.0f} MB")
        batch = step("read", lambda: importing.read([path]))
        step("add", lambda: importing.add(batch.found, "Chart", Path(folder) / "library"))


def write(path: Path) -> None:
    """Write a chart of random reflectances."""
    import numpy as np

    values = np.random.default_rng(1).uniform(0.05, 0.9, (SAMPLES, len(BANDS)))
    fields = " ".join(f"SPECTRAL_NM{nm}" for nm in BANDS)
    rows = (
        f'{number} "Patch {number}" ' + " ".join(f"{value:.4f}" for value in row)
        for number, row in enumerate(values, 1)
    )
    text = [
        *("CGATS.17", f"NUMBER_OF_FIELDS {len(BANDS) + 2}", "BEGIN_DATA_FORMAT"),
        *(f"SAMPLE_ID SAMPLE_NAME {fields}", "END_DATA_FORMAT"),
        *(f"NUMBER_OF_SETS {SAMPLES}", "BEGIN_DATA", *rows, "END_DATA\n"),
    ]
    path.write_text("\n".join(text), encoding="utf-8")


def step(name: str, work: Callable[[], Found]) -> Found:
    """Do one step and print its cost."""
    wall, processor = time.perf_counter(), time.process_time()
    found = work()
    processor, wall = time.process_time() - processor, time.perf_counter() - wall
    print(
        f"{name:>10}  {wall:.2f} s, {processor:.2f} s of the processor, "
        f"most memory {memory():.0f} MB",
        flush=True,
    )
    return found


def memory() -> float:
    """Most megabytes that the process has held."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    main()
