# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Choosing a sample for the first time after installing: how long the window stands still.

These come before all other scenes, which load what is to be loaded here.
"""

import sys
import time
from pathlib import Path

import bpy
from driver import area, click, find, press, scene, write
from stage import empty_file, ours, state

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import pace

_STEP = 0.004


class _Watch:
    """Notes for how long the window's loop does not come around, until it is left."""

    def __enter__(self):
        self.gaps, self._last, self._on = [], time.thread_time(), True
        bpy.app.timers.register(self._turn, first_interval=0.0)
        return self

    def __exit__(self, *_):
        self._on = False

    def _turn(self):
        # Of the processor, in this thread: other programs take as much as they like.
        now = time.thread_time()
        self.gaps.append(now - self._last)
        self._last = now
        return _STEP if self._on else None

    def is_quiet(self):
        """Whether the window has come around often."""
        return len(self.gaps) > 25

    def longest(self):
        """Give the longest since the last question, in seconds of the manual's machine."""
        found = max(self.gaps, default=0.0)
        self.gaps.clear()
        return pace.there(found)


@scene
def first_list(found):
    """Click the button, type a word, press Enter; nothing of ours was used before."""
    yield from empty_file()
    panel = area("PROPERTIES")
    # By its neighbor: to name the button itself, Blender would ask it for the list.
    _, y = yield from find(panel, "rough_spectra.find_nearest", across=0.9)
    found["known"] = len(ours("addon.interface.operators.choose_sample")._items)
    yield 1.0
    pace.unit()
    with _Watch() as watch:
        yield watch.is_quiet
        watch.longest()
        yield from click(panel.x + panel.width // 2, y)
        yield watch.is_quiet
        found["opened"] = watch.longest()
        yield from write("foliage")
        yield watch.is_quiet
        found["typed"] = watch.longest()
        yield from press("RET")
        yield 1.0
        yield watch.is_quiet
        found["assigned"] = watch.longest()
    found["chosen"] = state()["sample"]
