# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of lamps that are changed in a picture while the user watches, in the Render tab."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ...picture import lamp_sliders
from . import pictures, text

if TYPE_CHECKING:
    from ...picture.relit import Relit

_SHARE = 0.62
"""Of a row, that the slider has; the rest is the spectrum's."""


class ROUGHSPECTRA_PT_lamps(pictures.RenderTab, bpy.types.Panel):
    """Other lamps in a picture while you watch; the scene's lamps stay as they are"""

    bl_label = "Lamps"
    bl_parent_id = "ROUGHSPECTRA_PT_picture"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show for Cycles."""
        return bool(context.engine == "CYCLES")

    def draw(self, context: Any) -> None:
        """Draw the button; once lamps were rendered, a slider and a spectrum for each."""
        from ...picture import relit  # most sessions of Blender never render them

        layout: Any = self.layout
        layout.operator("rough_spectra.render_lamps", icon="LIGHT")
        last = relit.last()
        if last is None:
            return
        group = context.window_manager.rough_spectra
        row = layout.row(align=True)
        button = row.operator("rough_spectra.show_picture", text=iface_("Picture"))
        button.which = relit.RELIT
        row.operator("rough_spectra.reset_lamps", icon="LOOP_BACK")
        _draw_lamps(layout.column(align=True), group, last)
        row = layout.row()
        row.use_property_split = True
        row.use_property_decorate = False
        row.prop(group, "observer")
        form = pictures.format_of(context)
        tolerance = context.scene.rough_spectra.tolerance
        told = [form.sentence(words, icon) for words, icon in _told(last, tolerance)]
        text.draw(layout.column(align=True), told)


def _draw_lamps(column: Any, group: Any, last: Relit) -> None:
    for number, name in enumerate(last.lights.names[: lamp_sliders.MOST]):
        row = column.split(factor=_SHARE, align=True)
        row.prop(group, lamp_sliders.name(number), text=name, slider=True, translate=False)
        words = last.chosen[number] or iface_("Its Own")
        menu = row.operator_menu_enum(
            "rough_spectra.change_lamp", "spectrum", text=words, translate=False
        )
        menu.lamp = number


def _told(last: Relit, tolerance: float) -> list[tuple[str, str]]:
    """Say what is not in the rows, and how far the picture may be off."""
    more = len(last.lights.names) - lamp_sliders.MOST
    told = []
    if more > 0:
        words = iface_("{count} more lamps have no slider: the verb relight sets them")
        told.append((words.format(count=more), "INFO"))
    words = iface_("{count} bands; predicted: 95 % within ΔE00 {off:.2f}")
    icon = "INFO" if last.off <= tolerance else "ERROR"
    told.append((words.format(count=len(last.lights.wavelengths), off=last.off), icon))
    return told


classes = (ROUGHSPECTRA_PT_lamps,)
