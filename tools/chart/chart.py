# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure every method against two truths, peers included, and draw the chart into docs/.

`python3 dev.py chart` starts it: python -m tools.chart.chart --draw PYTHON [--peers PYTHON]. Each
part runs in a process of its own, one after the other, and leaves its numbers in build/chart.
"""

from __future__ import annotations

import argparse
import os
import platform
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from tools.chart.chart_timing import SINGLE_THREAD, load
from tools.chart.chart_work import write_json
from tools.run.run_command_line import ROOT

FOLDER = ROOT / "build" / "chart"

PEERS: dict[str, tuple[str, list[tuple[str, ...]]]] = {
    "mitsuba-diffuse": (
        "Mitsuba diffuse",
        [
            ("tools.chart.chart_mitsuba", "diffuse", variant)
            for variant in ("llvm_ad_spectral", "scalar_spectral")
        ],
    ),
    "mitsuba-principled": (
        "Mitsuba principled",
        [
            ("tools.chart.chart_mitsuba", "principled", variant)
            for variant in ("llvm_ad_spectral", "scalar_spectral")
        ],
    ),
    "luxcore-roughmatte": ("LuxCore roughmatte", [("tools.chart.chart_luxcore",)]),
}
"""Label of each peer, and the ways to run it, best first. Mitsuba's vectorized variants need an
LLVM library on the machine that is not too old, and end the process where it is."""


def run(python: str | Path, *words: str | Path, log: Path | None = None) -> int:
    """Run one part on one thread and return its exit status."""
    environment = os.environ | SINGLE_THREAD | {"BLENDER_USER_RESOURCES": str(FOLDER / "user")}
    command = [str(python), "-m", *map(str, words)]
    if log is None:
        return subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode
    with log.open("wb") as stream:
        return subprocess.run(
            command, cwd=ROOT, env=environment, stdout=stream, stderr=stream, check=False
        ).returncode


def run_peer(key: str, python: Path | None) -> None:
    """Have a peer answer; where it can't, write down why."""
    label, ways = PEERS[key]
    numbers = FOLDER / f"peer-{key}.json"
    reason = "its environment could not be set up"
    for way in ways if python is not None else ():
        log = FOLDER / f"peer-{key}.log"
        status = run(python or "", *way, FOLDER, log=log)
        if status == 0 and numbers.exists():
            return
        numbers.unlink(missing_ok=True)
        lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
        reason = (
            f"{' '.join(way[1:]) or label} ended with status {status}: {(lines or ['no word'])[-1]}"
        )
        print(f"  {reason}", flush=True)
    write_json(numbers, {"key": key, "label": label, "group": "peer", "missing": reason})


def processor() -> str:
    """Name of the processor, as far as the system tells."""
    known = Path("/proc/cpuinfo")
    if known.exists():
        for line in known.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def used_seconds() -> int:
    """Processor time of all parts so far."""
    times = os.times()
    return round(times.user + times.system + times.children_user + times.children_system)


def main(argv: Sequence[str]) -> int:
    """Run all parts; returns the exit status."""
    parser = argparse.ArgumentParser(prog="tools.chart.chart", description=__doc__)
    parser.add_argument("--draw", required=True, type=Path, help="Python that has matplotlib")
    parser.add_argument("--peers", type=Path, help="Python that has Mitsuba and pyluxcore")
    options = parser.parse_args(argv)
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    start = time.monotonic()

    def step(what: str) -> None:
        print(f"{time.monotonic() - start:5.0f} s  {what}", flush=True)

    loads = [load()]
    step("the V-cavity and the traces")
    status = run(sys.executable, "tools.chart.chart_measure", "work", FOLDER)
    if status:
        return status
    for key, (label, _) in PEERS.items():
        step(label)
        run_peer(key, options.peers)
    for what, name in (
        ("our methods", ("tools.chart.chart_measure", "methods")),
        ("speed of the core", ("tools.chart.chart_speed",)),
        ("Blender", ("tools.chart.chart_blender",)),
    ):
        step(what)
        loads.append(load())
        log = FOLDER / "blender.log" if what == "Blender" else None
        status = run(sys.executable, *name, FOLDER, log=log)
        if status:
            print(
                f"{what}: exit status {status}" + (f"; see {log}" if log else ""), file=sys.stderr
            )
            return status
    machine = {"processor": processor(), "cores": os.cpu_count(), "load": max(loads)}
    machine |= {"seconds": round(time.monotonic() - start), "processor_seconds": used_seconds()}
    machine |= {"python": platform.python_version(), "system": platform.system()}
    write_json(FOLDER / "machine.json", machine)
    step("figures and tables")
    status = run(options.draw, "tools.chart.chart_draw", FOLDER)
    step("done" if status == 0 else f"drawing failed with exit status {status}")
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
