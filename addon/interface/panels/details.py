# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel around the boxes: the settings, and whether the color follows from them."""

from __future__ import annotations

from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from ....core import limits, white_scale
from ...material import derivation, settled
from ..operators import giving, targets
from . import obstacle, redraw, renewal, sentences, text
from .icon_values import icon_value

_LABELS = 0.4
"""Share of the width that Blender gives to the names of properties."""
_NARROWEST = 210.0
"""Pixels at UI scale 1 that names need beside their values; else they go above."""


def draw(layout: Any, context: Any) -> None:
    """Draw whether the color follows from the settings, and these."""
    here = redraw.current(context)
    if here.shown is None:
        told = "Measuring needs no sample"
        text.draw(layout, sentences.of(told, "INFO", here.style))
        return
    _draw_state(layout, here, here.shown)
    _draw_settings(layout, targets.active_material(context), here, here.shown)


def _draw_settings(
    layout: Any, material: Any, here: redraw.Redraw, shown: redraw.PanelMaterial
) -> None:
    group, inputs = material.rough_spectra, shown.facts.inputs
    narrow = here.format.width() < _NARROWEST
    layout.use_property_split = not narrow
    layout.use_property_decorate = False
    column = layout.column()
    column.enabled = material.is_editable
    names = ["kind"]
    if inputs.kind == "reading" or inputs.white[0] != white_scale.PERFECT:
        names.append("instrument")
    _draw_named(column, group, [*names, *giving.white_settings(group), "sigma"], here, narrow)
    _draw_sigma_range(column, settled.derived(shown.facts), narrow)
    names = ["use_scene"] if shown.facts.analyzed else []
    if not inputs.scene_view:
        names.append("illuminant")
    names += ["read_at", "shader", "model"]
    if inputs.model == "auto":
        names.append("tolerance")
    _draw_named(column, group, names, here, narrow)


def _draw_named(
    column: Any, group: Any, names: list[str], here: redraw.Redraw, narrow: bool
) -> None:
    """Draw settings, with their names above where they would be cut beside them."""
    for name in names:
        if not narrow:
            column.prop(group, name, slider=name == "sigma")
            continue
        part = column.column(align=True)
        known = group.bl_rna.properties[name]
        label = iface_(known.name)
        if known.type == "BOOLEAN" and here.format.fits(label):
            part.prop(group, name)  # its name stands beside the box
            continue
        text.draw(part, sentences.of(known.name, "NONE", here.style))
        told = iface_("On") if known.type == "BOOLEAN" else ""
        part.prop(group, name, text=told, slider=name == "sigma")


def _draw_sigma_range(layout: Any, last: derivation.Stamp | None, narrow: bool) -> None:
    """Draw how far σ may go, to the scale of the slider above."""
    if last is None or last.sigma_max is None or last.sigma_max >= limits.MATCHED_SIGMA_DEGREES:
        return
    if not narrow:
        layout = layout.split(factor=_LABELS)
        layout.label(text="")
    words = iface_("Fits up to {degrees}°").format(degrees=f"{last.sigma_max:.1f}")
    layout.progress(text=words, factor=last.sigma_max / limits.MATCHED_SIGMA_DEGREES, type="BAR")


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
        box.operator("rough_spectra.make_local", icon_value=icon_value("UNLINKED"))
        return
    against = renewal.reason_against(shown.uid, shown.facts)
    if against:
        text.draw(box, sentences.refused(against, here.style))
        obstacle.draw(box, here, shown)
    row = box.row(align=True) if here.format.width() >= _NARROWEST else box.column(align=True)
    if shown.facts.surface is not None and shown.facts.surface.muted:
        row.operator("rough_spectra.unmute")
    renewing = row.row(align=True)
    renewing.enabled = against == ""
    renew = icon_value("FILE_REFRESH")
    renewing.operator("rough_spectra.renew", icon_value=renew).scope = "ACTIVE"
    if kind == "stale":
        row.operator("rough_spectra.keep", icon_value=icon_value("PINNED"))
        row.operator("rough_spectra.renew", text="Renew All").scope = "ALL_STALE"
