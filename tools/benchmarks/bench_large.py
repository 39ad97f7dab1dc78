# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether one process bakes, and checks, a file with a huge number of materials, and what it takes.

    python -m tools.benchmarks.bench_large [--materials 20000]

The materials get smooth random spectra; `bake --predicted-only` then writes their readings, and
`check` measures them. Each step is a process of its own. Prints of each the status, the seconds,
those of the processor, and the most memory that it, or a second Blender of its, had.
Needs an environment with bpy.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tools.run.run_command_line import ROOT

_MIB = 1024  # kB, which is what Linux gives
_RUNNER = ROOT / "tools" / "run" / "run_command_line.py"


def main() -> int:
    """Run the steps one after the other; exit status 0 if each has its own."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--materials", type=int, default=20_000)
    parser.add_argument("--make", type=Path, help=argparse.SUPPRESS)  # the first step's process
    options = parser.parse_args()
    if options.make:
        from tools.checks.check_farm import make_scene

        make_scene(options.make, options.materials, 1)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        blend, base = Path(folder) / "large.blend", Path(folder) / "readings"
        count = str(options.materials)
        make = ["-m", "tools.benchmarks.bench_large", "--materials", count, "--make", str(blend)]
        words = ["--blend", str(blend), "--quiet"]
        bake = ["bake", *words, "--predicted-only", "--output", str(base)]
        status = told("make and assign", make) or told(bake[0], [str(_RUNNER), *bake])
        sizes = {path.name: path.stat().st_size for path in base.parent.glob(f"{base.name}*")}
        print("  " + ", ".join(f"{name} {size / 1e6:.0f} MB" for name, size in sizes.items()))
        return status or told("check", [str(_RUNNER), "check", *words])


def told(name: str, words: list[str]) -> int:
    """Do a step, and print what it took with the processes that it started."""
    started = time.monotonic()
    process = subprocess.Popen([sys.executable, *words], cwd=ROOT)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    print(
        f"{name}: status {process.returncode}, {time.monotonic() - started:.0f} s, processor "
        f"{used.ru_utime + used.ru_stime:.0f} s, at most {used.ru_maxrss / _MIB:.0f} MiB",
        flush=True,
    )
    return process.returncode


if __name__ == "__main__":
    sys.exit(main())
