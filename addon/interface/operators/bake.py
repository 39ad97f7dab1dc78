# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake virtual spectrophotometer readings, without blocking Blender."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, StringProperty

from . import background, common, targets

if TYPE_CHECKING:
    from ....core.numerics.arrays import Array
    from ...instrument.bake import Plan


class ROUGHSPECTRA_OT_bake(background.Measuring, bpy.types.Operator):
    """Write predicted and measured readings of materials to files; ESC stops"""

    bl_idname = "rough_spectra.bake"
    bl_label = "Bake Readings"
    bl_options = {"REGISTER"}  # no undo step: nothing in the .blend changes
    menu_place = 3, 2

    filepath: StringProperty(
        name="Files",
        description="Folder and base name; endings such as .predicted.csv are added",
        subtype="FILE_PATH",
    )
    scope: EnumProperty(
        name="For",
        description="Materials to measure",
        items=(*targets.SCOPE_ITEMS, targets.ALL_WITH_SPECTRUM),
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need at least one material."""
        return targets.has_materials(cls)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose where to write."""
        return common.choose_files(self, context, "-readings")

    def to_measure(self, context: Any) -> Plan:
        """Check the target, and take down the predictions."""
        from ...instrument import bake
        from ...readings import writers

        self._base = Path(bpy.path.abspath(self.filepath))
        writers.check(self._base)
        materials = targets.materials_in_scope(context, self.scope)
        surfaces = [("", material) for material in materials]
        self._prepared = bake.as_flat_samples(surfaces, bake.prepare(surfaces))
        return bake.plan(surfaces, self._prepared)

    def take(self, values: Array) -> str:
        """Write all files."""
        from ...instrument import bake
        from ...readings import writers

        result = bake.compare(self._prepared, values)
        written = writers.write(result, self._base)
        for sentence in result.faults:
            self.report({"WARNING"}, sentence)
        largest = result.largest_delta_e
        count = len(result.entries)
        if largest is None:
            sentence = rpt_("{readings}; {files} files in {folder}")
        else:
            sentence = rpt_("{readings}, largest ΔE00 {largest:.2f}; {files} files in {folder}")
        return sentence.format(
            readings=rpt_("1 reading") if count == 1 else rpt_("{} readings").format(count),
            largest=largest,
            files=len(written),
            folder=self._base.parent,
        )


classes = (ROUGHSPECTRA_OT_bake,)
