# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the file work in another color space, and derive all materials anew."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_

from . import common, looking


class SwitchesSpace(looking.LooksFirst):
    """What operators share that switch the working space."""

    known_as = ""
    """The space's name, for people."""
    better = ""
    """What it does that the file's does not."""
    stopped = "Looking at textures was stopped; their materials are to be renewed"

    def space(self) -> str:
        """Give the name of the space."""
        raise NotImplementedError

    @classmethod
    def description(cls, _context: Any, _properties: Any) -> str:
        """Say what changes besides the material at hand."""
        return tip_(
            "Change the color space of the whole file, not of one material alone, to {}, which {}. "
            "All other colors are converted and look the same. Asks before, and Undo takes it back"
        ).format(cls.known_as, cls.better)

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Tell what changes before it does: it is all of the file, and not this material alone."""
        lines = (
            rpt_("The whole file will work in {}, which {}.").format(self.known_as, self.better),
            rpt_("All colors of materials, lights and worlds are converted, and look the same."),
            rpt_("Materials with a spectrum follow; Renew derives any that is left behind."),
            rpt_("Undo takes it back."),
        )
        return set(
            context.window_manager.invoke_confirm(
                self,
                event,
                title=rpt_("Use {} for this file?").format(self.known_as),
                message="\n".join(lines),
                confirm_text=rpt_("Use {}").format(self.known_as),
                icon="NONE",
            )
        )

    def execute(self, context: Any) -> set[str]:
        """Switch, and renew what was up to date: its color follows, and nothing else does."""
        from ...material import selection, state

        self._followed = [m for m in selection.with_spectrum() if state.state(m).kind == "fresh"]
        done = bpy.ops.wm.set_working_color_space(convert_colors=True, working_space=self.space())
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
