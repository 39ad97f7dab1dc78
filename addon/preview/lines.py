# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Antialiased lines on a canvas, see `raster`.

A pixel's share comes from its distance. Shares sum up to the area of the line within 4 %, for lines
of one pixel within 13 %, on exact diagonals. Only pixels that a line covers are looked at.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from ...core.arrays import Array
from .raster import Box, Color, lay

_LEAST = 1e-9
"""Pixels; what is shorter is a point, and nothing is divided by less."""


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
    height, across = canvas.shape[:2]
    box = within or (0, 0, across, height)
    index, share = _covered(line.tobytes(), width, tuple(dash), box, (height, across))
    lay(canvas, index, share, color, alpha)


@lru_cache(maxsize=16)
def _covered(
    points: bytes, width: float, dash: tuple[float, ...], box: Box, shape: tuple[int, int]
) -> tuple[Array, Array]:
    """List the pixels that a line covers, counted row by row, and how much of each; float32.

    Kept, because of the curves of a picture not all change while σ is dragged.
    """
    line = np.frombuffer(points).reshape(-1, 2)
    if dash:
        start, end = _dashes(line, dash, width)
    elif len(line) == 1:
        start = end = line
    else:
        start, end = line[:-1], line[1:]
    index, share = _near(start, end, width, box, shape[1])
    # Where pieces meet the one that covers most counts.
    most = np.empty(shape[0] * shape[1], np.float32)
    most[index] = 0
    np.maximum.at(most, index, share)
    kept = np.flatnonzero((share > 0) & (share == most[index]))
    return index[kept], share[kept]


def _near(start: Array, end: Array, width: float, box: Box, across: int) -> tuple[Array, Array]:
    """List the pixels near pieces of a line, and how much of each the piece covers.

    Parameters
    ----------
    start, end
        Of the pieces, (pieces, 2).
    box
        Whole pixels outside of which nothing counts.
    across
        Pixels of a row.

    Returns
    -------
    Number of the pixel, counted row by row, and its share, float32. Pixels come once a piece.
    """
    reach = width / 2 + 0.5
    along = end - start
    length = np.sqrt(along[:, 0] ** 2 + along[:, 1] ** 2)
    # A point is a piece along x.
    along[length < _LEAST] = (_LEAST, 0)
    ux, uy = (along / np.maximum(length, _LEAST)[:, np.newaxis]).T
    left, top = (np.minimum(start, end) - reach).T
    right, bottom = (np.maximum(start, end) + reach).T
    # Rows whose middle is near enough to a piece.
    first, rows = _whole(top, bottom, box[1], box[3])
    pieces = np.array((start[:, 0], start[:, 1], ux, uy, length, left, right))
    x, y, ux, uy, length, left, right = pieces.repeat(rows, axis=1)
    row = _count(first, rows)
    # Of each row the pixels between two lines along the piece, no further than its ends.
    down = row + 0.5 - y
    steep = np.maximum(np.abs(uy), _LEAST)
    middle, half = x + down * ux / np.copysign(steep, uy), reach / steep
    left, right = np.maximum(left, middle - half), np.minimum(right, middle + half)
    column, columns = _whole(left, right, box[0], box[2])
    beside = column + 0.5 - x
    # Of each pixel the way from the start of the piece, along it and across.
    spans = np.array((beside * ux + down * uy, down * ux - beside * uy, ux, uy, length), np.float32)
    ahead, aside, ux, uy, length = spans.repeat(columns, axis=1)
    leftmost = row * across + column
    index = _count(leftmost, columns)
    step = (index - leftmost.repeat(columns)).astype(np.float32)
    ahead += step * ux
    aside -= step * uy
    ahead -= np.minimum(np.maximum(ahead, 0), length)
    away = np.sqrt(ahead * ahead + aside * aside)
    share = np.minimum(np.maximum(np.float32(reach) - away, 0), np.float32(min(width, 1.0)))
    return index, share


def _whole(low: Array, high: Array, least: float, most: float) -> tuple[Array, Array]:
    """Pixels whose middle lies between two places: the first of them, and how many."""
    first = np.minimum(np.maximum(np.ceil(low - 0.5), least), most).astype(np.intp)
    beyond = np.minimum(np.maximum(np.floor(high + 0.5), least), most).astype(np.intp)
    return first, np.maximum(beyond - first, 0)


def _count(first: Array, counts: Array) -> Array:
    """Count up from each number, as often as its count says."""
    beyond = counts.cumsum()
    return np.arange(beyond[-1] if beyond.size else 0) + (first - beyond + counts).repeat(counts)


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
    knots = np.sort(np.concatenate((at, starts, ends)))
    drawn = np.searchsorted(starts, knots[:-1], side="right") > np.searchsorted(
        ends, knots[:-1], side="right"
    )
    dots = starts[ends <= starts]
    x, y = (np.interp(knots, at, line[:, i]) for i in (0, 1))
    path = np.stack((x, y), axis=1)
    points = np.stack([np.interp(dots, at, line[:, i]) for i in (0, 1)], axis=1)
    return np.concatenate((path[:-1][drawn], points)), np.concatenate((path[1:][drawn], points))
