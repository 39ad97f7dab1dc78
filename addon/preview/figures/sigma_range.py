# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The roughness that fits a reading."""

from __future__ import annotations

import numpy as np

from ....core.limits import MATCHED_SIGMA_DEGREES as MOST
from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from ..drawing import raster, text
from ..drawing.looks import Look, readable
from . import plot
from .plot import Size


def sigma_range(canvas: Array, sigma: float, sigma_max: float | None, look: Look) -> None:
    """Draw which roughness fits the reading, up to the end of the slider, and the one that is set.

    What does not fit is hatched. A third of the height is the mark of the current value, a third
    the bar; the rest is for the largest value that fits, written where there is room.

    Parameters
    ----------
    sigma, sigma_max
        Degrees; None where every σ fits.
    """
    size = canvas.shape[1], canvas.shape[0]
    limit = MOST if sigma_max is None else min(max(sigma_max, 0.0), MOST)
    canvas[:] = _range_ground(limit, size, look)
    _, top, _, bottom = _range_box(_limit_said(limit), size, look)
    fits = sigma <= limit + 1e-6
    x, reach = _range_place(sigma, size, look), 4 * look.scale
    ink = look.text if fits else readable(look.blender, look.background)
    raster.pointer(canvas, (x, top - 1), 0, reach, ink)
    raster.rectangle(canvas, (x - look.scale / 2, top - 1, x + look.scale / 2, bottom), ink)


def _limit_said(limit: float) -> str:
    return f"fits up to {limit:.1f}°" if limit < MOST else "any roughness fits"


def _range_box(said: str, size: Size, look: Look) -> tuple[int, int, int, int]:
    """Place the bar; it leaves room below for what is said, if that fits."""
    width, height = size
    named = height >= 2.6 * look.font and text.width(said, look.font) + 4 <= width
    bottom = height - (plot.legend_height(look) if named else 0)
    inset = round(4 * look.scale)
    return inset, round(bottom * 0.5), width - inset, bottom - 1


def _range_place(degrees: float, size: Size, look: Look) -> float:
    """Place a σ along the bar."""
    left, _, right, _ = _range_box("", size, look)
    return left + (right - left) * min(max(degrees, 0.0), MOST) / MOST


@memoized(maxsize=16)
def _range_ground(limit: float, size: Size, look: Look) -> Array:
    canvas = raster.blank(size[1], size[0])
    said = _limit_said(limit)
    box = left, top, right, bottom = _range_box(said, size, look)
    end = _range_place(limit, size, look)
    raster.rectangle(canvas, box, look.grid)
    if limit < MOST:
        _hatch(canvas, (int(end), top, right, bottom), look)
    raster.rectangle(canvas, (left, top, end, bottom), look.target)
    if bottom + 1 < size[1]:
        half = text.width(said, look.font) / 2
        middle = min(max(end, half + 2), size[0] - half - 2)
        base = size[1] - 0.3 * look.font
        text.draw(canvas, said, middle, base, look.font, look.faint, align=0.5)
    return canvas


def _hatch(canvas: Array, box: tuple[int, int, int, int], look: Look) -> None:
    """Draw slanted lines, one every five pixels at scale 1, all at once."""
    left, top, right, bottom = box
    across, down = np.arange(left, right) + 0.5, np.arange(top, bottom) + 0.5
    period, width = 5 * look.scale, look.scale
    # Distance from the nearest line: those at 45° are √½ apart of their distance along a row.
    place = (across + down[:, np.newaxis]) % period
    distance = np.minimum(place, period - place) * np.sqrt(0.5)
    coverage = np.clip(width / 2 + 0.5 - distance, 0, min(width, 1)).astype(np.float32)
    raster.paint(canvas, coverage, left, top, look.faint)
