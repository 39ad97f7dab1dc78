# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands and eyes in a Blender window: mouse, keys, and what is under the pointer.

A scene is a generator that gives its findings a name each and yields while Blender has to work: a
number of seconds, or a function that says whether it may go on.
"""

import json
import os
import subprocess
import time
import traceback
from pathlib import Path

import bpy

PATIENCE = 60.0
TICK = 0.03
STEP = 8  # pixels: less than the height of a button at UI scale 1

SCENES = {}


def scene(function):
    """Register a scene."""
    SCENES[function.__name__] = function
    return function


def play(names, results: Path) -> None:
    """Act out the scenes one after the other, and quit."""
    found = {}

    def script():
        for name in names or SCENES:
            found[name] = {}
            try:
                yield from SCENES[name](found[name])
            except Exception:
                found[name]["failed"] = traceback.format_exc()
                yield from press("ESC")
            results.write_text(json.dumps(found, indent=1))
        bpy.ops.wm.quit_blender()

    running, wait = script(), [None, 0.0]

    def turn():
        until, end = wait
        if until is not None and time.monotonic() < end and not until():
            return TICK
        if until is not None and time.monotonic() >= end:
            step = _stopped(running)
        else:
            step = next(running, StopIteration)
        if step is StopIteration:
            return None
        wait[:] = (step, time.monotonic() + PATIENCE) if callable(step) else (None, 0.0)
        return step if isinstance(step, float) else TICK

    bpy.app.timers.register(turn, first_interval=1.0, persistent=True)


def _stopped(running):
    try:
        return running.throw(TimeoutError(f"nothing came of it in {PATIENCE:.0f} s"))
    except StopIteration:
        return StopIteration


def window():
    """Give the window."""
    return bpy.data.window_managers[0].windows[0]


def area(kind):
    """Give the area of a kind, such as "PROPERTIES"."""
    return next(area for area in window().screen.areas if area.type == kind)


def over(where, kind="WINDOW"):
    """Override the context, so that it is that of an area, in its region of a kind."""
    region = next(region for region in where.regions if region.type == kind)
    return bpy.context.temp_override(window=window(), area=where, region=region)


def middle(where):
    """Give the point in the middle of an area."""
    return where.x + where.width // 2, where.y + where.height // 2


def move(x, y):
    """Move the pointer."""
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=int(x), y=int(y))
    yield TICK


def press(key, text="", **modifiers):
    """Press a key or a button and let it go."""
    options = {"unicode": text} if text else {}
    window().event_simulate(type=key, value="PRESS", **options, **modifiers)
    yield TICK
    window().event_simulate(type=key, value="RELEASE", **modifiers)
    yield TICK


def click(x, y, button="LEFTMOUSE"):
    """Click at a point."""
    yield from move(x, y)
    window().event_simulate(type=button, value="PRESS", x=int(x), y=int(y))
    yield TICK
    window().event_simulate(type=button, value="RELEASE", x=int(x), y=int(y))
    yield 2 * TICK


def write(text):
    """Type a text."""
    for letter in text:
        key = "SPACE" if letter == " " else letter.upper()
        yield from press(key, letter)


def grab(name):
    """Save what the screen shows, where ROUGH_SPECTRA_PICTURES names a folder for it."""
    folder = os.environ.get("ROUGH_SPECTRA_PICTURES")
    if folder:
        picture = Path(folder) / f"{name}.png"
        subprocess.run(["import", "-window", "root", str(picture)], check=True)


def find(where, wanted, across=0.6, kind="WINDOW"):
    """Move over an area, from the top down, until what is wanted is under the pointer.

    Yields while it moves; returns the point. What is further down is scrolled to.
    """
    x = where.x + int(where.width * across)
    seen = set()
    for scrolled in range(2):
        for y in range(where.y + where.height - 4, where.y, -STEP):
            yield from move(x, y)
            with over(where, kind):
                button = _under(bpy.context)
            seen.add(button)
            if button is not None and button.startswith(wanted):
                # The middle of it: the first step may have met its edge.
                yield from move(x, y - STEP // 2)
                return x, y - STEP // 2
        if not scrolled:
            yield from move(*middle(where))
            for _ in range(40):
                window().event_simulate(type="WHEELDOWNMOUSE", value="PRESS", **_at(where))
                yield TICK
            yield 0.3
    msg = f"{wanted} is not in the {where.type} editor, but {seen} are"
    raise LookupError(msg)


def _at(where):
    x, y = middle(where)
    return {"x": x, "y": y}


def _under(context):
    """Name the property, or give the call of the operator, of the button under the pointer."""
    held = getattr(context, "property", None)
    if held is not None:
        return held[1].rpartition(".")[2]
    if not bpy.ops.ui.copy_python_command_button.poll():
        return None
    bpy.ops.ui.copy_python_command_button()
    return context.window_manager.clipboard.removeprefix("bpy.ops.")
