# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Target and Blender side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ....material import verdict
    from .. import redraw

LABEL = "Difference"
TOOLTIP = (
    "Target and Blender side by side, and what the difference means. A black or white corner marks "
    "a color that your screen cannot show"
)
PLACE = 10
IN_SIDEBAR = True
IS_CLOSED = False

_SWATCH_UNITS = 5.0
_NARROWEST = 200.0
"""Pixels at UI scale 1 that numbers need beside the swatches; else they go below."""


def poll(context: Any) -> bool:
    """Show where the material stores a spectrum."""
    from .. import redraw

    return redraw.current(context).shown is not None


def draw(layout: Any, context: Any) -> None:
    """Show target and Blender side by side, what the difference means, and what limits it."""
    from ...operators import targets
    from .. import redraw, sentences, text

    here = redraw.current(context)
    if here.shown is None:
        return
    shown = here.shown
    material: Any = targets.active_material(context)
    details = material.rough_spectra.details
    if shown.obstacle is not None:
        text.draw(layout, sentences.obstacle(shown.obstacle, here.style))
        if shown.state.kind == "fresh":
            text.draw(layout, sentences.remarks(shown.facts, here.style, details))
        return
    apart = _draw_swatches(layout, here, shown)
    if shown.state.kind == "fresh":
        text.draw(layout, sentences.difference(shown.facts, apart, here.style, details))
        _draw_remedies(layout, here, shown, apart)
    if shown.is_glossy:
        told = "The numbers include the gloss; Remove Gloss makes it matte"
        text.draw(layout, sentences.of(told, "INFO", here.style))
        if shown.state.kind != "linked":
            layout.operator("rough_spectra.remove_gloss").scope = "ACTIVE"
    if shown.is_bumped:
        told = "Bump is not counted: measure to know"
        text.draw(layout, sentences.of(told, "INFO", here.style))
        layout.operator("rough_spectra.measure", text="Measure").scope = "ACTIVE"


def _draw_remedies(
    layout: Any, here: redraw.Redraw, shown: redraw.PanelMaterial, apart: verdict.Numbers | None
) -> None:
    """Offer what the sentences above name."""
    from ....material import verdict

    last = shown.state.stamp
    limit = "" if last is None else verdict.limit(shown.facts, last, apart)
    wide = here.format.width() >= _NARROWEST
    row = layout.row(align=True) if wide else layout.column(align=True)
    if limit in {"engine", "solid"}:
        row.operator("rough_spectra.switch_to_cycles")
        # Where it follows the scene, it may have been matched to it for Cycles.
        if not shown.facts.analyzed or (last is not None and last.roughness > 0.0):
            row.operator("rough_spectra.analyze_scene").scope = "VIEW"
    elif limit == "flat":
        row.operator("rough_spectra.renew").scope = "ACTIVE"
    elif limit == "gamut" and verdict.has_wider_space(shown.facts.working_space):
        row.operator("rough_spectra.use_wide_gamut")


def _draw_swatches(
    layout: Any, here: redraw.Redraw, shown: redraw.PanelMaterial
) -> verdict.Numbers | None:
    """Draw the colors with their numbers, which are None until they are computed."""
    from .. import sentences, text

    picture = shown.picture("swatches", _SWATCH_UNITS)
    beside = here.format.width(sentences.SWATCHES) >= _NARROWEST
    row = layout.row() if beside else layout.column()
    row.template_icon(picture, scale=_SWATCH_UNITS)
    apart = shown.apart()
    if apart is not None:
        told = sentences.numbers(apart, shown.facts.inputs.read_at, beside, here.style)
        text.draw(row.column(), told)
    return apart
