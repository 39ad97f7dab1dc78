# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The dialog between reading measurement files and using them: nothing is made before OK."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    FloatVectorProperty,
    IntProperty,
    StringProperty,
)

from ...material.properties import title
from . import common, giving
from .import_options import ImportOptions

if TYPE_CHECKING:
    from ...samples.importing import Batch, Found

_WIDTH = 560
_CHARACTERS_A_LINE = 92
_ROWS = 8
_MOST_REFUSED = 5

_batch: list[Batch] = []
"""What the dialog shows: an operator's properties cannot hold it."""


class RoughSpectraImportItem(bpy.types.PropertyGroup):
    """A sample in the list of the import dialog."""

    chosen: BoolProperty(name="Import", description="Import this sample", default=True)
    swatch: FloatVectorProperty(
        name="Color",
        description="Color of the reading under D65, for the 2° observer",
        subtype="COLOR_GAMMA",
        min=0.0,
        max=1.0,
    )
    has_color: BoolProperty(name="Has Color", description="Whether its bands make a color")
    about: StringProperty(name="About", description="What the file says of the measurement")
    warnings: StringProperty(name="Warnings", description="What to watch for, one a line")
    notes: StringProperty(name="Notes", description="What else to know of it, one a line")


def _icon_of(item: Any) -> str:
    if item.warnings:
        return "ERROR"
    return "INFO" if item.notes else "BLANK1"


class ROUGHSPECTRA_UL_import(bpy.types.UIList):
    """Samples of measurement files"""

    def draw_item(
        self,
        _context: Any,
        layout: Any,
        _data: Any,
        item: Any,
        _icon: Any,
        _active_data: Any,
        _active_property: str,
    ) -> None:
        """Draw checkbox, color, name, what it is, and whether there is something to know."""
        row = layout.row(align=True)
        row.prop(item, "chosen", text="")
        common.draw_swatch(row, item, item.has_color)
        split = row.split(factor=0.45)
        split.label(text=item.name, translate=False)
        detail = split.row()
        detail.label(text=item.about, translate=False)
        detail.label(text="", icon=_icon_of(item))


def _choose_all(operator: Any, _context: Any) -> None:
    for item in operator.items:
        item.chosen = operator.all_chosen


class ROUGHSPECTRA_OT_import_review(ImportOptions, bpy.types.Operator):
    """Choose which samples of the files to import, and what to make of them"""

    bl_idname = "rough_spectra.import_review"
    bl_label = "Import Spectra"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    items: CollectionProperty(
        name="Samples",
        description="Samples of the files",
        type=RoughSpectraImportItem,
        options={"SKIP_SAVE", "HIDDEN"},
    )
    index: IntProperty(
        name="Sample", description="The highlighted sample", options={"SKIP_SAVE", "HIDDEN"}
    )
    all_chosen: BoolProperty(
        name="All",
        description="Check or uncheck all samples",
        default=True,
        update=_choose_all,
        options={"SKIP_SAVE"},
    )

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Show the samples of the batch."""
        _fill(self.items, _batch[0].found)
        return context.window_manager.invoke_props_dialog(
            self, width=_WIDTH, title="Import Measured Spectra", confirm_text="Import"
        )

    def draw(self, _context: Any) -> None:
        """Draw the list, what to know of the highlighted sample, and what to do."""
        layout = self.layout
        layout.template_list(
            "ROUGHSPECTRA_UL_import", "", self, "items", self, "index", rows=_ROWS, maxrows=_ROWS
        )
        row = layout.row()
        row.prop(self, "all_chosen")
        count = len(self.items)
        text = iface_("1 sample") if count == 1 else iface_("{} samples").format(count)
        row.label(text=text, translate=False)
        if 0 <= self.index < len(self.items):
            column = layout.column(align=True)
            item = self.items[self.index]
            for sentences, icon in ((item.warnings, "ERROR"), (item.notes, "INFO")):
                for sentence in filter(None, sentences.split("\n")):
                    _draw_sentence(column, sentence, icon)
        _draw_refused(layout, _batch[0].refused if _batch else ())
        layout.separator(type="LINE")
        layout.use_property_split = True
        layout.use_property_decorate = False
        giving.draw_white(layout, self)
        layout.prop(self, "add_to_library")
        column = layout.column()
        column.enabled = self.add_to_library
        column.prop(self, "collection", placeholder="Names of the files")
        if _batch and len({each.path for each in _batch[0].found}) > 1:
            row = column.row()
            row.enabled = not self.collection  # that is one already
            row.prop(self, "together")
        layout.prop(self, "materials", expand=True)
        for name, label in (("sigma", "σ Unless Stated"), ("shader", "Shader")):
            row = layout.row()
            row.enabled = self.materials != "NONE"
            row.prop(self, name, text=label)

    def execute(self, context: Any) -> set[str]:
        """Import what is checked."""
        found = _batch[0].found if _batch else ()
        if len(found) != len(self.items):
            self.report({"ERROR"}, "The files are no longer at hand; import them again")
            return {"CANCELLED"}
        chosen = [each for each, item in zip(found, self.items, strict=True) if item.chosen]
        if not chosen:
            self.report({"ERROR"}, "No sample is checked; check those to import")
            return {"CANCELLED"}
        at = min(max(self.index, 0), len(found) - 1)
        active = found[at] if self.items[at].chosen else chosen[0]
        return self.carry_out(context, chosen, active)


def present(batch: Batch, **options: Any) -> None:
    """Open the dialog for files that were read."""
    _batch[:] = [batch]
    bpy.ops.rough_spectra.import_review("INVOKE_DEFAULT", **options)


def _fill(items: Any, found: tuple[Found, ...]) -> None:
    from ...samples import swatches

    rgb, _ = swatches.of_samples([each.sample for each in found])
    items.clear()
    for each, color in zip(found, rgb.tolist(), strict=True):
        item = items.add()
        item.name = each.sample.name
        item.about = _about(each)
        item.has_color = color[0] == color[0]  # NaN where the bands make none
        if item.has_color:
            item.swatch = color
        if each.warnings:
            item.warnings = "\n".join(each.warnings)
        notes = [note for note in each.sentences if note not in each.warnings]
        if notes:
            item.notes = "\n".join(notes)


def _about(each: Found) -> str:
    sample = each.sample
    parts = (
        *(sample.kind.capitalize(), sample.geometry or title("instrument", sample.instrument)),
        *(sample.specular, sample.condition, sample.device),
        iface_("{} readings").format(len(sample.readings)) if sample.others else "",
    )
    return ", ".join(part for part in parts if part)


def _draw_refused(layout: Any, refused: tuple[str, ...]) -> None:
    column = layout.column(align=True)
    column.alert = True
    for sentence in refused[:_MOST_REFUSED]:
        _draw_sentence(column, iface_("Not read: {}").format(sentence), "CANCEL")
    more = len(refused) - _MOST_REFUSED
    if more > 0:
        several = iface_("{} more files were not read").format(more)
        text = iface_("1 more file was not read") if more == 1 else several
        column.label(text=text, translate=False)


def _draw_sentence(column: Any, sentence: str, icon: str) -> None:
    for number, line in enumerate(textwrap.wrap(sentence, _CHARACTERS_A_LINE)):
        column.label(text=line, icon=icon if number == 0 else "BLANK1", translate=False)


classes = (RoughSpectraImportItem, ROUGHSPECTRA_UL_import, ROUGHSPECTRA_OT_import_review)
