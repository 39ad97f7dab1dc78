# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of a material as the squares that a panel can show."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...core.arrays import Array
from . import figures, raster

if TYPE_CHECKING:
    from .data import Data
    from .theme import Look

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
        "swatches", "spectrum", "angles", "polar", or "sheet": range of σ, spectrum and angles.
    found
        What it shows.
    side
        Pixels.
    """
    canvas = raster.blank(side, side)
    _DRAWN[figure](canvas, found, look)
    return canvas


def _swatches(canvas: Array, found: Data, look: Look) -> None:
    outside = (found.target.outside, found.blender.outside)
    figures.swatch_pair(canvas, found.target.color, found.blender.color, look, outside)


def _sheet(canvas: Array, found: Data, look: Look) -> None:
    side = len(canvas)
    strip, gap = round(_STRIP * look.scale), round(_GAP * look.scale)
    plots = [_spectrum, _angles]
    high = (side - strip - 2 * gap) // 2
    if high < _LOWEST * look.scale:
        # No room for both: the one that changes with σ.
        plots, high = [_angles], side - strip - gap
    figures.sigma_range(canvas[:strip], found.sigma, found.sigma_max, look)
    row = strip + gap
    for plot in plots:
        plot(canvas[row : row + high], found, look)
        row += high + gap


def _spectrum(canvas: Array, found: Data, look: Look) -> None:
    figures.spectrum(canvas, found.wavelengths, found.albedo, found.reading, found.bars, look)


def _angles(canvas: Array, found: Data, look: Look) -> None:
    curves = (found.view, found.target_curve, found.blender_curve)
    figures.angles(canvas, *curves, found.lambert, look, found.engine)


def _polar(canvas: Array, found: Data, look: Look) -> None:
    curves = (found.view, found.target_curve, found.blender_curve)
    figures.angles_polar(canvas, *curves, look, found.engine)


_DRAWN = {
    "swatches": _swatches,
    "sheet": _sheet,
    "spectrum": _spectrum,
    "angles": _angles,
    "polar": _polar,
}
