# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's own right-click menus."""

from __future__ import annotations

from typing import Any

import bpy

from ..operators import common

_MENUS = (
    "MATERIAL_MT_context_menu",
    "NODE_MT_context_menu",
    "OUTLINER_MT_object",
    "VIEW3D_MT_object_context_menu",
)


def draw_measure(menu: Any, context: Any) -> None:
    """Offer to measure what was clicked: the selected objects, or the material shown."""
    in_nodes = context.area is not None and context.area.type == "NODE_EDITOR"
    if in_nodes and not common.is_material_tree(context):
        return
    in_material = in_nodes or (context.area is not None and context.area.type == "PROPERTIES")
    menu.layout.separator()
    entry = menu.layout.operator("rough_spectra.measure", icon="COLOR")
    entry.scope = "ACTIVE" if in_material else "SELECTED"


def register() -> None:
    """Add the entries."""
    for name in _MENUS:
        menu = getattr(bpy.types, name, None)
        if menu is not None:
            menu.append(draw_measure)


def unregister() -> None:
    """Take the entries away."""
    for name in _MENUS:
        menu = getattr(bpy.types, name, None)
        if menu is not None:
            menu.remove(draw_measure)
