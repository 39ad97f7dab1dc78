# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render with the engine that shows how rough a surface is."""

from __future__ import annotations

from typing import Any

import bpy

from . import common

_CYCLES = "CYCLES"


class ROUGHSPECTRA_OT_switch_to_cycles(bpy.types.Operator):
    """Render the scene with Cycles, which shows the roughness of surfaces; Eevee leaves it out"""

    bl_idname = "rough_spectra.switch_to_cycles"
    bl_label = "Switch to Cycles"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 6

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need another engine."""
        if context.scene is None or context.scene.render.engine == _CYCLES:
            cls.poll_message_set("The scene is rendered with Cycles already")
            return False
        return True

    def execute(self, context: Any) -> set[str]:
        """Set the engine; materials that follow their scene follow that, too, when renewed."""
        try:
            context.scene.render.engine = _CYCLES
        except TypeError:
            common.report_error(
                self, "Cycles is switched off; enable the add-on Cycles Render Engine first."
            )
            return {"CANCELLED"}
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_switch_to_cycles,)
