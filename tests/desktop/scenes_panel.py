# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel under mouse and keys."""

import bpy
from driver import TICK, area, click, find, move, press, scene, window, write
from stage import empty_file, green_file, ours, state, undo_step


@scene
def dragging_sigma(found):
    """Drag the slider, then undo and redo once each."""
    yield from green_file()
    found["before"] = state()
    panel = area("PROPERTIES")
    x, y = yield from find(panel, "sigma")
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield TICK
    found["dragged"] = []
    for step in range(1, 9):
        yield from move(x + 10 * step, y)
        found["dragged"].append(state())
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x + 80, y=y)
    yield 0.5
    found["after"] = state()
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = state()
    yield from press("Z", ctrl=True, shift=True)
    yield 0.5
    found["redone"] = state()


@scene
def choosing_a_sample(found):
    """Click the button, type a name, press Enter, and undo."""
    yield from empty_file()
    panel = area("PROPERTIES")
    x, y = yield from find(panel, "rough_spectra.choose_sample")
    yield from click(x, y)
    yield 1.0
    yield from write("foliage")
    yield 0.5
    yield from press("RET")
    yield 1.0
    found["chosen"] = state()
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = state()
    yield from press("Z", ctrl=True, shift=True)
    yield 0.5
    found["redone"] = state()
    x, y = yield from find(panel, "rough_spectra.choose_sample")
    yield from click(x, y)
    yield 1.0
    yield from press("ESC")
    yield 0.3
    found["left"] = state()


@scene
def choosing_for_several(found):
    """Do the same with three objects selected, two of them without a material; then undo."""
    yield from empty_file()
    wall = bpy.data.objects["Wall"]
    for name in ("Box", "Ball"):
        other = bpy.data.objects.new(name, wall.data.copy())
        bpy.context.scene.collection.objects.link(other)
        other.select_set(True)
    own = bpy.data.materials.new("Own")
    own.use_fake_user = True
    bpy.data.objects["Ball"].active_material = own
    undo_step("Three")
    yield 0.5
    panel = area("PROPERTIES")
    x, y = yield from find(panel, "rough_spectra.choose_sample")
    yield from click(x, y)
    yield 1.0
    yield from write("brick")
    yield 0.5
    yield from press("RET")
    yield 1.0
    found["chosen"] = _materials()
    found["sigma"] = round(state()["sigma"], 4)
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = _materials()
    yield from press("Z", ctrl=True, shift=True)
    yield 0.5
    found["redone"] = _materials()


@scene
def finding_by_color(found):
    """Open the dialog, which begins at the material's color, take the second match, and undo."""
    yield from green_file()
    panel = area("PROPERTIES")
    x, y = yield from find(panel, "rough_spectra.find_nearest", across=0.9)
    yield from click(x, y)
    yield lambda: ours("addon.interface.operators.ahead").is_done()
    yield 1.0
    yield from press("RET")
    yield 1.0
    done = bpy.context.window_manager.operators[-1]
    found["ran"] = done.bl_idname
    found["nearest"] = [(m.name, round(m.difference, 2)) for m in done.matches][:2]
    found["color"] = [round(value, 3) for value in done.color]
    found["apart"] = done.apart
    found["sigma"] = state()["sigma"]
    found["sample"] = state()["sample"]
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = state()


def _materials():
    """Give the material of each object, what sample it is of, and its color in solid shading."""
    return {
        thing.name: None
        if thing.active_material is None
        else [
            thing.active_material.name,
            thing.active_material.rough_spectra.sample_name,
            [round(value, 3) for value in thing.active_material.diffuse_color],
        ]
        for thing in bpy.data.objects
    }
