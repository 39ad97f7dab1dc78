# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Load, while the user looks at a list, the user's samples and what the click after it needs.

After installing, Python compiles each of our modules at its first import: a second in all, in which
the window would stand still. Blender's Python must not go on in a thread of its own, so the
window's timer does it, in steps that nobody notices.
"""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import bpy

from ...support import events

_AT_ONCE = 0.012
"""Seconds of work in one turn of the timer: less than a frame. A step may take more."""
_PAUSE = 0.005
"""Seconds for the window between two."""

STEPS = (
    "addon.colorimetry.rgb_space",
    "addon.matching.request",
    "addon.blender.shader_nodes",
    "core.cycles.least_mean_fit",
    "core.cycles.gloss_reading",
    "addon.samples.readers.formats",
    "addon.samples.readers.parts.unsaid",
    "addon.samples.readers.parts.joining",
    "addon.matching.scene_match",
    "addon.material.settled",
    "addon.samples.presets",
    "addon.support.atomic_files",
    "addon.samples.library_files",
    "addon.preview.drawing.text",
    "core.closure.table",
    "addon.samples.quality",
    "addon.preview.drawing.lines",
    "addon.preview.figures.plot",
    "core.oren_nayar",
    "addon.material.textures",
    "addon.samples.swatches",
    "addon.matching.solution",
    "addon.support.version",
    "core.vcavity",
    "addon.matching.solve",
    "addon.material.storage",
    "addon.blender.untouched",
    "addon.material.naming",
    "addon.material.roughness_origin",
    "addon.material.selection",
    "addon.preview.figures.data",
    "core.surface",
    "core.models.surface",
    "addon.samples.library",
    "addon.material.derive",
    "addon.material.last_measurement",
    "addon.matching.assess",
    "addon.matching.own_gloss",
    "addon.preview.icons",
    "addon.preview.list_icons",
    "addon.preview.figures.compose",
    "addon.preview.data",
    "addon.preview.sample_ball",
    "addon.matching.metamerism",
)
"""Modules, each after those that it imports itself: no step brings more than 50 kB of source,
but for the table of surfaces. With the last of them a sample is assigned and pictured."""


def _unpack_surface() -> None:
    from ....core import surface

    surface.factors(0.8, 0.0, 0.0, 0.5)


def _import_masked() -> None:
    importlib.import_module("numpy.ma")  # for the median of a spectrum's steps


_WORK = (_import_masked, _unpack_surface)
"""What no import brings along."""

_left: list[Callable[[], object]] = []
_waiting: list[tuple[str, Any, Any, Any]] = []
"""An operator that is to be invoked afterwards, with window, area and region."""
_ROOT = __name__.partition(".addon.")[0]


def begin(context: Any = None, then: str = "") -> None:
    """Begin, unless it was done; in a background Blender, which has no window, never.

    Parameters
    ----------
    context, then
        Name of one of our operators that waits for it, and where it is to be invoked.
    """
    if then:
        _waiting[:] = [(then, context.window, context.area, context.region)]
        context.window.cursor_set("WAIT")
    if bpy.app.background or is_done() or bpy.app.timers.is_registered(_turn):
        return
    _left[:] = [*(partial(importlib.import_module, f"{_ROOT}.{name}") for name in STEPS), *_WORK]
    bpy.app.timers.register(_turn, first_interval=_PAUSE)
    events.unregistering.subscribe(_end)


def _turn() -> float | None:
    end = time.monotonic() + _AT_ONCE
    while _left:
        _left.pop(0)()
        if time.monotonic() > end:
            return _PAUSE
    from ...material import preferences
    from ...samples import library

    if library.read_next(preferences.user_folder()):
        return _PAUSE
    if _waiting:
        bpy.app.timers.register(_invoke, first_interval=0.0)
    return None


def _invoke() -> None:
    """Invoke what waited, if the editor that it came from is still there."""
    while _waiting:
        name, window, area, region = _waiting.pop()
        if window not in tuple(bpy.context.window_manager.windows):
            continue
        window.cursor_set("DEFAULT")
        if area in tuple(window.screen.areas):
            with bpy.context.temp_override(window=window, area=area, region=region):
                getattr(bpy.ops.rough_spectra, name)("INVOKE_DEFAULT")


def is_done() -> bool:
    """Whether all modules are loaded and the user's samples read, but for what changed since.

    A background Blender has nothing to wait for.
    """
    if bpy.app.background:
        return True
    if f"{_ROOT}.{STEPS[-1]}" not in sys.modules:
        return False
    return not bpy.app.timers.is_registered(_turn)


def _end() -> None:
    """Stop: the extension is switched off."""
    _left.clear()
    _waiting.clear()
    if bpy.app.timers.is_registered(_turn):
        bpy.app.timers.unregister(_turn)
    events.unregistering.unsubscribe(_end)
