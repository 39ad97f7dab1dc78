# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the file work in a space that holds colors which the usual one does not."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import RoughSpectraError
from . import common


class ROUGHSPECTRA_OT_use_wide_gamut(bpy.types.Operator):
    """Let this file work in ACEScg, which holds more colors, and derive all materials anew"""

    bl_idname = "rough_spectra.use_wide_gamut"
    bl_label = "Use ACEScg"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 8

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a file that works in a narrower space, and a Blender that has others."""
        from ...blender import working_space
        from ...material import verdict

        if not verdict.has_wider_space(working_space.working_space_name()):
            cls.poll_message_set("The file works in a wide space, or Blender has no other")
            return False
        return True

    def execute(self, _context: Any) -> set[str]:
        """Switch, and renew what was up to date: its color follows, and nothing else does."""
        from ...material import derive, selection, state, verdict

        followed = [m for m in selection.with_spectrum() if state.state(m).kind == "fresh"]
        done = bpy.ops.wm.set_working_color_space(
            convert_colors=True, working_space=verdict.WIDE_SPACE
        )
        if "FINISHED" not in done:
            return {"CANCELLED"}
        try:
            materials, left = derive.renewable(followed)
            solutions = derive.renew(materials)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"FINISHED"}  # the space was changed, and undo takes that back
        for sentence in left:
            self.report({"WARNING"}, sentence)
        common.report_warnings(self, zip(materials, solutions, strict=True))
        self.report({"INFO"}, rpt_("{} materials renewed").format(len(materials)))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_use_wide_gamut,)
