# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Accept edits by hand."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import RoughSpectraError
from . import common, targets


class ROUGHSPECTRA_OT_keep(bpy.types.Operator):
    """Keep color and roughness as they are, though they no longer follow from the spectrum"""

    bl_idname = "rough_spectra.keep"
    bl_label = "Keep"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 3

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material that is not up to date."""
        from ...material import state

        if not targets.has_own_spectrum(cls, context):
            return False
        known = state.state(targets.active_material(context))
        if known.kind in {"fresh", "kept"} or known.stamp is None:
            cls.poll_message_set("There is nothing to keep: the material is up to date")
            return False
        return True

    def execute(self, context: Any) -> set[str]:
        """Note what is shown as kept."""
        from ...material import storage

        material: Any = targets.active_material(context)
        try:
            storage.keep(material)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{} kept as it is").format(material.name))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_keep,)
