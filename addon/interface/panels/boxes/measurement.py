# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the virtual spectrophotometer read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .. import redraw

LABEL = "Measurement"
TOOLTIP = "Measure the material with a virtual spectrophotometer"
PLACE = 30
IN_SIDEBAR = True
IS_CLOSED = False

_NARROWEST = 150.0
"""Pixels at UI scale 1 that two buttons need beside each other."""


def poll(context: Any) -> bool:
    """Show where there is a material."""
    from .. import redraw

    return bool(redraw.current(context).has_material)


def draw(layout: Any, context: Any) -> None:
    """Offer to measure, and show the last measurement beside the prediction."""
    from ....material import preferences
    from .. import redraw
    from ..icon_values import icon_value

    here, render = redraw.current(context), icon_value("RENDER_STILL")
    beside = here.format.width() >= _NARROWEST
    row = layout.row(align=True) if beside else layout.column(align=True)
    row.operator("rough_spectra.measure", text="Measure", icon_value=render).scope = "ACTIVE"
    row.operator("rough_spectra.measure", text="Measure All").scope = "ALL"
    layout.operator("rough_spectra.measure_here", icon_value=icon_value("EYEDROPPER"))
    if here.shown is not None:
        _draw_measured(layout, context, here, here.shown)
    layout.operator("rough_spectra.bake", icon_value=icon_value("EXPORT"))
    if preferences.flamenco_manager():
        layout.operator("rough_spectra.submit_to_flamenco", icon_value=icon_value("URL"))


def _draw_measured(
    layout: Any, context: Any, here: redraw.Redraw, shown: redraw.PanelMaterial
) -> None:
    from ....material import last_measurement, settled
    from ...operators import targets
    from .. import sentences, text

    found = last_measurement.get(targets.active_material(context), shown.facts)
    if found is None or found.delta_e is None:
        return
    predicted = found.predicted
    if predicted is None and (of_now := settled.numbers(shown.facts, False)) is not None:
        predicted = of_now[0]
    told = sentences.measurement(predicted, found, here.style)
    text.draw(layout.column(align=True), told)
