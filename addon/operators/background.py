# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that measure in a second Blender while the user goes on working; ESC stops."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy

from ...core.errors import RoughSpectraError

if TYPE_CHECKING:
    from ...core.arrays import Array

_TIMER_SECONDS = 0.1


class Measuring:
    """What such operators share; each says what to measure and what to do with the result."""

    _measurement: Any = None
    _timer: Any = None

    def to_measure(self, context: Any) -> list[Any]:
        """Give the materials to measure, and note what the result is to be compared with.

        Raises
        ------
        RoughSpectraError
            If there is nothing to measure.
        """
        raise NotImplementedError

    def take(self, values: Array) -> str:
        """Use what was measured, shape (materials, 2, 3), and say so in one sentence."""
        raise NotImplementedError

    def execute(self, context: Any) -> set[str]:
        """Start the second Blender; in a background Blender, wait for it too."""
        from ..spectrophotometer import measure

        try:
            materials = self.to_measure(context)
            self._count = len(materials)  # the materials themselves may not outlive an undo
            self._measurement = measure.Measurement(materials, (measure.RING_45_0,))
            if bpy.app.background:
                self._measurement.wait()
                return self._finish(context)
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

    def _show(self, context: Any) -> None:
        done, total = self._measurement.done, max(self._measurement.total, 1)
        context.window_manager.progress_update(done / total)
        what = "1 material" if self._count == 1 else f"{self._count} materials"
        context.workspace.status_text_set(
            f"Measuring {what}: {done} of {total} renders   |   ESC: stop"
        )

    def _finish(self, context: Any) -> set[str]:
        sentence = self.take(self._measurement.result()[0])
        self._end(context)
        self.report({"INFO"}, sentence)
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
