# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose work a second Blender does while the user goes on working; ESC stops."""

from __future__ import annotations

from contextlib import ExitStack
from functools import partial
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import RoughSpectraError
from . import common

if TYPE_CHECKING:
    from ....core.numerics.arrays import Array
    from ...blender.background_job import Job
    from ...instrument.bake import Plan

_TIMER_SECONDS = 0.1


class InBackground:
    """What such operators share; each says what the job is and what to do with its result."""

    stopped = "Stopped; nothing was written"
    """What is reported when the user stops it."""

    _job: Any = None

    if TYPE_CHECKING:  # of bpy.types.Operator, which every such class is as well

        def report(self, kind: set[str], message: str) -> None: ...  # noqa: D102

    def start(self, context: Any) -> Job:
        """Start the job.

        Raises
        ------
        RoughSpectraError
            If there is nothing to do, or the second Blender cannot be started.
        """
        raise NotImplementedError

    def state(self, done: int, total: int) -> str:
        """Say how far the job is."""
        raise NotImplementedError

    def finish(self, job: Any) -> str:
        """Use the result of a job that has ended, and say so in one sentence."""
        raise NotImplementedError

    def execute(self, context: Any) -> set[str]:
        """Start the second Blender; in a background Blender, wait for it too."""
        status = self.begin(context)
        if status == {"RUNNING_MODAL"}:
            context.window_manager.modal_handler_add(self)
        return status

    def begin(self, context: Any) -> set[str]:
        """Start the job, for `modal` to watch; who is modal already calls only this."""
        try:
            self._job = self.start(context)
            if bpy.app.background:
                self._job.wait()
                return self._finish()
        except RoughSpectraError as error:
            return self._fail(error)
        manager = context.window_manager
        timer = manager.event_timer_add(_TIMER_SECONDS, window=context.window)
        manager.progress_begin(0, 1)
        # Blender drops an operator without a word when its class is unregistered.
        self._workspaces: set[str] = set()
        self._job.when_closed(partial(_clear, timer, self._workspaces))
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Watch the second Blender; everything else goes to Blender as ever."""
        if event.type not in {"ESC", "TIMER"}:
            return {"PASS_THROUGH"}
        with ExitStack() as last:
            last.callback(self._end)  # after what nobody foresaw, too
            if event.type == "ESC":
                self.report({"WARNING"}, rpt_(self.stopped))
                return {"CANCELLED"}
            try:
                if self._job.poll():
                    return self._finish()
            except RoughSpectraError as error:
                return self._fail(error)
            self._show(context)
            last.pop_all()
        return {"PASS_THROUGH"}

    def cancel(self, _context: Any) -> None:
        """Blender is closing, or another file was opened."""
        self._end()

    def _show(self, context: Any) -> None:
        done, total = self._job.done, max(self._job.total, 1)
        context.window_manager.progress_update(done / total)
        self._workspaces.add(context.workspace.name)
        context.workspace.status_text_set(f"{self.state(done, total)}   |   {rpt_('ESC: stop')}")

    def _finish(self) -> set[str]:
        from ...preview import icons

        sentence = self.finish(self._job)
        self._end()
        icons.redraw()  # nobody has to touch the panel for it to show what was found
        self.report({"INFO"}, sentence)
        return {"FINISHED"}

    def _fail(self, error: RoughSpectraError) -> set[str]:
        self._end()
        common.report_error(self, error)
        return {"CANCELLED"}

    def _end(self) -> None:
        if self._job is not None:
            self._job.close()
            self._job = None


def _clear(timer: Any, workspaces: set[str]) -> None:
    """Take away what an operator shows; the user may have turned to another workspace meanwhile."""
    manager = bpy.context.window_manager
    manager.event_timer_remove(timer)
    manager.progress_end()
    for name in workspaces & set(bpy.data.workspaces.keys()):
        bpy.data.workspaces[name].status_text_set(None)


class Measuring(InBackground):
    """What operators that measure share; each says what to measure and what to do with it."""

    stopped = "Measuring was stopped; nothing was written"

    def to_measure(self, context: Any) -> Plan:
        """Say what to measure, and note what the result is to be compared with.

        Raises
        ------
        RoughSpectraError
            If there is nothing to measure.
        """
        raise NotImplementedError

    def take(self, values: Array) -> str:
        """Use what was measured, shape (readings, 2, 3), and say so in one sentence."""
        raise NotImplementedError

    def start(self, context: Any) -> Job:
        """Start the measurement."""
        from ...instrument import measure

        plan = self.to_measure(context)
        materials, geometries = plan.work
        self._count = len(materials)  # the materials themselves may not outlive an undo
        self._plan = plan
        return measure.Measurement(materials, geometries)

    def state(self, done: int, total: int) -> str:
        """Say how many renders are done."""
        if self._count == 1:
            sentence = rpt_("Measuring 1 material: {done} of {total} rendered")
        else:
            sentence = rpt_("Measuring {count} materials: {done} of {total} rendered")
        return sentence.format(count=self._count, done=done, total=total)

    def finish(self, job: Any) -> str:
        """Hand the values on."""
        return self.take(self._plan.taken(job.result()))
