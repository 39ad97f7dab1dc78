# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let a muted shader node show again."""

from __future__ import annotations

from typing import Any

import bpy

from . import common, targets


class ROUGHSPECTRA_OT_unmute(bpy.types.Operator):
    """Switch the surface's shader node on again, which is muted"""

    bl_idname = "rough_spectra.unmute"
    bl_label = "Unmute"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material with a spectrum that may be changed."""
        return targets.has_own_spectrum(cls, context)

    def execute(self, context: Any) -> set[str]:
        """Unmute it."""
        from ...blender import shader_nodes

        node = shader_nodes.shader_node(targets.active_material(context))
        if node is None:
            common.report_error(self, "The surface comes from no shader node of ours to unmute.")
            return {"CANCELLED"}
        node.mute = False
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_unmute,)
