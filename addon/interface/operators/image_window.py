# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a picture is shown: in an Image Editor that is open, or where F12 shows a render."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy


def show(image: Any) -> bool:
    """Show an image; gives whether it is, which the user's preferences may not want.

    An Image Editor that is open has it, unless it is pinned to another; else what the preference
    Temporary Editors ▸ Render In names: a new window, an editor, or none.
    """
    spaces = list(_spaces())
    for space in spaces:
        if not space.use_image_pin:
            space.image = image
            _redraw()
            return True
    if bpy.app.background or bpy.context.window is None:
        return False
    if bpy.context.preferences.view.render_display_type == "NONE":
        return False
    known = set(bpy.data.images)
    if "FINISHED" not in bpy.ops.render.view_show("INVOKE_DEFAULT"):
        return False
    opened = [space for space in _spaces() if space.image is not None]
    found = [space for space in opened if space.image.type == "RENDER_RESULT"]
    for space in found:
        space.image = image
    for made in set(bpy.data.images) - known:  # the file had no render result
        bpy.data.images.remove(made)
    return bool(found)


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
