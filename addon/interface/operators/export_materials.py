# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Export materials for other renderers: from the File menu, or from a material's own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, StringProperty

from ....core.errors import RoughSpectraError
from . import common, targets

_MOST_SENTENCES = 20

_items: list[tuple[str, str, str, int]] = []
"""Blender keeps no reference to dynamic enumeration texts; without this list they are freed."""


def target_items(_operator: Any, _context: Any) -> list[tuple[str, str, str, int]]:
    """List the targets that this Blender can write."""
    from ...export import targets, write

    _items[:] = [
        (name, targets.find(name).TITLE, f"Write a .{targets.find(name).ENDING}", 1 << place)
        for place, name in enumerate(write.usable())
    ]
    return _items


class ROUGHSPECTRA_OT_export_materials(bpy.types.Operator):
    """Write materials for other renderers, each solved for the lobe of the renderer"""

    bl_idname = "rough_spectra.export_materials"
    bl_label = "Export Materials"
    bl_options = {"REGISTER"}  # no undo step: nothing in the .blend changes
    menu_place = 4, 5

    filepath: StringProperty(
        name="Files",
        description="Folder and base name; endings such as .mtlx are added",
        subtype="FILE_PATH",
    )
    scope: EnumProperty(
        name="For",
        description="Materials to export",
        items=(*targets.SCOPE_ITEMS, targets.ALL_WITH_SPECTRUM),
        default="ALL",
    )
    targets: EnumProperty(
        name="Targets",
        description="Renderers and formats; without any, all of them",
        items=target_items,
        options={"ENUM_FLAG"},
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need at least one material with a spectrum."""
        return targets.has_spectra(cls)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose where to write."""
        if not self.targets:
            from ...export import write

            self.targets = set(write.usable())
        return common.choose_files(self, context)

    def draw(self, _context: Any) -> None:
        """Draw the options beside the files; of targets one a line."""
        self.layout.prop(self, "scope")
        self.layout.label(text="Targets")
        self.layout.column(align=True).prop(self, "targets")

    def execute(self, context: Any) -> set[str]:
        """Write all files, or none."""
        from ...export import write

        base = Path(bpy.path.abspath(self.filepath))
        try:
            materials = targets.materials_in_scope(context, self.scope)
            chosen = [name for name in write.usable() if name in self.targets]
            found = write.materials(materials, base, chosen or write.usable())
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        said = [*found.faults, *found.warnings]
        for sentence in said[:_MOST_SENTENCES]:
            self.report({"WARNING"}, sentence)
        if len(said) > _MOST_SENTENCES:
            self.report(
                {"WARNING"}, rpt_("{} more such sentences").format(len(said) - _MOST_SENTENCES)
            )
        sentence = rpt_("{files} files in {folder}; at most ΔE00 {largest:.2f} at the instrument")
        largest = max(entry.delta_e_instrument for entry in found.entries)
        told = sentence.format(files=len(found.files), folder=base.parent, largest=largest)
        self.report({"INFO"}, told)
        return {"FINISHED"}


_MENUS = {"TOPBAR_MT_file_export": "ALL", "MATERIAL_MT_context_menu": "ACTIVE"}
"""Menus of Blender's, and which materials are meant there."""


def register_menu() -> None:
    """Add the export to the File menu and to a material's own."""
    for name in _MENUS:
        getattr(bpy.types, name).append(_draw_entry)


def unregister_menu() -> None:
    """Take it out again."""
    for name in _MENUS:
        getattr(bpy.types, name).remove(_draw_entry)


def _draw_entry(menu: Any, _context: Any) -> None:
    entry = menu.layout.operator(
        "rough_spectra.export_materials", text="Measured Materials (.mtlx, .usda, .gltf, …)"
    )
    entry.scope = _MENUS.get(menu.bl_idname, "ALL")


classes = (ROUGHSPECTRA_OT_export_materials,)
