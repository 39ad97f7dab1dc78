# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Albedo and reading over wavelength, and the albedos that the reading leaves open."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from ...colorimetry import srgb
from ..drawing import raster, text
from ..drawing.lines import Line
from ..drawing.looks import Look
from . import plot
from .plot import Axes, Key, Size

SHOWN_NM = (380.0, 730.0)
"""Wavelengths shown; the eye sees next to nothing beyond."""
_NM_TICKS = (400, 500, 600, 700)
_OPEN = 0.3
"""How much of its color the range of albedos lays over what is behind it."""
_BAND = 5.0
"""Height of the color band under the spectrum, at scale 1."""


def spectrum_axes(size: Size, look: Look, peak: float) -> Axes:
    """Where `spectrum` draws."""
    below = math.ceil((_BAND + 5) * look.scale + text.height(look.font))
    return plot.axes_of(size, look, SHOWN_NM, plot.ceiling(peak), below)


def spectrum(
    canvas: Array,
    wavelengths: Array,
    albedo: Array,
    reading: Array,
    bars: Sequence[tuple[float, float, float]],
    look: Look,
    open_albedos: tuple[Array, Array] | None = None,
) -> list[Line]:
    """Show albedo and reading over wavelength, and the three numbers that Blender keeps.

    Parameters
    ----------
    wavelengths
        Nanometers, shape (bands,).
    albedo, reading
        Fractions, shape (bands,).
    bars
        First and last wavelength, and value, of blue, green and red: see `data.rgb_bars`.
    open_albedos
        Lowest and highest albedo at any σ, each (bands,), to be shaded; None for nothing.

    Returns
    -------
    The curves, which are not drawn yet.
    """
    shown = (wavelengths > SHOWN_NM[0] - 50) & (wavelengths < SHOWN_NM[1] + 50)
    curves = (albedo, reading) if open_albedos is None else (albedo, reading, open_albedos[1])
    peak = max(*(float(c[shown].max(initial=0)) for c in curves), *(b[2] for b in bars))
    size, top = (canvas.shape[1], canvas.shape[0]), plot.ceiling(peak)
    axes, ground, (for_reading, for_albedo, for_bars) = _spectrum_ground(
        size, look, top, open_albedos is not None
    )
    nm = _thinned(wavelengths[shown], axes)
    if open_albedos is not None:
        sides = (np.interp(nm, wavelengths, values) for values in open_albedos)
        ground = _shaded(size, look, top, nm.tobytes(), *(side.tobytes() for side in sides))
    canvas[:] = ground
    half = for_bars.width * look.scale / 2
    first, last = axes.x
    spans = np.array(bars, np.float64).reshape(-1, 3).T
    left, right = axes.across(np.minimum(np.maximum(spans[:2], first), last))
    y = axes.down(np.maximum(spans[2], 0.0))
    for box in zip(left, y - half, right, y + half, strict=True):
        raster.rectangle(canvas, box, for_bars.color)
    return [
        plot.curve(canvas, axes, nm, np.interp(nm, wavelengths, values), key, look)
        for values, key in ((albedo, for_albedo), (reading, for_reading))
    ]


def _spectrum_keys(look: Look) -> tuple[Key, Key, Key]:
    return (
        Key("Reading", look.target, 1.6),
        Key("Albedo", look.text, 1.3, (4.5, 2.5)),
        Key("Blender RGB", look.blender, 3.2, short="RGB"),
    )


def _open_key(look: Look) -> Key:
    return Key("any σ", look.faint, 6.0)


@memoized(maxsize=16)
def _shaded(size: Size, look: Look, top: float, nm: bytes, low: bytes, high: bytes) -> Array:
    """Give the ground with the range of albedos laid over it: the same while σ is dragged."""
    axes, ground, _ = _spectrum_ground(size, look, top, True)
    canvas = ground.copy()
    across = np.frombuffer(nm)
    below, above = (
        axes.place(across, np.minimum(np.maximum(np.frombuffer(side), 0), top))
        for side in (low, high)
    )
    outline = np.concatenate((below, above[::-1]))
    raster.polygon(canvas, [outline], _open_key(look).color, _OPEN)
    return canvas


@memoized(maxsize=16)
def _spectrum_ground(
    size: Size, look: Look, top: float, is_open: bool
) -> tuple[Axes, Array, tuple[Key, Key, Key]]:
    """Give all that does not change with the curves: where they go, what is behind, their keys."""
    axes, keys = spectrum_axes(size, look, top), _spectrum_keys(look)
    canvas = raster.blank(size[1], size[0])
    named = not plot.is_small(size, look)
    plot.draw_grid(canvas, axes, (0, top / 2, top), look, named=named)
    gap = round(2 * look.scale)
    _visible_band(canvas, axes, axes.bottom + gap, round(_BAND * look.scale))
    row = axes.bottom + gap + (_BAND + 3) * look.scale + text.height(look.font)
    ticks = [(nm, f"{nm} nm" if nm == _NM_TICKS[-1] else f"{nm}") for nm in _NM_TICKS]
    plot.name_below(canvas, axes, ticks, row, look)
    shown = (*keys, _open_key(look)) if is_open else keys
    plot.draw_legend(canvas, shown, axes.left, look)
    return axes, canvas, keys


def _thinned(nm: Array, axes: Axes) -> Array:
    """Bands to draw: all of them, or one for every other pixel where there are more."""
    most = (axes.right - axes.left) // 2
    first, last = axes.x
    inside = np.minimum(np.maximum(nm, first), last)
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
    linear = srgb.FROM_XYZ @ np.stack((x, y, z))
    linear -= np.minimum(linear.min(axis=0), 0)
    linear /= linear.max(axis=0)
    fade = np.clip(np.maximum.reduce((x, y, z)) / 0.1, 0, 1)
    part = canvas[top : top + height, axes.left : axes.right]
    part[:] = raster.encoded(np.vstack((srgb.encode(linear) * fade, fade)).T)
