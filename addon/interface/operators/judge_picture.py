# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Say whether RGB is enough for the scene, by small pictures that a second Blender renders."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy

from . import picturing

if TYPE_CHECKING:
    from ...picture.verdict import Judging


class ROUGHSPECTRA_OT_judge_picture(picturing.Picturing, bpy.types.Operator):
    """Render small pictures, spectral and in RGB, and say how far RGB is off and what to do"""

    bl_idname = "rough_spectra.judge_picture"
    bl_label = "Is RGB Enough?"
    bl_options = {"REGISTER"}
    menu_place = 4, 0

    stopped = "Stopped; there is no verdict"
    rendering = "Is RGB enough"

    def start(self, context: Any) -> Judging:
        """Start the small pictures."""
        from ...picture import verdict

        scene = context.scene
        self._scene = scene.name
        return verdict.Judging(scene, tolerance=scene.rough_spectra.tolerance)

    def finish(self, job: Judging) -> str:
        """Keep the verdict for the panel."""
        from ...picture import last_verdict

        found = job.verdict()
        scene = bpy.data.scenes.get(self._scene)
        if scene is not None:
            last_verdict.put(scene, found)
        return found.sentence


classes = (ROUGHSPECTRA_OT_judge_picture,)
