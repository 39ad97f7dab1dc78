# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures: from numbers to pixels. Knows no Blender.

Every figure fills the canvas (see `raster`) that it is given. A plot hands back its curves for
`lines.draw`, which draws those of several plots at once in little more time than one. What stays
the same while σ is dragged is drawn once and copied. Nothing is told by color alone: curves differ
in dash and thickness and are named beside a sample.
"""

from .angles import (
    LIGHT_ANGLE,
    STEEPEST,
    angles,
    angles_axes,
    angles_polar,
    polar_place,
)
from .ball import ball, balls
from .sigma_range import sigma_range
from .spectrum import SHOWN_NM, spectrum, spectrum_axes
from .swatches import swatch_pair

__all__ = [
    "LIGHT_ANGLE",
    "SHOWN_NM",
    "STEEPEST",
    "angles",
    "angles_axes",
    "angles_polar",
    "ball",
    "balls",
    "polar_place",
    "sigma_range",
    "spectrum",
    "spectrum_axes",
    "swatch_pair",
]
