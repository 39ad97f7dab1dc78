# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Show a picture that was rendered, or its map."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import StringProperty

from . import common, image_window


class ROUGHSPECTRA_OT_show_picture(bpy.types.Operator):
    """Show it in an Image Editor, or where F12 shows a render"""

    bl_idname = "rough_spectra.show_picture"
    bl_label = "Show Picture"
    bl_options = {"REGISTER"}

    which: StringProperty(
        name="Picture", description="As it was called", options={"HIDDEN", "SKIP_SAVE"}
    )

    def execute(self, _context: Any) -> set[str]:
        """Show it, or say where it is."""
        from ...picture import images

        image = images.find(self.which)
        if image is None:
            common.report_error(self, rpt_("There is no such picture; render it first."))
            return {"CANCELLED"}
        if not image_window.show(image):
            sentence = rpt_("Open an Image Editor and choose the image {name}")
            self.report({"INFO"}, sentence.format(name=image.name))
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_show_picture,)
