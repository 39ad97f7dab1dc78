# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a spectral picture of the scene in the background, and show it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import IntProperty

from . import picturing

if TYPE_CHECKING:
    from ...picture.render import Rendering


class ROUGHSPECTRA_OT_render_spectral(picturing.Picturing, bpy.types.Operator):
    """Render the scene in bands with a second Blender, and put them together; ESC stops"""

    bl_idname = "rough_spectra.render_spectral"
    bl_label = "Render Spectral Picture"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 4, 1

    rendering = "Spectral picture"

    renders: IntProperty(
        name="Renders",
        description="As many renders of three bands each; 0 for what the scene's settings say",
        min=0,
        options={"SKIP_SAVE", "HIDDEN"},
    )

    def start(self, context: Any) -> Rendering:
        """Look for colors, choose bands, and start."""
        from ...picture import render, settings

        return render.Rendering(context.scene, settings.wanted(context.scene, self.renders))

    def finish(self, job: Rendering) -> str:
        """Put the pictures into the file, show them, and say how far RGB is off."""
        from ...picture import images

        picture = job.result()
        image, *_ = images.put(picture)
        for name, left in picture.untranslated.items():
            sentence = rpt_("{name}: {what} stays RGB")
            self.report({"WARNING"}, sentence.format(name=name, what=", ".join(left)))
        found = picture.comparison
        if found is None:
            told = rpt_("Spectral picture: {count} bands").format(count=len(picture.wavelengths))
        else:
            told = rpt_("Spectral picture: RGB is off by ΔE00 {mean:.2f} on average").format(
                mean=found.mean
            )
        return f"{told}{picturing.shown(image)}"


classes = (ROUGHSPECTRA_OT_render_spectral,)
