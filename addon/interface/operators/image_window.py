# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a picture is shown: in an Image Editor that is open, or where F12 shows a render."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import bpy


def show(image: Any) -> bool:
    """Show an image; gives whether it is, which the user's preferences may not want.

    An Image Editor that is open has it, unless it is pinned to another; else what the preference
    Temporary Editors ▸ Render In names: a new window, an editor, or none.
    """
    for space in _spaces():
        if not space.use_image_pin:
            space.image = image
            _redraw()
            return True
    if bpy.app.background or bpy.context.window is None:
        return False
    if bpy.context.preferences.view.render_display_type == "NONE":
        return False
    # Later: the handler of an operator that opens a window while it is modal would stay.
    open_it = partial(_open, image.session_uid, bpy.context.window.as_pointer())
    bpy.app.timers.register(open_it, first_interval=0)
    return True


def _open(uid: int, pointer: int) -> None:
    """Open what F12 opens, and show an image there."""
    windows = list(bpy.context.window_manager.windows)
    image = next((each for each in bpy.data.images if each.session_uid == uid), None)
    if image is None or not windows:
        return
    asked = [window for window in windows if window.as_pointer() == pointer]
    known = set(bpy.data.images)
    with bpy.context.temp_override(window=(asked or windows)[0]):
        bpy.ops.render.view_show("INVOKE_DEFAULT")
    for space in _spaces():
        if space.image is not None and space.image.type == "RENDER_RESULT":
            space.image = image
    for made in set(bpy.data.images) - known:  # the file had no render result
        bpy.data.images.remove(made)


def _spaces() -> Iterator[Any]:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.ui_type == "IMAGE_EDITOR":
                yield area.spaces.active


def _redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                area.tag_redraw()
