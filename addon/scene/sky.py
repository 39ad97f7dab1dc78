# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Color of Blender's sky textures, from a table that `tools/tables/fit_sky.py` rendered."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...core.numerics.arrays import Array
from ..colorimetry.rgb_space import WorkingSpace

_KINDS = {"NISHITA": "SINGLE_SCATTERING"}
"""Up to Blender 4.5 there was one physical sky, under another name."""
_DUST = {"aerosol_density": "dust_density"}
_LEAST = 1e-6


@dataclass(frozen=True)
class Sky:
    """What a sky sheds, in scene-linear RGB.

    Parameters
    ----------
    radiance
        Mean of the dome, shape (3,).
    irradiance
        Of the sun on a surface that faces it, shape (3,), or None without a sun.
    elevation, azimuth
        Where the sun stands, radians.
    half_angle
        Half of the sun's width, radians.
    warnings
        Sentences about what the table does not know.
    """

    radiance: Array
    irradiance: Array | None
    elevation: float
    azimuth: float
    half_angle: float
    warnings: tuple[str, ...] = ()


def read(node: Any, space: WorkingSpace) -> Sky:
    """Look up a sky texture node."""
    kind = _KINDS.get(node.sky_type, node.sky_type)
    if kind in {"PREETHAM", "HOSEK_WILKIE"}:
        x, y, z = node.sun_direction
        elevation = math.atan2(z, math.hypot(x, y))
        rgb = _turbid(kind, node.turbidity, math.degrees(elevation))
        return Sky(_to_space(rgb, space), None, elevation, math.atan2(y, x), 0.0)
    numbers = _atmosphere(kind, node)
    sun = None
    if node.sun_disc and node.sun_elevation > 0 and numbers[3:].max() > 0:
        sun = _to_space(numbers[3:], space) * node.sun_intensity
    return Sky(
        _to_space(numbers[:3], space),
        sun,
        node.sun_elevation,
        math.pi / 2 - node.sun_rotation,
        node.sun_size / 2,
    )


def _atmosphere(kind: str, node: Any) -> Array:
    """RGB of dome and sun: ratios of single settings, multiplied."""
    table = _table()
    at = math.degrees(node.sun_elevation)
    at = min(at, 180 - at)
    base = _over_elevation(table[kind]["base"], at)
    found = np.log(base)
    for name, values in table["settings"].items():
        value = getattr(node, name, None)
        if value is None:
            value = getattr(node, _DUST[name])
        rows = [_over_elevation(rows, at) for rows in table[kind][name]]
        found = found + np.log(_between(value, values, np.array(rows))) - np.log(base)
    return np.where(np.exp(found) > 10 * _LEAST, np.exp(found), 0.0)


def _turbid(kind: str, turbidity: float, elevation: float) -> Array:
    rows = [_over_elevation(rows, elevation) for rows in _table()[kind]]
    return _between(turbidity, _table()["turbidities"], np.array(rows))


def _over_elevation(rows: list[list[float]], elevation: float) -> Array:
    # Steps of the root of elevation are about even in how the light's way through air shrinks.
    nodes = np.sqrt(np.array(_table()["elevations"]) + 5)
    place = math.sqrt(max(elevation + 5, 0))
    return _log_interpolate(place, nodes, np.array(rows))


def _between(value: float, nodes: list[float], rows: Array) -> Array:
    return _log_interpolate(value, np.array(nodes), rows)


def _log_interpolate(place: float, nodes: Array, rows: Array) -> Array:
    logarithms = np.log(np.maximum(rows, _LEAST))
    columns = [np.interp(place, nodes, column) for column in logarithms.T]
    return np.exp(np.array(columns))


def _to_space(rec709: Array, space: WorkingSpace) -> Array:
    """Bring Linear Rec.709, in which the table was measured, to the working space."""
    return np.maximum(space.from_xyz @ np.linalg.solve(_rec709(), rec709), 0)


def _rec709() -> Array:
    """XYZ to Linear Rec.709 (ITU-R BT.709, D65)."""
    xy = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
    white = np.array([0.3127, 0.3290])
    primaries, whole = (
        np.concatenate((point, 1 - point.sum(-1, keepdims=True)), -1) / point[..., 1:2]
        for point in (xy, white)
    )
    return np.linalg.inv(primaries.T * np.linalg.solve(primaries.T, whole))


def _table() -> dict[str, Any]:
    path = Path(__file__).with_name("sky_table.json")
    return dict(json.loads(path.read_text(encoding="utf-8")))
