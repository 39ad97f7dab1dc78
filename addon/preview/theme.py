# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read the theme and the scale of Blender's interface; `drawing/looks.py` makes them readable."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy

from ...core.numerics.memoized import memoized
from .drawing.looks import Look, look

if TYPE_CHECKING:
    from .drawing.raster import Color


_PANELS_OF_INTERFACE = bpy.app.version >= (5, 0, 0)
"""Blender 5 moved the colors of panels from each editor to the interface."""


def current(preferences: Any) -> Look:
    """Give the look of `bpy.context.preferences`: the theme's panels, and the interface scale."""
    theme = preferences.themes[0]
    if _PANELS_OF_INTERFACE:
        back, text = theme.user_interface.panel_back, theme.user_interface.panel_text
    else:
        space = theme.properties.space
        back, text = space.panelcolors.back, space.text
    red, green, blue, alpha = back
    behind = (0.0, 0.0, 0.0) if alpha == 1.0 else tuple(theme.properties.space.back[:3])
    return _look((red, green, blue), alpha, behind, tuple(text[:3]), scale(preferences))


@memoized(maxsize=8)
def _look(back: Color, alpha: float, behind: Color, text: Color, scale: float) -> Look:
    """Round once and not at every draw."""
    over = zip(back, behind, strict=True)
    red, green, blue = (round(alpha * c + (1 - alpha) * b, 3) for c, b in over)
    letters = (round(text[0], 3), round(text[1], 3), round(text[2], 3))
    return look((red, green, blue), letters, scale)


def scale(preferences: Any) -> float:
    """Give the scale of the interface; without a window Blender says 0."""
    return round(preferences.system.ui_scale, 4) or 1.0
