# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Put the presets' asset library into the preferences again."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import common


class ROUGHSPECTRA_OT_show_presets(bpy.types.Operator):
    """Add the asset library of all presets to the preferences, after it was taken out"""

    bl_idname = "rough_spectra.show_presets"
    bl_label = "Show Presets in the Asset Browser"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a library that is not there yet."""
        from ...assets import shelf

        if shelf.is_offered():
            cls.poll_message_set("They are there: choose the library in the Asset Browser")
            return False
        return True

    def execute(self, _context: Any) -> set[str]:
        """Add it."""
        from ...assets import shelf

        name = shelf.offer(again=True)
        if name is None:
            common.report_error(self, f"{shelf.folder()} is missing; install the extension again.")
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("Choose {!r} in the Asset Browser").format(name))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_show_presets,)
