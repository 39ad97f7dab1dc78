# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kill verbs at random moments, and look whether what they write is whole: before it, or after.

    .venv/bpy-5.2/bin/python -m tools.checks.kills --kills 1000

Each verb first writes its files twice, with different options. Then it is started over the first
ones with the second options, and killed by SIGKILL somewhere in the time that it takes. Once an
interrupted publication is settled, as every reader of ours does first, all files have to be those
of one of the two.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import bpy

from tools.checks.check_farm import make_scene
from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension().register()

from rough_spectra.addon.support import journal

RUNNER = ROOT / "tools" / "run" / "run_command_line.py"
_EARLIEST = 0.3
"""Of the time that a verb takes: before, nothing but Blender starts."""

Words = Callable[[Path, int], list[object]]
"""Words of a verb, from the folder that it writes to and which of the two options are meant."""


def main() -> int:
    """Kill all verbs in turn; exit status 0 if no file was ever half."""
    parser = argparse.ArgumentParser(prog="tools.checks.kills", description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=1000, help="in all, over all verbs")
    parser.add_argument("--minutes", type=float, default=600.0, help="after which it ends")
    parser.add_argument("--materials", type=int, default=30, help="of the scene")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "kills")
    options = parser.parse_args()
    folder = options.folder.absolute()
    shutil.rmtree(folder, ignore_errors=True)
    verbs = {
        name: Verb(name, words, folder / name) for name, words in _verbs(folder, options).items()
    }
    until = time.monotonic() + 60 * options.minutes
    random.seed(1)
    for number in range(options.kills):
        if time.monotonic() > until:
            break
        list(verbs.values())[number % len(verbs)].kill()
    for verb in verbs.values():
        print(f"{verb.name}: {dict(verb.found)}", flush=True)
    halves = sum(verb.found["half"] for verb in verbs.values())
    print(f"{sum(verb.found.total() for verb in verbs.values())} kills, {halves} half", flush=True)
    return 1 if halves else 0


def _verbs(folder: Path, options: argparse.Namespace) -> dict[str, Words]:
    scene = folder / "scene.blend"
    make_scene(scene, options.materials, 1)
    table = folder / "tiles.csv"
    bands = "".join(
        f"{nm},{0.3 + nm / 9000:.4f},{0.2 + nm / 9000:.4f}\n" for nm in range(400, 701, 10)
    )
    table.write_text("# geometry: 45/0\nwavelength,Tile,Tile rough\n" + bands)
    parts = folder / "parts"
    for shard in ("1/2", "2/2"):
        words = ["bake", "--blend", scene, "--predicted-only", "--shard", shard]
        _run([*words, "--output", parts / "x"]).wait()
    shards = sorted(parts.glob("*.json"))
    some = ["--material", "Paint 0001", "--material", "Paint 0002"]
    return {
        "bake": lambda to, which: [
            *("bake", "--blend", scene, "--predicted-only", "--output", to / "x"),
            *(["--read-at", "di:8"] if which else []),
        ],
        "export": lambda to, which: [
            *("export", "--blend", scene, "--output", to / "x", *(some if which else [])),
            *("--target", "mitsuba", "--target", "pbrt"),
        ],
        "import": lambda to, which: [
            *("import", table, "--folder", to, "--collection", "b" if which else "a"),
        ],
        "estimate": lambda to, which: [
            *("estimate", table, "--smooth", "Tile", "--rough", "Tile rough"),
            *("--repeatability", which + 1, "--output", to / "x.csv"),
        ],
        "merge": lambda to, which: [
            *("merge", *shards, "--output", to / "x", *(["--format", "csv"] if which else [])),
        ],
    }


class Verb:
    """One verb, and what became of its files."""

    def __init__(self, name: str, words: Words, folder: Path) -> None:
        self.name, self.words, self.folder = name, words, folder
        self.found: Counter[str] = Counter()
        self.old, self.new = folder / "old", folder / "new"
        for to, which in ((self.old, 0), (self.new, 0), (self.new, 1)):
            to.mkdir(parents=True, exist_ok=True)
            started = time.monotonic()
            status = _run(words(to, which)).wait()
            self.seconds = time.monotonic() - started
            if status:
                raise SystemExit(f"{name} ends with status {status}: see why by hand")

    def kill(self) -> None:
        """Start it over the old files, kill it, and look."""
        to = self.folder / "killed"
        shutil.rmtree(to, ignore_errors=True)
        shutil.copytree(self.old, to)
        process = _run(self.words(to, 1))
        time.sleep(random.uniform(_EARLIEST, 1.05) * self.seconds)
        ended = process.poll() is not None
        if not ended:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        journal.finish(to)
        what = _contents(to)
        if what == _contents(self.new):
            self.found["done before" if ended else "new"] += 1
        elif what == _contents(self.old):
            self.found["old"] += 1
        else:
            self.found["half"] += 1
            print(f"{self.name}: half: {sorted(what)}", flush=True)
            shutil.copytree(to, self.folder / f"half-{self.found['half']}")


def _run(words: list[object]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, str(RUNNER), *map(str, words)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def _contents(folder: Path) -> dict[str, bytes]:
    """Give the files that a user sees; hidden ones are locks and what was not finished."""
    return {
        path.name: path.read_bytes()
        for path in folder.iterdir()
        if path.is_file() and not path.name.startswith(".")
    }


if __name__ == "__main__":
    bpy.context.preferences.view.show_splash = False
    sys.exit(main())
