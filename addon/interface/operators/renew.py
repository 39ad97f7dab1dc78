# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Derive color and roughness again from the stored spectrum."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty

from ....core.errors import RoughSpectraError
from . import common, looking, targets

_NAMED = 3
"""Materials named in a report; of more only the number is told."""


class ROUGHSPECTRA_OT_renew(looking.LooksFirst, bpy.types.Operator):
    """Make it look like its sample again. Color and roughness follow from spectrum and settings"""

    bl_idname = "rough_spectra.renew"
    bl_label = "Renew"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 2

    scope: EnumProperty(
        name="For",
        description="Materials to renew",
        items=(
            *targets.SCOPE_ITEMS,
            ("ALL_STALE", "All Not Up to Date", "Every material in use that needs it"),
        ),
    )
    overwrite_edits: BoolProperty(
        name="Overwrite Edits by Hand",
        description="Renew materials, too, whose color or roughness was edited by hand; the active "
        "material alone always is",
        default=False,
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a material with a spectrum."""
        return targets.has_spectra(cls)

    def work(self, context: Any) -> looking.Work:
        """Renew the active material, or all in scope that can be."""
        from ...material import derive

        materials = self._materials(context)
        left: list[str] = []
        if self.scope != "ACTIVE":
            materials, left = self._without_edited(materials)
            materials, refused = derive.renewable(materials)
            left += refused

        def act(materials: Sequence[Any], looked: Mapping[Any, Any]) -> str:
            solutions = derive.renew(materials, looked)
            for sentence in left:
                self.report({"WARNING"}, sentence)
            common.report_warnings(self, zip(materials, solutions, strict=True))
            return rpt_("{} renewed").format(_names(list(materials)))

        return looking.Work(materials, None, act, does=bool(materials))

    def _materials(self, context: Any) -> list[Any]:
        from ...material import selection, snapshot, state

        if self.scope == "ALL_STALE":
            states = ((m, state.state(m)) for m in selection.in_use(bpy.data.materials))
            found = [m for m, known in states if known.kind in {"stale", "error"}]
            return sorted(found, key=lambda m: m.name)
        found = targets.materials_in_scope(context, self.scope)
        materials = [material for material in found if snapshot.has_spectrum(material)]
        if not materials:
            msg = "No material in scope has a measured spectrum; assign one first."
            raise RoughSpectraError(msg)
        return materials

    def _without_edited(self, materials: list[Any]) -> tuple[list[Any], list[str]]:
        """Leave out what was edited by hand, and say so."""
        from ...material import state

        edited = [] if self.overwrite_edits else [m for m in materials if state.edited_by_hand(m)]
        if not edited:
            return materials, []
        sentence = rpt_("{} left as edited by hand; overwrite edits to renew them too").format(
            _names(edited)
        )
        return [m for m in materials if m not in edited], [sentence]


def _names(materials: list[Any]) -> str:
    if 0 < len(materials) <= _NAMED:
        return ", ".join(material.name for material in materials)
    return rpt_("{} materials").format(len(materials))


classes = (ROUGHSPECTRA_OT_renew,)
