# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Give a lamp of the picture another spectrum, or let all be as they were rendered."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, IntProperty

from ....core.errors import RoughSpectraError
from ...material.properties import ILLUMINANT_ITEMS
from . import common
from .open_light import LightFile

_RENDERED, _FILE = "RENDERED", "FILE"
SPECTRUM_ITEMS = (
    (_RENDERED, "Its Own", "What it was rendered with", 100),
    *ILLUMINANT_ITEMS,
    ("HP1", "HP1", "CIE illuminant HP1: sodium at high pressure, 1960 K", 101),
    ("sodium", "Sodium", "Sodium at low pressure: its two lines alone", 102),
    (_FILE, "Open File…", "The spectrum of a file", 103),
)


class ROUGHSPECTRA_OT_change_lamp(LightFile, bpy.types.Operator):
    """Spectrum of the lamp in this picture, as bright as before; the lamp itself stays as it is"""

    bl_idname = "rough_spectra.change_lamp"
    bl_label = "Spectrum"
    bl_options = {"REGISTER"}

    lamp: IntProperty(
        name="Lamp",
        description="Its number in the picture",
        min=0,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    spectrum: EnumProperty(
        name="Spectrum",
        description="What the lamp sends",
        items=SPECTRUM_ITEMS,
        default=_RENDERED,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need lamps that were rendered apart."""
        return _poll(cls)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose a file where one is meant."""
        if self.spectrum != _FILE:
            return self.execute(context)
        return common.open_file(self, context)

    def execute(self, _context: Any) -> set[str]:
        """Set it; the picture follows."""
        from ...picture import relit
        from ...preview import icons

        last = relit.last()
        if last is None or self.lamp >= len(last.intensities):  # the browser was open for long
            common.report_error(self, rpt_("There is no such lamp; render the lamps apart again."))
            return {"CANCELLED"}
        names = {_RENDERED: None, _FILE: bpy.path.abspath(self.filepath)}
        try:
            last.set_light(self.lamp, names.get(self.spectrum, self.spectrum))
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        relit.changed()
        icons.redraw()
        return {"FINISHED"}


class ROUGHSPECTRA_OT_reset_lamps(bpy.types.Operator):
    """Let all lamps of this picture, and its observer, be as they were rendered"""

    bl_idname = "rough_spectra.reset_lamps"
    bl_label = "As Rendered"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need lamps that were rendered apart."""
        return _poll(cls)

    def execute(self, _context: Any) -> set[str]:
        """Reset them; the picture follows."""
        from ...picture import relit
        from ...preview import icons

        last = relit.last()
        assert last is not None
        last.reset()
        relit.changed()
        icons.redraw()
        return {"FINISHED"}


def _poll(cls: Any) -> bool:
    from ...picture import relit

    if relit.last() is None:
        cls.poll_message_set("Render the lamps apart first; they are not kept in the file")
        return False
    return True


classes = (ROUGHSPECTRA_OT_change_lamp, ROUGHSPECTRA_OT_reset_lamps)
