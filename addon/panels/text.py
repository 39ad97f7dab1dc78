# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences in a panel: wrapped to its width, once for each text and width."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import blf

from ..preview import theme

_FONT = 0  # the interface's
_MARGINS = 64.0  # icon, panel and scroll bar, pixels at UI scale 1
_TABS = 20.0  # beside the panels of a sidebar
_LEAST = 80.0
_GLUED = "ΔE00\N{NO-BREAK SPACE}"


def sentence(
    layout: Any, context: Any, text: str, icon: str = "BLANK1", inset: float = 0.0
) -> None:
    """Draw a sentence over as many lines as it needs.

    Parameters
    ----------
    layout
        A column; the lines are set close to each other.
    context
        Tells how wide the region is.
    text
        Translated already.
    icon
        Before the first line.
    inset
        Pixels at UI scale 1 that are taken beside the sentence, such as by a box around it.
    """
    scale = theme.scale(context.preferences)
    margins = _MARGINS + inset + (_TABS if context.area.type == "NODE_EDITOR" else 0.0)
    width = max(int(context.region.width / scale - margins), _LEAST)
    column = layout.column(align=True)
    below = "NONE" if icon == "NONE" else "BLANK1"
    for number, line in enumerate(_lines(text, width, _points(context.preferences), scale)):
        row = column.row()
        row.scale_y = 0.8
        row.label(text=line, icon=icon if number == 0 else below, translate=False)


def _points(preferences: Any) -> float:
    return float(preferences.ui_styles[0].widget.points)


@lru_cache(maxsize=256)
def _lines(text: str, width: float, points: float, scale: float) -> tuple[str, ...]:
    """Wrap to a width in pixels at UI scale 1, as the font is drawn: Blender cuts what is longer.

    A word that is too long by itself, such as a path, is broken.
    """
    blf.size(_FONT, points * scale)
    lines, line = [], ""
    for word in " ".join(text.split()).replace("ΔE00 ", _GLUED).split(" "):
        longer = f"{line} {word}".lstrip()
        if _fits(longer, width * scale):
            line = longer
            continue
        if line:
            lines.append(line)
        line = ""
        for letter in word:
            if line and not _fits(line + letter, width * scale):
                lines.append(line)
                line = ""
            line += letter
    return tuple(line.replace(_GLUED, "ΔE00 ") for line in (*lines, line))


def _fits(text: str, pixels: float) -> bool:
    return bool(blf.dimensions(_FONT, text)[0] <= pixels)
