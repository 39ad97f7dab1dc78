# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles' Diffuse closure with its derivatives, for searches that return to the same directions.

The same numbers as `cycles.reflectance`, without its checks: a search stays within the domain.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .arrays import Array
from .cycles import ALBEDO_SPAN, MEAN_SPAN, albedo_shape


class Directions(NamedTuple):
    """What of the closure only the directions decide, each of shape (directions, 1)."""

    tilt: Array
    lost: Array


def prepare(theta_i: Array, theta_r: Array, delta_phi: Array) -> Directions:
    """Compute what of the closure only the directions decide; angles in radians, (directions,)."""
    tilt = np.sin(theta_i) * np.sin(theta_r) * np.cos(delta_phi)
    tilt = np.where(tilt > 0, tilt / np.maximum(np.cos(theta_i), np.cos(theta_r)), tilt)
    lost = (ALBEDO_SPAN - albedo_shape(theta_i)) * (ALBEDO_SPAN - albedo_shape(theta_r))
    return Directions(tilt[:, np.newaxis], lost[:, np.newaxis])


def reflectance(
    color: Array, roughness: Array, directions: Directions
) -> tuple[Array, Array, Array]:
    """Reflectance factor, and its derivatives by color and by roughness.

    Parameters
    ----------
    color
        Scene-linear RGB, shape (materials, 3).
    roughness
        Cycles' roughness, shape (materials,).

    Returns
    -------
    reflected, by_color, by_roughness
        Each of shape (materials, directions, 3). A channel follows only its own color.
    """
    c, s = color[:, np.newaxis], roughness[:, np.newaxis, np.newaxis]
    a = 1 / (np.pi + s * ALBEDO_SPAN)
    # a' = -a² k with k the albedo span, so (s a)' = π a².
    single = np.pi * a * (1 + s * directions.tilt)
    single_slope = np.pi * a * a * (np.pi * directions.tilt - ALBEDO_SPAN)
    ratio, ratio_slope = s * a * MEAN_SPAN, np.pi * a * a * MEAN_SPAN
    lost = directions.lost / MEAN_SPAN**2
    multiple, multiple_slope = (
        lost * ratio * (1 - ratio),
        lost * ratio_slope * (1 - 2 * ratio),
    )
    rest = 1 / (1 - c * ratio)
    square = c * c * rest
    reflected = c * (single + square * multiple)
    by_color = single + square * multiple * (3 - 2 * c * ratio) * rest
    by_roughness = c * (
        single_slope + square * (multiple_slope + multiple * c * ratio_slope * rest)
    )
    return reflected, by_color, by_roughness
