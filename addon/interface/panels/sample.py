# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel around the boxes: the sample, the settings, and whether the color follows from them."""

from __future__ import annotations

from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from ....core import limits, white_scale
from ...material import derivation, settled
from ..operators import common
from . import redraw, sentences, text
from .icon_values import icon_value

_LABELS = 0.4
"""Share of the width that Blender gives to the names of properties."""


def draw(layout: Any, context: Any) -> None:
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


def _draw_settings(layout: Any, material: Any, shown: redraw.PanelMaterial) -> None:
    group, inputs = material.rough_spectra, shown.facts.inputs
    layout.use_property_split = True
    layout.use_property_decorate = False
    column = layout.column()
    column.enabled = material.is_editable
    column.prop(group, "kind")
    if inputs.kind == "reading" or inputs.white[0] != white_scale.PERFECT:
        column.prop(group, "instrument")
    common.draw_white(column, group)
    column.prop(group, "sigma", slider=True)
    _draw_sigma_range(column, settled.derived(shown.facts))
    if shown.facts.analyzed:
        column.prop(group, "use_scene")
    if not inputs.scene_view:
        column.prop(group, "illuminant")
    column.prop(group, "read_at")
    column.prop(group, "shader")
    column.prop(group, "model")
    if inputs.model == "auto":
        column.prop(group, "tolerance")


def _draw_sigma_range(layout: Any, last: derivation.Stamp | None) -> None:
    """Draw how far σ may go, to the scale of the slider above."""
    if last is None or last.sigma_max is None or last.sigma_max >= limits.MATCHED_SIGMA_DEGREES:
        return
    split = layout.split(factor=_LABELS)
    split.label(text="")
    words = iface_("Fits up to {degrees}°").format(degrees=f"{last.sigma_max:.1f}")
    split.progress(text=words, factor=last.sigma_max / limits.MATCHED_SIGMA_DEGREES, type="BAR")


def _draw_state(layout: Any, here: redraw.Redraw, shown: redraw.PanelMaterial) -> None:
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
