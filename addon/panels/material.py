# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels show of a material. Draws what is stored; computes nothing."""

from __future__ import annotations

from typing import Any

from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_tip as tip_

from .. import measured, stamp
from ..operators import common
from ..preview import words
from .text import sentence

_SWATCH_UNITS = 5.0
_WHERE = ("45°/0°", "All angles", "95 % below")
_LABELS = 0.4
"""Share of the width that Blender gives to the names of properties."""
_LARGEST_SIGMA = 90.0
_BOX = 24.0
_SWATCHES = 98.0
_GAMUT = 0.05
"""ΔE00 at the instrument from where on the gamut is what limits: below, it is rounding."""


def stored_material(context: Any) -> Any | None:
    """Give the material shown if it stores a spectrum."""
    material = common.active_material(context)
    return material if material is not None and stamp.has_spectrum(material) else None


def draw_sample(layout: Any, context: Any) -> None:
    """Draw which sample the material is of, and the settings."""
    material = stored_material(context)
    row = layout.row(align=True)
    if material is None:
        row.operator("rough_spectra.choose_sample", icon="COLOR")
    else:
        name = material.rough_spectra.sample_name
        row.operator("rough_spectra.choose_sample", text=name, icon="COLOR", translate=False)
    row.operator("rough_spectra.assign_file", text="", icon="FILE_FOLDER")
    row.operator("rough_spectra.find_nearest", text="", icon="EYEDROPPER")
    if material is None:
        text = iface_("Choose a sample, or open a file that an instrument wrote")
        sentence(layout, context, text, "INFO")
        return
    _draw_settings(layout, material)
    draw_state(layout, context, material)


def _draw_settings(layout: Any, material: Any) -> None:
    group = material.rough_spectra
    column = layout.column()
    column.enabled = material.is_editable
    column.prop(group, "kind")
    if group.kind == "reading":
        column.prop(group, "instrument")
    column.prop(group, "sigma", slider=True)
    _draw_sigma_range(column, material)
    if group.scene_view:
        column.prop(group, "use_scene")
    if not (group.scene_view and group.use_scene):
        column.prop(group, "illuminant")
    column.prop(group, "shader")
    column.prop(group, "model")
    if group.model == "auto":
        column.prop(group, "tolerance")


def _draw_sigma_range(layout: Any, material: Any) -> None:
    """Draw how far σ may go, to the scale of the slider above."""
    found = stamp.get_stamp(material)
    if found is None or found.sigma_max is None:
        return
    split = layout.split(factor=_LABELS)
    split.label(text="")
    text = iface_("Fits up to {degrees}°").format(degrees=f"{found.sigma_max:.1f}")
    split.progress(text=text, factor=found.sigma_max / _LARGEST_SIGMA, type="BAR")


def draw_state(layout: Any, context: Any, material: Any) -> None:
    """Say whether the color still follows from the spectrum, and offer what mends it."""
    state = stamp.state(material)
    if state.kind in ("fresh", "none"):
        return
    box = layout.box()
    column = box.column(align=True)
    column.alert = state.kind in ("stale", "error")
    icon = "INFO" if state.kind in ("kept", "linked") else "ERROR"
    for reason in map(tip_, state.reasons):
        text = reason if reason.startswith("σ") else reason[:1].upper() + reason[1:]
        sentence(column, context, text, icon, _BOX)
        icon = "BLANK1"
    if state.kind == "linked":
        return
    row = box.row(align=True)
    row.operator("rough_spectra.renew", icon="FILE_REFRESH").scope = "ACTIVE"
    if state.kind == "stale":
        row.operator("rough_spectra.keep", icon="PINNED")
        row.operator("rough_spectra.renew", text="Renew All").scope = "ALL_STALE"


def draw_difference(layout: Any, context: Any, material: Any) -> None:
    """Show target and Blender side by side, what the difference means, and what limits it."""
    from ..preview import icons

    found = stamp.get_stamp(material)
    row = layout.row()
    picture = icons.icon_id(material, "swatches", _SWATCH_UNITS, context)
    row.template_icon(picture, scale=_SWATCH_UNITS)
    column = row.column(align=True)
    sentence(column, context, iface_("Left the target, right Blender"), "NONE", _SWATCHES)
    numbers = icons.differences(material, context)
    if found is not None and stamp.numbers_hold(material):
        numbers = (found.delta_e_instrument, found.delta_e_mean, found.delta_e_95)
    for where, number in zip(_WHERE, numbers or (), strict=bool(numbers)):
        text = _difference(iface_(where), number)
        sentence(column, context, text, "NONE", _SWATCHES)
    if found is None or stamp.state(material).kind != "fresh":
        return
    sentence(layout, context, _limit(found, context), "INFO")
    if material.rough_spectra.model == "auto":
        text = iface_("Model {reason}").format(reason=found.model_reason)
        sentence(layout, context, text, "MODIFIER")
    sentence(layout, context, iface_("Material {}").format(found.shader_reason), "MATERIAL")
    for warning in found.warnings:
        sentence(layout, context, warning, "ERROR")


def _difference(where: str, delta_e: float) -> str:
    return f"{where}: ΔE00 {delta_e:.2f}, {iface_(words.words(delta_e))}"


def _limit(found: Any, context: Any) -> str:
    if stamp.engine_is_flat():
        return tip_("Limited by the engine: only Cycles shows the roughness")
    if len(found.delta_e_lights) > 1:
        return tip_("Limited by the lights: no single color is right under all of them")
    if found.delta_e_instrument > _GAMUT:
        return tip_("Limited by the gamut: {space} cannot hold this color").format(
            space=found.working_space
        )
    if found.roughness == 0.0:
        return tip_("Limited by leaving the roughness out, which hardly shows here")
    return tip_("Limited by the angles: one roughness has to fit all of them")


def draw_plots(layout: Any, context: Any, material: Any) -> None:
    """Show the range of σ, spectrum and angles."""
    from ..preview import icons

    units = icons.fit(context)
    layout.template_icon(icons.icon_id(material, "sheet", units, context), scale=units)


def draw_measurement(layout: Any, context: Any) -> None:
    """Offer to measure, and show the last measurement beside the prediction."""
    row = layout.row(align=True)
    row.operator("rough_spectra.measure", text="Measure", icon="RENDER_STILL").scope = "ACTIVE"
    row.operator("rough_spectra.measure", text="Measure All").scope = "ALL"
    material = stored_material(context)
    found = None if material is None else measured.get(material)
    predicted = None if material is None else stamp.get_stamp(material)
    if found is not None and found.delta_e is not None and predicted is not None:
        column = layout.column(align=True)
        for when, delta_e in (
            (iface_("Predicted"), predicted.delta_e_instrument),
            (iface_("Measured"), found.delta_e),
        ):
            sentence(column, context, _difference(when, delta_e), "NONE")
        if not found.current:
            text = iface_("Measured before the last change; measure again")
            sentence(column, context, text, "ERROR")
    layout.operator("rough_spectra.bake", icon="EXPORT")
