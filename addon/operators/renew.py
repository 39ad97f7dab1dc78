# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Derive color and roughness again from the stored spectrum."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty

from ...core.errors import RoughSpectraError
from .. import stamp
from . import common


class ROUGHSPECTRA_OT_renew(bpy.types.Operator):
    """Derive color and roughness again from the stored spectrum and the settings shown"""

    bl_idname = "rough_spectra.renew"
    bl_label = "Renew"
    bl_options = {"REGISTER", "UNDO"}

    scope: EnumProperty(name="For", description="Materials to renew", items=common.SCOPE_ITEMS)

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material with a spectrum."""
        material = common.active_material(context)
        if material is not None and stamp.has_spectrum(material):
            return True
        cls.poll_message_set("The material has no measured spectrum; assign one first")
        return False

    def execute(self, context: Any) -> set[str]:
        """Renew all materials in scope that store a spectrum, or none."""
        from .. import assign

        try:
            found = common.materials_in_scope(context, self.scope)
            materials = [material for material in found if stamp.has_spectrum(material)]
            if not materials:
                msg = "No material in scope has a measured spectrum; assign one first."
                raise RoughSpectraError(msg)
            solutions = assign.renew(materials)
        except RoughSpectraError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        common.report_warnings(self, zip(materials, solutions, strict=True))
        self.report({"INFO"}, f"{len(materials)} materials renewed")
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_renew,)
