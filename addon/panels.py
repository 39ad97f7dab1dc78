# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Material ▸ Rough Spectra. Draws what is stored; computes nothing."""

from __future__ import annotations

import textwrap
from typing import Any

import bpy

from . import stamp
from .operators import common

_CHARACTERS_A_LINE = 44
_ENGINES = {"CYCLES", "BLENDER_EEVEE", "BLENDER_EEVEE_NEXT", "BLENDER_WORKBENCH"}


class ROUGHSPECTRA_PT_material(bpy.types.Panel):
    """Measured spectrum of the material"""

    bl_label = "Rough Spectra"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    COMPAT_ENGINES = _ENGINES

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show wherever a material can be."""
        thing = common.active_object(context)
        return common.active_material(context) is not None or hasattr(
            getattr(thing, "data", None), "materials"
        )

    def draw(self, context: Any) -> None:
        """Draw what to assign, what is stored and whether it still holds."""
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(align=True)
        column.operator("rough_spectra.assign_preset", icon="PRESET")
        column.operator("rough_spectra.assign_file", icon="FILE_FOLDER")
        material = common.active_material(context)
        if material is None or not stamp.has_spectrum(material):
            return
        group = material.rough_spectra
        column = layout.column()
        column.enabled = material.library is None
        column.label(text=f"Sample: {group.sample_name}", icon="COLOR")
        column.prop(group, "kind")
        column.prop(group, "sigma")
        column.prop(group, "illuminant")
        column.prop(group, "model")
        column.prop(group, "shader")
        _state(layout, material)
        if context.scene.render.engine != "CYCLES":
            layout.label(text="Only Cycles shows the roughness", icon="INFO")
        layout.operator("rough_spectra.bake", icon="RENDER_STILL")


def _state(layout: Any, material: Any) -> None:
    reasons = stamp.stale_reasons(material, stamp.working_space_name())
    box = layout.box()
    if reasons:
        column = box.column(align=True)
        column.alert = True
        _sentence(column, f"Not up to date: {'; '.join(reasons)}.", "ERROR")
        box.operator("rough_spectra.renew", icon="FILE_REFRESH")
        return
    found = stamp.get_stamp(material)
    if found is None:
        return
    column = box.column(align=True)
    column.label(text=f"ΔE00 at 45°/0°: {found.delta_e_instrument:.2f}", icon="CHECKMARK")
    column.label(text=f"All angles: mean {found.delta_e_mean:.2f}, 95 % {found.delta_e_95:.2f}")
    if material.rough_spectra.model == "auto":
        _sentence(column, f"Model {found.model_reason}", "BLANK1")
        _sentence(column, f"Material {found.shader_reason}", "BLANK1")
    for warning in found.warnings:
        _sentence(column, warning, "INFO")


def _sentence(column: Any, text: str, icon: str) -> None:
    for number, line in enumerate(textwrap.wrap(text, _CHARACTERS_A_LINE)):
        column.label(text=line, icon=icon if number == 0 else "BLANK1")


classes = (ROUGHSPECTRA_PT_material,)
