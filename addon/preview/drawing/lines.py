# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Antialiased lines on a canvas, see `raster`.

A pixel's share comes from its distance. Shares sum up to the area of the line within 4 %, for lines
of one pixel within 13 %, on exact diagonals. Only pixels that a line covers are looked at.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ....core.numerics.arrays import Array
from ....core.numerics.memoized import kept
from .raster import Box, Color, lay

_LEAST = 1e-9
"""Pixels; what is shorter is a point, and nothing is divided by less."""

_BOUND = 16
"""Lines whose pixels are kept."""


class Line(NamedTuple):
    """A line through points, with round joins and ends.

    Parameters
    ----------
    canvas
        Where to draw.
    points
        Pixels, (points, 2). A single point is a disc.
    width
        Pixels.
    dash
        Lengths of strokes and gaps in turn, pixels, ends of strokes included; empty for a solid
        line.
    within
        Box of whole pixels outside of which nothing is drawn.
    """

    canvas: Array
    points: npt.ArrayLike
    color: Color
    width: float = 1.5
    dash: tuple[float, ...] = ()
    within: Box | None = None


class _Shape(NamedTuple):
    """What the pixels of a line depend on; its points as bytes, first all x and then all y."""

    points: bytes
    width: float
    dash: tuple[float, ...]
    box: Box
    size: tuple[int, int]


class _Cover(NamedTuple):
    """Pixels of a line, counted row by row: those it fills, the others, and the latter's share.

    Shares are float32 and come once for each byte of a pixel.
    """

    full: Array
    part: Array
    share: Array


_kept: dict[_Shape, _Cover] = kept(__name__, "_kept")
"""Pixels of the lines drawn last, because not all curves of a picture change while σ is dragged."""


def polyline(
    canvas: Array,
    points: npt.ArrayLike,
    color: Color,
    width: float = 1.5,
    dash: Sequence[float] = (),
    within: Box | None = None,
) -> None:
    """Draw one line, see `Line`."""
    draw([Line(canvas, points, color, width, tuple(dash), within)])


def draw(lines: Sequence[Line]) -> None:
    """Draw lines, each over those before it; several at once take little longer than one."""
    shapes = [_shape(line) for line in lines]
    # Another thread may draw at the same time: what is kept may be gone at any moment.
    covers = {shape: known for shape in shapes if (known := _kept.pop(shape, None)) is not None}
    missing = [shape for shape in dict.fromkeys(shapes) if shape not in covers]
    if missing:
        with np.errstate(invalid="ignore"):  # what is no number covers nothing
            found = _near(missing)
        for shape, near in zip(missing, found, strict=True):
            covers[shape] = _cover(*near, math.prod(shape.size))
    for line, shape in zip(lines, shapes, strict=True):
        lay(line.canvas, *covers[shape], line.color)
    _kept.update(covers)
    for shape in list(_kept)[:-_BOUND]:
        _kept.pop(shape, None)


def _shape(line: Line) -> _Shape:
    height, across = line.canvas.shape[:2]
    box = line.within or (0, 0, across, height)
    points = np.asarray(line.points, np.float64).reshape(-1, 2)
    return _Shape(points.T.tobytes(), line.width, line.dash, box, (height, across))


def _cover(index: Array, share: Array, pixels: int) -> _Cover:
    """Make one of the pixels near a line, of which several pieces may each cover a share."""
    full = index[(share >= 1).nonzero()[0]]
    rest = (share < 1).nonzero()[0]
    index, share = index[rest], share[rest]
    # Where pieces meet the one that covers most counts.
    most = np.empty(pixels, np.float32)
    most[index] = 0
    np.maximum.at(most, index, share)
    most[full] = 1
    kept = (share == most[index]).nonzero()[0]
    return _Cover(full, index[kept], share[kept].repeat(4))


def _near(shapes: Sequence[_Shape]) -> list[tuple[Array, Array]]:
    """List the pixels near the pieces of each line, and how much of each the piece covers.

    All lines in one go: the time goes into calling numpy and not into the numbers.

    Returns
    -------
    For each line numbers of pixels, counted row by row, and their shares, float32. Pixels come once
    a piece.
    """
    pieces = [_pieces(shape) for shape in shapes]
    counts = [piece.shape[1] for piece in pieces]
    ends = np.concatenate(pieces, axis=1)
    start, end = ends[:2], ends[2:]
    given = np.array([_given(shape) for shape in shapes]).T.repeat(counts, axis=1)
    reach, limit, across = given[:3]
    along = end - start
    squares = along * along
    length = np.sqrt(squares[0] + squares[1])
    way = along / np.maximum(length, _LEAST)
    # A point is a piece along x.
    np.copyto(way, ((1.0,), (0.0,)), where=length < _LEAST)
    left, top = np.maximum(np.minimum(start, end) - reach, given[3:5])
    right, bottom = np.minimum(np.maximum(start, end) + reach, given[5:])
    # Rows whose middle is near enough to a piece.
    first, rows = _whole(top, bottom)
    row_sums = _sums(rows)
    offset = first - row_sums[:-1]
    table = np.array((*start, *way, length, left, right, reach, limit, across, offset))
    x, y, ux, uy, length, left, right, reach, limit, across, offset = table.repeat(rows, axis=1)
    # Of each row the pixels between two lines along the piece, no further than its ends.
    row = np.arange(row_sums[-1]) + offset
    down = row + 0.5 - y
    steep = np.maximum(np.abs(uy), _LEAST)
    middle, half = x + down * ux / np.copysign(steep, uy), reach / steep
    column, columns = _whole(np.maximum(left, middle - half), np.minimum(right, middle + half))
    sums = _sums(columns)
    before = sums[:-1]
    leftmost = (row * across + column).astype(np.intp)
    index = np.arange(sums[-1]) + (leftmost - before).repeat(columns)
    # Of each pixel the way from the start of the piece, along it and across.
    beside = column + 0.5 - x
    ahead, aside = beside * ux + down * uy, down * ux - beside * uy
    table = np.array((ahead, aside, ux, uy, length, reach, limit, before), np.float32)
    # What belongs to a row lies side by side, which numpy copies at once.
    ahead, aside, ux, uy, length, reach, limit, before = table.T.repeat(columns, axis=0).T
    step = np.arange(sums[-1], dtype=np.float32) - before
    ahead, aside = ahead + step * ux, aside - step * uy
    ahead -= np.minimum(np.maximum(ahead, 0), length)
    away = np.sqrt(ahead * ahead + aside * aside)
    share = np.minimum(np.maximum(reach - away, 0), limit)
    bounds = sums[row_sums[[*accumulate(counts, initial=0)]]].tolist()
    return [(index[i:j], share[i:j]) for i, j in pairwise(bounds)]


def _given(shape: _Shape) -> tuple[float, ...]:
    """How far a line reaches, its largest share, pixels of a row, and the box."""
    return shape.width / 2 + 0.5, min(shape.width, 1.0), shape.size[1], *shape.box


def _whole(low: Array, high: Array) -> tuple[Array, Array]:
    """Pixels whose middle lies between two places: the first of them, a float, and how many."""
    first = np.ceil(low - 0.5)
    count = np.maximum(np.floor(high + 0.5) - first, 0)
    known = np.isfinite(count)
    return np.where(known, first, 0), np.where(known, count, 0).astype(np.intp)


def _sums(counts: Array) -> Array:
    """Sum up from 0 on, one number more than there are counts."""
    sums = np.zeros(counts.size + 1, np.intp)
    counts.cumsum(out=sums[1:])
    return sums


def _pieces(shape: _Shape) -> Array:
    """Straight pieces of a line: x and y of their starts, x and y of their ends; (4, pieces)."""
    line = np.frombuffer(shape.points).reshape(2, -1)
    # Along a line with a gap nobody can tell where dashes are.
    if shape.dash and np.isfinite(line).all():
        return _dashes(line, shape.dash, shape.width)
    if line.shape[1] == 1:
        return np.concatenate((line, line))
    return np.concatenate((line[:, :-1], line[:, 1:]))


def _dashes(line: Array, dash: tuple[float, ...], width: float) -> Array:
    """Pieces of the strokes of a dashed line; round ends lengthen a stroke by the line's width."""
    at = np.zeros(line.shape[1])
    np.hypot(*(line[:, 1:] - line[:, :-1])).cumsum(out=at[1:])
    length = float(at[-1])
    strokes = _strokes(dash, width, int(length // sum(dash)) + 1)
    # Starts and ends in turn, up to the end of the line.
    edges = np.minimum(strokes[: strokes[:, 0].searchsorted(length)], length).reshape(-1)
    knots = np.concatenate((at, edges))
    knots.sort()
    drawn = (edges.searchsorted(knots[:-1], side="right") % 2).nonzero()[0]
    path = _along(line, at, knots)
    pieces = np.concatenate((path.take(drawn, axis=1), path.take(drawn + 1, axis=1)))
    dots = edges[::2][edges[1::2] <= edges[::2]]
    if not dots.size:
        return pieces
    points = _along(line, at, dots)
    return np.concatenate((pieces, np.concatenate((points, points))), axis=1)


def _strokes(dash: tuple[float, ...], width: float, turns: int) -> Array:
    """Where strokes start and end, (strokes, 2), without the round ends; a short one is a dot."""
    turn = np.arange(turns)[:, np.newaxis] * sum(dash)
    offsets = np.concatenate(([0.0], np.cumsum(dash)))
    starts = (turn + offsets[:-1:2]).ravel() + width / 2
    ends = np.maximum((turn + offsets[1::2]).ravel() - width / 2, starts)
    return np.stack((starts, ends), axis=1)


def _along(line: Array, at: Array, knots: Array) -> Array:
    """Points of a line, (2, knots), after some of its length."""
    return np.array([np.interp(knots, at, line[i]) for i in (0, 1)])
