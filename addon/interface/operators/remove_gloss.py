# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make materials matte: take the gloss away, and let the color show the whole reading."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty

from ....core.errors import RoughSpectraError
from . import common, targets


class ROUGHSPECTRA_OT_remove_gloss(bpy.types.Operator):
    """Make it matte. Sets specular level and coat to 0, and derives the color without them"""

    bl_idname = "rough_spectra.remove_gloss"
    bl_label = "Remove Gloss"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 5

    scope: EnumProperty(
        name="For", description="Materials that lose their gloss", items=targets.SCOPE_ITEMS
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a material with a spectrum."""
        return targets.has_spectra(cls)

    def execute(self, context: Any) -> set[str]:
        """Remove the gloss of all in scope that have one."""
        from ...material import derive

        try:
            materials = _glossy(targets.materials_in_scope(context, self.scope))
            solutions = derive.remove_gloss(materials)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        common.report_warnings(self, zip(materials, solutions, strict=True))
        self.report({"INFO"}, rpt_("Gloss removed: {}").format(len(materials)))
        return {"FINISHED"}


def _glossy(materials: list[Any]) -> list[Any]:
    """Give those with a spectrum and gloss.

    Raises
    ------
    RoughSpectraError
        If there is none.
    """
    from ...blender import shader_nodes
    from ...material import snapshot

    found = []
    for material in filter(snapshot.has_spectrum, materials):
        surface = shader_nodes.surface(material)
        if surface is not None and surface.gloss is not None:
            found.append(material)
    if not found:
        msg = (
            "No material in scope has both a measured spectrum and gloss; there is none to remove."
        )
        raise RoughSpectraError(msg)
    return found


classes = (ROUGHSPECTRA_OT_remove_gloss,)
