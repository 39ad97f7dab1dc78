# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectrum of the pixel that was clicked last, as an icon that a panel draws."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.utils import previews

from ...core.numerics.arrays import Array
from ..support import events
from . import icons, theme

UNITS = 9.0
"""For `template_icon`, as which it is drawn pixel for pixel."""
_NAME = "pixel"

_collection: Any = None


def make(wavelengths: Array, radiance: Array) -> None:
    """Draw a spectrum; not to be called while drawing."""
    global _collection
    from .figures import radiance as figure

    preferences = bpy.context.preferences
    look = theme.current(preferences)
    height = icons.unit(look.scale, preferences.system.pixel_size)
    canvas = figure.picture(icons.side(UNITS, height), wavelengths, radiance, look)
    if _collection is None:
        _collection = previews.new()
        events.unregistering.subscribe(clear)
    preview = _collection.get(_NAME) or _collection.new(_NAME)
    icons.upload(preview, canvas)


def icon_id() -> int:
    """Give its icon, to be called while drawing; 0 while there is none."""
    return 0 if _collection is None else int(_collection[_NAME].icon_id)


def clear() -> None:
    """Forget it."""
    global _collection
    if _collection is not None:
        previews.remove(_collection)
        _collection = None
        events.unregistering.unsubscribe(clear)
