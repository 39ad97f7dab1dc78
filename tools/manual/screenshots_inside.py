# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of `screenshots` that runs inside the desktop Blender.

`screenshots_states` puts the window into a state. Blender then redraws until everything that is
drawn later has arrived, and the part of the window that matters is saved.
"""

from __future__ import annotations

import math
import shlex
import subprocess
import sys
import time
import traceback
from pathlib import Path
from typing import Any

import bpy

bpy.utils.expose_bundled_modules()

import numpy as np  # noqa: E402

from tools.manual import (  # noqa: E402
    palette_png,
    screenshots_readings,  # noqa: F401, it registers its states
    screenshots_states,
)

ZIP, OUT, SCALE, WIDTH, THEME, GRAB, *NAMES = sys.argv[sys.argv.index("--") + 1 :]
SETTLE_SECONDS = 1.5
MOST_SECONDS = 120.0
PREVIEW_SECONDS = 15.0  # Eevee's take minutes on a virtual screen, and may be changed
CONTRAST = 8  # of 255: what differs more within a row of pixels is not background
STATUS_PIXELS = 900  # at UI scale 1
VIEW_PIXELS = 520  # of the 3D view's height, from below


def start() -> None:
    """Install the extension, set scale and theme, and take the pictures one by one."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.show_tooltips = False
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
    screenshots_states.split_window(int(WIDTH) * float(SCALE))
    waiting = [name for name in screenshots_states.PICTURES if not NAMES or name in NAMES]
    bpy.app.timers.register(lambda: _begin(waiting), first_interval=0.5)


def _begin(waiting: list[str]) -> None:
    screenshots_states.show_material_tab()
    bpy.app.timers.register(lambda: _set(waiting), first_interval=0.5)


def _set(waiting: list[str], last: float = math.inf) -> None:
    # What Cycles renders a preview of must not be changed meanwhile: Blender may wait forever.
    last = min(last, time.monotonic() + PREVIEW_SECONDS)
    if bpy.app.is_job_running("RENDER_PREVIEW") and time.monotonic() < last:
        bpy.app.timers.register(lambda: _set(waiting, last), first_interval=0.2)
        return
    if not waiting:
        bpy.ops.wm.quit_blender()
        return
    name = waiting.pop(0)
    picture = screenshots_states.PICTURES[name]
    try:
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            picture.show()
    except Exception:
        _give_up()
        return
    last = time.monotonic() + MOST_SECONDS
    bpy.app.timers.register(lambda: _wait(name, last, waiting))
    return


def _give_up() -> None:
    """Say why and quit: the window would stay open forever."""
    traceback.print_exc()
    sys.stderr.flush()
    bpy.ops.wm.quit_blender()


def _wait(name: str, last: float, waiting: list[str]) -> float | None:
    if not screenshots_states.PICTURES[name].ready() and time.monotonic() < last:
        return 0.2
    for area in bpy.context.window_manager.windows[0].screen.areas:
        area.tag_redraw()  # panels that moved stand in their new places after another redraw
    bpy.app.timers.register(lambda: _take(name, waiting), first_interval=SETTLE_SECONDS)
    return None


def _take(name: str, waiting: list[str]) -> None:
    picture = screenshots_states.PICTURES[name]
    window = bpy.context.window_manager.windows[0]
    path = Path(OUT) / f"{name}.png"
    try:
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
        if GRAB:
            subprocess.run([*shlex.split(GRAB), path], check=True)
        else:
            with bpy.context.temp_override(window=window):
                bpy.ops.screen.screenshot(filepath=str(path))
        _cut(path, picture.part, window)
    except Exception:
        _give_up()
        return
    if picture.part in ("dialog", "status"):
        for value in ("PRESS", "RELEASE"):
            window.event_simulate(type="ESC", value=value)
    print(path, flush=True)
    bpy.app.timers.register(lambda: _set(waiting), first_interval=0.5)


def _cut(path: Path, part: str, window: Any) -> None:
    """Leave the part of the window that the picture is of."""
    import OpenImageIO

    pixels = OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.UINT8)[..., :3]
    wide = min(window.screen.areas, key=lambda area: area.x)
    if part == "panel":
        tab = max(window.screen.areas, key=lambda area: area.x)
        pixels = _panel(_within(pixels, tab, window), 48, CONTRAST)
    elif part == "sidebar":
        [region] = [region for region in wide.regions if region.type == "UI"]
        # Below the sidebar's panels a grid shows through.
        pixels = _panel(_within(pixels, region, window), 24, 3 * CONTRAST)
    elif part == "dialog":
        pixels = _dialog(_within(pixels, wide, window), 4, 0)
    elif part == "nodes":
        pixels = _dialog(_within(pixels, wide, window), 40, 12)
    elif part == "status":
        below = min(area.y for area in window.screen.areas)
        pixels = pixels[window.height - below :, : round(STATUS_PIXELS * float(SCALE))]
    elif part == "view":
        pixels = _within(pixels, wide, window)[-round(VIEW_PIXELS * float(SCALE)) :]
    elif part == "preferences":
        other = bpy.context.window_manager.windows[-1]
        top = window.height - other.y - other.height
        pixels = pixels[top : top + other.height, other.x : other.x + other.width]
    palette_png.write(path, pixels)


def _within(pixels: Any, part: Any, window: Any) -> Any:
    top = window.height - part.y - part.height
    return pixels[top : top + part.height, part.x : part.x + part.width]


def _panel(pixels: Any, left: int, contrast: int) -> Any:
    """Cut what is below the last panel."""
    inner = pixels[:-8, round(left * float(SCALE)) : -round(48 * float(SCALE))]
    busy = np.flatnonzero(np.ptp(inner, axis=1).max(axis=-1) > contrast)
    return pixels[: min(len(pixels), int(busy.max()) + 8 + round(12 * float(SCALE)))]


def _dialog(pixels: Any, left: int, around: int) -> Any:
    """Cut what is around the dialog in the empty text editor; a wide one begins near the left.

    `around` are pixels that stay on each side.
    """
    margin = round(40 * float(SCALE))
    pixels = pixels[margin:-margin, left:-margin]
    shown = np.abs(pixels.astype(int) - pixels[0, 0]).max(axis=-1) > 2
    rows, columns = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
    top, first = max(rows[0] - around, 0), max(columns[0] - around, 0)
    return pixels[top : rows[-1] + 1 + around, first : columns[-1] + 1 + around]
