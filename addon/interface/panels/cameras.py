# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of infrared and thermal cameras in the Render tab."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ...picture import cameras
from ..operators import targets
from . import pictures, text


class ROUGHSPECTRA_PT_infrared(pictures.RenderTab, bpy.types.Panel):
    """What a camera sees in a band of the infrared, by the light of lamps"""

    bl_label = "Infrared Camera"
    bl_parent_id = "ROUGHSPECTRA_PT_picture"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show for Cycles."""
        return bool(context.engine == "CYCLES")

    def draw(self, context: Any) -> None:
        """Draw the camera's settings, the button, and what was found."""
        layout: Any = self.layout
        column = _column(layout, context)
        group = context.scene.rough_spectra
        column.prop(group, "infrared_band")
        column.prop(group, "false_color")
        layout.operator("rough_spectra.render_infrared", icon="RENDER_STILL")
        _found(layout, context, "Infrared")


class ROUGHSPECTRA_PT_thermal(pictures.RenderTab, bpy.types.Panel):
    """What surfaces emit by their temperature in a band, and reflect of each other"""

    bl_label = "Thermal Camera"
    bl_parent_id = "ROUGHSPECTRA_PT_picture"

    def draw(self, context: Any) -> None:
        """Draw the camera's settings, temperatures, the button, and what was found."""
        layout: Any = self.layout
        column = _column(layout, context)
        group = context.scene.rough_spectra
        for name in ("thermal_band", "ambient", "use_sky"):
            column.prop(group, name)
        if group.use_sky:
            column.prop(group, "sky")
        column.prop(group, "emissivity")
        _draw_temperature(layout, context)
        layout.operator("rough_spectra.render_thermal", icon="RENDER_STILL")
        _found(layout, context, "Thermal")


def _column(layout: Any, context: Any) -> Any:
    layout.use_property_split = True
    layout.use_property_decorate = False
    column = layout.column()
    column.enabled = context.scene.is_editable
    return column


def _draw_temperature(layout: Any, context: Any) -> None:
    """Show the active object's temperature, or offer to give it one."""
    thing = context.view_layer.objects.active
    if not targets.can_carry(thing):
        return
    if cameras.TEMPERATURE in thing:
        layout.prop(thing, f'["{cameras.TEMPERATURE}"]', text=thing.name)
    else:
        words = iface_("Set Temperature of {name}").format(name=thing.name)
        layout.operator("rough_spectra.set_temperature", text=words, translate=False)


def _found(layout: Any, context: Any, name: str) -> None:
    """Say what the last picture showed, and offer to show it."""
    from ...picture import camera_images  # most sessions of Blender never render one

    told = camera_images.told(name)
    if not told:
        return
    layout.operator("rough_spectra.show_picture", text=iface_("Picture")).which = name
    form = pictures.format_of(context)
    icons = ("INFO", *("ERROR",) * (len(told) - 1))
    lines = [form.sentence(words, icon) for words, icon in zip(told, icons, strict=True)]
    text.draw(layout.column(align=True), lines)


classes = (ROUGHSPECTRA_PT_infrared, ROUGHSPECTRA_PT_thermal)
