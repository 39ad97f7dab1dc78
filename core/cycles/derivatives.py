# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles' Diffuse closure with its derivatives, for searches that return to the same directions.

The closure is a sum of three functions of the directions alone, each times a number that color and
roughness decide: a search computes the functions once. The same numbers as `cycles.reflectance`,
without its checks: a search stays within the domain.
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array
from .lobe import ALBEDO_SPAN, MEAN_SPAN, directions

_OTHERS = (0.0,) * 9
"""Between the derivatives of one channel by its color, and of the next by its own."""


def functions(theta_i: Array, theta_r: Array, delta_phi: Array) -> Array:
    """Give 1, what single scattering gains by the tilt of the facets or loses, and what was lost.

    The three are independent of color and roughness, and scaled so that few terms are left.

    Parameters
    ----------
    theta_i, theta_r, delta_phi
        Radians, shape (directions,).

    Returns
    -------
    Shape (3, directions).

    Examples
    --------
    >>> functions(np.array([0.8]), np.array([0.0]), np.array([0.0])).shape
    (3, 1)
    """
    return of_directions(*directions(theta_i, theta_r, delta_phi))


def of_directions(tilt: Array, spread: Array) -> Array:
    """Give the same of what the closure takes from directions, or of its mean over several.

    Parameters
    ----------
    tilt, spread
        As `core.cycles.lobe` takes them, shape (directions,).

    Returns
    -------
    Shape (3, directions).

    Examples
    --------
    >>> of_directions(np.zeros(1), np.ones(1)).shape
    (3, 1)
    """
    # With a = 1 / (π + s k) single scattering is c a (π + π s t), which is c + c s a (π t - k).
    bent = (np.pi * tilt - ALBEDO_SPAN) / MEAN_SPAN
    return np.stack((np.ones_like(tilt), bent, spread / MEAN_SPAN))


def coefficients(materials: list[list[float]]) -> Array:
    """Give what the three functions are multiplied with, and its derivatives.

    In plain numbers: a search has so few materials at once that calling numpy would take several
    times as long as computing them.

    Parameters
    ----------
    materials
        Red, green and blue, scene-linear, and Cycles' roughness of each.

    Returns
    -------
    Shape (materials, 5, 3, 3): the value, its derivatives by red, green, blue and roughness; then
    channel; then function. `found[:, 0] @ functions(…)` is the reflectance factor.

    Examples
    --------
    >>> found = coefficients([[0.2, 0.5, 0.8, 0.6]])
    >>> found.shape
    (1, 5, 3, 3)
    >>> at = functions(np.array([0.8]), np.array([0.0]), np.array([0.0]))
    >>> np.round((found[0, 0] @ at).ravel(), 4).tolist()
    [0.1717, 0.4452, 0.762]
    """
    found: list[float] = []
    for *color, s in materials:
        a = 1 / (np.pi + s * ALBEDO_SPAN)
        # a' = -a² k with k the albedo span, so (s a)' = π a².
        ratio, rise = MEAN_SPAN * s * a, MEAN_SPAN * np.pi * a * a
        other = 1 - ratio
        left = ratio * other
        slopes: list[float] = []
        turns: list[float] = []
        for c in color:
            rest = 1 / (1 - c * ratio)
            square = c * c * rest
            found += (c, c * ratio, c * square * left)
            # With b the color times ratio: (c³ / (1 - b))' = c² (3 - 2b) / (1 - b)². It is only
            # its own color that moves a channel.
            slopes += (1.0, ratio, square * (2 + rest) * left, *_OTHERS)
            turns += (0.0, rise * c, rise * c * square * (other * rest - ratio))
        found += slopes[: -len(_OTHERS)]
        found += turns
    return np.array(found).reshape(-1, 5, 3, 3)
