# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lights of the scene, and what they decide."""

from __future__ import annotations

from typing import Any

LABEL = "Scene"
TOOLTIP = "What the scene shows of the material"
PLACE = 40
IN_SIDEBAR = False
IS_CLOSED = False


def poll(context: Any) -> bool:
    """Show where the material stores a spectrum."""
    from .. import redraw

    return redraw.current(context).shown is not None


def draw(layout: Any, context: Any) -> None:
    """Draw the button, and the lights that were found."""
    from .. import redraw, sentences, text
    from ..icon_values import icon_value

    row, light = layout.row(align=True), icon_value("LIGHT")
    row.operator("rough_spectra.analyze_scene", icon_value=light).scope = "VIEW"
    here = redraw.current(context)
    if here.shown is not None:
        told = sentences.scene(here.shown.facts, context.scene.name, here.style)
        text.draw(layout, told)
