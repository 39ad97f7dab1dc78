# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures: from numbers to pixels. Knows no Blender.

Every figure fills the canvas (see `raster`) that it is given; what stays the same while σ is
dragged is drawn once and copied. Nothing is told by color alone: curves differ in dash and
thickness and are named beside a sample.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from ...core.arrays import Array
from . import lines, plot, raster, text
from .plot import Axes, Key, Size
from .raster import Color
from .theme import Look, contrast, readable

VISIBLE_NM = (380.0, 730.0)
"""Wavelengths shown; the eye sees next to nothing beyond."""
_NM_TICKS = (400, 500, 600, 700)
_BAND = 5.0
"""Height of the color band under the spectrum, at scale 1."""

STEEPEST = 80.0
"""View angles shown on either side, degrees."""
LIGHT_ANGLE = 45.0
_ANGLE_TICKS = (-60, -30, 0, 30, 60)

LARGEST_SIGMA = 90.0


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


@lru_cache(maxsize=16)
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


def swatch(color: Color, size: int, look: Look) -> Array:
    """Show one color, display-encoded, as an icon for lists: with a thin frame."""
    [found] = swatches([color], size, look)
    return np.asarray(found)


def swatches(colors: npt.ArrayLike, size: int, look: Look) -> Array:
    """Show many colors, (colors, 3), each as in `swatch`: shape (colors, size, size, 4)."""
    wanted = raster.encoded(colors).reshape(-1, 3)
    canvas = raster.blank(size, size)
    raster.frame(canvas, (0, 0, size, size), look.grid, max(1, round(look.scale)))
    opaque = np.concatenate((wanted, np.full((len(wanted), 1), 255, np.uint8)), axis=1)
    return np.where(canvas[..., 3:], canvas, opaque[:, np.newaxis, np.newaxis])


def spectrum_axes(size: Size, look: Look, peak: float) -> Axes:
    """Where `spectrum` draws."""
    width, height = size
    top = plot.ceiling(peak)
    left = 1 if plot.is_small(size, look) else plot.margin((0, top / 2, top), look)
    below = math.ceil((_BAND + 5) * look.scale + text.height(look.font))
    head = plot.legend_height(look) + round(2 * look.scale)
    return Axes(left, head, width - 1, height - below, VISIBLE_NM, (0.0, top))


def spectrum(
    canvas: Array,
    wavelengths: Array,
    albedo: Array,
    reading: Array,
    bars: Sequence[tuple[float, float, float]],
    look: Look,
) -> None:
    """Draw albedo and reading over wavelength, and the three numbers that Blender keeps.

    Parameters
    ----------
    wavelengths
        Nanometers, shape (bands,).
    albedo, reading
        Fractions, shape (bands,).
    bars
        First and last wavelength, and value, of blue, green and red: see `data.rgb_bars`.
    """
    shown = (wavelengths > VISIBLE_NM[0] - 50) & (wavelengths < VISIBLE_NM[1] + 50)
    peak = max(*(float(c[shown].max(initial=0)) for c in (albedo, reading)), *(b[2] for b in bars))
    size = canvas.shape[1], canvas.shape[0]
    axes = spectrum_axes(size, look, peak)
    canvas[:] = _spectrum_ground(axes, size, look)
    keys = _spectrum_keys(look)
    half = keys[2].width * look.scale / 2
    for start, end, value in bars:
        (left, y), (right, _) = axes.place(np.clip((start, end), *axes.x), [max(value, 0.0)] * 2)
        raster.rectangle(canvas, (left, y - half, right, y + half), keys[2].color)
    nm = _thinned(wavelengths[shown], axes)
    for values, key in ((albedo, keys[1]), (reading, keys[0])):
        plot.draw_curve(canvas, axes, nm, np.interp(nm, wavelengths, values), key, look)


def _spectrum_keys(look: Look) -> tuple[Key, Key, Key]:
    return (
        Key("Reading", look.target, 1.6),
        Key("Albedo", look.text, 1.3, (4.5, 2.5)),
        Key("Blender RGB", look.blender, 3.2, short="RGB"),
    )


@lru_cache(maxsize=16)
def _spectrum_ground(axes: Axes, size: Size, look: Look) -> Array:
    canvas = raster.blank(size[1], size[0])
    top = axes.y[1]
    named = not plot.is_small(size, look)
    plot.draw_grid(canvas, axes, (0, top / 2, top), look, named=named)
    gap = round(2 * look.scale)
    _visible_band(canvas, axes, axes.bottom + gap, round(_BAND * look.scale))
    row = axes.bottom + gap + (_BAND + 3) * look.scale + text.height(look.font)
    ticks = [(nm, f"{nm} nm" if nm == _NM_TICKS[-1] else f"{nm}") for nm in _NM_TICKS]
    plot.name_below(canvas, axes, ticks, row, look)
    plot.draw_legend(canvas, _spectrum_keys(look), axes.left, look)
    return canvas


def _thinned(nm: Array, axes: Axes) -> Array:
    """Bands to draw: all of them, or one for every other pixel where there are more."""
    most = (axes.right - axes.left) // 2
    inside = np.clip(nm, *axes.x)
    return inside if nm.size <= most else np.linspace(inside[0], inside[-1], most)


def _visible_band(canvas: Array, axes: Axes, top: int, height: int) -> None:
    """Draw light of each wavelength as the screen can best show it.

    Spectral light lies outside of every screen's gamut; its color is moved towards gray until it
    fits, and fades as the eye's sensitivity does. Color matching functions: Wyman, Sloan and
    Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions" (JCGT 2013).
    """
    wide = axes.right - axes.left
    nm = axes.x[0] + (np.arange(wide) + 0.5) / wide * (axes.x[1] - axes.x[0])

    def lobe(middle: float, below: float, above: float) -> Array:
        return np.asarray(np.exp(-0.5 * ((nm - middle) * np.where(nm < middle, below, above)) ** 2))

    x = 0.362 * lobe(442, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
    x -= 0.065 * lobe(501.1, 0.0490, 0.0382)
    y = 0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322)
    z = 1.217 * lobe(437, 0.0845, 0.0278) + 0.681 * lobe(459, 0.0385, 0.0725)
    to_rgb = ((3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570))
    linear = np.array(to_rgb) @ np.stack((x, y, z))
    linear -= np.minimum(linear.min(axis=0), 0)
    linear /= linear.max(axis=0)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    fade = np.clip(np.maximum.reduce((x, y, z)) / 0.1, 0, 1)
    part = canvas[top : top + height, axes.left : axes.right]
    part[:] = raster.encoded(np.vstack((encoded * fade, fade)).T)


def angles_axes(size: Size, look: Look, peak: float) -> Axes:
    """Where `angles` draws."""
    width, height = size
    top = plot.ceiling(peak)
    left = 1 if plot.is_small(size, look) else plot.margin((0, top / 2, top), look)
    below = math.ceil(5 * look.scale + text.height(look.font))
    head = plot.legend_height(look) + round(2 * look.scale)
    return Axes(left, head, width - 1, height - below, (-STEEPEST, STEEPEST), (0.0, top))


def angles(
    canvas: Array,
    view: Array,
    target: Array,
    blender: Array,
    lambert: float,
    look: Look,
    engine: str = "Cycles",
) -> None:
    """Draw the reflectance factor over the view angle, with light from 45° on the left.

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
    """
    size = canvas.shape[1], canvas.shape[0]
    axes = angles_axes(size, look, max(float(target.max()), float(blender.max()), lambert))
    canvas[:] = _angles_ground(axes, size, look, engine)
    for_target, for_blender, for_lambert = _angle_keys(look, engine)
    [[_, y]] = axes.place([0], [max(lambert, 0.0)])
    half = for_lambert.width * look.scale / 2
    stroke, gap = for_lambert.dash
    box = (axes.left, float(y) - half, axes.right, float(y) + half)
    raster.dashes(canvas, box, (stroke * look.scale, gap * look.scale), for_lambert.color)
    plot.draw_curve(canvas, axes, view, target, for_target, look)
    plot.draw_curve(canvas, axes, view, blender, for_blender, look)


def _angle_keys(look: Look, engine: str) -> tuple[Key, Key, Key]:
    return (
        Key("Target", look.target, 2.6),
        Key(engine, look.blender, 1.6, (5.5, 3.5)),
        Key("Lambert", look.faint, 1.0, (2.0, 2.0)),
    )


@lru_cache(maxsize=16)
def _angles_ground(axes: Axes, size: Size, look: Look, engine: str) -> Array:
    canvas = raster.blank(size[1], size[0])
    top = axes.y[1]
    named = not plot.is_small(size, look)
    plot.draw_grid(canvas, axes, (0, top / 2, top), look, named=named)
    row = axes.bottom + 4 * look.scale + text.height(look.font)
    plot.name_below(canvas, axes, [(t, f"{plot.label(t)}°") for t in _ANGLE_TICKS], row, look)
    plot.draw_legend(canvas, _angle_keys(look, engine), axes.left, look)
    if axes.bottom - axes.top >= 36 * look.scale:
        [[x, _]] = axes.place([-LIGHT_ANGLE], [0])
        _sun(canvas, float(x), axes.bottom - 8 * look.scale, look)
    return canvas


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
) -> None:
    """Draw the same as `angles` around the point that is looked at: distance is reflectance."""
    size = canvas.shape[1], canvas.shape[0]
    top = plot.ceiling(max(float(target.max()), float(blender.max())))
    canvas[:] = _polar_ground(size, look, engine)
    for values, key in zip((target, blender), _angle_keys(look, engine), strict=False):
        dash = [part * look.scale for part in key.dash]
        points = polar_place(size, look, view, values / top)
        lines.polyline(canvas, points, key.color, key.width * look.scale, dash)


def polar_place(size: Size, look: Look, degrees: npt.ArrayLike, share: npt.ArrayLike) -> Array:
    """Give pixels (angles, 2) of angles, (angles,), and shares of the radius in `angles_polar`."""
    width, height = size
    head, foot = plot.legend_height(look) + round(2 * look.scale), round(3 * look.scale)
    radius = min(width / 2 - 2, height - head - foot)
    turn = np.radians(np.asarray(degrees, float))
    out = np.stack((np.sin(turn), -np.cos(turn)), axis=-1)
    center = np.array((width / 2, height - foot))
    return np.asarray(center + radius * np.asarray(share, float)[..., np.newaxis] * out)


@lru_cache(maxsize=8)
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


def sigma_range(canvas: Array, sigma: float, sigma_max: float | None, look: Look) -> None:
    """Draw which roughness fits the reading, from 0 to 90°, and the one that is set.

    What does not fit is hatched. A third of the height is the mark of the current value, a third
    the bar; the rest is for the largest value that fits, written where there is room.

    Parameters
    ----------
    sigma, sigma_max
        Degrees; None where every σ fits.
    """
    size = canvas.shape[1], canvas.shape[0]
    limit = LARGEST_SIGMA if sigma_max is None else min(max(sigma_max, 0.0), LARGEST_SIGMA)
    canvas[:] = _range_ground(limit, size, look)
    _, top, _, bottom = _range_box(_limit_said(limit), size, look)
    fits = sigma <= limit + 1e-6
    x, reach = _range_place(sigma, size, look), 4 * look.scale
    ink = look.text if fits else readable(look.blender, look.background)
    raster.pointer(canvas, (x, top - 1), 0, reach, ink)
    raster.rectangle(canvas, (x - look.scale / 2, top - 1, x + look.scale / 2, bottom), ink)


def _limit_said(limit: float) -> str:
    return f"fits up to {limit:.1f}°" if limit < LARGEST_SIGMA else "every σ fits"


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
    return left + (right - left) * min(max(degrees, 0.0), LARGEST_SIGMA) / LARGEST_SIGMA


@lru_cache(maxsize=16)
def _range_ground(limit: float, size: Size, look: Look) -> Array:
    canvas = raster.blank(size[1], size[0])
    said = _limit_said(limit)
    box = left, top, right, bottom = _range_box(said, size, look)
    end = _range_place(limit, size, look)
    raster.rectangle(canvas, box, look.grid)
    if limit < LARGEST_SIGMA:
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
