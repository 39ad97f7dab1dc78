# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the panels of a material are laid out. Draws what is stored; computes nothing."""

from __future__ import annotations

from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from ....core import limits
from ...material import derivation, last_measurement, settled
from ...preview import icons
from ..operators import common
from . import redraw, sentences, text
from .icon_values import icon_value
from .redraw import current

_SWATCH_UNITS = 5.0
_LABELS = 0.4
"""Share of the width that Blender gives to the names of properties."""
_NARROWEST = 200.0
"""Pixels at UI scale 1 that numbers need beside the swatches; else they go below."""


def draw_sample(layout: Any, context: Any) -> None:
    """Draw which sample the material is of, and the settings."""
    here = redraw.begin(context)
    row = layout.row(align=True)
    color = icon_value("COLOR")
    if here.shown is None:
        row.operator("rough_spectra.choose_sample", icon_value=color)
    else:
        material: Any = common.active_material(context)
        name = material.rough_spectra.sample_name
        row.operator("rough_spectra.choose_sample", text=name, icon_value=color, translate=False)
    row.operator("rough_spectra.assign_file", text="", icon_value=icon_value("FILE_FOLDER"))
    row.operator("rough_spectra.find_nearest", text="", icon_value=icon_value("EYEDROPPER"))
    if here.shown is None:
        label = "Choose a sample, or open a file that an instrument wrote"
        text.draw(layout, sentences.of(label, "INFO", here.style))
        return
    _draw_settings(layout, material, here.shown)
    _draw_state(layout, here, here.shown)


def _draw_settings(layout: Any, material: Any, shown: redraw.Shown) -> None:
    group, inputs = material.rough_spectra, shown.facts.inputs
    layout.use_property_split = True
    layout.use_property_decorate = False
    column = layout.column()
    column.enabled = material.is_editable
    column.prop(group, "kind")
    if inputs.kind == "reading":
        column.prop(group, "instrument")
    column.prop(group, "sigma", slider=True)
    _draw_sigma_range(column, settled.derived(shown.facts))
    if shown.facts.analyzed:
        column.prop(group, "use_scene")
    if not inputs.scene_view:
        column.prop(group, "illuminant")
    column.prop(group, "shader")
    column.prop(group, "model")
    if inputs.model == "auto":
        column.prop(group, "tolerance")


def _draw_sigma_range(layout: Any, last: derivation.Stamp | None) -> None:
    """Draw how far σ may go, to the scale of the slider above."""
    if last is None or last.sigma_max is None:
        return
    split = layout.split(factor=_LABELS)
    split.label(text="")
    words = iface_("Fits up to {degrees}°").format(degrees=f"{last.sigma_max:.1f}")
    split.progress(text=words, factor=last.sigma_max / limits.LARGEST_SIGMA_DEGREES, type="BAR")


def _draw_state(layout: Any, here: redraw.Redraw, shown: redraw.Shown) -> None:
    """Say whether the color still follows from the spectrum, and offer what mends it."""
    kind = shown.state.kind
    if kind in ("fresh", "none"):
        return
    box = layout.box()
    column = box.column(align=True)
    column.alert = kind in ("stale", "error")
    text.draw(column, sentences.reasons(shown.facts, here.style))
    if kind == "linked":
        return
    row = box.row(align=True)
    renew = icon_value("FILE_REFRESH")
    row.operator("rough_spectra.renew", icon_value=renew).scope = "ACTIVE"
    if kind == "stale":
        row.operator("rough_spectra.keep", icon_value=icon_value("PINNED"))
        row.operator("rough_spectra.renew", text="Renew All").scope = "ALL_STALE"


def draw_difference(layout: Any, context: Any) -> None:
    """Show target and Blender side by side, what the difference means, and what limits it."""
    here = current(context)
    if here.shown is None:
        return
    shown = here.shown
    if shown.obstacle is not None:
        text.draw(layout, sentences.obstacle(shown.obstacle, here.style))
        return
    apart = _draw_swatches(layout, here, shown)
    if shown.state.kind == "fresh":
        text.draw(layout, sentences.difference(shown.facts, apart, here.style))
    if shown.is_bumped:
        told = "Bump is not counted: numbers are of the surface without it. Measure it to know"
        text.draw(layout, sentences.of(told, "INFO", here.style))


def _draw_swatches(
    layout: Any, here: redraw.Redraw, shown: redraw.Shown
) -> sentences.Numbers | None:
    """Draw the colors with their numbers, which are None until they are computed."""
    picture = shown.picture("swatches", _SWATCH_UNITS)
    beside = here.format.width(sentences.SWATCHES) >= _NARROWEST
    row = layout.row() if beside else layout.column()
    row.template_icon(picture, scale=_SWATCH_UNITS)
    apart = shown.apart()
    if apart is not None:
        text.draw(row.column(align=True), sentences.numbers(apart, beside, here.style))
    return apart


def draw_plots(layout: Any, context: Any) -> None:
    """Show the range of σ, spectrum and angles."""
    here = current(context)
    if here.shown is None:
        return
    shown = here.shown
    if shown.obstacle is not None:
        one = "There is no one color to plot"
        told = one if shown.obstacle == settled.LINKED else "There is no color to plot"
        text.draw(layout, sentences.of(told, "INFO", here.style))
        return
    units = icons.fit(here.width, shown.unit)
    layout.template_icon(shown.picture("sheet", units), scale=units)


def draw_measurement(layout: Any, context: Any) -> None:
    """Offer to measure, and show the last measurement beside the prediction."""
    row, render = layout.row(align=True), icon_value("RENDER_STILL")
    row.operator("rough_spectra.measure", text="Measure", icon_value=render).scope = "ACTIVE"
    row.operator("rough_spectra.measure", text="Measure All").scope = "ALL"
    here = current(context)
    if here.shown is not None:
        _draw_measured(layout, context, here, here.shown)
    layout.operator("rough_spectra.bake", icon_value=icon_value("EXPORT"))


def _draw_measured(layout: Any, context: Any, here: redraw.Redraw, shown: redraw.Shown) -> None:
    found = last_measurement.get(common.active_material(context), shown.facts)
    if found is None or found.delta_e is None:
        return
    predicted = found.predicted
    if predicted is None and (of_now := settled.numbers(shown.facts, False)) is not None:
        predicted = of_now[0]
    told = sentences.measurement(predicted, found.delta_e, found.current, here.style)
    text.draw(layout.column(align=True), told)


def draw_scene(layout: Any, context: Any) -> None:
    """Draw the button, and the lights that were found."""
    row, light = layout.row(align=True), icon_value("LIGHT")
    row.operator("rough_spectra.analyze_scene", icon_value=light).scope = "VIEW"
    here = current(context)
    if here.shown is not None:
        told = sentences.scene(here.shown.facts, context.scene.name, here.style)
        text.draw(layout, told)


def draw_source(layout: Any, context: Any) -> None:
    """Draw source, what the file says of the measurement, and every note."""
    material: Any = common.active_material(context)
    group, here = material.rough_spectra, current(context)
    cited, about, notes = sentences.source(
        group.source, group.details, group.sigma_source, here.style
    )
    text.draw(layout, cited)
    text.draw(layout.column(align=True), about)
    text.draw(layout, notes)
