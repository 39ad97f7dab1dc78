# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Show the viewport as it is rendered, where Material Preview shows another engine's picture."""

from __future__ import annotations

from typing import Any

import bpy

from . import targets


class ROUGHSPECTRA_OT_show_rendered(bpy.types.Operator):
    """Shade the viewport as Rendered: Material Preview is Eevee, which leaves the roughness out"""

    bl_idname = "rough_spectra.show_rendered"
    bl_label = "Show Rendered"
    bl_options = {"REGISTER"}
    menu_place = 2, 7

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a viewport that shows Material Preview."""
        if not targets.previews(context):
            cls.poll_message_set("No viewport shows Material Preview")
            return False
        return True

    def execute(self, context: Any) -> set[str]:
        """Switch all of the window that do."""
        for space in targets.previews(context):
            space.shading.type = "RENDERED"
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_show_rendered,)
