# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles' Diffuse closure with its derivatives, for searches that return to the same directions.

The closure is a sum of three functions of the directions alone, each times a number that color and
roughness decide: a search computes the functions once. The same numbers as `cycles.reflectance`,
without its checks: a search stays within the domain.
"""

from __future__ import annotations

import numpy as np

from .arrays import Array
from .cycles import ALBEDO_SPAN, MEAN_SPAN, albedo_shape


def functions(theta_i: Array, theta_r: Array, delta_phi: Array) -> Array:
    """Give 1, the tilt of the facets and the light that single scattering lost.

    Parameters
    ----------
    theta_i, theta_r, delta_phi
        Radians, shape (directions,).

    Returns
    -------
    Shape (3, directions).
    """
    tilt = np.sin(theta_i) * np.sin(theta_r) * np.cos(delta_phi)
    tilt = np.where(tilt > 0, tilt / np.maximum(np.cos(theta_i), np.cos(theta_r)), tilt)
    lost = (ALBEDO_SPAN - albedo_shape(theta_i)) * (ALBEDO_SPAN - albedo_shape(theta_r))
    return np.stack((np.ones_like(tilt), tilt, lost / MEAN_SPAN**2))


def coefficients(color: Array, roughness: Array) -> Array:
    """Give what the three functions are multiplied with, and its derivatives.

    Parameters
    ----------
    color
        Scene-linear RGB, shape (materials, 3).
    roughness
        Cycles' roughness, shape (materials,).

    Returns
    -------
    Shape (materials, 5, 3, 3): the value, its derivatives by red, green, blue and roughness; then
    channel; then function. `found[:, 0] @ functions(…)` is the reflectance factor.
    """
    s = roughness[:, np.newaxis]
    a = 1 / (np.pi + s * ALBEDO_SPAN)
    # a' = -a² k with k the albedo span, so (s a)' = π a².
    rise = np.pi * a * a
    ratio = MEAN_SPAN * s * a
    left = ratio - ratio * ratio
    rest = 1 / (1 - color * ratio)
    square = color * color * rest
    found = np.zeros((len(color), 5, 3, 3))
    by_color = np.empty((*color.shape, 3))
    by_color[..., 0] = np.pi * a
    by_color[..., 1] = np.pi * s * a
    # With b the color times ratio: (c³ / (1 - b))' = c² (3 - 2b) / (1 - b)².
    by_color[..., 2] = square * (2 + rest) * left
    found[:, (1, 2, 3), (0, 1, 2)] = by_color
    cube = color * square
    value = color[..., np.newaxis] * by_color
    value[..., 2] = cube * left
    found[:, 0] = value
    turn = rise * color
    by_roughness = found[:, 4]
    by_roughness[..., 0] = -ALBEDO_SPAN * turn
    by_roughness[..., 1] = np.pi * turn
    by_roughness[..., 2] = MEAN_SPAN * rise * cube * (1 - 2 * ratio + left * color * rest)
    return found
