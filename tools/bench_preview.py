# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what the panel's pictures cost, at interface scale 1 and 2.

    python tools/bench_preview.py

Needs the bpy module. The least of many runs in wall time, and the median of the thread's own time,
which other programs disturb less. Milliseconds.
"""

from __future__ import annotations

import importlib
import statistics
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

REPEATS = 100
PATCH = Path(__file__).resolve().parents[1] / "presets" / "colorchecker" / "14-green.json"
SHEET = 280
"""Side of the largest picture at scale 1: a properties editor of about 320 pixels."""
SWATCHES = 96


def main() -> None:
    """Print a table."""
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    extension = importlib.import_module("run_command_line").load_extension()
    extension.register()
    import bpy
    import numpy as np
    from rough_spectra.addon import assign, readers, target, working_space
    from rough_spectra.addon.preview import compose, data, icons, theme

    material = bpy.data.materials.new("Bench")
    [sample] = readers.read(PATCH)
    assign.assign([(material, target.Request(sample, float(np.radians(28))))])
    space = working_space.current()
    found = data.collect(material, space)
    preview = icons._previews().new("bench")
    print(f"Blender {bpy.app.version_string}, numpy {np.__version__}, {REPEATS} runs: least (CPU)")
    row("numbers of all figures", lambda: data.collect(material, space))
    for model in ("two-bounce", "reference"):
        request = target.Request(sample, 0.5, model=model)
        color = np.array((0.1, 0.3, 0.1))
        row(f"… {model}", partial(data.of_request, request, color, 0.4, space))
    row("asking for an icon", lambda: icons._state(material, bpy.context))
    for scale in (1, 2):
        look = theme.look((0.239,) * 3, (0.902,) * 3, float(scale))
        print(f"scale {scale}: sheet of {SHEET * scale}, swatches of {SWATCHES * scale} pixels")
        for figure, side in (("sheet", SHEET), ("swatches", SWATCHES)):
            size = side * scale
            canvas = compose.picture(figure, found, size, look)
            row(figure, partial(compose.picture, figure, found, size, look))
            row("… to Blender", partial(icons._upload, preview, canvas))

        def everything(k: theme.Look = look, s: int = scale) -> None:
            numbers = data.collect(material, space)
            for figure, side in (("sheet", SHEET), ("swatches", SWATCHES)):
                icons._upload(preview, compose.picture(figure, numbers, side * s, k))

        row("all of a material", everything)
    icons.clear()
    extension.unregister()


def row(name: str, work: Callable[[], object]) -> None:
    """Print the cost of one piece of work."""
    walls, cpus = [], []
    for _ in range(REPEATS):
        wall, cpu = time.perf_counter(), time.thread_time()
        work()
        cpus.append(time.thread_time() - cpu)
        walls.append(time.perf_counter() - wall)
    print(f"{name:>26}  {1e3 * min(walls):7.2f}  ({1e3 * statistics.median(cpus):.2f})")


if __name__ == "__main__":
    main()
