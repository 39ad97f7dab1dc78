# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the processor time of the verb `assign` grows with the number of materials.

    python -m tools.benchmarks.bench_assign [--few N] [--times N] [--profile STEP]

One process, first few materials and then several times as many, each in a file of its own:
materials that are there, materials that `--create` makes, and samples of a measurement file by
name. Prints each step's seconds and their ratio: a verb that is linear has the ratio of the
materials. Needs an environment with bpy.
"""

from __future__ import annotations

import argparse
import cProfile
import pstats
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.blender import blend_file
from rough_spectra.addon.commands import command_line, mapping
from rough_spectra.addon.samples import presets

FEW = 2000
TIMES = 10
_WARM = 100
"""Materials of a first run, which is not measured: it imports, and fills what is kept."""
_SHOWN = 40  # lines of a profile

Steps = dict[str, float]


def _mapping(path: Path, count: int) -> list[str]:
    """Write a mapping of presets with as many rows."""
    known = presets.names()
    rows = [f"Material {i},{known[i % len(known)]},{45 * i / count:.3f}" for i in range(count)]
    path.write_text("\n".join(["material,sample,sigma_deg", *rows]), encoding="utf-8")
    return ["assign", "--mapping", str(path)]


def _table(path: Path, count: int) -> list[str]:
    """Write a measurement file with as many samples."""
    bands = np.arange(400, 701, 10)
    values = np.random.default_rng(1).uniform(0.05, 0.9, (count, bands.size))
    rows = [
        ",".join([f"Material {i}", *(f"{value:.5f}" for value in row)])
        for i, row in enumerate(values.tolist())
    ]
    path.write_text("\n".join([",".join(["name", *map(str, bands)]), *rows]), encoding="utf-8")
    return ["assign", "--by-name", str(path), "--sigma", "20"]


def run(words: list[str], output: Path, profiled: str = "") -> Steps:
    """Do what the verb does, step by step; gives the seconds of processor time of each."""
    options = command_line._parser().parse_args([*words, "--output", str(output)])
    took: Steps = {}

    def step(name: str, task: Callable[[], Any]) -> Any:
        profile = cProfile.Profile() if name == profiled else None
        start = time.process_time()
        found = profile.runcall(task) if profile else task()
        took[name] = time.process_time() - start
        if profile:
            pstats.Stats(profile).sort_stats("tottime").print_stats(_SHOWN)
        return found

    rows = step("read", lambda: mapping.rows(options))
    pairs = step("pair", lambda: mapping.pair(rows, options))
    step("assign", lambda: mapping.assign(pairs, options.gloss))
    step("save", lambda: blend_file.save(options.output))
    took["all"] = sum(took.values())
    return took


def compare(
    folder: Path,
    write: Callable[[Path, int], list[str]],
    few: int,
    times: int,
    *,
    create: bool,
    profiled: str = "",
) -> tuple[Steps, Steps]:
    """Give the seconds of few materials, and those of several times as many."""
    found = []
    for count in (min(_WARM, few), few, few * times):
        words = write(folder / "rows.csv", count) + ["--create"] * create
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        for number in range(0 if create else count):
            bpy.data.materials.new(f"Material {number}").use_fake_user = True
        found.append(run(words, folder / "out.blend", profiled if count == few * times else ""))
    return found[1], found[2]


CASES: dict[str, tuple[Callable[[Path, int], list[str]], bool]] = {
    "presets, materials in the file": (_mapping, False),
    "presets, --create": (_mapping, True),
    "a measurement file, --by-name": (_table, False),
}


def main() -> int:
    """Print what each case took, and how many times as much the many."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--few", type=int, default=FEW, help="materials of the first run")
    parser.add_argument("--times", type=int, default=TIMES, help="how many times as many then")
    parser.add_argument("--profile", default="", metavar="STEP", help="show where it spends time")
    options = parser.parse_args()
    extension = sys.modules["rough_spectra"]
    extension.register()
    try:
        with tempfile.TemporaryDirectory() as folder:
            for name, (write, create) in CASES.items():
                few, many = compare(
                    Path(folder),
                    write,
                    options.few,
                    options.times,
                    create=create,
                    profiled=options.profile,
                )
                print(f"{name}: {options.few:,} and {options.few * options.times:,} materials")
                for step, seconds in few.items():
                    ratio = many[step] / max(seconds, 1e-9)
                    print(f"  {step:7}{seconds:8.2f} s {many[step]:8.2f} s {ratio:8.1f}")
                sys.stdout.flush()
    finally:
        extension.unregister()
    return 0


if __name__ == "__main__":
    sys.exit(main())
