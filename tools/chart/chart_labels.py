# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write labels beside points without covering anything, wherever a measurement puts the points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

DISTANCES = (9, 16, 26, 38, 52, 68, 86, 106, 130, 160)
"""Points (1/72 inch) between a mark and its label, tried in this order."""
DIRECTIONS = tuple(range(-180, 180, 15))
"""Degrees."""
_NEAR = 20
"""From here on a line leads from the label to its mark."""
_MARK = 5.5
"""Half the width of a mark and the air around it, points."""

# What it counts to cover something; five points of distance count 1.
_COVERS_TEXT, _LEADER_COVERS_TEXT, _COVERS_LINE, _LEADER_CROSSES_LINE = 200, 100, 14, 2
_TURN = 2
"""What half the way round from the preferred direction counts, halved."""


def write(
    axes: Axes,
    points: Sequence[tuple[float, float, str, float, dict[str, Any]]],
    lines: list[Bbox],
    texts: list[Bbox],
) -> None:
    """Label points, most important first.

    Parameters
    ----------
    axes
        Where the points are drawn already, with final limits.
    points
        x, y, text, preferred direction (degrees) and style of each.
    lines, texts
        What labels had better not cover, and must not, in pixels, besides the marks of the points.
    """
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()
    half = _MARK * figure.dpi / 72
    taken, crossed = list(texts), list(lines)
    for x, y, *_ in points:
        px, py = axes.transData.transform((x, y))
        taken.append(Bbox.from_extents(px - half, py - half, px + half, py + half))
    for index, (x, y, text, prefer, style) in enumerate(points):
        own = taken[len(texts) + index]
        note = axes.annotate(text, (x, y), (0, 0), textcoords="offset points", **style)
        note.set_in_layout(False)
        distance, direction = _best(note, own, prefer, taken, crossed)
        box = _put(note, distance, direction)
        taken.append(box)
        if distance >= _NEAR:
            crossed += _leader(own, box)
            _draw_leader(axes, own, box, str(style["color"]))


def _best(
    note: Annotation, own: Bbox, prefer: float, taken: list[Bbox], crossed: list[Bbox]
) -> tuple[float, float]:
    """Find the distance and direction of a label at which it covers least."""
    axes = note.axes
    assert axes is not None
    frame = axes.get_window_extent()
    others = [one for one in taken if one is not own]
    choices = sorted(
        (
            distance / 5 + _TURN * (1 - math.cos(math.radians(direction - prefer))),
            distance,
            direction,
        )
        for distance in DISTANCES
        for direction in DIRECTIONS
    )
    least, best = math.inf, choices[0]
    for choice in choices:
        penalty, distance, direction = choice
        if penalty >= least:
            break  # the penalties of all that follow begin higher
        box = _put(note, distance, direction)
        if _outside(box, frame):
            continue
        penalty += _COVERS_TEXT * _overlaps([box], taken)
        penalty += _COVERS_LINE * _overlaps([box], crossed)
        if distance >= _NEAR and penalty < least:
            leader = _leader(own, box)
            penalty += _LEADER_COVERS_TEXT * _overlaps(leader, others)
            penalty += _LEADER_CROSSES_LINE * _overlaps(leader, crossed)
        if penalty < least:
            least, best = penalty, choice
    return best[1], best[2]


def _put(note: Annotation, distance: float, direction: float) -> Bbox:
    """Move a label around its mark; returns the place it takes."""
    dx = distance * math.cos(math.radians(direction))
    dy = distance * math.sin(math.radians(direction))
    note.set_position((dx, dy))
    note.set_horizontalalignment("left" if dx > 1 else "right" if dx < -1 else "center")
    if abs(dy) < abs(dx):
        note.set_verticalalignment("center")
    else:
        note.set_verticalalignment("bottom" if dy > 0 else "top")
    return note.get_window_extent().padded(1.5)


def _outside(box: Bbox, frame: Bbox) -> bool:
    return bool(box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1)


def _overlaps(boxes: list[Bbox], others: list[Bbox]) -> int:
    """Count the others that any of the boxes overlaps."""
    return sum(any(box.overlaps(other) for box in boxes) for other in others)


def _ends(mark: Bbox, box: Bbox) -> tuple[float, float, float, float]:
    """Start at the middle of a mark and end at the nearest place of a label, pixels."""
    x, y = (mark.x0 + mark.x1) / 2, (mark.y0 + mark.y1) / 2
    return x, y, min(max(x, box.x0), box.x1), min(max(y, box.y0), box.y1)


def _leader(mark: Bbox, box: Bbox) -> list[Bbox]:
    """Cut the line from a mark to its label into small boxes."""
    x, y, to_x, to_y = _ends(mark, box)
    steps = max(1, int(math.hypot(to_x - x, to_y - y) / 4))
    places = [(place + 0.5) / steps for place in range(steps)]
    middles = [(x + part * (to_x - x), y + part * (to_y - y)) for part in places]
    return [Bbox.from_extents(px - 1, py - 1, px + 1, py + 1) for px, py in middles]


def _draw_leader(axes: Axes, mark: Bbox, box: Bbox, color: str) -> None:
    x, y, to_x, to_y = _ends(mark, box)
    inverse = axes.transData.inverted()
    ends = [inverse.transform(end) for end in ((x, y), (to_x, to_y))]
    axes.plot(*zip(*ends, strict=True), color=color, linewidth=0.6, zorder=2.5)
