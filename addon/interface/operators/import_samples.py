# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Import measurement files: from the File menu, or by dropping them on Blender."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, CollectionProperty, StringProperty

from ...samples.endings import endings
from . import common, giving
from .import_options import ImportOptions, waiting

if TYPE_CHECKING:
    from ...samples.importing import Batch

_LEFT_TO_BLENDER = {"exr"}
"""Endings of files whose dropping belongs to Blender's own images."""

_MOST_SENTENCES = 20


class ROUGHSPECTRA_OT_import_samples(ImportOptions, bpy.types.Operator):
    """Add the samples of measurement files to your library, and to materials if wanted"""

    bl_idname = "rough_spectra.import_samples"
    bl_label = "Import Spectra"  # the file browser's button holds no more
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 1, 4

    filepath: StringProperty(
        name="File",
        description="Spectra that an instrument wrote",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    directory: StringProperty(
        name="Folder",
        description="Folder of the files",
        subtype="DIR_PATH",
        options={"SKIP_SAVE", "HIDDEN"},
    )
    files: CollectionProperty(
        name="Files",
        description="Names of the files in the folder",
        type=bpy.types.OperatorFileListElement,
        options={"SKIP_SAVE", "HIDDEN"},
    )
    keep_going: BoolProperty(
        name="Keep Going",
        description="Add the other samples even if some file cannot be used",
    )

    _asks = False

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Review files that were dropped; otherwise let the user choose some."""
        self._asks = True
        if self.filepath or self.files:
            if not self.properties.is_property_set("materials"):
                on_properties = context.area is not None and context.area.type == "PROPERTIES"
                self.materials = "ASSIGN" if on_properties else "NONE"
            return self.execute(context)
        return common.open_file(self, context)

    def execute(self, context: Any) -> set[str]:
        """Read the files; let the user review them, or go on as the options say."""
        from ...samples import importing

        with waiting(context):
            batch = importing.read(self._paths())
        asks = self._asks and not bpy.app.background
        if batch.refused and not (batch.found and (asks or self.keep_going)):
            for sentence in batch.refused:
                common.report_error(self, sentence)
            return {"CANCELLED"}
        if not batch.found:
            self.report({"ERROR"}, "No file was chosen; choose a measurement file")
            return {"CANCELLED"}
        if asks:
            return self._review(batch)
        told = (sentence for each in batch.found for sentence in each.sentences)
        said = [*batch.refused, *dict.fromkeys(told)]
        for sentence in said[:_MOST_SENTENCES]:
            self.report({"WARNING"}, sentence)
        if len(said) > _MOST_SENTENCES:
            self.report(
                {"WARNING"}, rpt_("{} more such sentences").format(len(said) - _MOST_SENTENCES)
            )
        return self.carry_out(context, batch.found, batch.found[0])

    def draw(self, _context: Any) -> None:
        """Draw the options beside the files."""
        names = (
            "add_to_library",
            "collection",
            "together",
            "materials",
            "sigma",
            "shader",
            "scope",
        )
        giving.draw_in_browser(self, (*names, "keep_going"))

    def _paths(self) -> list[Path]:
        folder = bpy.path.abspath(self.directory)
        named = [Path(folder, file.name) for file in self.files if file.name]
        if named or not self.filepath:
            return named
        return [Path(bpy.path.abspath(self.filepath))]

    def _review(self, batch: Batch) -> set[str]:
        from . import import_review

        told = self.properties.is_property_set("shader")
        import_review.present(
            batch,
            **({"shader": self.shader} if told else {}),  # or each material keeps its own
            add_to_library=self.add_to_library,
            collection=self.collection,
            together=self.together,
            materials=self.materials,
            sigma=self.sigma,
            white=self.white,
            plaque=self.plaque,
            white_factor=self.white_factor,
            scope=self.scope,
        )
        return {"CANCELLED"}  # nothing was done yet


class ROUGHSPECTRA_FH_import(bpy.types.FileHandler):
    """Measurement files that are dropped on the viewport or on the properties editor"""

    bl_idname = "ROUGHSPECTRA_FH_import"
    bl_label = "Measured Spectra"
    bl_import_operator = "rough_spectra.import_samples"
    # Any file can be chosen in the File menu: content decides.
    bl_file_extensions = ";".join(
        f".{ending}" for ending in endings() if ending not in _LEFT_TO_BLENDER
    )

    @classmethod
    def poll_drop(cls, context: Any) -> bool:
        """Take files where materials are seen."""
        return context.area is not None and context.area.type in {"VIEW_3D", "PROPERTIES"}


def register_menu() -> None:
    """Add the import to the File menu."""
    bpy.types.TOPBAR_MT_file_import.append(_draw_menu)


def unregister_menu() -> None:
    """Take it out again."""
    bpy.types.TOPBAR_MT_file_import.remove(_draw_menu)


def _draw_menu(menu: Any, _context: Any) -> None:
    menu.layout.operator(
        "rough_spectra.import_samples", text="Measured Spectra (.cgats, .cxf, .csv, …)"
    )


classes = (ROUGHSPECTRA_OT_import_samples, ROUGHSPECTRA_FH_import)
