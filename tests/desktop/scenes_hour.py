# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An artist's first jobs, from the file that Blender begins with: every click is counted.

The table of `docs/first-material.md` is what is counted here.
"""

from collections import Counter

import bpy
import driver
from driver import TICK, area, find, move, scene, window, write
from scenes_shelf import drag, on_screen, region_of
from stage import ours, undo_step

_FIRST_ROW = 46
"""Pixels from the button to the first row of the list that it opens."""

_BESIDE = (4.0, 1.0, 0.0)
"""Place of the next object: no camera or lamp, onto which one can drop, too, is drawn before it."""


class _Hands:
    """Does what a user does and counts it: clicks, drags, and words typed."""

    def __init__(self):
        self.count = Counter()

    def click(self, x, y):
        """Click at a point."""
        self.count["clicks"] += 1
        yield from driver.click(x, y)

    def write(self, word):
        """Type a word."""
        self.count["words"] += 1
        yield from write(word)

    def drag(self, start, end):
        """Drag a picture onto something."""
        self.count["drags"] += 1
        yield from drag(start, end)

    def slide(self, x, y, across):
        """Drag a slider."""
        self.count["drags"] += 1
        window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
        yield TICK
        for step in range(1, 9):
            yield from move(x + across * step // 8, y)
        window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x + across, y=y)
        yield 0.5

    def done(self):
        """Give what was counted since the last time."""
        count, self.count = dict(self.count), Counter()
        return count


@scene
def first_hour(found):
    """Brick on a cube, the next object, three at once, shine; and whether it is right."""
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield 1.0
    hands = _Hands()
    yield from _open_tab(hands)
    yield from _choose(hands)
    driver.grab("first")
    button = yield from find(area("PROPERTIES"), "rough_spectra.switch_to_cycles", 0.6)
    yield from hands.click(*button)
    yield lambda: _verdict() == "looks right"
    driver.grab("right")
    found["first"] = [hands.done(), *_shown("Cube"), _verdict()]
    yield from _next_object(hands, found)
    yield from _several(hands, found)
    before = _shown("Cube")[1]
    yield from hands.slide(*(yield from find(area("PROPERTIES"), "gloss", 0.4)), 90)
    yield lambda: _shown("Cube")[1] > before
    driver.grab("gloss")
    found["gloss"] = [hands.done(), _verdict()]


def _open_tab(hands):
    """Click the Material tab; which icon that is a script does not know, and tries."""
    editor = area("PROPERTIES")
    tabs = region_of(editor, "NAVIGATION_BAR")
    x = tabs.x + tabs.width // 2
    for y in range(tabs.y + 4, tabs.y + tabs.height, 6):
        hands.done()
        yield from hands.click(x, y)
        yield 2 * TICK
        if editor.spaces.active.context == "MATERIAL":
            yield 0.5
            return
    raise LookupError("no Material tab")


def _choose(hands):
    """Click the button, type a word, click the first row."""
    editor = area("PROPERTIES")
    # By its neighbor: to name the button itself, Blender would ask it for the list.
    _, y = yield from find(editor, "rough_spectra.find_nearest", 0.95)
    x = editor.x + int(editor.width * 0.5)
    yield from hands.click(x, y)
    yield 1.0
    yield from hands.write("brick")
    yield 1.0
    driver.grab("list")
    yield from hands.click(x, y - _FIRST_ROW)
    yield 1.0


def _next_object(hands, found):
    """Drag the first picture of the shelf onto a second cube."""
    _add("Second", _BESIDE)
    view = area("VIEW_3D")
    pictures = region_of(view, "ASSET_SHELF")
    yield 3.0
    start = pictures.x + 40, pictures.y + pictures.height // 2
    yield from hands.drag(start, on_screen(view, _BESIDE))
    yield lambda: bool(bpy.data.objects["Second"].active_material)
    driver.grab("second")
    found["next"] = [hands.done(), bool(_shown("Second")[0])]


def _several(hands, found):
    """Choose for three objects, of which two have no material."""
    for name, y in (("Third", 4.0), ("Fourth", 8.0)):
        _add(name, (0.0, y, 0.0))
    bpy.data.objects["Cube"].select_set(True)
    bpy.data.objects["Third"].select_set(True)
    bpy.context.view_layer.objects.active = bpy.data.objects["Cube"]
    undo_step("Three")
    yield 1.0
    yield from _choose(hands)
    yield lambda: all(bpy.data.objects[name].active_material for name in ("Third", "Fourth"))
    driver.grab("several")
    names = ("Cube", "Third", "Fourth")
    found["several"] = [hands.done(), [_shown(name)[0] for name in names]]


def _add(name, place):
    """Put a cube without a material into the scene, and select it alone."""
    mesh = bpy.data.objects["Cube"].data.copy()
    mesh.materials.clear()
    thing = bpy.data.objects.new(name, mesh)
    thing.location = place
    bpy.context.scene.collection.objects.link(thing)
    for other in bpy.data.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing
    undo_step(name)


def _shown(name):
    """Give sample and gloss of an object."""
    group = bpy.data.objects[name].active_material.rough_spectra
    return [group.sample_name, round(group.gloss, 3)]


def _verdict():
    """Give the words that the panel last drew beside its square."""
    last = ours("addon.interface.panels.redraw")._last
    if not last or last[0].shown is None:
        return ""
    here = last[0]
    verdict = ours("addon.material.verdict")
    return verdict.of(here.shown.facts, here.shown.apart(), here.previewed).words
