# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake virtual spectrophotometer readings, without blocking Blender."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.props import EnumProperty, StringProperty

from ...core.errors import RoughSpectraError
from . import common

_TIMER_SECONDS = 0.1


class ROUGHSPECTRA_OT_bake(bpy.types.Operator):
    """Write predicted and measured readings of materials to files; ESC stops"""

    bl_idname = "rough_spectra.bake"
    bl_label = "Bake Readings"
    bl_options = {"REGISTER"}  # no undo step: nothing in the .blend changes

    filepath: StringProperty(
        name="Files",
        description="Folder and base name; endings such as .predicted.csv are added",
        subtype="FILE_PATH",
    )
    scope: EnumProperty(
        name="For",
        description="Materials to measure",
        items=(
            *common.SCOPE_ITEMS,
            ("ALL", "All with a Spectrum", "Every material of the file that stores a spectrum"),
        ),
    )

    _measurement: Any = None
    _timer: Any = None

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need at least one material."""
        if len(bpy.data.materials) > 0:
            return True
        cls.poll_message_set("There is no material to measure")
        return False

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose where to write."""
        if not self.filepath:
            blend = Path(bpy.data.filepath or "untitled.blend")
            self.filepath = str(blend.with_name(f"{blend.stem}-readings"))
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        """Start the second Blender; in a background Blender, wait for it too."""
        from .. import outputs, readings
        from ..spectrophotometer import measure

        try:
            self._base = Path(bpy.path.abspath(self.filepath))
            outputs.check_base(self._base)
            surfaces = [("", material) for material in self._materials(context)]
            self._prepared = readings.prepare(surfaces)
            distinct, self._places = readings.distinct_materials(surfaces)
            self._measurement = measure.Measurement(distinct, (measure.RING_45_0,))
            if bpy.app.background:
                self._measurement.wait()
                return self._finish()
        except RoughSpectraError as error:
            return self._fail(context, error)
        manager = context.window_manager
        self._timer = manager.event_timer_add(_TIMER_SECONDS, window=context.window)
        manager.progress_begin(0, 1)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Watch the second Blender; everything else goes to Blender as ever."""
        if event.type == "ESC":
            self._end(context)
            self.report({"WARNING"}, "Measuring was stopped; nothing was written")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            if not self._measurement.poll():
                self._show(context)
                return {"PASS_THROUGH"}
            return self._finish(context)
        except RoughSpectraError as error:
            return self._fail(context, error)

    def cancel(self, context: Any) -> None:
        """Blender is closing, or another file was opened."""
        self._end(context)

    def _materials(self, context: Any) -> list[Any]:
        from .. import selection

        if self.scope == "ALL":
            return [material for _, material in selection.surfaces((), ())]
        return common.materials_in_scope(context, self.scope)

    def _show(self, context: Any) -> None:
        done, total = self._measurement.done, self._measurement.total
        context.window_manager.progress_update(done / max(total, 1))
        context.workspace.status_text_set(
            f"Measuring {len(self._prepared)} materials: {done} of {max(total, 1)} renders"
            "   |   ESC: stop"
        )

    def _finish(self, context: Any = None) -> set[str]:
        from .. import readings, writers

        values = self._measurement.result()[0][self._places]
        result = readings.compare(self._prepared, values)
        written = writers.write(result, self._base)
        self._end(context)
        largest = result.largest_delta_e
        difference = "" if largest is None else f", largest ΔE00 {largest:.2f}"
        self.report(
            {"INFO"},
            f"{len(result.entries)} readings{difference}; {len(written)} files in "
            f"{self._base.parent}",
        )
        return {"FINISHED"}

    def _fail(self, context: Any, error: RoughSpectraError) -> set[str]:
        self._end(context)
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}

    def _end(self, context: Any) -> None:
        if self._measurement is not None:
            self._measurement.close()
            self._measurement = None
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            context.window_manager.progress_end()
            context.workspace.status_text_set(None)
            self._timer = None


classes = (ROUGHSPECTRA_OT_bake,)
