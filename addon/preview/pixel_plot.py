# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectrum of the pixel that was clicked last, as an icon that a panel draws."""

from __future__ import annotations

import bpy

from ...core.numerics.arrays import Array
from . import icons, theme
from .kept import Kept

UNITS = 9.0
"""For `template_icon`, as which it is drawn pixel for pixel."""
_NAME = "pixel"


def make(wavelengths: Array, radiance: Array) -> None:
    """Draw a spectrum; not to be called while drawing."""
    from .figures import radiance as figure

    preferences = bpy.context.preferences
    look = theme.current(preferences)
    height = icons.unit(look.scale, preferences.system.pixel_size)
    canvas = figure.picture(icons.side(UNITS, height), wavelengths, radiance, look)
    icons.upload(_kept.get(_NAME), canvas)


def icon_id() -> int:
    """Give its icon, to be called while drawing; 0 while there is none."""
    return _kept.icon_id(_NAME)


def clear() -> None:
    """Forget it."""
    _kept.close()


_kept = Kept(clear)
