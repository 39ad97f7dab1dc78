# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences in a panel: wrapped to its width, once for each text and width."""

from __future__ import annotations

import textwrap
from functools import lru_cache
from typing import Any

from ..preview import theme

_PIXELS_A_CHARACTER = 5.7  # at UI scale 1, of the mean of Blender's interface font
_MARGINS = 70.0  # icon, box and panel, pixels at UI scale 1
_FEWEST = 16


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
        Pixels at UI scale 1 that a box around the sentence takes.
    """
    scale = theme.scale(context.preferences)
    width = int((context.region.width / scale - _MARGINS - inset) / _PIXELS_A_CHARACTER)
    column = layout.column(align=True)
    for number, line in enumerate(_lines(text, max(width, _FEWEST))):
        row = column.row()
        row.scale_y = 0.8
        row.label(text=line, icon=icon if number == 0 else "BLANK1", translate=False)


@lru_cache(maxsize=256)
def _lines(text: str, width: int) -> tuple[str, ...]:
    return tuple(textwrap.wrap(text, width))
