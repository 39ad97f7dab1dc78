# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of `screenshots` that runs inside the desktop Blender.

A picture is a function that puts the window into a state. Blender then redraws until everything
that is drawn later has arrived, and the area or the window is saved.
"""

from __future__ import annotations

import math
import shlex
import subprocess
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy

ZIP, OUT, SCALE, THEME, GRAB, *NAMES = sys.argv[sys.argv.index("--") + 1 :]
SETTLE_SECONDS = 1.5
PANEL_WIDTH = 440  # pixels at UI scale 1
CONTRAST = 8  # of 255: what differs more within a row of pixels is not background

Picture = Callable[[], str]
PICTURES: dict[str, Picture] = {}


def picture(function: Picture) -> Picture:
    """Register a picture; the function returns "panel" or "window", what is to be saved."""
    PICTURES[function.__name__.replace("_", "-")] = function
    return function


def start() -> None:
    """Install the extension, set scale and theme, and take the pictures one by one."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.ui_scale = float(SCALE)
    bpy.ops.extensions.package_install_files(
        filepath=ZIP, repo="user_default", enable_on_install=True, overwrite=True
    )
    if THEME == "light":
        folders = bpy.utils.preset_paths("interface_theme")
        [path] = [path for root in folders for path in Path(root).glob("Blender_Light.xml")]
        bpy.ops.script.execute_preset(
            filepath=str(path),
            menu_idname="USERPREF_MT_interface_theme_presets",
        )
    _layout()
    waiting = [name for name in PICTURES if not NAMES or name in NAMES]
    bpy.app.timers.register(lambda: _begin(waiting), first_interval=0.5)


def _begin(waiting: list[str]) -> None:
    _material_tab()
    bpy.app.timers.register(lambda: _set(waiting), first_interval=0.5)


def _set(waiting: list[str]) -> None:
    if not waiting:
        bpy.ops.wm.quit_blender()
        return
    name = waiting.pop(0)
    try:
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            what = PICTURES[name]()
    except Exception:  # the window would stay open forever
        traceback.print_exc()
        sys.stderr.flush()
        bpy.ops.wm.quit_blender()
        return
    bpy.app.timers.register(lambda: _take(name, what, waiting), first_interval=SETTLE_SECONDS)


def _take(name: str, what: str, waiting: list[str]) -> None:
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
    path = str(Path(OUT) / f"{name}.png")
    window = bpy.context.window_manager.windows[0]
    if GRAB:
        subprocess.run([*shlex.split(GRAB), path], check=True)
    else:
        with bpy.context.temp_override(window=window):
            bpy.ops.screen.screenshot(filepath=path)
    if what == "panel":
        _cut(path, max(window.screen.areas, key=lambda area: area.x), window.height)
    print(path, flush=True)
    bpy.app.timers.register(lambda: _set(waiting), first_interval=0.1)


def _cut(path: str, area: Any, height: int) -> None:
    """Leave an area of the picture, down to its last button."""
    bpy.utils.expose_bundled_modules()
    import numpy as np
    import OpenImageIO

    whole = OpenImageIO.ImageBuf(path)
    top = height - area.y - area.height
    pixels = whole.get_pixels(OpenImageIO.UINT8)[
        top : top + area.height, area.x : area.x + area.width
    ]
    inner = pixels[:-8, 48:-48]
    busy = np.flatnonzero(np.ptp(inner, axis=1).max(axis=-1) > CONTRAST)
    pixels = np.ascontiguousarray(pixels[: min(len(pixels), int(busy.max()) + 12), :, :3])
    cut = OpenImageIO.ImageBuf(
        OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], 3, OpenImageIO.UINT8)
    )
    cut.set_pixels(OpenImageIO.ROI(), pixels)
    cut.write(path)


# States ------------------------------------------------------------------------------------------


def _layout() -> None:
    """Make the window a text editor beside the Material tab: a viewport would draw for minutes."""
    window = bpy.context.window_manager.windows[0]
    for area in sorted(window.screen.areas, key=lambda area: area.width * area.height)[:-1]:
        with bpy.context.temp_override(window=window, area=area):
            bpy.ops.screen.area_close()
    area = window.screen.areas[0]
    area.type = "TEXT_EDITOR"
    factor = 1 - PANEL_WIDTH * float(SCALE) / area.width
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=factor)


def _material_tab() -> None:
    """Turn the narrow area, whose place is known after a redraw, into the Material tab."""
    window = bpy.context.window_manager.windows[0]
    panel = max(window.screen.areas, key=lambda area: area.x)
    panel.type = "PROPERTIES"
    # A script cannot fold panels, so the others of the tab are hidden.
    for cls in bpy.types.Panel.__subclasses__():
        in_tab = getattr(cls, "bl_context", "") == "material" and getattr(cls, "bl_label", "")
        if in_tab and cls.is_registered and "rough_spectra" not in cls.__module__:
            cls.poll = classmethod(lambda _cls, _context: False)
    with bpy.context.temp_override(window=window, area=panel):
        panel.spaces.active.context = "MATERIAL"


def _fresh() -> Any:
    """Leave one plane, without a material."""
    things = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    bpy.data.batch_remove([*things, *bpy.data.materials])
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    thing = bpy.data.objects.new("Wall", mesh)
    scene.collection.objects.link(thing)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    return thing


def _green(degrees: float = 30.0) -> Any:
    thing = _fresh()
    bpy.ops.rough_spectra.assign_preset(
        "EXEC_DEFAULT", preset="colorchecker/14-green", sigma=math.radians(degrees)
    )
    return thing.active_material


@picture
def empty() -> str:
    """Show a mesh without a material."""
    _fresh()
    return "panel"


@picture
def assigned() -> str:
    """Show a preset at 30°."""
    _green()
    return "panel"


@picture
def edited() -> str:
    """Show a color that was edited by hand."""
    material = _green()
    node = next(node for node in material.node_tree.nodes if node.type.startswith("BSDF"))
    node.inputs[0].default_value = (0.4, 0.1, 0.1, 1)
    return "panel"


if __name__ == "__main__":
    start()
