# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Submit the file to the Flamenco manager that the preferences name."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from ....core.errors import RoughSpectraError
from ....core.limits import TOLERANCE
from ...material import preferences
from . import common


class ROUGHSPECTRA_OT_submit_to_flamenco(bpy.types.Operator):
    """Hand the saved file to the Flamenco manager that the preferences name"""

    bl_idname = "rough_spectra.submit_to_flamenco"
    bl_label = "Submit to Flamenco"
    bl_options = {"REGISTER"}  # no undo step: nothing in the .blend changes
    menu_place = 4, 6

    what: EnumProperty(
        name="Job",
        description="What the farm does with the file",
        items=(
            ("BAKE", "Bake and Judge", "Read all materials, and judge them by the largest ΔE00"),
            ("SPECTRAL", "Spectral Picture", "Render the scene in bands of wavelengths"),
        ),
    )
    output: StringProperty(
        name="Output", description="Folder that all workers share", subtype="DIR_PATH"
    )
    parts: IntProperty(
        name="Parts",
        description="Tasks that share the materials; one is best below some 400 for each",
        default=1,
        min=1,
        max=1000,
    )
    max_delta_e: FloatProperty(
        name="Largest ΔE00", description="Limit of the judgement", default=TOLERANCE, min=0.0
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need an address, leave to use the network, and a file that is on the disk."""
        if not preferences.flamenco_manager():
            cls.poll_message_set("Write the address of a Flamenco manager in the preferences")
            return False
        if not bpy.app.online_access:
            cls.poll_message_set("Allow Online Access is off in Blender's preferences")
            return False
        if not bpy.data.filepath:
            cls.poll_message_set("Save the file first: the farm reads it from the disk")
            return False
        return True

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Ask what to do."""
        if not self.output:
            blend = Path(bpy.data.filepath)
            self.output = str(blend.with_name(f"{blend.stem}-readings"))
        return set(context.window_manager.invoke_props_dialog(self, confirm_text="Submit"))

    def draw(self, _context: Any) -> None:
        """Draw what belongs to the job."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "what")
        layout.prop(self, "output")
        if self.what == "BAKE":
            layout.prop(self, "parts")
            layout.prop(self, "max_delta_e")

    def execute(self, _context: Any) -> set[str]:
        """Hand the job over; the farm reads what is on the disk, so nothing may be unsaved."""
        from ...support import flamenco

        if bpy.data.is_dirty and not bpy.app.background:  # without windows nothing resets it
            self.report({"ERROR"}, "Save the file first: the farm reads it from the disk")
            return {"CANCELLED"}
        blend = bpy.data.filepath
        manager = preferences.flamenco_manager()
        try:
            number = flamenco.submit(
                manager, f"{Path(blend).stem}: {self.what.lower()}", self._settings(blend)
            )
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        told = rpt_("Job {number} was handed to {manager}")
        self.report({"INFO"}, told.format(number=number, manager=manager))
        return {"FINISHED"}

    def _settings(self, blend: str) -> dict[str, Any]:
        """Give what the job type asks for."""
        output = bpy.path.abspath(self.output) or str(Path(blend).parent)
        parts, words = self.parts, "bake --skip-done"
        if self.what == "SPECTRAL":
            parts = 1
            words = f"spectral --output {shlex.quote(str(Path(output) / '{name}.exr'))}"
        return {
            "scenes": blend,
            "output": output,
            "tasks": parts,
            "shards": parts,
            "words": words,
            "max_delta_e": round(self.max_delta_e, 5),
            "blendfile": blend,
        }


classes = (ROUGHSPECTRA_OT_submit_to_flamenco,)
