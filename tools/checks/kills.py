# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kill verbs at random moments, and look whether what they write is whole: before it, or after.

    .venv/bpy-5.2/bin/python -m tools.checks.kills --kills 1000 [VERB ...]

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
from pathlib import Path

import bpy

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension().register()

from rough_spectra.addon.support import journal
from rough_spectra.addon.support.openimageio import openimageio

from tools.checks import kill_cases
from tools.checks.kill_cases import Words

RUNNER = ROOT / "tools" / "run" / "run_command_line.py"
_EARLIEST = 0.3
"""Of the time that a verb takes: before, nothing but Blender starts."""
_AIMED, _WRITING = 0.5, 0.05
"""How many kills come after a file appeared or changed, and seconds within which they do."""


def main() -> int:
    """Kill all verbs in turn; exit status 0 if no file was ever half."""
    parser = argparse.ArgumentParser(prog="tools.checks.kills", description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=1000, help="in all, over all verbs")
    parser.add_argument("--minutes", type=float, default=600.0, help="after which it ends")
    parser.add_argument("--materials", type=int, default=30, help="of the scene without light")
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "kills")
    parser.add_argument("verbs", nargs="*", metavar="VERB", help="all that write, if none is named")
    options = parser.parse_args()
    folder = options.folder.absolute()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    until = time.monotonic() + 60 * options.minutes
    verbs = []
    left = []
    for name, words in _verbs(folder, options).items():
        try:
            verbs.append(Verb(name, words, folder / name.replace(" ", "")))
        except _NotReadyError as error:
            left.append(name)
            print(f"{name}: {error}", flush=True)
            continue
        print(f"{name}: {verbs[-1].seconds:.1f} s", flush=True)
    random.seed(1)
    for number in range(options.kills):
        if time.monotonic() > until:
            break
        verbs[number % len(verbs)].kill()
    for verb in verbs:
        print(f"{verb.name}: {dict(verb.found)}", flush=True)
    halves = sum(verb.found["half"] for verb in verbs)
    print(f"{sum(verb.found.total() for verb in verbs)} kills, {halves} half", flush=True)
    return 1 if halves or left else 0


def _verbs(folder: Path, options: argparse.Namespace) -> dict[str, Words]:
    cases = kill_cases.of_tables(folder) | kill_cases.of_scenes(folder, options.materials)
    for shard in ("1/2", "2/2"):
        words = [*cases["bake"](folder / "parts", 0), "--shard", shard]
        _run(words).wait()
    cases |= kill_cases.of_shards(sorted((folder / "parts").glob("*.json")))
    unknown = set(options.verbs) - cases.keys()
    if unknown:
        raise SystemExit(f"There is no {unknown.pop()!r}; choose from: {', '.join(cases)}.")
    return {name: words for name, words in cases.items() if name in (options.verbs or cases)}


class _NotReadyError(Exception):
    """A verb that does not end well, or whose two options make no difference."""


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
                raise _NotReadyError(f"it ends with status {status}; see why by hand")
        self.before, self.after = _contents(self.old), _contents(self.new)
        if self.before == self.after:
            raise _NotReadyError("it writes the same with both options; nothing could be told")

    def kill(self) -> None:
        """Start it over the old files, kill it, and look."""
        to = self.folder / "killed"
        shutil.rmtree(to, ignore_errors=True)
        shutil.copytree(self.old, to)
        process = _run(self.words(to, 1))
        if random.random() < _AIMED:
            before = _listing(to)
            while process.poll() is None and _listing(to) == before:
                time.sleep(0.0005)
            time.sleep(random.uniform(0.0, _WRITING))
        else:
            time.sleep(random.uniform(_EARLIEST, 1.05) * self.seconds)
        ended = process.poll() is not None
        if not ended:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        journal.finish(to)
        what = _contents(to)
        backups = {path.name: _materials(path) for path in to.glob("*.blend1")}
        if any(found != self.before.get(name[:-1]) for name, found in backups.items()):
            what |= backups
        if what == self.after:
            self.found["done before" if ended else "new"] += 1
        elif what == self.before:
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


def _listing(folder: Path) -> set[tuple[str, int, int]]:
    """Give what is there, hidden files too, and when it was written."""
    found = set()
    for entry in os.scandir(folder):
        try:
            state = entry.stat()
        except FileNotFoundError:
            continue  # moved to its place meanwhile
        found.add((entry.name, state.st_size, state.st_mtime_ns))
    return found


def _contents(folder: Path) -> dict[str, object]:
    """Give the files that a user sees; hidden ones are locks and what was not finished.

    Versions that Blender keeps are looked at apart: they come before what follows them.
    """
    told = {".blend": _materials, ".exr": _picture}
    return {
        path.name: told.get(path.suffix, Path.read_bytes)(path)
        for path in folder.iterdir()
        if path.is_file() and not path.name.startswith(".") and path.suffix != ".blend1"
    }


def _materials(path: Path) -> object:
    """Give what a .blend's materials are set to: its bytes hold addresses, which differ."""
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False)
    except RuntimeError as error:
        return f"does not open: {error}"
    return {
        material.name: [
            (node.bl_idname, socket.name, _value(socket.default_value))
            for node in material.node_tree.nodes
            for socket in node.inputs
            if hasattr(socket, "default_value")
        ]
        for material in bpy.data.materials
        if material.node_tree
    } | {image.name: Path(image.filepath).name for image in bpy.data.images}


def _picture(path: Path) -> object:
    """Give all that a picture holds but when it was written."""
    file = openimageio().ImageInput.open(str(path))
    if file is None:
        return "does not open"
    spec, pixels = file.spec(), file.read_image(openimageio().FLOAT)
    file.close()
    known = [(each.name, str(each.value)) for each in spec.extra_attribs]
    whole = "breaks off" if pixels is None else pixels.tobytes()
    return whole, [pair for pair in known if pair[0] != "DateTime"]


def _value(value: object) -> object:
    return tuple(value) if hasattr(value, "__len__") else value  # type: ignore[arg-type]


if __name__ == "__main__":
    bpy.context.preferences.view.show_splash = False
    sys.exit(main())
