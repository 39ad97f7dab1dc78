# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of a lamp, and that of a world: its spectrum in spectral pictures."""

from __future__ import annotations

from typing import Any

import bpy

_MEASURED = "MEASURED"


class _Spectrum:
    """What it sends in spectral pictures"""

    bl_label = "Rough Spectra"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_options = {"DEFAULT_CLOSED"}
    COMPAT_ENGINES = {"CYCLES"}
    OWNER = ""

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show for Cycles, which renders spectral pictures."""
        return (
            context.engine in cls.COMPAT_ENGINES and getattr(context, cls.OWNER, None) is not None
        )

    def draw(self, context: Any) -> None:
        """Draw the choice, and the file where there is one."""
        layout: Any = self.layout  # type: ignore[attr-defined]
        layout.use_property_split = True
        layout.use_property_decorate = False
        data = getattr(context, self.OWNER)
        group = data.rough_spectra
        column = layout.column()
        column.enabled = data.is_editable
        column.prop(group, "spectrum")
        row = column.row()
        row.use_property_split = False
        if group.spectrum == _MEASURED and group.measured:
            row.label(text=group.sample_name, translate=False)
        row.operator("rough_spectra.open_light", text="Open File")


class ROUGHSPECTRA_PT_light(_Spectrum, bpy.types.Panel):
    """What the lamp sends in spectral pictures"""

    bl_context = "data"
    OWNER = "light"


class ROUGHSPECTRA_PT_world(_Spectrum, bpy.types.Panel):
    """What the world sends in spectral pictures, where it is of one color"""

    bl_context = "world"
    OWNER = "world"


classes = (ROUGHSPECTRA_PT_light, ROUGHSPECTRA_PT_world)
