# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the file work in a space that holds colors which the usual one does not."""

from __future__ import annotations

from typing import Any

import bpy

from .switching_space import SwitchesSpace


class ROUGHSPECTRA_OT_use_wide_gamut(SwitchesSpace, bpy.types.Operator):
    """Let the whole file work in ACEScg, which holds more colors"""

    bl_idname = "rough_spectra.use_wide_gamut"
    bl_label = "Use ACEScg"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 8
    known_as = "ACEScg"
    better = "holds more colors"

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a file that works in a narrower space, and a Blender that has others."""
        from ...blender import working_space
        from ...material import verdict

        if not verdict.has_wider_space(working_space.working_space_name()):
            cls.poll_message_set("The file works in a wide space, or Blender has no other")
            return False
        return True

    def space(self) -> str:
        """Give the name of the space."""
        from ...material.verdict import WIDE_SPACE

        return WIDE_SPACE


classes = (ROUGHSPECTRA_OT_use_wide_gamut,)
