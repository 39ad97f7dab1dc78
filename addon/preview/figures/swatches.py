# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain colors: the pair of target and Blender."""

from __future__ import annotations

from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from ..drawing import raster, text
from ..drawing.looks import Look, contrast
from ..drawing.raster import Color
from . import plot
from .plot import Size


def swatch_pair(
    canvas: Array,
    target: Color,
    blender: Color,
    look: Look,
    outside: tuple[bool, bool] = (False, False),
) -> None:
    """Show two colors that touch, the target on the left, with their names where there is room.

    Parameters
    ----------
    target, blender
        Display-encoded sRGB, 0 to 1.
    outside
        Whether each color lies outside of what the screen can show: its outer corner is marked.
    """
    height, width = canvas.shape[:2]
    caption = _caption((width, height), look)
    bottom, half = height - len(caption), width // 2
    canvas[bottom:] = caption
    for color, box, is_outside, side in (
        (target, (0, 0, half, bottom), outside[0], 1),
        (blender, (half, 0, width, bottom), outside[1], -1),
    ):
        raster.rectangle(canvas, box, color)
        if is_outside:
            _mark_corner(canvas, 0 if side > 0 else width, side, color, look)


@memoized(maxsize=16)
def _caption(size: Size, look: Look) -> Array:
    """Name the two colors, in rows below them; none where there is no room."""
    width, height = size
    names = ("Target", "Blender")
    room = max(text.width(name, look.font) for name in names) <= width / 2 - 2
    rows = plot.legend_height(look) if room and height > 3 * look.font else 0
    canvas = raster.blank(height, width)
    if rows:
        base = height - 0.25 * look.font
        for name, color, x in zip(names, (look.target, look.blender), (0.25, 0.75), strict=True):
            text.draw(canvas, name, x * width, base, look.font, color, align=0.5)
    return canvas[height - rows :].copy()


def _mark_corner(canvas: Array, x: int, side: int, color: Color, look: Look) -> None:
    """Draw a triangle into an upper corner, black or white, whichever shows."""
    black, white = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    ink = black if contrast(black, color) > contrast(white, color) else white
    reach = round(9 * look.scale)
    raster.polygon(canvas, [[(x, 0), (x + side * reach, 0), (x, reach)]], ink)
