# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Give objects a temperature, for thermal pictures."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import FloatProperty

from ...picture import cameras
from . import common, targets


class ROUGHSPECTRA_OT_set_temperature(bpy.types.Operator):
    """Give active and selected objects a temperature of their own, which a thermal camera sees"""

    bl_idname = "rough_spectra.set_temperature"
    bl_label = "Set Temperature"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 4, 5

    kelvin: FloatProperty(
        name="Temperature",
        description="Kelvin; 0 °C are 273.15",
        default=310.0,
        min=0.0,
        max=cameras.HOTTEST,
        precision=2,
        step=100,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need an object."""
        if not _objects(context):
            cls.poll_message_set("Select objects with a surface")
            return False
        return True

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Ask for the number."""
        context.window_manager.invoke_props_dialog(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        """Set the custom property, in the precision of the number that was entered."""
        able = [thing for thing in _objects(context) if thing.is_editable]
        if not able:
            common.report_error(self, rpt_("The selected objects are linked; override them first."))
            return {"CANCELLED"}
        for thing in able:
            thing[cameras.TEMPERATURE] = round(self.kelvin, 4)
        return {"FINISHED"}


def _objects(context: Any) -> list[Any]:
    """Give the active object, and those that are selected."""
    chosen = dict.fromkeys((targets.active_object(context), *context.selected_objects))
    return [thing for thing in chosen if targets.can_carry(thing)]


classes = (ROUGHSPECTRA_OT_set_temperature,)
