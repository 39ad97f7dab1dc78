# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of one sample for a dialog: a ball with its color, roughness and gloss.

Made when another sample is highlighted, and not while drawing: there is one, which changes.
"""

from __future__ import annotations

import bpy

from ..samples.sample import Sample
from . import icons, theme
from .kept import Kept

_NAME = "ball"


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
    preview = _kept.get(_NAME)
    icons.upload(preview, canvas)
    return int(preview.icon_id)


def clear() -> None:
    """Forget the picture."""
    _kept.close()


_kept = Kept(clear)
