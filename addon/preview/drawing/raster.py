# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Antialiased areas on an array of pixels.

A canvas is a uint8 array (height, width, 4) of display-encoded red, green and blue times alpha, and
alpha, its first row on top: what Blender blends pictures with. Its bytes lie without gaps, so that
whole rows of a canvas are a canvas, too. Every shape laid over another rounds once, by half a
level. Coordinates are in pixels, x to the right and y down; pixel i covers i to i + 1. A pixel's
share of a shape is its area there, exactly. `lines` draws lines.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized

Color = tuple[float, float, float]
Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""


def blank(height: int, width: int) -> Array:
    """Give a transparent canvas."""
    return np.zeros((height, width, 4), np.uint8)


def encoded(colors: npt.ArrayLike) -> Array:
    """Give shares from 0 to 1 as bytes of a canvas, of the same shape."""
    return np.asarray(np.asarray(colors, np.float32) * np.float32(255) + np.float32(0.5), np.uint8)


def paint(
    canvas: Array, coverage: Array, left: int, top: int, color: Color, alpha: float = 1
) -> None:
    """Lay a color over the canvas where `coverage`, (rows, columns) from 0 to 1, says.

    What lies outside the canvas is left out.
    """
    _blend(canvas, coverage.repeat(4, axis=1), left, top, color, alpha)


def _blend(
    canvas: Array, share: Array, left: int, top: int, color: Color, alpha: float = 1
) -> None:
    """Lay a color over the canvas, of which each byte has its share.

    The bytes of a row one after the other: numpy is slow over the four of a pixel.
    """
    height, width = canvas.shape[:2]
    x0, y0 = max(left, 0), max(top, 0)
    share = share[y0 - top : max(height - top, 0), 4 * (x0 - left) : 4 * max(width - left, 0)]
    rows, columns = share.shape
    part = canvas.reshape(height, 4 * width)[y0 : y0 + rows, 4 * x0 : 4 * x0 + columns]
    if alpha < 1:
        share = share * np.float32(alpha)
    part[:] = _mixed(part, share, _row(color, columns // 4))


def _mixed(below: Array, share: Array, ink: Array) -> Array:
    """Lay ink over bytes, as much as the share says; float32, for bytes to cut off."""
    under = below.astype(np.float32)
    mixed = ink - under
    mixed *= share
    mixed += under
    mixed += np.float32(0.5)
    return mixed


def _row(color: Color, pixels: int) -> Array:
    """Give the bytes of opaque pixels, float32."""
    return _pixel(color)[1].repeat(pixels).view(np.float32)


@memoized(maxsize=64)
def _pixel(color: Color) -> tuple[Array, Array]:
    """Give an opaque pixel: its four bytes in one number, and four float32 of them in one."""
    levels = [255 * c for c in (*color, 1.0)]
    whole = np.array([int(level + 0.5) for level in levels], np.uint8)
    return whole.view(np.uint32), np.array(levels, np.float32).view(np.complex128)


def lay(canvas: Array, full: Array, part: Array, share: Array, color: Color) -> None:
    """Fill pixels, counted row by row, and others in part.

    `share`, float32, has four equal numbers for each of the latter.
    """
    pixels = canvas.view(np.uint32).reshape(-1)
    pixels[full] = _pixel(color)[0]
    mixed = _mixed(pixels[part].view(np.uint8), share, _row(color, part.size))
    pixels[part] = mixed.astype(np.uint8).view(np.uint32)


def rectangle(canvas: Array, box: Box, color: Color, alpha: float = 1) -> None:
    """Fill a rectangle; edges between pixels cover their share of them."""
    left, top, right, bottom = box
    if left >= right or top >= bottom:
        return
    if alpha == 1 and all(edge == int(edge) for edge in box):
        x0, y0, x1, y1 = (max(int(edge), 0) for edge in box)
        canvas.view(np.uint32)[y0:y1, x0:x1, 0] = _pixel(color)[0]
        return
    x0, across = _interval(left, right)
    y0, down = _interval(top, bottom)
    _blend(canvas, down[:, np.newaxis] * across.repeat(4), x0, y0, color, alpha)


def _interval(start: float, stop: float) -> tuple[int, Array]:
    """Give the first pixel of an interval, and the shares of its pixels."""
    first, last = math.floor(start), math.ceil(stop)
    covered = np.empty(last - first, np.float32)
    covered.fill(1)
    covered[0] -= start - first
    covered[-1] -= last - stop
    return first, covered


def dashes(
    canvas: Array, box: Box, dash: tuple[float, float], color: Color, alpha: float = 1
) -> None:
    """Fill a rectangle in strokes along x, as long as `dash` says, with gaps between them."""
    left, top, right, bottom = box
    y0, down = _interval(top, bottom)
    share = down[:, np.newaxis] * _strokes(left, right, dash)
    _blend(canvas, share, math.floor(left), y0, color, alpha)


def _strokes(left: float, right: float, dash: tuple[float, float]) -> Array:
    """Give each byte's share of a row of strokes, float32."""
    stroke, period = dash[0], sum(dash)
    # Strokes up to each edge between pixels; the difference is each pixel's share.
    at = np.arange(math.floor(left), math.ceil(right) + 1) - left
    at = np.minimum(np.maximum(at, 0), right - left)
    turns = np.floor(at / period)
    filled = turns * stroke + np.minimum(at - turns * period, stroke)
    return (filled[1:] - filled[:-1]).astype(np.float32).repeat(4)


def pointer(canvas: Array, tip: tuple[float, int], top: int, reach: float, color: Color) -> None:
    """Fill a triangle that points down to its tip, from whole rows up to as far as `reach`.

    What `polygon` draws, in a tenth of the time.
    """
    x, bottom = tip
    x0 = math.floor(x - reach)
    edge = np.arange(x0, math.ceil(x + reach) + 1) - x
    half = _falling(reach, bottom - top + 1)
    # How far each row is filled from the middle to an edge between pixels: the mean of the lesser
    # of the edge's and the side's distance, of which the latter falls evenly along the row.
    near = np.minimum(np.abs(edge), half)
    sums = near * (half - near / 2)
    filled = (sums[:-1] - sums[1:]) * ((bottom - top) / reach) * np.sign(edge)
    coverage = filled[:, 1:] - filled[:, :-1]
    paint(canvas, coverage.astype(np.float32), x0, top, color)


def _falling(reach: float, rows: int) -> Array:
    """Half the width of a triangle between its rows, one below the other."""
    return np.linspace(reach, 0, rows)[:, np.newaxis]


def frame(canvas: Array, box: Box, color: Color, width: float = 1, alpha: float = 1) -> None:
    """Draw a border just inside a rectangle."""
    left, top, right, bottom = box
    for side in (
        (left, top, right, top + width),
        (left, bottom - width, right, bottom),
        (left, top + width, left + width, bottom - width),
        (right - width, top + width, right, bottom - width),
    ):
        rectangle(canvas, side, color, alpha)


def polygon(
    canvas: Array, contours: Sequence[npt.ArrayLike], color: Color, alpha: float = 1
) -> None:
    """Fill polygons, each (points, 2); one inside another the other way round is a hole."""
    points = [np.asarray(contour, np.float64) for contour in contours]
    low = np.floor(np.min([contour.min(axis=0) for contour in points], axis=0)).astype(int)
    high = np.ceil(np.max([contour.max(axis=0) for contour in points], axis=0)).astype(int)
    start = np.concatenate(points) - low
    end = np.concatenate([np.roll(contour, -1, axis=0) for contour in points]) - low
    coverage = area(start, end, (int(high[1] - low[1]), int(high[0] - low[0])))
    paint(canvas, coverage, int(low[0]), int(low[1]), color, alpha)


def area(start: Array, end: Array, shape: tuple[int, int]) -> Array:
    """Share of every pixel that lies inside closed outlines.

    Parameters
    ----------
    start, end
        Edges of the outlines, (edges, 2), all within the shape.
    shape
        Rows and columns.

    Returns
    -------
    float32 array of that shape, 0 to 1. Exact, except where outlines cross within a pixel.
    """
    rows, columns = shape
    # Cut where an edge crosses a row, then where it crosses a column: each piece lies in one pixel
    # and takes a trapezoid of it, and all that is to the right of it.
    start, end = _cut(*_cut(start, end, 1), 0)
    middle, down = (start + end) / 2, end[:, 1] - start[:, 1]
    column = np.clip(np.floor(middle[:, 0]), 0, columns - 1).astype(np.intp)
    row = np.clip(np.floor(middle[:, 1]), 0, rows - 1).astype(np.intp)
    inside = middle[:, 0] - column
    at = row * (columns + 1) + column
    size = rows * (columns + 1)
    sums = (
        np.bincount(at, down * (1 - inside), size)
        + np.bincount(at + 1, down * inside, size + 1)[:size]
    )
    filled = np.abs(np.cumsum(sums.reshape(rows, columns + 1), axis=1)[:, :columns])
    # Sums that cancel leave 1e-16, which is nothing.
    return np.asarray(np.where(filled < 1e-9, 0, np.minimum(filled, 1)), np.float32)


def _cut(start: Array, end: Array, axis: int) -> tuple[Array, Array]:
    """Cut edges at the whole numbers of one axis."""
    low, high = start[:, axis], end[:, axis]
    first = np.floor(np.minimum(low, high))
    pieces = np.maximum(np.ceil(np.maximum(low, high)) - first, 1).astype(np.intp)
    edge = np.repeat(np.arange(len(start)), pieces)
    step = np.arange(edge.size) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    length = (high - low)[edge]
    rising = length >= 0
    # Along a falling edge the same cuts come in reverse, which leaves each piece where it is.
    lines = first[edge] + step
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = (lines - low[edge]) / length, (lines + 1 - low[edge]) / length
    near, far = np.where(rising, a, b), np.where(rising, b, a)
    near, far = (np.clip(np.nan_to_num(t, nan=n), 0, 1) for t, n in ((near, 0.0), (far, 1.0)))
    along = (end - start)[edge]
    return start[edge] + near[:, np.newaxis] * along, start[edge] + far[:, np.newaxis] * along
