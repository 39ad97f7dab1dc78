# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of a material, in the three places where artists look.

Right below the material slots in the Material tab, and as a tab in the sidebars of 3D view and
shader editor. In each a panel with what everybody needs, and inside it one that is closed at first,
Details, with the boxes.
"""

from __future__ import annotations

from typing import Any

import bpy

from ..operators import targets
from .boxes import Box, boxes

_ENGINES = {"CYCLES", "BLENDER_EEVEE", "BLENDER_EEVEE_NEXT", "BLENDER_WORKBENCH"}


class _Tab:
    """Place of a panel in the Material tab of the Properties editor."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    COMPAT_ENGINES = _ENGINES

    @classmethod
    def is_here(cls, context: Any) -> bool:
        """Show wherever a surface material can be."""
        material, thing = getattr(context, "material", None), targets.active_object(context)
        if material is not None:
            return not material.is_grease_pencil
        return targets.can_carry(thing)


class _View:
    """Place of a panel in the sidebar of the 3D view."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Rough Spectra"

    @classmethod
    def is_here(cls, context: Any) -> bool:
        """Show where the active object can have a surface material."""
        return targets.can_carry(targets.active_object(context))


class _Sidebar:
    """Place of a panel in the sidebar of the shader editor."""

    bl_space_type = "NODE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Rough Spectra"

    @classmethod
    def is_here(cls, context: Any) -> bool:
        """Show where the nodes are those of a surface material."""
        return targets.is_material_tree(context) and not context.space_data.id.is_grease_pencil


class _Main:
    """Measured color, roughness and gloss of the material"""

    bl_label = "Rough Spectra"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show wherever a material can be."""
        return bool(cls.is_here(context))  # type: ignore[attr-defined]

    def draw(self, context: Any) -> None:
        """Draw what everybody needs."""
        from . import simple  # most sessions of Blender never show the panel

        simple.draw(self.layout, context)  # type: ignore[attr-defined]


class ROUGHSPECTRA_PT_material(_Main, _Tab, bpy.types.Panel):
    """Measured color, roughness and gloss of the material"""

    # Panels without a header come first, and among these the slots, whoever registers when.
    bl_options = {"HIDE_HEADER"}
    bl_order = 1


class ROUGHSPECTRA_PT_view(_Main, _View, bpy.types.Panel):
    """Measured color, roughness and gloss of the material"""


class ROUGHSPECTRA_PT_nodes(_Main, _Sidebar, bpy.types.Panel):
    """Measured color, roughness and gloss of the material"""


class _Details:
    """Settings, numbers and plots"""

    bl_label = ""
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show where there is a material, which can at least be measured."""
        from . import redraw

        return bool(redraw.current(context).has_material)

    def draw_header(self, context: Any) -> None:
        """Draw the name, which depends on the width."""
        from . import simple

        simple.draw_details_header(self.layout, context)  # type: ignore[attr-defined]

    def draw(self, context: Any) -> None:
        """Draw the settings; the boxes are panels of their own."""
        from . import details

        details.draw(self.layout, context)  # type: ignore[attr-defined]


class ROUGHSPECTRA_PT_details(_Details, _Tab, bpy.types.Panel):
    """Settings, numbers and plots"""

    bl_parent_id = "ROUGHSPECTRA_PT_material"


class ROUGHSPECTRA_PT_view_details(_Details, _View, bpy.types.Panel):
    """Settings, numbers and plots"""

    bl_parent_id = "ROUGHSPECTRA_PT_view"


class ROUGHSPECTRA_PT_nodes_details(_Details, _Sidebar, bpy.types.Panel):
    """Settings, numbers and plots"""

    bl_parent_id = "ROUGHSPECTRA_PT_nodes"


def _panel(box: Box, name: str, place: type, around: type) -> Any:
    """Make the class that Blender wants of a box in one of its places."""

    def poll(_cls: Any, context: Any) -> bool:
        return box.poll(context)

    def draw(self: Any, context: Any) -> None:
        box.draw(self.layout, context)

    content = {
        "__doc__": box.TOOLTIP,
        "bl_label": box.LABEL,
        "bl_parent_id": around.__name__,
        "bl_options": {"DEFAULT_CLOSED"} if box.IS_CLOSED else set(),
        "poll": classmethod(poll),
        "draw": draw,
    }
    return type(f"ROUGHSPECTRA_PT_{name}", (place, bpy.types.Panel), content)


def _inside(prefix: str, found: list[Box], place: type, around: type) -> list[Any]:
    names = [box.__name__.rpartition(".")[2] for box in found]
    return [
        _panel(box, prefix + name, place, around) for box, name in zip(found, names, strict=True)
    ]


_BOXES = boxes()
_IN_SIDEBARS = [box for box in _BOXES if box.IN_SIDEBAR]
classes = (
    ROUGHSPECTRA_PT_material,
    ROUGHSPECTRA_PT_details,
    *_inside("", _BOXES, _Tab, ROUGHSPECTRA_PT_details),
    ROUGHSPECTRA_PT_view,
    ROUGHSPECTRA_PT_view_details,
    *_inside("view_", _IN_SIDEBARS, _View, ROUGHSPECTRA_PT_view_details),
    ROUGHSPECTRA_PT_nodes,
    ROUGHSPECTRA_PT_nodes_details,
    *_inside("nodes_", _IN_SIDEBARS, _Sidebar, ROUGHSPECTRA_PT_nodes_details),
)
