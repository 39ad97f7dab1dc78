# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a spectral picture of the scene in the background, and show it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from . import background

if TYPE_CHECKING:
    from ...picture.render import Rendering


class ROUGHSPECTRA_OT_render_spectral(background.InBackground, bpy.types.Operator):
    """Render the scene in bands with a second Blender, and put them together; ESC stops"""

    bl_idname = "rough_spectra.render_spectral"
    bl_label = "Render Spectral Picture"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 4, 1

    stopped = "Stopped; no picture was made"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need Cycles and a camera."""
        scene = context.scene
        if scene is None or scene.render.engine != "CYCLES":
            cls.poll_message_set("Only Cycles renders spectral pictures; switch the engine to it")
            return False
        if scene.camera is None:
            cls.poll_message_set("The scene has no camera; add one")
            return False
        return True

    def start(self, context: Any) -> Rendering:
        """Look for colors, choose bands, and start."""
        from ...picture import render, settings

        return render.Rendering(context.scene, settings.wanted(context.scene))

    def state(self, done: int, total: int) -> str:
        """Say how many renders are done."""
        sentence = rpt_("Spectral picture: {done} of {total} renders done")
        return sentence.format(done=done, total=total)

    def finish(self, job: Rendering) -> str:
        """Put the pictures into the file, show them, and say how far RGB is off."""
        from ...picture import images

        picture = job.result()
        shown = images.put(picture)
        is_shown = _show(shown[0])
        for name, left in picture.untranslated.items():
            sentence = rpt_("{name}: {what} stays RGB")
            self.report({"WARNING"}, sentence.format(name=name, what=", ".join(left)))
        last = images.last()
        assert last is not None
        told = last.told[-1]
        if not is_shown:
            told += rpt_("; open an Image Editor and choose the image {name}").format(
                name=shown[0].name
            )
        return f"{rpt_('Spectral picture')}: {told}"


def _show(image: Any) -> bool:
    """Show an image in an Image Editor, if one is open and not pinned to another."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.ui_type == "IMAGE_EDITOR" and not area.spaces.active.use_image_pin:
                area.spaces.active.image = image
                area.tag_redraw()
                return True
    return False


classes = (ROUGHSPECTRA_OT_render_spectral,)
