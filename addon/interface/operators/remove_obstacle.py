# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove what keeps a color from being derived: a link, an animation, or metal and the like."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, StringProperty

from ....core.errors import RoughSpectraError
from . import common, targets

_KINDS = (
    ("UNLINK", "Unlink", "Remove the link of the socket; the other node stays"),
    ("CLEAR", "Clear Animation", "Remove drivers and keyframes of the socket"),
    (
        "NEUTRAL",
        "Set to 0",
        "Unlink the socket, clear its animation, and set it to what adds nothing",
    ),
)


class ROUGHSPECTRA_OT_remove_obstacle(bpy.types.Operator):
    """Remove what keeps the color from being derived"""

    bl_idname = "rough_spectra.remove_obstacle"
    bl_label = "Remove Obstacle"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="How", description="What is done", items=_KINDS)
    socket: StringProperty(name="Socket", description="Of the material's shader node")

    @classmethod
    def description(cls, _context: Any, properties: Any) -> str:
        """Say what the button at hand does."""
        told = next(about for kind, _, about in _KINDS if kind == properties.kind)
        return f"{properties.socket}: {told}"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material with a spectrum that may be changed."""
        return targets.has_own_spectrum(cls, context)

    def execute(self, context: Any) -> set[str]:
        """Remove it; what follows from the spectrum is then derived by *Renew*."""
        from ...blender import obstacles

        material = targets.active_material(context)
        try:
            obstacles.remove(material, self.kind, self.socket)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{socket} is free").format(socket=self.socket))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_remove_obstacle,)
