# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let a material of another file be changed in this one."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import common, targets


class ROUGHSPECTRA_OT_make_local(bpy.types.Operator):
    """Take the material out of its library into this file, with the object that shows it"""

    bl_idname = "rough_spectra.make_local"
    bl_label = "Make Local"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 4

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material that belongs elsewhere."""
        from ...material import snapshot

        material = targets.active_material(context)
        if material is None or not snapshot.elsewhere(material):
            cls.poll_message_set("The material belongs to this file already")
            return False
        return True

    def execute(self, context: Any) -> set[str]:
        """Make it local; the slot that shows it, too, where that belongs elsewhere."""
        material: Any = targets.active_material(context)
        name, thing = material.name, targets.active_object(context)
        shown = thing is not None and thing.active_material == material
        if shown and thing is not None:
            for owner in (thing, thing.data):
                if not owner.is_editable or owner.override_library is not None:
                    owner.make_local()
        local = material.make_local()
        if local is None or not local.is_editable or local.override_library is not None:
            sentence = f"Material {name!r} cannot be made local; append it from its file instead."
            common.report_error(self, sentence)
            return {"CANCELLED"}
        if shown and thing is not None and thing.active_material != local:
            thing.active_material = local
        self.report({"INFO"}, rpt_("{} belongs to this file now").format(local.name))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_make_local,)
