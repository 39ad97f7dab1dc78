# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the spectrum comes from."""

from __future__ import annotations

from typing import Any

LABEL = "Source"
TOOLTIP = "Where the spectrum comes from"
PLACE = 50
IN_SIDEBAR = False
IS_CLOSED = True


def poll(context: Any) -> bool:
    """Show where the material stores a spectrum."""
    from .. import redraw

    return redraw.current(context).shown is not None


def draw(layout: Any, context: Any) -> None:
    """Draw source, what the file says of the measurement, and every note."""
    from ....material import roughness_origin, snapshot
    from ...operators import targets
    from .. import redraw, sentences, text

    material: Any = targets.active_material(context)
    group, here = material.rough_spectra, redraw.current(context)
    white = snapshot.white(group)
    cited, about, notes = sentences.source(
        group.source,
        group.details,
        (snapshot.sigma_degrees(group), roughness_origin.told(material)),
        (*white, group.instrument),
        here.style,
        group.spectrum,
    )
    text.draw(layout, cited)
    text.draw(layout.column(align=True), about)
    text.draw(layout, notes)
