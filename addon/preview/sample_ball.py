# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of one sample for a dialog: a ball with its color, roughness and gloss.

Made when another sample is highlighted, and not while drawing: there is one, which changes.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.utils import previews

from ..samples.sample import Sample
from ..support import events
from . import icons, theme

_NAME = "ball"

_collection: Any = None


def icon_id(sample: Sample, sigma: float, units: float) -> int:
    """Picture a sample and give the icon for `template_icon(…, scale=units)`.

    Parameters
    ----------
    sigma
        Roughness, radians.

    Raises
    ------
    DomainError
        If no material can be made of the sample.
    """
    from ...core.models import TARGET
    from ..blender import working_space
    from ..matching import own_gloss, solve
    from . import figures
    from .figures import data

    space, gloss = working_space.current(), own_gloss.of_sample(sample)
    [solution] = solve.solve([solve.Request(sample, sigma, TARGET, gloss=gloss)], space)
    system = bpy.context.preferences.system
    height = icons.unit(theme.scale(bpy.context.preferences), system.pixel_size)
    canvas = figures.ball(
        icons.side(units, height),
        solution.color,
        solution.roughness,
        data.to_screen(space.key),
        gloss,
    )
    preview = _previews().get(_NAME) or _previews().new(_NAME)
    icons.upload(preview, canvas)
    return int(preview.icon_id)


def clear() -> None:
    """Forget the picture."""
    global _collection
    if _collection is not None:
        previews.remove(_collection)
        _collection = None
        events.unregistering.unsubscribe(clear)


def _previews() -> Any:
    global _collection
    if _collection is None:
        _collection = previews.new()
        events.unregistering.subscribe(clear)
    return _collection
