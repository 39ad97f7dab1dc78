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
from . import redraw
from .text import Writer

_SWATCH_UNITS = 5.0
_WHERE = ("45°/0°", "All angles", "95 % below")
_LABELS = 0.4
"""Share of the width that Blender gives to the names of properties."""
_LARGEST_SIGMA = 90.0
_BOX = 24.0
_SWATCHES = 98.0
_NARROWEST = 200.0
"""Pixels at UI scale 1 that numbers need beside the swatches; else they go below."""
_NOTHING = 0.005
"""ΔE00 that is written as 0.00."""
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
        Writer(context).sentence(layout, text, "INFO")
        return
    shown = redraw.begin(material, context)
    _draw_settings(layout, material, shown.state.stamp)
    draw_state(layout, shown)


def _draw_settings(layout: Any, material: Any, found: stamp.Stamp | None) -> None:
    group = material.rough_spectra
    column = layout.column()
    column.enabled = material.is_editable
    column.prop(group, "kind")
    if group.kind == "reading":
        column.prop(group, "instrument")
    column.prop(group, "sigma", slider=True)
    _draw_sigma_range(column, found)
    if group.scene_view:
        column.prop(group, "use_scene")
    if not (group.scene_view and group.use_scene):
        column.prop(group, "illuminant")
    column.prop(group, "shader")
    column.prop(group, "model")
    if group.model == "auto":
        column.prop(group, "tolerance")


def _draw_sigma_range(layout: Any, found: stamp.Stamp | None) -> None:
    """Draw how far σ may go, to the scale of the slider above."""
    if found is None or found.sigma_max is None:
        return
    split = layout.split(factor=_LABELS)
    split.label(text="")
    text = iface_("Fits up to {degrees}°").format(degrees=f"{found.sigma_max:.1f}")
    split.progress(text=text, factor=found.sigma_max / _LARGEST_SIGMA, type="BAR")


def draw_state(layout: Any, shown: redraw.Redraw) -> None:
    """Say whether the color still follows from the spectrum, and offer what mends it."""
    state = shown.state
    if state.kind in ("fresh", "none"):
        return
    box = layout.box()
    column = box.column(align=True)
    column.alert = state.kind in ("stale", "error")
    icon = "INFO" if state.kind in ("kept", "linked") else "ERROR"
    for reason in map(tip_, state.reasons):
        text = reason if reason.startswith("σ") else reason[:1].upper() + reason[1:]
        shown.write.sentence(column, text, icon, _BOX)
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
    shown = redraw.current(material, context)
    write, state = shown.write, shown.state
    if shown.is_textured(material):
        text = tip_("Color or roughness comes from another node: there is no one color to compare")
        write.sentence(layout, text, "INFO")
        return
    numbers = _draw_swatches(layout, context, material, shown)
    found = state.stamp
    if found is None or state.kind != "fresh":
        return
    group = material.rough_spectra
    write.sentence(layout, _limit(found, numbers, group), "INFO")
    if group.model == "auto":
        # Whatever the engine, the target is the surface's.
        text = iface_("Target of the model {}" if stamp.engine_is_flat() else "Model {}")
        write.sentence(layout, text.format(found.model_reason), "MODIFIER")
    write.sentence(layout, iface_("Material {}").format(_shader(found, group)), "MATERIAL")
    for warning in found.warnings:
        write.sentence(layout, warning, "ERROR")


def _draw_swatches(
    layout: Any, context: Any, material: Any, shown: redraw.Redraw
) -> tuple[float, ...] | None:
    """Draw the colors with their numbers, which are None until they are computed."""
    from ..preview import icons

    write, found = shown.write, shown.state.stamp
    digest = shown.digest(material, context)
    picture = icons.icon_id(material, "swatches", _SWATCH_UNITS, context, digest)
    beside = write.width(_SWATCHES) >= _NARROWEST
    row = layout.row() if beside else layout.column()
    row.template_icon(picture, scale=_SWATCH_UNITS)
    column = row.column(align=True)
    numbers: tuple[float, ...] | None
    if found is not None and stamp.numbers_hold(material, shown.state):
        numbers = (found.delta_e_instrument, found.delta_e_mean, found.delta_e_95)
    else:
        numbers = icons.differences(material, context, digest)
    inset = _SWATCHES if beside else 0.0
    for where, number in zip(_WHERE, numbers or (), strict=bool(numbers)):
        write.sentence(column, _difference(iface_(where), number), "NONE", inset)
    return numbers


def _difference(where: str, delta_e: float) -> str:
    return f"{where}: ΔE00 {delta_e:.2f}, {iface_(words.words(delta_e))}"


def _limit(found: stamp.Stamp, numbers: tuple[float, ...] | None, group: Any) -> str:
    if numbers is not None and max(numbers) < _NOTHING:
        return tip_("Limited by nothing: Blender shows the target")
    if stamp.engine_is_flat() and (found.roughness > 0.0 or stamp.has_scene(group)):
        return tip_("Limited by the engine: only Cycles shows the roughness")
    apart = [delta_e for _, delta_e in found.delta_e_lights]
    several = len(apart) > 1
    # Where lights mix everywhere, it is at the instrument, under the main one alone, that it shows.
    if several and max(max(apart) - min(apart), found.delta_e_instrument) >= words.SIDE_BY_SIDE:
        return tip_("Limited by the lights: no single color is right under all of them")
    if not several and found.delta_e_instrument > _GAMUT:
        return tip_("Limited by the gamut: {space} cannot hold this color").format(
            space=found.working_space
        )
    if found.roughness == 0.0:
        return tip_("Limited by leaving the roughness out, which hardly shows here")
    return tip_("Limited by the angles: one roughness has to fit all of them")


def _shader(found: stamp.Stamp, group: Any) -> str:
    if found.roughness == 0.0 or not stamp.engine_is_flat():
        return found.shader_reason
    if group.scene_view:
        return tip_(
            "lambert: this engine leaves the roughness out; check Light from the Scene for the "
            "closest color"
        )
    return tip_(
        "lambert: this engine leaves the roughness out; analyze the scene for the closest color"
    )


def draw_plots(layout: Any, context: Any, material: Any) -> None:
    """Show the range of σ, spectrum and angles."""
    from ..preview import icons

    shown = redraw.current(material, context)
    if shown.is_textured(material):
        text = iface_("There is no one color to plot")
        shown.write.sentence(layout, text, "INFO")
        return
    units, digest = icons.fit(context), shown.digest(material, context)
    picture = icons.icon_id(material, "sheet", units, context, digest)
    layout.template_icon(picture, scale=units)


def draw_measurement(layout: Any, context: Any) -> None:
    """Offer to measure, and show the last measurement beside the prediction."""
    row = layout.row(align=True)
    row.operator("rough_spectra.measure", text="Measure", icon="RENDER_STILL").scope = "ACTIVE"
    row.operator("rough_spectra.measure", text="Measure All").scope = "ALL"
    material = stored_material(context)
    found = None if material is None else measured.get(material)
    if found is not None:
        _draw_measured(layout, context, material, found)
    layout.operator("rough_spectra.bake", icon="EXPORT")


def _draw_measured(layout: Any, context: Any, material: Any, found: measured.Measured) -> None:
    shown = redraw.current(material, context)
    write, predicted = shown.write, shown.state.stamp
    if predicted is None or found.delta_e is None:
        return
    column = layout.column(align=True)
    for when, delta_e in (
        (iface_("Predicted"), predicted.delta_e_instrument),
        (iface_("Measured"), found.delta_e),
    ):
        write.sentence(column, _difference(when, delta_e))
    if not found.current:
        text = iface_("Measured before the last change; measure again")
        write.sentence(column, text, "ERROR")
