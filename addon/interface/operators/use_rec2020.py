# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the file work in the space that a verdict on its picture found to be better."""

from __future__ import annotations

from typing import Any

import bpy

from .switching_space import SwitchesSpace


class ROUGHSPECTRA_OT_use_rec2020(SwitchesSpace, bpy.types.Operator):
    """Let the whole file work in Linear Rec.2020, where RGB is less far off"""

    bl_idname = "rough_spectra.use_rec2020"
    bl_label = "Use Linear Rec.2020"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 9
    known_as = "Linear Rec.2020"
    better = "brings RGB closer to the spectral picture"

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need another space, and a Blender that can switch."""
        from ...blender import working_space
        from ...picture.verdict import WIDE

        if not hasattr(bpy.data, "colorspace") or working_space.working_space_name() == WIDE:
            cls.poll_message_set("The file works in it, or Blender has no other space")
            return False
        return True

    def space(self) -> str:
        """Give the name of the space."""
        from ...picture.verdict import WIDE

        return WIDE


classes = (ROUGHSPECTRA_OT_use_rec2020,)
