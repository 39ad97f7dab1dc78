# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the file work in a space that holds colors which the usual one does not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_

from . import common, looking


class ROUGHSPECTRA_OT_use_wide_gamut(looking.LooksFirst, bpy.types.Operator):
    """Let the whole file work in ACEScg, which holds more colors"""

    bl_idname = "rough_spectra.use_wide_gamut"
    bl_label = "Use ACEScg"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 8

    stopped = "Looking at textures was stopped; their materials are to be renewed"

    @classmethod
    def description(cls, _context: Any, _properties: Any) -> str:
        """Say what changes besides the material at hand."""
        return tip_(
            "Change the color space of the whole file, not of one material alone, to ACEScg, which "
            "holds this color. All other colors are converted and look the same. Asks before, and "
            "Undo takes it back"
        )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a file that works in a narrower space, and a Blender that has others."""
        from ...blender import working_space
        from ...material import verdict

        if not verdict.has_wider_space(working_space.working_space_name()):
            cls.poll_message_set("The file works in a wide space, or Blender has no other")
            return False
        return True

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Tell what changes before it does: it is all of the file, and not this material alone."""
        lines = (
            "The whole file will work in ACEScg, which holds more colors.",
            "All colors of materials, lights and worlds are converted, and look the same.",
            "Materials with a spectrum follow; Renew derives any that is left behind.",
            "Undo takes it back.",
        )
        return set(
            context.window_manager.invoke_confirm(
                self,
                event,
                title=rpt_("Use ACEScg for this file?"),
                message="\n".join(map(rpt_, lines)),
                confirm_text=rpt_("Use ACEScg"),
                icon="NONE",
            )
        )

    def execute(self, context: Any) -> set[str]:
        """Switch, and renew what was up to date: its color follows, and nothing else does."""
        from ...material import selection, state, verdict

        self._followed = [m for m in selection.with_spectrum() if state.state(m).kind == "fresh"]
        done = bpy.ops.wm.set_working_color_space(
            convert_colors=True, working_space=verdict.WIDE_SPACE
        )
        if "FINISHED" not in done:
            return {"CANCELLED"}
        return _switched(super().execute(context))

    def modal(self, context: Any, event: Any) -> set[str]:
        """Watch the second Blender that looks at textures in the new space."""
        return _switched(super().modal(context, event))

    def work(self, _context: Any) -> looking.Work:
        """Renew what followed."""
        from ...material import derive

        able, left = derive.renewable(self._followed)

        def act(materials: Sequence[Any], looked: Mapping[Any, Any]) -> str:
            solutions = derive.renew(materials, looked)
            for sentence in left:
                self.report({"WARNING"}, sentence)
            common.report_warnings(self, zip(materials, solutions, strict=True))
            return rpt_("{} materials renewed").format(len(materials))

        return looking.Work(able, None, act)


def _switched(status: set[str]) -> set[str]:
    """Say that something was done even where nothing was renewed: undo takes the space back."""
    return {"FINISHED"} if status == {"CANCELLED"} else status


classes = (ROUGHSPECTRA_OT_use_wide_gamut,)
