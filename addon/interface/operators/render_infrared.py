# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render what a camera for the infrared sees in the background, and show it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import picturing

if TYPE_CHECKING:
    from ...picture.infrared import Infrared


class ROUGHSPECTRA_OT_render_infrared(picturing.Picturing, bpy.types.Operator):
    """Render what a camera sees in a band of the infrared, by the light of lamps; ESC stops"""

    bl_idname = "rough_spectra.render_infrared"
    bl_label = "Render Infrared Picture"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 4, 3

    rendering = "Infrared picture"

    def start(self, context: Any) -> Infrared:
        """Look what is known there, and start."""
        from ...picture import infrared, settings

        self._false_color = context.scene.rough_spectra.false_color
        return infrared.Infrared(context.scene, settings.infrared(context.scene))

    def finish(self, job: Infrared) -> str:
        """Put the picture into the file, show it, and name what is not known there."""
        from ...picture import camera_images

        image = camera_images.put_infrared(job.result(), false_color=self._false_color)
        first, *others = camera_images.told(camera_images.INFRARED)
        for sentence in others:
            self.report({"WARNING"}, sentence)
        return f"{rpt_('Infrared picture')}: {first}{picturing.shown(image)}"


classes = (ROUGHSPECTRA_OT_render_infrared,)
