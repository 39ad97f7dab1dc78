# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Material ▸ Rough Spectra, and the same in the sidebar of the shader editor."""

from __future__ import annotations

from typing import Any

import bpy

from ..operators import common
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
        """Show wherever a material can be."""
        if common.active_material(context) is not None:
            return True
        thing = common.active_object(context)
        return hasattr(getattr(thing, "data", None), "materials")


class _Sidebar:
    """Place of a panel in the sidebar of the shader editor."""

    bl_space_type = "NODE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Rough Spectra"

    @classmethod
    def is_here(cls, context: Any) -> bool:
        """Show where the nodes are those of a material."""
        return common.is_material_tree(context)


class _Main:
    """Measured spectrum of the material"""

    bl_label = "Rough Spectra"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show wherever a material can be."""
        return bool(cls.is_here(context))  # type: ignore[attr-defined]

    def draw(self, context: Any) -> None:
        """Draw the sample and the settings."""
        from . import sample  # most sessions of Blender never show the panel

        sample.draw(self.layout, context)  # type: ignore[attr-defined]


class ROUGHSPECTRA_PT_material(_Main, _Tab, bpy.types.Panel):
    """Measured spectrum of the material"""


class ROUGHSPECTRA_PT_nodes(_Main, _Sidebar, bpy.types.Panel):
    """Measured spectrum of the material"""


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
classes = (
    ROUGHSPECTRA_PT_material,
    *_inside("", _BOXES, _Tab, ROUGHSPECTRA_PT_material),
    ROUGHSPECTRA_PT_nodes,
    *_inside("nodes_", [box for box in _BOXES if box.IN_SIDEBAR], _Sidebar, ROUGHSPECTRA_PT_nodes),
)
