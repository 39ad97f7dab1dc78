# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two lobes of renderers as formulas: EON and Cycles' own, matched as their users would.

Who works in a renderer has the color that an instrument read at 45°/0°, and a slider. So a lobe
gets the color with which it reads the same there, and for each roughness of the surface the slider
with which it comes closest over all directions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from core import cycles, lobes
from tools.chart.chart_work import RING, Array

SLIDERS = np.linspace(0, 1, 41)


def eon(color: Array, roughness: Any, angles: Array) -> Array:
    """Reflectance factor of EON, the rough diffuse of OpenPBR: `core.lobes.eon`.

    Parameters
    ----------
    color
        ρ, shape (..., channels).
    roughness
        r, 0 to 1; broadcasts against the leading axes of `color`.
    angles
        θi, θr and Δφ, radians, three arrays that broadcast against the same.

    Returns
    -------
    Shape (..., channels), in the precision of `color`.
    """
    return lobes.reflected(color, _terms(color, roughness, angles))


def eon_color(reading: Array, roughness: Any) -> Array:
    """Color with which EON reads this at 45°/0°."""
    return lobes.color_for(reading, _terms(reading, roughness, np.array(RING)))


def _terms(color: Array, roughness: Any, angles: Array) -> tuple[Array, Array, Array]:
    s, *three = (np.asarray(x, color.dtype) for x in (roughness, *angles))
    return lobes.EON.terms(s, *three)


def cycles_lobe(color: Array, roughness: Any, angles: Array) -> Array:
    """Reflectance factor of Cycles' Diffuse BSDF; arguments as those of `eon`."""
    return cycles.reflectance(color, roughness, *angles)


@dataclass(frozen=True)
class Lobe:
    """A lobe: its formula, and the color with which it gives a reading at 45°/0°."""

    label: str
    about: str
    reflectance: Callable[[Array, Any, Array], Array]
    color: Callable[[Array, Any], Array]


LOBES = {
    "eon": Lobe("EON (OpenPBR)", "the energy-preserving Oren-Nayar as a formula", eon, eon_color),
    "cycles": Lobe(
        "Cycles Diffuse",
        "the lobe of Cycles as a formula",
        cycles_lobe,
        cycles.color_for_reading,
    ),
}


def match(
    of: Lobe, readings: Array, angles: Array, error: Callable[[Array], float]
) -> tuple[Array, float]:
    """Give the answer of a lobe at the slider with the least error.

    Parameters
    ----------
    of
        The lobe.
    readings
        RGB at 45°/0°, shape (patches, 3).
    angles
        Shape (3, geometries).
    error
        Of an answer (geometries, patches, 3).

    Returns
    -------
    That answer, and the slider.
    """
    tried = []
    for slider in SLIDERS:
        color = of.color(readings, slider)
        answer = of.reflectance(color[np.newaxis], slider, angles[:, :, np.newaxis])
        tried.append((error(answer), float(slider), answer))
    _, slider, answer = min(tried, key=lambda one: one[0])
    return answer, slider
