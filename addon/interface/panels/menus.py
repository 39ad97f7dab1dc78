# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's own menus."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from typing import Any

import bpy

from ..operators import targets

_MENUS = (
    "MATERIAL_MT_context_menu",
    "NODE_MT_context_menu",
    "OUTLINER_MT_object",
    "VIEW3D_MT_object_context_menu",
)

_groups: list[list[str]] = []
"""Operators in the menu of everything."""


class ROUGHSPECTRA_MT_actions(bpy.types.Menu):
    """Everything that Rough Spectra does; Blender's search finds what is in a menu"""

    bl_label = "Rough Spectra"

    def draw(self, _context: Any) -> None:
        """Draw groups of operators, with dialogs where they have some."""
        self.layout.operator_context = "INVOKE_DEFAULT"
        for number, group in enumerate(_groups):
            if number:
                self.layout.separator()
            for name in group:
                self.layout.operator(name)


def draw_actions(menu: Any, _context: Any) -> None:
    """Add the menu of everything."""
    menu.layout.separator()
    menu.layout.menu("ROUGHSPECTRA_MT_actions", icon="COLOR")


def draw_measure(menu: Any, context: Any) -> None:
    """Offer to measure what was clicked: the selected objects, or the material shown."""
    in_nodes = context.area is not None and context.area.type == "NODE_EDITOR"
    if in_nodes and not targets.is_material_tree(context):
        return
    in_material = in_nodes or (context.area is not None and context.area.type == "PROPERTIES")
    menu.layout.separator()
    entry = menu.layout.operator("rough_spectra.measure", icon="COLOR")
    entry.scope = "ACTIVE" if in_material else "SELECTED"


def _grouped(classes: Iterable[Any]) -> list[list[str]]:
    """Give the operators that have a place in the menu, group by group."""
    placed = sorted((cls for cls in classes if hasattr(cls, "menu_place")), key=_place)
    return [
        [cls.bl_idname for cls in group] for _, group in groupby(placed, lambda cls: _place(cls)[0])
    ]


def _place(cls: Any) -> tuple[int, int, str]:
    return *cls.menu_place, cls.bl_idname


def register(classes: Iterable[Any]) -> None:
    """Add the menu and the entries.

    Parameters
    ----------
    classes
        All that are registered, operators among them.
    """
    _groups[:] = _grouped(classes)
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
