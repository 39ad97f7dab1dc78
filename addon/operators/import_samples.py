# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Import measurement files: from the File menu, or by dropping them on Blender."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, StringProperty

from ...core.errors import RoughSpectraError
from . import common

if TYPE_CHECKING:
    from ..importing import Batch, Found
    from ..sample import Sample
    from ..target import Solution

ENDINGS = (
    *("csv", "tsv", "txt", "dat", "cgats", "ti3", "sp", "it8", "cxf", "xml", "qtx", "spdx"),
    *("asd", "jdx", "dx", "jcamp", "trt", "ttt", "tit", "rfl8", "json"),
)
"""Of files that may be dropped. Any file can be chosen in the File menu: content decides. Without
exr, whose dropping belongs to images."""

MATERIALS_ITEMS = (
    ("NONE", "None", "Add to the library only", 0),
    ("ASSIGN", "Assign to Active", "Assign the highlighted sample to the active material", 1),
    ("CREATE", "Create", "Make a new material of each sample that is checked", 2),
)

_MOST_SENTENCES = 20


class ImportOptions(common.AssignOptions):
    """What to do with the samples of measurement files."""

    add_to_library: BoolProperty(
        name="Add to Library", description="Keep the samples in your library", default=True
    )
    collection: StringProperty(
        name="Collection", description="Where in the library; empty takes each file's name"
    )
    materials: EnumProperty(
        name="Materials", description="What to make of the samples", items=MATERIALS_ITEMS
    )


class ROUGHSPECTRA_OT_import_samples(ImportOptions, bpy.types.Operator):
    """Add the samples of measurement files to your library, and to materials if wanted"""

    bl_idname = "rough_spectra.import_samples"
    bl_label = "Import Spectra"  # the file browser's button holds no more
    bl_options = {"REGISTER", "UNDO"}

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
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        """Read the files; let the user review them, or go on as the options say."""
        from .. import importing

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
        said = [*batch.refused, *(sentence for each in batch.found for sentence in each.sentences)]
        for sentence in said[:_MOST_SENTENCES]:
            self.report({"WARNING"}, sentence)
        if len(said) > _MOST_SENTENCES:
            self.report(
                {"WARNING"}, rpt_("{} more such sentences").format(len(said) - _MOST_SENTENCES)
            )
        return carry_out(self, context, batch.found, batch.found[0])

    def _paths(self) -> list[Path]:
        folder = bpy.path.abspath(self.directory)
        named = [Path(folder, file.name) for file in self.files if file.name]
        if named or not self.filepath:
            return named
        return [Path(bpy.path.abspath(self.filepath))]

    def _review(self, batch: Batch) -> set[str]:
        from . import import_review

        import_review.present(
            batch,
            add_to_library=self.add_to_library,
            collection=self.collection,
            materials=self.materials,
            sigma=self.sigma,
            shader=self.shader,
            scope=self.scope,
        )
        return {"CANCELLED"}  # nothing was done yet


class ROUGHSPECTRA_FH_import(bpy.types.FileHandler):
    """Measurement files that are dropped on the viewport or on the properties editor"""

    bl_idname = "ROUGHSPECTRA_FH_import"
    bl_label = "Measured Spectra"
    bl_import_operator = "rough_spectra.import_samples"
    bl_file_extensions = ";".join(f".{ending}" for ending in ENDINGS)

    @classmethod
    def poll_drop(cls, context: Any) -> bool:
        """Take files where materials are seen."""
        return context.area is not None and context.area.type in {"VIEW_3D", "PROPERTIES"}


@contextmanager
def waiting(context: Any) -> Iterator[None]:
    """Show the wait cursor for the block, where there is a window."""
    if context.window is None or bpy.app.background:
        yield
        return
    context.window.cursor_set("WAIT")
    try:
        yield
    finally:
        context.window.cursor_set("DEFAULT")


def carry_out(operator: Any, context: Any, chosen: Sequence[Found], active: Found) -> set[str]:
    """Do with samples what the operator's `ImportOptions` say, and report it."""
    from .. import importing, library

    said = ""
    assigned: list[tuple[Any, Solution]] = []
    try:
        if operator.add_to_library:
            added = importing.add(chosen, operator.collection, library.user_folder())
            said = importing.summary(added)
        if operator.materials == "ASSIGN":
            request = common.new_request(active.sample, _sigma(operator, active.sample))
            assigned = common.assign_in_scope(context, operator.scope, request, operator.shader)
        elif operator.materials == "CREATE":
            assigned = _create(operator, chosen)
    except RoughSpectraError as error:
        common.report_error(operator, f"{error} Nonetheless, {said}." if said else error)
        return {"CANCELLED"}
    seen = {sentence for each in chosen for sentence in each.sentences}
    for material, solution in assigned:
        for warning in solution.warnings:
            if warning not in seen:
                operator.report({"WARNING"}, f"{material.name}: {warning}")
    names = ", ".join(material.name for material, _ in assigned[:3])
    if len(assigned) > 3:
        names = rpt_("{} and {} more").format(names, len(assigned) - 3)
    made = rpt_("assigned to {}").format(names) if assigned else ""
    told = "; ".join(filter(None, (said, made))) or rpt_("Nothing was asked for")
    operator.report({"INFO"}, told)
    return {"FINISHED"}


def _sigma(operator: Any, sample: Sample) -> float:
    """Give the roughness: what the file states comes before the field."""
    return operator.sigma if sample.sigma_degrees is None else radians(sample.sigma_degrees)


def _create(operator: Any, chosen: Sequence[Found]) -> list[tuple[Any, Solution]]:
    from .. import assign

    requests = [common.new_request(e.sample, _sigma(operator, e.sample)) for e in chosen]
    materials = [bpy.data.materials.new(each.sample.name) for each in chosen]
    try:
        solutions = assign.assign(list(zip(materials, requests, strict=True)), operator.shader)
    except RoughSpectraError:
        bpy.data.batch_remove(materials)
        raise
    for material in materials:
        material.use_fake_user = True  # nothing uses it yet, and it is to be saved
    return list(zip(materials, solutions, strict=True))


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
