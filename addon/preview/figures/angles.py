# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reflectance over the view angle, beside each other and around a point."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from ..drawing import lines, raster, text
from ..drawing.lines import Line
from ..drawing.looks import Look
from . import plot
from .plot import Axes, Key, Size

STEEPEST = 80.0
"""View angles shown on either side, degrees."""
LIGHT_ANGLE = 45.0
_ANGLE_TICKS = (-60, -30, 0, 30, 60)


def angles_axes(size: Size, look: Look, peak: float) -> Axes:
    """Where `angles` draws."""
    below = math.ceil(5 * look.scale + text.height(look.font))
    return plot.axes_of(size, look, (-STEEPEST, STEEPEST), plot.ceiling(peak), below)


def angles(
    canvas: Array,
    view: Array,
    target: Array,
    blender: Array,
    lambert: float,
    look: Look,
    engine: str = "Cycles",
) -> list[Line]:
    """Show the reflectance factor over the view angle, with light from 45° on the left.

    Parameters
    ----------
    view
        Degrees in the plane of incidence, negative on the side of the light, shape (angles,).
    target, blender
        Luminance factor of the model and of Blender, shape (angles,).
    lambert
        The same of the smooth material with the same reading.
    engine
        What draws for Blender, as the legend names it.

    Returns
    -------
    The curves, which are not drawn yet.
    """
    size = canvas.shape[1], canvas.shape[0]
    top = plot.ceiling(max(float(target.max()), float(blender.max()), lambert))
    axes, ground, (for_target, for_blender, for_lambert) = _angles_ground(size, look, top, engine)
    canvas[:] = ground
    y, half = axes.down(max(lambert, 0.0)), for_lambert.width * look.scale / 2
    stroke, gap = for_lambert.dash
    box = (axes.left, y - half, axes.right, y + half)
    raster.dashes(canvas, box, (stroke * look.scale, gap * look.scale), for_lambert.color)
    return [
        plot.curve(canvas, axes, view, target, for_target, look),
        plot.curve(canvas, axes, view, blender, for_blender, look),
    ]


def _angle_keys(look: Look, engine: str) -> tuple[Key, Key, Key]:
    return (
        Key("Target", look.target, 2.6),
        Key(engine, look.blender, 1.6, (5.5, 3.5)),
        Key("Lambert", look.faint, 1.0, (2.0, 2.0)),
    )


@memoized(maxsize=16)
def _angles_ground(
    size: Size, look: Look, top: float, engine: str
) -> tuple[Axes, Array, tuple[Key, Key, Key]]:
    """Give all that does not change with the curves: where they go, what is behind, their keys."""
    axes, keys = angles_axes(size, look, top), _angle_keys(look, engine)
    canvas = raster.blank(size[1], size[0])
    named = not plot.is_small(size, look)
    plot.draw_grid(canvas, axes, (0, top / 2, top), look, named=named)
    row = axes.bottom + 4 * look.scale + text.height(look.font)
    plot.name_below(canvas, axes, [(t, f"{plot.label(t)}°") for t in _ANGLE_TICKS], row, look)
    plot.draw_legend(canvas, keys, axes.left, look)
    if axes.bottom - axes.top >= 36 * look.scale:
        _sun(canvas, axes.across(-LIGHT_ANGLE), axes.bottom - 8 * look.scale, look)
    return axes, canvas, keys


def _sun(canvas: Array, x: float, y: float, look: Look) -> None:
    """Mark where the light stands: a disc with rays and its name."""
    unit = look.scale
    lines.polyline(canvas, [(x, y)], look.faint, 4 * unit)
    for turn in np.arange(8) * np.pi / 4:
        way = np.array((np.cos(turn), np.sin(turn)))
        ray = np.array((x, y)) + np.outer((3.4 * unit, 4.8 * unit), way)
        lines.polyline(canvas, ray, look.faint, unit)
    base = y + text.height(look.font) / 2
    text.draw(canvas, "light", x + 8 * unit, base, look.font, look.faint)


def angles_polar(
    canvas: Array,
    view: Array,
    target: Array,
    blender: Array,
    look: Look,
    engine: str = "Cycles",
) -> list[Line]:
    """Show the same as `angles` around the point that is looked at: distance is reflectance."""
    size = canvas.shape[1], canvas.shape[0]
    top = plot.ceiling(max(float(target.max()), float(blender.max())))
    canvas[:] = _polar_ground(size, look, engine)
    return [
        plot.line(canvas, polar_place(size, look, view, values / top), key, look)
        for values, key in zip((target, blender), _angle_keys(look, engine), strict=False)
    ]


def polar_place(size: Size, look: Look, degrees: npt.ArrayLike, share: npt.ArrayLike) -> Array:
    """Give pixels (angles, 2) of angles, (angles,), and shares of the radius in `angles_polar`."""
    width, height = size
    head, foot = plot.legend_height(look) + round(2 * look.scale), round(3 * look.scale)
    radius = min(width / 2 - 2, height - head - foot)
    turn = np.radians(np.asarray(degrees, float))
    out = np.stack((np.sin(turn), -np.cos(turn)), axis=-1)
    center = np.array((width / 2, height - foot))
    return np.asarray(center + radius * np.asarray(share, float)[..., np.newaxis] * out)


@memoized(maxsize=8)
def _polar_ground(size: Size, look: Look, engine: str) -> Array:
    canvas = raster.blank(size[1], size[0])
    thin = max(1.0, look.scale)
    around = np.linspace(-90, 90, 61)
    for share in (0.5, 1.0):
        arc = polar_place(size, look, around, np.full(61, share))
        lines.polyline(canvas, arc, look.grid, thin)
    for degrees in (-90, -60, -30, 0, 30, 60, 90):
        spoke = polar_place(size, look, [degrees] * 2, [0, 1])
        lines.polyline(canvas, spoke, look.grid, thin)
    [[x, y]] = polar_place(size, look, [-LIGHT_ANGLE], [1])
    _sun(canvas, float(x) + 6 * look.scale, float(y) + 6 * look.scale, look)
    plot.draw_legend(canvas, _angle_keys(look, engine)[:2], 1, look)
    return canvas
