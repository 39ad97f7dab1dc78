# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The experiment in pictures: readings over albedo, ΔE00 by model, and σ inferred."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ....core import models, reading
from ....core.numerics.arrays import Array
from ...preview.drawing import lines, looks, raster, text
from ...preview.drawing.looks import Look
from ...preview.figures import plot
from ...preview.figures.plot import Axes, Key
from .meshes import Grays
from .results import Inferred, Read
from .surfaces import Surface

_WHITE, _BLACK = (1.0, 1.0, 1.0), (0.1, 0.1, 0.1)
_SCALE = 2.0
_COLUMNS = 3
_PANEL = 300, 190
"""Width and height at scale 1."""
_WIDTH, _ROW = 720, 34
_NAMES = 255
"""Room for names of surfaces, at scale 1."""
_MOST = 46
"""Characters of a name that are shown."""
_LANE = 4.6
"""Between the dots of two models in a row, at scale 1: dots in one place would hide each other."""

# Okabe and Ito's colors.
_COLORS = {
    "lambert": (0.46, 0.46, 0.46),
    "first-order": (0.902, 0.624, 0.0),
    "two-bounce": (0.337, 0.706, 0.914),
    "closure": (0.8, 0.475, 0.655),
    "reference": (0.0, 0.62, 0.451),
    "surface": (0.0, 0.447, 0.698),
}
_OTHER = (0.835, 0.369, 0.0)


@dataclass(frozen=True, eq=False)
class Panel:
    """Readings of one surface by one instrument, over albedo.

    Attributes
    ----------
    title, sigma, instrument
        Of the curves: radians; NaN for none.
    albedo, read
        Shape (points,).
    """

    title: str
    sigma: float
    instrument: str
    albedo: Array
    read: Array


def panels_of_grays(grays: Sequence[Grays]) -> list[Panel]:
    """Give what was measured of meshes, as panels."""
    return [
        Panel(of.name, math.radians(of.degrees), "45a:0", of.albedo, of.reflectance) for of in grays
    ]


def panels_of_readings(surfaces: Sequence[Surface], inferred: Sequence[Inferred]) -> list[Panel]:
    """Give all bands of all materials of known albedo, as panels: one a surface and instrument.

    Where σ is not known from elsewhere, curves are drawn for the one that was inferred.
    """
    found = []
    for surface, of in zip(surfaces, inferred, strict=True):
        points: dict[str, list[tuple[Array, Array]]] = {}
        for material in surface.materials:
            for sample in material.rough:
                if material.albedo is not None:
                    pair = (material.albedo, sample.reflectance)
                    points.setdefault(sample.instrument, []).append(pair)
        sigma = math.radians(of.sigma) if surface.sigma is None else surface.sigma
        for instrument, pairs in points.items():
            albedo, read = (np.concatenate(part) for part in zip(*pairs, strict=True))
            title = f"{surface.name}, {instrument}, σ = {math.degrees(sigma):.0f}°"
            keep = albedo > 0
            found.append(Panel(title, sigma, instrument, albedo[keep], read[keep]))
    return found


def over_albedo(panels: Sequence[Panel]) -> Array:
    """Draw reading over albedo by albedo, points measured and curves by each model."""
    look = _look()
    columns = min(_COLUMNS, len(panels))
    rows = math.ceil(len(panels) / columns)
    width, height = (round(side * _SCALE) for side in _PANEL)
    head = plot.legend_height(look) + round(8 * _SCALE)
    canvas = _canvas(rows * height + head, max(columns, 2) * width)  # the legend needs two
    keys = [Key("measured: reading / albedo", look.text, 3.0), *_keys(models.NAMES, look)]
    plot.draw_legend(canvas, keys, 40 * _SCALE, look)
    shown = np.concatenate([of.read / of.albedo for of in panels])
    low = max(0.0, math.floor(10 * min(float(np.quantile(shown, 0.01)), 0.9)) / 10)
    high = max(1.1, min(1.5, math.ceil(10 * float(np.quantile(shown, 0.99))) / 10))
    for number, panel in enumerate(panels):
        top, left = head + number // columns * height, number % columns * width
        one = _canvas(height, width)  # lines need a canvas in one piece
        _panel(one, panel, (low, high), look)
        canvas[top : top + height, left : left + width] = one
    return np.asarray(canvas[..., :3])


def _panel(canvas: Array, panel: Panel, y: tuple[float, float], look: Look) -> None:
    size = canvas.shape[1], canvas.shape[0]
    levels = [round(float(v), 1) for v in np.arange(y[0], y[1] + 0.01, 0.1)]
    above, below = (round(of * _SCALE) for of in (20, 20))
    left = plot.margin(levels, look) + round(4 * _SCALE)
    axes = Axes(left, above, size[0] - round(10 * _SCALE), size[1] - below, (0.0, 1.0), y)
    text.draw(canvas, _short(panel.title), left, above - 7 * _SCALE, look.font, look.text)
    plot.draw_grid(canvas, axes, levels[:: 1 + len(levels) // 8], look, named=True)
    ticks = [(v, f"{v:g}") for v in (0, 0.2, 0.4, 0.6, 0.8)] + [(1.0, "albedo 1")]
    plot.name_below(canvas, axes, ticks, size[1] - 5 * _SCALE, look)
    rho = np.linspace(0.005, 1, 100)
    curves = [
        plot.curve(canvas, axes, rho, reading_of(model, rho, panel) / rho, key, look)
        for model, key in zip(models.NAMES, _keys(models.NAMES, look), strict=True)
        if math.degrees(panel.sigma) <= models.find(model).largest_sigma
    ]
    lines.draw(curves)
    share = np.clip(panel.read / panel.albedo, *y)
    radius = 1.8 if panel.albedo.size < 40 else 0.9
    for x, y_at in axes.place(panel.albedo, share):
        _dot(canvas, x, y_at, radius, look.text)


def reading_of(model: str, albedo: Array, panel: Panel) -> Array:
    """Predict a panel's readings."""
    return reading.from_albedo(albedo, panel.sigma, model, panel.instrument)


def differences(reads: Sequence[Read], which: str) -> Array:
    """Draw the mean ΔE00 of each model by surface, on a logarithmic scale.

    Parameters
    ----------
    reads
        All readings.
    which
        "stated" or "own": see `Read`.
    """
    names = list(dict.fromkeys(read.surface for read in reads))
    means = {
        model: [_mean([getattr(r, which)[model] for r in reads if r.surface == n]) for n in names]
        for model in models.NAMES
    }
    ticks = (0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
    canvas, axes, look = _rows(names, (math.log10(ticks[0]), math.log10(ticks[-1])))
    marks = [(math.log10(t), f"{t:g}" if t > ticks[0] else f"≤ {t:g}") for t in ticks]
    _name_ticks(canvas, axes, marks, "mean ΔE00", look)
    plot.draw_legend(canvas, _keys(models.NAMES, look, 6.0), axes.left, look)
    for model, values in means.items():
        for row, value in enumerate(values):
            if math.isfinite(value):
                x = axes.across(math.log10(min(max(value, ticks[0]), ticks[-1])))
                _dot(canvas, x, _middle(axes, row) + _lane(model), 2.8, _color(model))
    return np.asarray(canvas[..., :3])


def sigmas(found: Sequence[Inferred]) -> Array:
    """Draw σ inferred by surface: from all materials, from single ones, by models; and known."""
    look = _look()
    shown = [v for of in found for v in (of.most, of.high, of.stated, *of.by_model.values())]
    most = max([10 * math.ceil(v / 10) for v in shown if math.isfinite(v)] or [60])
    canvas, axes, look = _rows([of.surface for of in found], (0.0, float(most)))
    ticks = [(float(v), f"{v}°") for v in range(0, most + 1, 10)]
    _name_ticks(canvas, axes, ticks, "σ", look)
    shown_models = [m for m in _COLORS if m != "lambert"]
    keys = [Key("known", look.text, 2.0), *_keys(shown_models, look, 6.0)]
    other = Key("reference, oren-nayar", _OTHER, 6.0)
    plot.draw_legend(canvas, [*keys, other], 40 * _SCALE, look)
    for row, of in enumerate(found):
        y = _middle(axes, row)
        if math.isfinite(of.least):
            low, high = axes.across(of.least), axes.across(of.most)
            box = (low, y + _lane("surface") - 4, high, y + _lane("surface") + 4)
            raster.rectangle(canvas, box, look.grid)
        if math.isfinite(of.stated):
            x = axes.across(of.stated)
            raster.rectangle(canvas, (x - 1, y - 15 * _SCALE, x + 2, y + 15 * _SCALE), look.text)
        for model, sigma in of.by_model.items():
            if math.isfinite(sigma):
                _dot(canvas, axes.across(sigma), y + _lane(model), 2.8, _color(model))
    return np.asarray(canvas[..., :3])


def _rows(names: Sequence[str], x: tuple[float, float]) -> tuple[Array, Axes, Look]:
    """Give a canvas with a row a surface, its name on the left."""
    look = _look()
    head, foot = plot.legend_height(look) + round(8 * _SCALE), round(24 * _SCALE)
    height = round(len(names) * _ROW * _SCALE)
    canvas = _canvas(head + height + foot, round(_WIDTH * _SCALE))
    left, right = round(_NAMES * _SCALE), round((_WIDTH - 16) * _SCALE)
    axes = Axes(left, head, right, head + height, x, (0.0, float(len(names))))
    for row, name in enumerate(names):
        if row % 2:
            band = (0, axes.top + row * _ROW * _SCALE, right, axes.top + (row + 1) * _ROW * _SCALE)
            raster.rectangle(canvas, band, look.grid, 0.35)
        base = _middle(axes, row) + text.height(look.font) / 2
        text.draw(canvas, _short(name), left - 8 * _SCALE, base, look.font, look.text, align=1)
    return canvas, axes, look


def _name_ticks(
    canvas: Array, axes: Axes, ticks: Sequence[tuple[float, str]], what: str, look: Look
) -> None:
    for value, _ in ticks:
        x = round(axes.across(value))
        raster.rectangle(canvas, (x, axes.top, x + 1, axes.bottom), look.grid)
    row = axes.bottom + 6 * _SCALE + text.height(look.font)
    plot.name_below(canvas, axes, ticks, row, look)
    text.draw(canvas, what, axes.left - 24 * _SCALE, row, look.font, look.faint, align=1)


def _middle(axes: Axes, row: int) -> float:
    return axes.top + (row + 0.5) * _ROW * _SCALE


def _lane(model: str) -> float:
    """How far below the middle of a row a model's dot stands; another model has lambert's lane."""
    lane = list(_COLORS).index(model) if model in _COLORS else 0
    return (lane - (len(_COLORS) - 1) / 2) * _LANE * _SCALE


def _dot(canvas: Array, x: float, y: float, radius: float, color: raster.Color) -> None:
    lines.draw([lines.Line(canvas, np.array([[x, y]]), color, 2 * radius * _SCALE)])


def _keys(names: Sequence[str], look: Look, width: float = 1.4) -> list[Key]:
    return [Key(name, _color(name), width) for name in names]


def _color(model: str) -> raster.Color:
    return looks.readable(_COLORS.get(model, _OTHER), _WHITE, 2.0)


def _look() -> Look:
    return looks.look(_WHITE, _BLACK, _SCALE)


def _canvas(rows: int, columns: int) -> Array:
    canvas = raster.blank(rows, columns)
    raster.rectangle(canvas, (0, 0, columns, rows), _WHITE)
    return canvas


def _short(name: str) -> str:
    return name if len(name) <= _MOST else f"{name[: _MOST - 1]}…"


def _mean(values: Sequence[float]) -> float:
    known = [value for value in values if math.isfinite(value)]
    return float(np.mean(known)) if known else math.nan
