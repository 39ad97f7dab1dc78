# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let textures show as they are again."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty

from ....core.errors import RoughSpectraError
from . import common, targets


class ROUGHSPECTRA_OT_remove_scale(bpy.types.Operator):
    """Take away the node that scales the material's texture; the texture is not changed"""

    bl_idname = "rough_spectra.remove_scale"
    bl_label = "Remove Scale of Texture"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 6

    scope: EnumProperty(
        name="For", description="Materials whose textures are meant", items=targets.SCOPE_ITEMS
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return targets.can_have_material(cls, context)

    def execute(self, context: Any) -> set[str]:
        """Remove it from all materials in scope that have one."""
        from ...blender import shader_nodes

        try:
            materials = targets.materials_in_scope(context, self.scope)
            done = [each.name for each in materials if shader_nodes.unscale(each)]
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        if not done:
            self.report({"WARNING"}, rpt_("No texture is scaled there"))
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{names}: scale removed").format(names=", ".join(done[:5])))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_remove_scale,)
