# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A render farm's job, by the engines' own programs: killed, resumed, joined, judged, and refused.

Makes scenes, bakes each in one go, and then the same by the Open Job Description bundle, whose
`openjd run` is an engine with one worker: in tasks of which one is killed and the job run again.
Flamenco's job type is compiled by a JavaScript engine against a stand-in of its documented API, and
its commands are run in the order that its tasks ask for. Both have to come to the same bytes.

    python3 dev.py farm --scenes 10 --materials 200 --tasks 8
"""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import bpy
import numpy as np

from tools.checks import flamenco_stand_in
from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension().register()

from rough_spectra.addon import api

BUNDLE = ROOT / "farm" / "openjd" / "bake" / "template.json"
JOB_TYPE = ROOT / "farm" / "flamenco" / "rough_spectra.js"


def main() -> int:
    """Run all of it; exit status 0 if everything holds."""
    options = _options()
    folder = options.folder.absolute()
    shutil.rmtree(folder, ignore_errors=True)
    scenes = folder / "scenes"
    for number in range(options.scenes):
        make_scene(scenes / f"scene-{number:02d}.blend", options.materials, number)
    farm = Farm(folder, scenes, options)
    farm.holds("one bake of each scene", farm.job(folder / "one", "bake") == 0)
    farm.check_openjd()
    farm.check_flamenco()
    farm.check_a_wrong_scene()
    print("\n".join(farm.lines))
    return 1 if farm.failed else 0


def make_scene(path: Path, count: int, seed: int) -> None:
    """Save a file with materials of smooth random spectra, dull enough for every gamut."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    random = np.random.default_rng(seed)
    bands = np.arange(400.0, 701.0, 10.0, dtype=np.float64)
    knots = np.linspace(400, 700, 5)
    pairs = []
    for number in range(count):
        values = np.interp(bands, knots, random.uniform(0.3, 0.6, knots.size))
        sample = api.Sample(f"Paint {number}", bands, values, "reading")
        material = bpy.data.materials.new(f"Paint {number:04d}")
        material.use_fake_user = True
        pairs.append((material, api.request(sample, random.uniform(0.0, 0.7))))
    api.assign(pairs)
    path.parent.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))


class Farm:
    """One farm: its scenes, its programs, and what was found."""

    def __init__(self, folder: Path, scenes: Path, options: argparse.Namespace) -> None:
        self.folder, self.scenes, self.options = folder, scenes, options
        self.blender = options.blender or self._stand_in()
        self.lines: list[str] = []
        self.failed = False

    def _stand_in(self) -> Path:
        """Make a program that takes Blender's words and runs the bpy module."""
        path = self.folder / "blender"
        runner = ROOT / "tools" / "run" / "run_command_line.py"
        command = shlex.join([sys.executable, str(runner)])
        path.write_text(f'#!/bin/sh\nshift 3\nexec {command} "$@"\n', encoding="utf-8")
        path.chmod(0o755)
        return path

    def holds(self, what: str, whether: bool) -> None:
        """Note whether something holds."""
        self.failed |= not whether
        self.lines.append(f"{'holds' if whether else 'FAILS'}  {what}")
        print(self.lines[-1], flush=True)

    def job(self, output: Path, words: str) -> int:
        """Run a job of one task without an engine."""
        where = ["--files", str(self.scenes), "--output", str(output), "--quiet"]
        command = [str(self.blender), "-b", "--command", "rough_spectra", "job", *where]
        return subprocess.run([*command, "--", words], check=False).returncode

    def openjd(self, output: Path, log: Path, *words: str) -> subprocess.Popen[bytes]:
        """Start `openjd run` with the bundle."""
        values = {"Scenes": self.scenes, "Output": output, "Blender": self.blender}
        values |= {"Tasks": self.options.tasks, "MaxDeltaE": 0.5}
        given = [word for key, value in values.items() for word in ("-p", f"{key}={value}")]
        program = str(self.options.farm / "bin" / "openjd")
        with log.open("wb") as file:
            command = [program, "run", str(BUNDLE), *given, *words]
            return subprocess.Popen(command, stdout=file, stderr=file)

    def check_openjd(self) -> None:
        """Kill a task, run the job again, and compare with one bake."""
        output, log = self.folder / "openjd", self.folder / "killed.log"
        program = str(self.options.farm / "bin" / "openjd")
        for template in sorted(BUNDLE.parents[1].glob("*/template.json")):
            checked = subprocess.run([program, "check", str(template)], check=False)
            self.holds(f"openjd check {template.parent.name}", checked.returncode == 0)
        started = time.monotonic()
        run = self.openjd(output, log)
        self._kill_task(run, output)
        self.holds("a killed task ends the run with a failure", run.wait() != 0)
        whole = sorted(path.stem for path in output.glob("*.json"))
        self.holds(
            f"what was done before it is whole: {len(whole)} of {self.options.scenes} scenes",
            0 < len(whole) < self.options.scenes,
        )
        log = self.folder / "resumed.log"
        status = self.openjd(output, log).wait()
        told = log.read_text(encoding="utf-8", errors="replace")
        seconds = time.monotonic() - started
        self.holds(f"run again, it is complete and judged; {seconds:.0f} s in all", status == 0)
        skipped = told.count("is there already; nothing was measured")
        self.holds(f"{skipped} scenes were not measured again", skipped == len(whole))
        judged = told.count(f"0 of {self.options.materials} materials exceed ΔE00 0.5")
        self.holds(f"{judged} scenes were judged", judged == self.options.scenes)
        self.holds("progress is told in the engine's lines", "openjd_progress: 100.0" in told)
        self.holds("every byte is that of one bake", self._equal(output))

    def _kill_task(self, run: subprocess.Popen[bytes], output: Path) -> None:
        """Kill a task as a lost machine would end it: while it measures, and others are done."""
        wanted = max(1, self.options.scenes // 3)
        while run.poll() is None:
            time.sleep(0.05)
            measuring = [pid for pid in _below(run.pid) if _runs(pid, "rough_spectra", "job")]
            if len(list(output.glob("*.json"))) >= wanted and measuring and _below(measuring[0]):
                os.kill(measuring[0], signal.SIGKILL)
                return

    def _equal(self, output: Path) -> bool:
        """Whether two folders hold the same files, but for parts."""
        one = {path.name: path.read_bytes() for path in (self.folder / "one").iterdir()}
        other = {path.name: path.read_bytes() for path in output.iterdir() if path.is_file()}
        return one == other

    def check_flamenco(self) -> None:
        """Compile the job type, and run its tasks in their order."""
        output = self.folder / "flamenco"
        settings = {"scenes": str(self.scenes), "output": str(output), "max_delta_e": 0.5}
        settings |= {"tasks": self.options.tasks, "shards": 1, "words": "bake --skip-done"}
        python = self.options.farm / "bin" / "python"
        tasks = flamenco_stand_in.compiled(python, JOB_TYPE, settings)
        self.holds(
            f"Flamenco's script makes {len(tasks)} tasks", len(tasks) == self.options.tasks + 1
        )
        self.holds("the judge waits for all", len(tasks[-1]["dependencies"]) == self.options.tasks)
        statuses = flamenco_stand_in.run(tasks, {"blender": str(self.blender)})
        self.holds("all of them end well", set(statuses) == {0})
        self.holds("every byte is that of one bake", self._equal(output))

    def check_a_wrong_scene(self) -> None:
        """Look at how a job ends that has a file which is no scene."""
        (self.scenes / "broken.blend").write_bytes(b"no scene")
        log = self.folder / "wrong.log"
        status = self.openjd(self.folder / "openjd", log).wait()
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        said = [line for line in lines if "rough_spectra job: " in line]
        self.holds("a wrong scene ends the job with a failure", status != 0)
        self.holds("and with our sentence", bool(said) and "broken.blend" in said[-1])
        ended = next(i for i, line in enumerate(lines) if said and line == said[-1])
        self.holds("which is the task's last", "exited with code: 2" in lines[ended + 1])
        print(said[-1] if said else "", flush=True)


def _runs(pid: int, *words: str) -> bool:
    """Whether a process, but no shell, was called with one of the words."""
    try:
        called = Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return False
    return not called[0].endswith("sh") and any(word in called for word in words)


def _below(pid: int) -> list[int]:
    """All processes that one started, and theirs."""
    try:
        # Each thread has children of its own.
        lists = [path.read_text() for path in Path(f"/proc/{pid}/task").glob("*/children")]
    except OSError:  # it has ended
        return []
    children = [int(word) for text in lists for word in text.split()]
    return [each for child in children for each in (child, *_below(child))]


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--scenes", type=int, default=3)
    parser.add_argument("--materials", type=int, default=4)
    parser.add_argument("--tasks", type=int, default=2)
    parser.add_argument("--folder", type=Path, default=ROOT / "build" / "farm")
    parser.add_argument("--farm", type=Path, default=ROOT / ".venv" / "farm", help="environment")
    parser.add_argument("--blender", type=Path, help="a real one, with the extension")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
