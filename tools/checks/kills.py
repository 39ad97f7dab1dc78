# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kill verbs at random moments, and look whether what they write is whole: before it, or after.

    .venv/bpy-5.2/bin/python -m tools.checks.kills --kills 1000 [VERB ...]

Each verb first writes its files twice, with different options. Then it is started over the first
ones with the second options, and killed by SIGKILL somewhere in the time that it takes, half of the
times alone and half together with its second Blender. Once an interrupted publication is settled,
as every reader of ours does first, all files have to be those of one of the two; of frames, which
are files of their own, each. No second Blender may go on, and no folder of its job be there once
the next job has begun. A verb that writes nothing is held to that alone.
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

from rough_spectra.addon.blender import background_job
from rough_spectra.addon.support import journal
from rough_spectra.addon.support.openimageio import openimageio

from tools.checks import kill_cases
from tools.checks.kill_cases import Words

RUNNER = ROOT / "tools" / "run" / "run_command_line.py"
_EARLIEST = 0.3
"""Of the time that a verb takes: before, nothing but Blender starts."""
_AIMED, _WRITING = 0.5, 0.05
"""How many kills come after a file appeared or changed, and seconds within which they do."""
_ALONE, _PATIENCE = 0.5, 10.0
"""How many kills hit the verb alone, and seconds within which its second Blender has to end."""
_ONE_BY_ONE = ("spectral --frames",)
_WITHOUT_FILES = ("verdict",)


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
    bad = {what: sum(verb.found[what] for verb in verbs) for what in _BAD}
    told = ", ".join(f"{count} {what}" for what, count in bad.items())
    kills = sum(verb.found.total() for verb in verbs) - sum(bad.values()) + bad["half"]
    print(f"{kills} kills, {told}", flush=True)
    return 1 if any(bad.values()) or left else 0


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


_BAD = ("half", "gone on", "left behind")
"""What must not be found: files, a second Blender, a folder of its job."""


class _NotReadyError(Exception):
    """A verb that does not end well, or whose two options make no difference."""


class Verb:
    """One verb, and what became of its files."""

    def __init__(self, name: str, words: Words, folder: Path) -> None:
        self.name, self.words, self.folder = name, words, folder
        self.found: Counter[str] = Counter()
        self.old, self.new = folder / "old", folder / "new"
        self.temporary = folder / "temporary"
        self.temporary.mkdir(parents=True)
        for to, which in ((self.old, 0), (self.new, 0), (self.new, 1)):
            to.mkdir(parents=True, exist_ok=True)
            started = time.monotonic()
            status = _run(words(to, which), self.temporary).wait()
            self.seconds = time.monotonic() - started
            if status and not (name in _WITHOUT_FILES and status == 1):  # as it judged
                raise _NotReadyError(f"it ends with status {status}; see why by hand")
        self.before, self.after = _contents(self.old), _contents(self.new)
        if self.before == self.after and name not in _WITHOUT_FILES:
            raise _NotReadyError("it writes the same with both options; nothing could be told")

    def kill(self) -> None:
        """Start it over the old files, kill it, and look."""
        to = self.folder / "killed"
        shutil.rmtree(to, ignore_errors=True)
        shutil.copytree(self.old, to)
        process = _run(self.words(to, 1), self.temporary)
        if random.random() < _AIMED and self.name not in _WITHOUT_FILES:
            before = _listing(to)
            while process.poll() is None and _listing(to) == before:
                time.sleep(0.0005)
            time.sleep(random.uniform(0.0, _WRITING))
        else:
            time.sleep(random.uniform(_EARLIEST, 1.05) * self.seconds)
        ended = process.poll() is not None
        alone = random.random() < _ALONE
        if not ended:
            if alone:
                process.kill()
            else:
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        self._look_for_traces(alone)
        journal.finish(to)
        what = _contents(to)
        backups = {path.name: _materials(path) for path in to.glob("*.blend1")}
        if any(found != self.before.get(name[:-1]) for name, found in backups.items()):
            what |= backups
        if self.name in _ONE_BY_ONE and what not in (self.before, self.after):
            mixed = all(what.get(n) in (self.before[n], self.after[n]) for n in self.before)
            if mixed and what.keys() == self.before.keys():
                self.found["some new"] += 1
                return
        if what == self.after and self.name not in _WITHOUT_FILES:
            self.found["done before" if ended else "new"] += 1
        elif what == self.before:
            self.found["old"] += 1
        else:
            self.found["half"] += 1
            print(f"{self.name}: half: {sorted(what)}", flush=True)
            shutil.copytree(to, self.folder / f"half-{self.found['half']}")

    def _look_for_traces(self, alone: bool) -> None:
        """Look for a second Blender that goes on, and for what the next job would not remove."""
        until = time.monotonic() + _PATIENCE
        while (going := _at_work_in(self.temporary)) and time.monotonic() < until:
            time.sleep(0.05)
        if going:
            self.found["gone on"] += 1
            print(f"{self.name}: goes on: {going}", flush=True)
        if not alone:
            background_job.sweep(self.temporary)
        there = [path.name for path in self.temporary.iterdir()]
        # An empty one of its own stays where any Blender is killed.
        own = [each for each in self.temporary.glob("blender_*") if not any(each.iterdir())]
        if len(there) > len(own) or len(own) > 1 + (not alone):
            self.found["left behind"] += 1
            print(f"{self.name}: left behind: {there}, alone: {alone}", flush=True)
        shutil.rmtree(self.temporary)
        self.temporary.mkdir()


def _at_work_in(folder: Path) -> list[str]:
    """Give the numbers of processes that were told of something in a folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal():
            try:
                words = (entry / "cmdline").read_bytes()
            except OSError:
                continue
            if str(folder).encode() in words:
                found.append(entry.name)
    return found


def _run(words: list[object], temporary: Path | None = None) -> subprocess.Popen[bytes]:
    """Start a verb; its temporary files go to a folder."""
    settings = os.environ | ({} if temporary is None else {"TMPDIR": str(temporary)})
    return subprocess.Popen(
        [sys.executable, str(RUNNER), *map(str, words)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        env=settings,
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
