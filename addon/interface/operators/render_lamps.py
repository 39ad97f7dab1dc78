# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render the light of each lamp apart in the background, so that lamps can be changed after it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import picturing

if TYPE_CHECKING:
    from ...picture.groups import Gathering


class ROUGHSPECTRA_OT_render_lamps(picturing.Picturing, bpy.types.Operator):
    """Render each lamp's light apart, to change lamps in the picture while you watch; ESC stops"""

    bl_idname = "rough_spectra.render_lamps"
    bl_label = "Render Lamps Apart"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 4, 6

    rendering = "Lamps apart"

    def start(self, context: Any) -> Gathering:
        """Choose bands for these lamps and for those that may come, and start."""
        from ...blender import working_space
        from ...picture import groups, relit, settings

        scene = context.scene
        self._from_xyz = working_space.current().from_xyz
        self._observer = int(scene.rough_spectra.observer)
        return groups.Gathering(scene, settings.lamps(scene), relit.MOST_BYTES)

    def finish(self, job: Gathering) -> str:
        """Put the picture into the file, and show it."""
        from ...picture import relit

        lights = job.lights()
        image = relit.put(relit.Relit(lights, self._from_xyz, self._observer))
        told = rpt_("Lamps apart: {lamps} in {count} bands").format(
            lamps=len(lights.names), count=len(lights.wavelengths)
        )
        return f"{told}{picturing.shown(image)}"


classes = (ROUGHSPECTRA_OT_render_lamps,)
