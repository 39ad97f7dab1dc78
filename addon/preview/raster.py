# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Antialiased lines and areas on an array of pixels.

A canvas is a float32 array (height, width, 4) of display-encoded red, green and blue times alpha,
and alpha, its first row on top. That is what Blender blends pictures with. Coordinates are in
pixels, x to the right and y down; pixel i covers i to i + 1. A pixel's share of a shape is an area:
exact for rectangles and polygons. That of a line comes from its distance and sums up to its area
within 4 %, for lines of one pixel within 13 %, on exact diagonals.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...core.arrays import Array

Color = tuple[float, float, float]
Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""

_LONGEST = 12.0
"""Lines are drawn in pieces of this many pixels: the box around one grows as its square."""


def blank(height: int, width: int) -> Array:
    """Give a transparent canvas.

    In memory the four channels lie one after the other: `paint` then works along rows of pixels
    instead of four numbers at a time, ten times as fast.
    """
    return np.moveaxis(np.zeros((4, height, width), np.float32), 0, -1)


def paint(
    canvas: Array, coverage: Array, left: int, top: int, color: Color, alpha: float = 1
) -> None:
    """Lay a color over the canvas where `coverage`, (rows, columns) from 0 to 1, says.

    What lies outside the canvas is left out.
    """
    height, width = canvas.shape[:2]
    x0, y0 = max(left, 0), max(top, 0)
    x1, y1 = min(left + coverage.shape[1], width), min(top + coverage.shape[0], height)
    if x0 >= x1 or y0 >= y1:
        return
    share = coverage[y0 - top : y1 - top, x0 - left : x1 - left] * np.float32(alpha)
    rest = 1 - share
    for channel, value in enumerate((*color, 1.0)):
        part = canvas[y0:y1, x0:x1, channel]
        part *= rest
        part += share * np.float32(value)


def rectangle(canvas: Array, box: Box, color: Color, alpha: float = 1) -> None:
    """Fill a rectangle; edges between pixels cover their share of them."""
    left, top, right, bottom = box
    x0, y0 = int(np.floor(left)), int(np.floor(top))
    across = _interval(left - x0, right - x0)
    down = _interval(top - y0, bottom - y0)
    paint(canvas, down[:, np.newaxis] * across, x0, y0, color, alpha)


def _interval(start: float, stop: float) -> Array:
    at = np.arange(max(int(np.ceil(stop)), 1), dtype=np.float32)
    covered = np.clip(np.minimum(at + 1, stop) - np.maximum(at, start), 0, 1)
    return np.asarray(covered, np.float32)


def dashes(
    canvas: Array, box: Box, dash: tuple[float, float], color: Color, alpha: float = 1
) -> None:
    """Fill a rectangle in strokes along x, as long as `dash` says, with gaps between them."""
    left, top, right, bottom = box
    x0, y0 = int(np.floor(left)), int(np.floor(top))
    stroke, period = dash[0], sum(dash)
    at = np.arange(x0, int(np.ceil(right)) + 1) - left
    # Strokes up to each edge between pixels; the difference is each pixel's share.
    turns = np.floor(at / period)
    filled = np.clip(turns * stroke + np.minimum(at - turns * period, stroke), 0, None)
    inside = np.clip(at, 0, right - left)
    across = np.asarray(np.diff(filled) * (np.diff(inside) > 0), np.float32)
    paint(canvas, _interval(top - y0, bottom - y0)[:, np.newaxis] * across, x0, y0, color, alpha)


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


def polyline(
    canvas: Array,
    points: npt.ArrayLike,
    color: Color,
    width: float = 1.5,
    dash: Sequence[float] = (),
    within: Box | None = None,
    alpha: float = 1,
) -> None:
    """Draw a line through points, (points, 2), with round joins and ends.

    Parameters
    ----------
    width
        Pixels.
    dash
        Lengths of strokes and gaps in turn, pixels, ends of strokes included; empty for a solid
        line. A single point is a disc.
    within
        Box of whole pixels outside of which nothing is drawn.
    """
    line = np.asarray(points, np.float64).reshape(-1, 2)
    if dash:
        start, end = _dashes(line, dash, width)
    elif len(line) == 1:
        start = end = line
    else:
        start, end = line[:-1], line[1:]
    if not len(start):
        return
    start, end = _short(start, end)
    height, across = canvas.shape[:2]
    box = within or (0, 0, across, height)
    reach = width / 2 + 0.5
    low = np.clip(np.floor(np.minimum(start, end) - reach), box[:2], box[2:]).astype(np.int32)
    high = np.clip(np.ceil(np.maximum(start, end) + reach), box[:2], box[2:]).astype(np.int32)
    (x0, y0), (x1, y1) = low.min(axis=0).tolist(), high.max(axis=0).tolist()
    if x0 >= x1 or y0 >= y1:
        return
    piece, x, y = _pixels(low - (x0, y0), high - (x0, y0))
    away = _distance(x, y, start - (x0 + 0.5, y0 + 0.5), end - start, piece)
    share = np.clip(np.float32(reach) - away, 0, min(width, 1.0))
    coverage = np.zeros((y1 - y0, x1 - x0), np.float32)
    np.maximum.at(coverage.reshape(-1), y * (x1 - x0) + x, share)
    paint(canvas, coverage, x0, y0, color, alpha)


def _pixels(low: Array, high: Array) -> tuple[Array, Array, Array]:
    """List the pixels of many boxes, (boxes, 2) each: number of the box, column and row."""
    columns, rows = (high - low).T
    count = columns * rows
    piece = np.repeat(np.arange(len(low), dtype=np.int32), count)
    first = np.cumsum(count, dtype=np.int32) - count
    number = np.arange(piece.size, dtype=np.int32) - first.astype(np.int32)[piece]
    row, column = np.divmod(number, columns.astype(np.int32)[piece])
    corner = low.astype(np.int32)
    return piece, column + corner[:, 0][piece], row + corner[:, 1][piece]


def _distance(x: Array, y: Array, start: Array, along: Array, piece: Array) -> Array:
    """Distance of points from their piece of the line; single precision, for speed."""
    sx, sy, ax, ay = np.concatenate((start, along), axis=1).astype(np.float32).T
    inverse = 1 / np.maximum(ax * ax + ay * ay, np.float32(1e-12))
    dx, dy = x - sx[piece], y - sy[piece]
    ax, ay = ax[piece], ay[piece]
    t = np.clip((dx * ax + dy * ay) * inverse[piece], 0, 1)
    dx -= t * ax
    dy -= t * ay
    return np.asarray(np.sqrt(dx * dx + dy * dy), np.float32)


def _short(start: Array, end: Array) -> tuple[Array, Array]:
    """Cut pieces so that none is longer than `_LONGEST`."""
    parts = np.maximum(np.ceil(np.hypot(*(end - start).T) / _LONGEST), 1).astype(np.intp)
    if parts.max(initial=1) == 1:
        return start, end
    piece = np.repeat(np.arange(len(start)), parts)
    step = np.arange(piece.size) - np.repeat(np.cumsum(parts) - parts, parts)
    share = 1 / parts[piece, np.newaxis]
    along = (end - start)[piece] * share
    begin = start[piece] + along * step[:, np.newaxis]
    return begin, begin + along


def _dashes(line: Array, dash: Sequence[float], width: float) -> tuple[Array, Array]:
    """Pieces of the strokes of a dashed line; round ends lengthen a stroke by the line's width."""
    at = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))))
    length = float(at[-1])
    period = sum(dash)
    turns = np.arange(int(length // period) + 1)[:, np.newaxis] * period
    offsets = np.concatenate(([0.0], np.cumsum(dash)))
    starts = (turns + offsets[:-1:2]).ravel() + width / 2
    ends = np.maximum((turns + offsets[1::2]).ravel() - width / 2, starts)
    inside = starts < length
    starts, ends = starts[inside], np.minimum(ends[inside], length)
    knots = np.unique(np.concatenate((at, starts, ends)))
    drawn = np.searchsorted(starts, knots[:-1], side="right") > np.searchsorted(
        ends, knots[:-1], side="right"
    )
    dots = starts[ends <= starts]
    x, y = (np.interp(knots, at, line[:, i]) for i in (0, 1))
    path = np.stack((x, y), axis=1)
    points = np.stack([np.interp(dots, at, line[:, i]) for i in (0, 1)], axis=1)
    return np.concatenate((path[:-1][drawn], points)), np.concatenate((path[1:][drawn], points))
