# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Assign one of the presets."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty

from . import giving, looking, targets

_items: list[tuple[str, str, str]] = []
"""Blender keeps no reference to dynamic enumeration texts; without this list they are freed."""


def preset_items(_operator: Any, _context: Any) -> list[tuple[str, str, str]]:
    """List the presets by the names of their files."""
    from ...samples import presets

    if not _items:
        for name in presets.names():
            collection, _, label = name.partition("/")
            title = label.replace("-", " ").title()
            _items.append((name, title, f"{title} of the {collection} presets"))
    return _items


class ROUGHSPECTRA_OT_assign_preset(looking.LooksFirst, giving.AssignOptions, bpy.types.Operator):
    """Make the material read like a preset sample, and store its spectrum"""

    bl_idname = "rough_spectra.assign_preset"
    bl_label = "Assign Preset"
    bl_options = {"REGISTER", "UNDO"}
    bl_property = "preset"

    preset: EnumProperty(name="Preset", description="Measured sample", items=preset_items)

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return targets.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user search the presets by name."""
        giving.begin_scope(self, context)
        context.window_manager.invoke_search_popup(self)
        return {"FINISHED"}

    def work(self, context: Any) -> looking.Work:
        """Assign to all materials in scope, or to none."""
        from ...samples import presets

        return looking.assignment(self, context, presets.load(self.preset))


classes = (ROUGHSPECTRA_OT_assign_preset,)
