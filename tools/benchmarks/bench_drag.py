# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare what a step of dragging σ costs here with what it cost in an earlier commit.

    python3 -m tools.benchmarks.bench_drag 20c539b

Needs the bpy module and git. Each version runs in a Blender of its own, and both take a step in
turn, so that neither has the better minutes of a shared server: what counts is the ratio of the
medians, and that of the times of each pair of steps. A step is what Blender calls when the slider
moves: deriving, the sockets, and the pictures of the panel, which are made visible before. Earlier
versions always showed plots and swatches; now they are in Details, closed at first: ``--closed``
compares what is seen then. Processor time.
"""

from __future__ import annotations

import argparse
import importlib.util
import itertools
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
WARM_UP = 10
FIGURES = (("sheet", 280), ("swatches", 96))
BALL = (("ball", 88),)
"""What is always seen, in versions that have it; the former are those of Details, or of all."""
MODELS = ("auto", "two-bounce", "reference")
CASES = tuple(itertools.product(MODELS, (False, True), (1, 2)))
"""Model, whether two lights of the scene light it, and scale of the interface."""


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("commit", help="of the version to compare with; or a folder that has it")
    parser.add_argument("--steps", type=int, default=150, help="for each row of the table")
    parser.add_argument("--closed", action="store_true", help="now, Details is closed")
    parser.add_argument("--as-worker", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.as_worker is not None:
        work(options.as_worker)
    elif Path(options.commit).is_dir():
        compare(Path(options.commit).resolve(), options.steps, options.closed)
    else:
        with tempfile.TemporaryDirectory() as folder:
            unpack(options.commit, folder)
            compare(Path(folder), options.steps, options.closed)


def unpack(commit: str, folder: str) -> None:
    """Put the files of a commit into a folder."""
    kept = ["git", "-C", str(ROOT), "archive", commit, "__init__.py", "blender_manifest.toml"]
    archive = subprocess.run([*kept, "core", "addon", "presets", "tools"], capture_output=True)
    if archive.returncode:
        sys.exit(f"{commit}: {archive.stderr.decode().strip()}")
    subprocess.run(["tar", "-x", "-C", folder], input=archive.stdout, check=True)


def compare(other: Path, steps: int, closed: bool) -> None:
    """Let both versions take steps in turn."""
    if hasattr(os, "sched_setaffinity"):  # one core for both: the others may be slower just now
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    before, now = start(other), start(ROOT)
    print("milliseconds of processor time a step, median; ratio of medians, median of ratios")
    try:
        ratios = []
        for case in CASES:
            for worker in (before, now):
                ask(worker, {"case": case, "closed": closed and worker is now})
            pairs = []
            for number in range(WARM_UP + steps):
                sigma = 0.1 + 0.9 * number / (WARM_UP + steps)
                order = (before, now) if number % 2 else (now, before)
                took = {id(worker): ask(worker, {"sigma": sigma}) for worker in order}
                pairs.append((took[id(before)], took[id(now)]))
            ratios.append(row(case, pairs[WARM_UP:]))
        print(f"{'mean of the ratios of medians':>46}  {statistics.mean(ratios):.3f}")
    finally:
        for worker in (before, now):
            worker.communicate("", timeout=60)


def row(case: tuple[str, bool, int], pairs: list[tuple[float, float]]) -> float:
    """Print the cost of a case in both versions; gives the ratio of medians."""
    model, scene, scale = case
    what = f"{model}, {'two lights' if scene else 'illuminant'}, scale {scale}"
    before, now = (statistics.median(times) for times in zip(*pairs, strict=True))
    each = statistics.median(after / first for first, after in pairs)
    print(f"{what:>46}  {before:6.2f}  {now:6.2f}  {now / before:.3f}  {each:.3f}", flush=True)
    return now / before


def start(root: Path) -> subprocess.Popen[str]:
    """Start a Blender with the version that lies in a folder."""
    command = [sys.executable, __file__, str(root), "--as-worker", str(root)]
    return subprocess.Popen(command, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def ask(worker: subprocess.Popen[str], request: dict[str, Any]) -> float:
    """Let a worker do something, and give the milliseconds that it took."""
    assert worker.stdin is not None
    assert worker.stdout is not None
    worker.stdin.write(json.dumps(request) + "\n")
    worker.stdin.flush()
    while line := worker.stdout.readline():  # Blender prints what it likes between
        if line.startswith("took "):
            return float(line.split()[1])
    raise SystemExit("A version ended before it had answered; its message stands above.")


def work(root: Path) -> None:
    """Do what `compare` asks for, with the version in a folder."""
    # Versions before the tools had folders started scripts by their bare names.
    in_folders = (root / "tools" / "run").is_dir()
    sys.path[0] = str(root if in_folders else root / "tools")
    tool = importlib.import_module("tools.benchmarks.bench_panel" if in_folders else "bench_panel")
    loader = "tools.run.run_command_line" if in_folders else "run_command_line"
    extension = importlib.import_module(loader).load_extension()
    extension.register()
    thing = tool.lit_plane()
    material = tool.assign(thing, "dragged")
    for node in material.node_tree.nodes:  # earlier versions took the gloss away
        if "Specular IOR Level" in node.inputs:
            node.inputs["Specular IOR Level"].default_value = 0.0
    step: Callable[[float], object] = float
    for line in sys.stdin:
        request = json.loads(line)
        if "case" in request:
            model, scene, scale = request["case"]
            set_up(material, model, scene)
            step = stepping(material, scale, request["closed"])
            request["sigma"] = 0.09
        begin = time.process_time()
        step(request["sigma"])
        print(f"took {1e3 * (time.process_time() - begin)}", flush=True)
    importlib.import_module("rough_spectra.addon.preview.icons").clear()
    extension.unregister()


def set_up(material: Any, model: str, scene: bool) -> None:
    """Choose the model, and whether the scene's lights count."""
    import bpy

    group = material.rough_spectra
    group.model = model
    if scene and not group.scene_view:
        bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT")
    if bool(scene) != group.use_scene:
        group.use_scene = bool(scene)


def stepping(material: Any, scale: int, closed: bool) -> Callable[[float], None]:
    """Make the panel's pictures visible, and give what a step of the slider does."""
    import bpy

    icons = importlib.import_module("rough_spectra.addon.preview.icons")
    theme = importlib.import_module("rough_spectra.addon.preview.theme")
    try:
        snapshot = importlib.import_module("rough_spectra.addon.material.snapshot")
    except ModuleNotFoundError:
        snapshot = importlib.import_module("rough_spectra.addon.facts")
    icons.clear()
    has_ball = importlib.util.find_spec("rough_spectra.addon.preview.balls") is not None
    figures = (BALL if has_ball else ()) + (() if closed else FIGURES)

    def draw() -> None:
        """Ask for the pictures, as drawing does."""
        basis = (snapshot.of(material), theme.current(bpy.context.preferences))
        for figure, side in figures:
            icons.icon_id(material.session_uid, figure, side * scale, basis)

    draw()
    icons._work()
    material.rough_spectra.sigma = 0.08
    draw()
    # Without a window, earlier versions leave the pictures to whoever asks for them.
    left_out = bool(icons._pending)
    icons._work()

    def step(sigma: float) -> None:
        for picture in icons._pictures.values():
            picture.drawn = time.monotonic()
        material.rough_spectra.sigma = sigma
        if left_out:
            icons.refresh(material)

    return step


if __name__ == "__main__":
    main()
