# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of a material as the squares that a panel can show."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ....core.numerics.arrays import Array
from .. import figures
from ..drawing import lines

if TYPE_CHECKING:
    from ..drawing.lines import Line
    from ..drawing.looks import Look
    from .data import Data

_STRIP = 28.0
"""Height of the range of σ in a sheet, at scale 1."""
_GAP = 7.0
"""Between the figures of a sheet, at scale 1."""
_LOWEST = 70.0
"""Height of a plot, at scale 1, below which its curves cannot be told apart."""


def picture(figure: str, found: Data, side: int, look: Look) -> Array:
    """Draw a square picture.

    Parameters
    ----------
    figure
        "ball", "swatches", "spectrum", "angles", "polar", or "sheet": range of σ, spectrum and
        angles.
    found
        What it shows.
    side
        Pixels.
    """
    # Whatever it holds: figures fill it.
    canvas = np.empty((side, side, 4), np.uint8)
    lines.draw(_DRAWN[figure](canvas, found, look))
    return canvas


def _swatches(canvas: Array, found: Data, look: Look) -> list[Line]:
    outside = (found.target.outside, found.blender.outside)
    figures.swatch_pair(canvas, found.target.color, found.blender.color, look, outside)
    return []


def _ball(canvas: Array, found: Data, _look: Look) -> list[Line]:
    what = (found.color, found.roughness, found.to_screen, found.gloss)
    canvas[:] = figures.ball(len(canvas), *what)
    return []


def _sheet(canvas: Array, found: Data, look: Look) -> list[Line]:
    side = len(canvas)
    strip, gap = round(_STRIP * look.scale), round(_GAP * look.scale)
    plots = [_spectrum, _angles]
    high = (side - strip - 2 * gap) // 2
    if high < _LOWEST * look.scale:
        # No room for both: the one that changes with σ.
        plots, high = [_angles], side - strip - gap
    figures.sigma_range(canvas[:strip], found.sigma, found.sigma_max, look)
    row, curves = strip, []
    for plot in plots:
        canvas[row : row + gap] = 0
        row += gap
        curves += plot(canvas[row : row + high], found, look)
        row += high
    canvas[row:] = 0
    return curves


def _spectrum(canvas: Array, found: Data, look: Look) -> list[Line]:
    curves = (found.wavelengths, found.albedo, found.reading)
    return figures.spectrum(canvas, *curves, found.bars, look, found.open_albedos)


def _angles(canvas: Array, found: Data, look: Look) -> list[Line]:
    curves = (found.view, found.target_curve, found.blender_curve)
    return figures.angles(canvas, *curves, found.lambert, look, found.engine)


def _polar(canvas: Array, found: Data, look: Look) -> list[Line]:
    curves = (found.view, found.target_curve, found.blender_curve)
    return figures.angles_polar(canvas, *curves, look, found.engine)


_DRAWN = {
    "ball": _ball,
    "swatches": _swatches,
    "sheet": _sheet,
    "spectrum": _spectrum,
    "angles": _angles,
    "polar": _polar,
}
