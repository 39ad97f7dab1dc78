# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of a material as the squares that a panel can show."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...core.arrays import Array
from . import figures, raster
from .plot import Size

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
    size = (side, side)
    if figure == "swatches":
        outside = (found.target.outside, found.blender.outside)
        return figures.swatch_pair(found.target.color, found.blender.color, size, look, outside)
    if figure == "polar":
        curves = (found.view, found.target_curve, found.blender_curve)
        return figures.angles_polar(*curves, size, look, found.engine)
    if figure == "sheet":
        return _sheet(found, side, look)
    return {"spectrum": _spectrum, "angles": _angles}[figure](found, size, look)


def _sheet(found: Data, side: int, look: Look) -> Array:
    strip, gap = round(_STRIP * look.scale), round(_GAP * look.scale)
    plots = [_spectrum, _angles]
    high = (side - strip - 2 * gap) // 2
    if high < _LOWEST * look.scale:
        # No room for both: the one that changes with σ.
        plots, high = [_angles], side - strip - gap
    canvas = raster.blank(side, side)
    canvas[:strip] = figures.sigma_range(found.sigma, found.sigma_max, (side, strip), look)
    row = strip + gap
    for plot in plots:
        canvas[row : row + high] = plot(found, (side, high), look)
        row += high + gap
    return canvas


def _spectrum(found: Data, size: Size, look: Look) -> Array:
    return figures.spectrum(found.wavelengths, found.albedo, found.reading, found.bars, size, look)


def _angles(found: Data, size: Size, look: Look) -> Array:
    curves = (found.view, found.target_curve, found.blender_curve)
    return figures.angles(*curves, found.lambert, size, look, found.engine)
