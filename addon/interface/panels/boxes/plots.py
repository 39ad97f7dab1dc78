# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Range of σ, spectrum and angles."""

from __future__ import annotations

from typing import Any

LABEL = "Plots"
TOOLTIP = "Range of σ, spectrum, and reflectance over the view angle"
PLACE = 20
IN_SIDEBAR = True
IS_CLOSED = False


def poll(context: Any) -> bool:
    """Show where the material stores a spectrum."""
    from .. import redraw

    return redraw.current(context).shown is not None


def draw(layout: Any, context: Any) -> None:
    """Show the range of σ, spectrum and angles."""
    from ....material import settled
    from ....preview import icons
    from .. import redraw, sentences, text

    here = redraw.current(context)
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
