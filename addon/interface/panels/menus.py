# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's own menus."""

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

_ACTIONS = (
    ("choose_sample", "find_nearest", "assign_file", "import_samples"),
    ("analyze_scene", "renew", "keep"),
    ("measure", "bake"),
    ("build_assets", "rename_sample", "remove_sample", "open_library"),
)


class ROUGHSPECTRA_MT_actions(bpy.types.Menu):
    """Everything that Rough Spectra does; Blender's search finds what is in a menu"""

    bl_label = "Rough Spectra"

    def draw(self, _context: Any) -> None:
        """Draw groups of operators, with dialogs where they have some."""
        self.layout.operator_context = "INVOKE_DEFAULT"
        for number, group in enumerate(_ACTIONS):
            if number:
                self.layout.separator()
            for name in group:
                self.layout.operator(f"rough_spectra.{name}")


def draw_actions(menu: Any, _context: Any) -> None:
    """Add the menu of everything."""
    menu.layout.separator()
    menu.layout.menu("ROUGHSPECTRA_MT_actions", icon="COLOR")


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
    """Add the menu and the entries."""
    bpy.utils.register_class(ROUGHSPECTRA_MT_actions)
    for name in _MENUS:
        menu = getattr(bpy.types, name, None)
        if menu is not None:
            menu.append(draw_measure)
    bpy.types.TOPBAR_MT_render.append(draw_actions)


def unregister() -> None:
    """Take the entries and the menu away."""
    bpy.types.TOPBAR_MT_render.remove(draw_actions)
    for name in _MENUS:
        menu = getattr(bpy.types, name, None)
        if menu is not None:
            menu.remove(draw_measure)
    bpy.utils.unregister_class(ROUGHSPECTRA_MT_actions)
