# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The asset shelf of the 3D view: every measured material of the asset libraries, to drag.

Blender asks for the shelf when it first draws a 3D view. That is when the library that comes with
the extension is added to the preferences: not at the start, and not in a Blender without a window.
"""

from __future__ import annotations

from typing import Any

import bpy

from ..material import preferences

PREVIEW_PIXELS = 64
_asked: list[bool] = []
"""Holds something once the library was offered in this session."""


class ROUGHSPECTRA_AST_materials(bpy.types.AssetShelf):
    """Measured materials; drag one onto an object."""

    bl_idname = "ROUGHSPECTRA_AST_materials"
    bl_space_type = "VIEW_3D"
    bl_options = {"DEFAULT_VISIBLE"}
    bl_default_preview_size = PREVIEW_PIXELS
    filter_material = True  # without, newer Blenders read all other assets, too

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show it in object mode, unless the preferences say otherwise."""
        if not _asked:
            _asked.append(True)
            # Preferences cannot be written while Blender draws; and a file may be opened first.
            bpy.app.timers.register(_offer, first_interval=0.0, persistent=True)
        return bool(context.mode == "OBJECT") and preferences.shows_shelf()

    @classmethod
    def asset_poll(cls, asset: Any) -> bool:
        """Show what this extension made."""
        from ..assets.catalogs import ROOT

        return asset.id_type == "MATERIAL" and ROOT in asset.metadata.tags


def _offer() -> None:
    from ..assets import shelf

    shelf.offer()


def unregister_timer() -> None:
    """Forget that the library was offered, and take a timer away that did not come to it."""
    _asked.clear()
    if bpy.app.timers.is_registered(_offer):
        bpy.app.timers.unregister(_offer)


classes = (ROUGHSPECTRA_AST_materials,)
