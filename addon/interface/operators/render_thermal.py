# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render what a thermal camera sees in the background, and show it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import picturing

if TYPE_CHECKING:
    from ...picture.thermal import Thermal


class ROUGHSPECTRA_OT_render_thermal(picturing.Picturing, bpy.types.Operator):
    """Render what surfaces emit by their temperature and reflect of each other; ESC stops"""

    bl_idname = "rough_spectra.render_thermal"
    bl_label = "Render Thermal Picture"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 4, 4

    rendering = "Thermal picture"
    needs_cycles = False

    def start(self, context: Any) -> Thermal:
        """Gather temperatures and emissivities, and start."""
        from ...picture import settings, thermal

        return thermal.Thermal(context.scene, settings.heat(context.scene))

    def finish(self, job: Thermal) -> str:
        """Put the picture into the file, show it, and name what is not known there."""
        from ...picture import camera_images

        image = camera_images.put_thermal(job.result())
        first, *others = camera_images.told(camera_images.THERMAL)
        for sentence in others:
            self.report({"WARNING"}, sentence)
        return f"{rpt_('Thermal picture')}: {first}{picturing.shown(image)}"


classes = (ROUGHSPECTRA_OT_render_thermal,)
