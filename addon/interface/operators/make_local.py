# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a linked, packed or overridden material local, so that its settings can be changed."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import RoughSpectraError
from . import common


class ROUGHSPECTRA_OT_make_local(bpy.types.Operator):
    """Make the linked material your own, in this file, so that it can be changed"""

    bl_idname = "rough_spectra.make_local"
    bl_label = "Make Local"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 6

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material that cannot be changed as it is."""
        material = common.active_material(context)
        if material is None:
            cls.poll_message_set("There is no material")
            return False
        if material.is_editable and material.override_library is None:
            cls.poll_message_set("The material is local already")
            return False
        return True

    def execute(self, context: Any) -> set[str]:
        """Make it local, whoever else uses it."""
        from ...blender import local

        try:
            made = local.make_local(common.active_material(context), common.active_object(context))
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("Material {!r} is local").format(made.name))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_make_local,)
