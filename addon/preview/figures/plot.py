# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the figures have in common: axes with ticks, legends, round numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from ....core.numerics.arrays import Array
from ..drawing import lines, raster, text
from ..drawing.looks import Look

_Numbers = TypeVar("_Numbers", float, Array)

Size = tuple[int, int]
"""Width and height, pixels."""

SMALL = 150.0
"""Below this width, in pixels of the interface at scale 1, numbers beside the axis are left out."""

_KEY = 16.0
"""Length of the sample of a line in a legend, at scale 1."""
_SMALL_KEY = 14.0
"""The same in a narrow picture."""


@dataclass(frozen=True)
class Axes:
    """A rectangle of pixels and the numbers at its sides."""

    left: int
    top: int
    right: int
    bottom: int
    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def box(self) -> raster.Box:
        """The rectangle."""
        return self.left, self.top, self.right, self.bottom

    def place(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Array:
        """Give pixels (points, 2) of numbers (points,)."""
        return np.array((self.across(np.asarray(x, float)), self.down(np.asarray(y, float)))).T

    def across(self, x: _Numbers) -> _Numbers:
        """Give pixels from the left of numbers along x."""
        low, high = self.x
        return self.left + (x - low) / (high - low) * (self.right - self.left)

    def down(self, y: _Numbers) -> _Numbers:
        """Give pixels from the top of numbers along y."""
        low, high = self.y
        return self.bottom - (y - low) / (high - low) * (self.bottom - self.top)


@dataclass(frozen=True)
class Key:
    """One entry of a legend: its name, color, line width at scale 1 and dash at scale 1.

    `short` is its name where the picture is narrow.
    """

    name: str
    color: raster.Color
    width: float
    dash: tuple[float, ...] = ()
    short: str = ""


def is_small(size: Size, look: Look) -> bool:
    """Whether there is no room for numbers beside the axis."""
    return size[0] < SMALL * look.scale


def ceiling(peak: float) -> float:
    """Round number at or above a value, so that an axis stays where it is while values change."""
    for top in (0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.6, 2.0, 3.0):
        if peak <= top:
            return top
    # A mirror's light in a polished gloss is hundreds of times that of white.
    decade = 10.0 ** math.floor(math.log10(peak))
    return next(step * decade for step in (2, 3, 4, 6, 8, 10, 20) if peak <= step * decade)


def label(value: float) -> str:
    """Write a tick; the minus sign is as wide as a digit."""
    return f"{value:g}".replace("-", "−")


def margin(axis: Sequence[float], look: Look) -> int:
    """Room for the numbers beside an axis, pixels."""
    widest = max(text.width(label(value), look.font) for value in axis)
    return math.ceil(widest + 5 * look.scale)


def axes_of(size: Size, look: Look, x: tuple[float, float], top: float, foot: int) -> Axes:
    """Place axes from 0 to `top` between a legend above and `foot` rows below."""
    width, height = size
    left = 1 if is_small(size, look) else margin((0, top / 2, top), look)
    head = legend_height(look) + round(2 * look.scale)
    return Axes(left, head, width - 1, height - foot, x, (0.0, top))


def draw_grid(
    canvas: Array, axes: Axes, ticks: Sequence[float], look: Look, *, named: bool
) -> None:
    """Draw level lines with their values, the lowest one stronger."""
    thin = max(1, round(look.scale))
    for value in ticks:
        # Whole pixels: a thin line between two rows would be a gray band.
        row = min(round(axes.down(value)), axes.bottom - thin)
        strong = value == ticks[0]
        color = look.faint if strong else look.grid
        raster.rectangle(canvas, (axes.left, row, axes.right, row + thin), color)
        if named:
            middle = row + text.height(look.font) / 2
            left = axes.left - 4 * look.scale
            text.draw(canvas, label(value), left, middle, look.font, look.faint, align=1)


def name_below(
    canvas: Array, axes: Axes, ticks: Sequence[tuple[float, str]], row: float, look: Look
) -> None:
    """Write numbers below a plot, kept inside the picture; every other one where room is short."""
    for step in range(1, len(ticks) + 1):
        kept = ticks[::-1][::step][::-1]
        halves = [text.width(name, look.font) / 2 for _, name in kept]
        places = [axes.across(value) for value, _ in kept]
        middles = [
            min(max(x, half + 1), canvas.shape[1] - half - 2)
            for x, half in zip(places, halves, strict=True)
        ]
        ends = [x + half + 3 * look.scale for x, half in zip(middles, halves, strict=True)]
        starts = [x - half for x, half in zip(middles, halves, strict=True)]
        if all(start >= end for start, end in zip(starts[1:], ends[:-1], strict=True)):
            break
    for x, (_, name) in zip(middles, kept, strict=True):
        text.draw(canvas, name, x, row, look.font, look.faint, align=0.5)


def legend_height(look: Look) -> int:
    """Rows of a legend, pixels."""
    return math.ceil(1.5 * look.font)


def draw_legend(canvas: Array, keys: Sequence[Key], left: float, look: Look) -> None:
    """Name the lines in one row along the top, each with a sample beside its name.

    Where the picture is narrow names get short and samples small, then the last ones are left out.
    """
    end = canvas.shape[1] - 1
    gap, space = 10 * look.scale, 4 * look.scale
    names = [key.name for key in keys]
    short = [key.short or key.name for key in keys]
    for sample, shown in ((_KEY, names), (_SMALL_KEY, names), (_SMALL_KEY, short)):
        length = sample * look.scale
        widths = [length + space + text.width(name, look.font) for name in shown]
        if left + sum(widths) + gap * (len(keys) - 1) <= end:
            break
    base = text.height(look.font) + 3 * look.scale
    middle = base - text.height(look.font) / 2
    x = float(left)
    for key, name, width in zip(keys, shown, widths, strict=True):
        if x + width > end:
            return
        reach = key.width * look.scale / 2
        ends = np.array(((x + reach, middle), (x + length - reach, middle)))
        lines.draw([line(canvas, ends, key, look)])
        text.draw(canvas, name, x + length + space, base, look.font, key.color)
        x += width + gap


def curve(canvas: Array, axes: Axes, x: Array, y: Array, key: Key, look: Look) -> lines.Line:
    """Give a line as its entry in the legend shows it, cut at the sides of the plot."""
    # Half a line may cross the border, so that a curve along it does not thin out.
    spare = math.ceil(key.width * look.scale / 2) + 1
    within = (axes.left, max(axes.top - spare, 0), axes.right, axes.bottom + spare)
    low, high = axes.y
    inside = np.minimum(np.maximum(y, low), high)
    return line(canvas, axes.place(x, inside), key, look, within)


def line(
    canvas: Array, points: Array, key: Key, look: Look, within: raster.Box | None = None
) -> lines.Line:
    """Give a line through pixels, (points, 2), as its entry in the legend shows it."""
    dash = tuple(part * look.scale for part in key.dash)
    return lines.Line(canvas, points, key.color, key.width * look.scale, dash, within)
