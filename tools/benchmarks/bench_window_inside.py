# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of `bench_window` that runs inside the desktop Blender.

Every `poll` and `draw` of the panels is timed where Blender calls it, in processor time of the
thread, which other programs disturb less than wall time. What Blender does afterwards with what
they drew, such as placing the buttons, is its own and not counted. Then σ is dragged.
"""

from __future__ import annotations

import statistics
import sys
import time
import traceback
from collections.abc import Callable, Iterator
from typing import Any

import bpy

from tools.manual import screenshots_states as states

[ZIP] = sys.argv[sys.argv.index("--") + 1 :]
MATERIALS = 500
DRAWS = 150
STEPS = 60
STATES = ("assigned", "lit-by-several", "edited", "eevee")
WIDTH = 440
CLOSED = "source_all"
"""The panel that is closed in Details until the user opens it: told, and not in the sum."""

_redraws: list[dict[str, float]] = []
"""Milliseconds that each panel took in each redraw of the tab."""


def start() -> None:
    """Install the extension, and measure state by state once the window stands."""
    bpy.context.preferences.view.show_splash = False
    bpy.ops.extensions.package_install_files(
        filepath=ZIP, repo="user_default", enable_on_install=True, overwrite=True
    )
    # The lists render previews, of materials that must not be changed meanwhile: hide them.
    for name in ("EEVEE_MATERIAL_PT_context_material", "CYCLES_PT_context_material"):
        getattr(bpy.types, name).poll = classmethod(lambda _cls, _context: False)
    states.split_window(WIDTH)
    script = _script()
    bpy.app.timers.register(lambda: _turn(script), first_interval=0.5)


def _turn(script: Iterator[float]) -> float | None:
    try:
        return next(script)
    except Exception as error:
        if not isinstance(error, StopIteration):
            traceback.print_exc()
            sys.stderr.flush()
        bpy.ops.wm.quit_blender()
        return None


def _script() -> Iterator[float]:
    states.show_material_tab()
    yield 0.5
    _watch(bpy.types.ROUGHSPECTRA_PT_material)
    said = f"Blender {bpy.app.version_string}; milliseconds of processor time: median (least)"
    print(said, flush=True)
    for state in STATES:
        window = bpy.context.window_manager.windows[0]
        with bpy.context.temp_override(window=window):
            states.PICTURES[state].show()
        for twin in states.open_details(source=True):
            _watch(twin)
        first = bpy.context.view_layer.objects.active.active_material
        others = [first, *(first.copy() for _ in range(MATERIALS - 1))]
        for number, material in enumerate(others[1:DRAWS]):
            material.rough_spectra.sigma += 1e-3 * number  # nothing that is stored is the same
        yield 0.5
        for how, shown in (("the same", others[:1]), ("another each time", others)):
            yield from _measure(f"{state}, {how}", shown)
        if state != "edited":
            yield from _drag(f"{state}, σ dragged")


def _drag(what: str) -> Iterator[float]:
    """Change σ as the slider does: color, sockets and pictures that are shown follow at once."""
    material = bpy.context.view_layer.objects.active.active_material
    times = []
    for step in range(STEPS):
        start = time.thread_time()
        material.rough_spectra.sigma = 0.1 + 1.3 * step / STEPS
        times.append(1e3 * (time.thread_time() - start))
        yield 0.01
    times = times[5:]
    print(f"{what:>36}  {statistics.median(times):.2f}  ({min(times):.2f})", flush=True)


def _measure(what: str, shown: list[Any]) -> Iterator[float]:
    """Redraw as Blender does by itself, the pictures that drawing asks for included."""
    _redraws.clear()
    for number in range(DRAWS):
        slot = bpy.context.view_layer.objects.active.material_slots[0]
        slot.material = shown[number % len(shown)]
        for area in bpy.context.window_manager.windows[0].screen.areas:
            area.tag_redraw()
        yield 0.01
    sums = [sum(redraw.values()) - redraw.get(CLOSED, 0.0) for redraw in _redraws[2:]]
    print(f"{what:>36}  {statistics.median(sums):.2f}  ({min(sums):.2f})  of {len(sums)} redraws")
    for panel in _redraws[-1]:
        times = [redraw.get(panel, 0.0) for redraw in _redraws[2:]]
        print(f"{panel:>46}  {statistics.median(times):.2f}  ({min(times):.2f})", flush=True)


def _watch(cls: Any) -> None:
    name = cls.__name__.removeprefix("ROUGHSPECTRA_PT_")
    cls.poll = classmethod(_timed(name, "poll", cls.poll.__func__))
    cls.draw = _timed(name, "draw", cls.draw)


def _timed(panel: str, which: str, function: Callable[..., Any]) -> Callable[..., Any]:
    def call(this: Any, context: Any) -> Any:
        if (panel, which) == ("material", "poll"):
            _redraws.append({})
        start = time.thread_time()
        try:
            return function(this, context)
        finally:
            spent = 1e3 * (time.thread_time() - start)
            if _redraws:
                _redraws[-1][panel] = _redraws[-1].get(panel, 0.0) + spent

    return call
