# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a place sends over wavelength."""

from __future__ import annotations

import math

import numpy as np

from ....core.numerics.arrays import Array
from ..drawing import lines, raster, text
from ..drawing.looks import Look
from . import plot
from .plot import Axes, Key
from .spectrum import SHOWN_NM

_TICKS = (400, 500, 600, 700)


def picture(side: int, wavelengths: Array, radiance: Array, look: Look) -> Array:
    """Draw radiance, whose largest fills the plot: uint8 pixels, shape (side, side, 4).

    Parameters
    ----------
    side
        Pixels.
    wavelengths, radiance
        Nanometers, and on any scale, shape (values,).
    look
        How it is drawn.
    """
    canvas = raster.blank(side, side)
    below = math.ceil(8 * look.scale + text.height(look.font))
    top = max(float(radiance.max()), np.finfo(float).tiny)
    axes = Axes(1, round(4 * look.scale), side - 1, side - below, SHOWN_NM, (0.0, top))
    plot.draw_grid(canvas, axes, (0.0, top / 2, top), look, named=False)
    row = axes.bottom + 6 * look.scale + text.height(look.font)
    names = [*(f"{nm}" for nm in _TICKS[:-1]), f"{_TICKS[-1]} nm"]
    plot.name_below(canvas, axes, list(zip(_TICKS, names, strict=True)), row, look)
    key = Key("", look.text, 1.6)
    lines.draw([plot.curve(canvas, axes, wavelengths, radiance, key, look)])
    return canvas
