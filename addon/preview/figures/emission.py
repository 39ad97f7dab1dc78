# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Emissivity over wavelength: of facets, of the rough surface in directions, and of all of them."""

from __future__ import annotations

import math

import numpy as np

from ....core.numerics.arrays import Array
from ...readings.emission import Emissivity
from ..drawing import lines, looks, raster, text
from ..drawing.looks import Look
from . import plot
from .plot import Axes, Key

_MICROMETERS = 2500.0
"""Nanometers from which on the axis is in micrometers."""

_TICKS = 6
"""Marks along the axis, about."""

_WHITE, _BLACK = (1.0, 1.0, 1.0), (0.1, 0.1, 0.1)
_SCALE = 2.0
_SIZE = 460, 260
"""Width and height at scale 1."""


def picture(found: Emissivity) -> Array:
    """Draw a sample's emissivity: uint8 pixels, shape (rows, columns, 3)."""
    look = looks.look(_WHITE, _BLACK, _SCALE)
    width, height = (round(side * _SCALE) for side in _SIZE)
    canvas = raster.blank(height, width)
    raster.rectangle(canvas, (0, 0, width, height), _WHITE)
    lines.draw(emission(canvas, found, look))
    return np.asarray(canvas[..., :3])


def emission(canvas: Array, found: Emissivity, look: Look) -> list[lines.Line]:
    """Show emissivities over wavelength, and the bands that were asked for.

    Returns
    -------
    The curves, which are not drawn yet.
    """
    curves = [
        (Key("facet", look.text, 1.3, (4.5, 2.5)), found.facets),
        *zip(_directions(found.angles, look), found.directional, strict=True),
        (Key("hemisphere", look.faint, 1.3, (2.0, 2.0)), found.hemispherical),
    ]
    shown = [values for _, values in curves]
    nm = found.wavelengths
    per_unit, unit = (1000.0, "µm") if nm[-1] > _MICROMETERS else (1.0, "nm")
    size = canvas.shape[1], canvas.shape[0]
    below = math.ceil(8 * look.scale + text.height(look.font))
    peak = max(float(values.max()) for values in shown)
    ends = (float(nm[0] / per_unit), float(nm[-1] / per_unit))
    axes = plot.axes_of(size, look, ends, plot.ceiling(max(peak, 0.02)), below)
    _draw_bands(canvas, axes, found, per_unit, look)
    top = axes.y[1]
    plot.draw_grid(canvas, axes, (0, top / 4, top / 2, 3 * top / 4, top), look, named=True)
    row = axes.bottom + 6 * look.scale + text.height(look.font)
    ticks = _ticks(*ends)
    names = [*(f"{tick:g}" for tick in ticks[:-1]), f"{ticks[-1]:g} {unit}"]
    plot.name_below(canvas, axes, list(zip(ticks, names, strict=True)), row, look)
    plot.draw_legend(canvas, [key for key, _ in curves], axes.left, look)
    return [plot.curve(canvas, axes, nm / per_unit, values, key, look) for key, values in curves]


def _directions(angles: tuple[float, ...], look: Look) -> list[Key]:
    """Entries for directions: from the color of the first to that of the last by their order."""
    found = []
    for place, angle in enumerate(angles):
        share = place / max(len(angles) - 1, 1)
        red, green, blue = (
            a + share * (b - a) for a, b in zip(look.target, look.blender, strict=True)
        )
        found.append(Key(f"{math.degrees(angle):g}°", (red, green, blue), 1.6))
    return found


def _draw_bands(canvas: Array, axes: Axes, found: Emissivity, per_unit: float, look: Look) -> None:
    """Shade the bands that were asked for."""
    for band in found.bands:
        left, right = (
            axes.across(min(max(end / per_unit, axes.x[0]), axes.x[1]))
            for end in (band.first, band.last)
        )
        raster.rectangle(canvas, (left, axes.top, right, axes.bottom), look.grid, 0.5)


def _ticks(first: float, last: float) -> list[float]:
    """Round numbers within an axis."""
    rough = (last - first) / _TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)
    count = range(math.ceil(first / step - 1e-9), math.floor(last / step + 1e-9) + 1)
    return [round(place * step, 9) for place in count] or [first]
