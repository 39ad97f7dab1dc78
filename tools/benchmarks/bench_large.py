# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether one process bakes, and checks, a file with a huge number of materials, and what it takes.

    python -m tools.benchmarks.bench_large [--materials 20000]

The materials get smooth random spectra; `bake --predicted-only` then writes their readings, and
`check` measures them. Prints of each step the status, the seconds, and the most memory so far.
Needs an environment with bpy.
"""

from __future__ import annotations

import argparse
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from tools.checks.check_farm import make_scene
from tools.run.run_command_line import load_extension

_MIB = 1024  # kB, which is what Linux gives


def main() -> int:
    """Run the steps one after the other; exit status 0 if each has its own."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--materials", type=int, default=20_000)
    options = parser.parse_args()
    load_extension()
    from rough_spectra.addon.commands import command_line

    with tempfile.TemporaryDirectory() as folder:
        blend, base = Path(folder) / "large.blend", Path(folder) / "readings"

        def make() -> int:
            make_scene(blend, options.materials, 1)
            return 0

        told("make and assign", make)
        words = ["--blend", str(blend), "--quiet"]
        bake = ["bake", *words, "--predicted-only", "--output", str(base)]
        status = told("bake --predicted-only", lambda: command_line.main(bake))
        sizes = {path.name: path.stat().st_size for path in base.parent.glob(f"{base.name}*")}
        print("  " + ", ".join(f"{name} {size / 1e6:.0f} MB" for name, size in sizes.items()))
        return status or told("check", lambda: command_line.main(["check", *words]))


def told(name: str, task: Callable[[], int]) -> int:
    """Do a step, and print what it took with the processes that it started."""
    started, before = time.monotonic(), _processor()
    status = task()
    most = max(resource.getrusage(who).ru_maxrss for who in _WHO) / _MIB
    print(
        f"{name}: status {status}, {time.monotonic() - started:.0f} s, processor "
        f"{_processor() - before:.0f} s, at most {most:.0f} MiB",
        flush=True,
    )
    return status


_WHO = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)


def _processor() -> float:
    used = [resource.getrusage(who) for who in _WHO]
    return sum(each.ru_utime + each.ru_stime for each in used)


if __name__ == "__main__":
    sys.exit(main())
