# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the panels again when a viewport is shaded otherwise: they tell whose picture that is.

Blender draws the Properties editor again when the scene changes, and shading is the viewport's own.
"""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

_OWNER = object()


def _subscribe() -> None:
    key = (bpy.types.View3DShading, "type")
    bpy.msgbus.subscribe_rna(key=key, owner=_OWNER, args=(), notify=_redraw)


def _redraw() -> None:
    from ...preview import icons  # most sessions of Blender never show the panel

    icons.redraw()


@persistent
def _on_load(_path: str) -> None:
    """Another file forgets who subscribed."""
    _subscribe()


def register() -> None:
    """Listen from now on, in every file."""
    _subscribe()
    bpy.app.handlers.load_post.append(_on_load)


def unregister() -> None:
    """Undo `register`."""
    bpy.app.handlers.load_post.remove(_on_load)
    bpy.msgbus.clear_by_owner(_OWNER)
