# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what the panel's pictures cost, at interface scale 1 and 2.

    python -m tools.benchmarks.bench_preview

Needs the bpy module. σ differs from run to run, as when it is dragged: what does not depend on it
may be kept, the rest has to be drawn. The least of many runs and the median, in the thread's own
time, which other programs disturb less than wall time. Milliseconds.
"""

from __future__ import annotations

import itertools
import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from tools.run.run_command_line import ROOT, load_extension

REPEATS = 100
PATCH = ROOT / "presets" / "colorchecker" / "14-green.json"
SHEET = 280
"""Side of the largest picture at scale 1: a properties editor of about 320 pixels."""
SWATCHES = 96


def main() -> None:
    """Print a table."""
    extension = load_extension()
    extension.register()
    import bpy
    import numpy as np
    from rough_spectra.addon.blender import shader_nodes, working_space
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.material import changes, derive, snapshot
    from rough_spectra.addon.preview import icons, theme
    from rough_spectra.addon.preview.data import collect
    from rough_spectra.addon.preview.drawing import looks
    from rough_spectra.addon.preview.figures import compose, data
    from rough_spectra.addon.samples import readers

    material = bpy.data.materials.new("Bench")
    [sample] = readers.read(PATCH)
    derive.assign([(material, solve.Request(sample, float(np.radians(28))))])
    space = working_space.current()
    degrees = itertools.cycle(np.linspace(15, 60, 91).tolist())

    def drag() -> data.Data:
        """Set another σ, and the roughness in the node as if it followed."""
        sigma = float(np.radians(next(degrees)))
        with changes.paused():
            material.rough_spectra.sigma = sigma
        shader_nodes.roughness_socket(shader_nodes.shader_node(material)).default_value = sigma / 2
        return collect(material, space)

    preview = icons._kept.get("bench")
    seen = theme.current(bpy.context.preferences)
    print(
        f"Blender {bpy.app.version_string}, numpy {np.__version__}, {REPEATS} runs: least (median)"
    )
    row("numbers of all figures", lambda: collect(material, space))
    for model in ("two-bounce", "reference"):
        request = solve.Request(sample, 0.5, model=model)
        color = np.array((0.1, 0.3, 0.1))
        row(f"… {model}", partial(data.of_request, request, color, 0.4, space))
    row(
        "asking for an icon",
        lambda: icons.icon_id(material.session_uid, "sheet", SHEET, (snapshot.of(material), seen)),
    )
    for scale in (1, 2):
        look = looks.look((0.239,) * 3, (0.902,) * 3, float(scale))
        print(f"scale {scale}: sheet of {SHEET * scale}, swatches of {SWATCHES * scale} pixels")
        for figure, side in (("sheet", SHEET), ("swatches", SWATCHES)):
            size = side * scale
            shown = itertools.cycle([drag() for _ in range(91)])

            def draw(f: str = figure, s: int = size, k: looks.Look = look, d: Any = shown) -> Any:
                return compose.picture(f, next(d), s, k)

            row(figure, draw)
            row("… to Blender", partial(icons.upload, preview, draw()))

        def everything(k: looks.Look = look, s: int = scale) -> None:
            numbers = drag()
            for figure, side in (("sheet", SHEET), ("swatches", SWATCHES)):
                icons.upload(preview, compose.picture(figure, numbers, side * s, k))

        row("all of a material", everything)
    icons.clear()
    extension.unregister()


def row(name: str, work: Callable[[], object]) -> None:
    """Print the cost of one piece of work."""
    times = []
    for _ in range(REPEATS):
        start = time.thread_time()
        work()
        times.append(1e3 * (time.thread_time() - start))
    print(f"{name:>26}  {min(times):7.2f}  ({statistics.median(times):.2f})")


if __name__ == "__main__":
    main()
