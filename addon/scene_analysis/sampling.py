# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From rays to a few weighted directions a material. No Blender here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array
from ...core.geometry import STEEPEST
from .. import light_spectrum

GEOMETRIES = 32
"""Directions that stand for a material's; a light has at least `_LEAST_OF_LIGHT` of them."""
SAME_COLOR = 0.003
"""Distance in u'v' below which lights count as one color; eyes tell apart about 0.002."""
MOST_LIGHTS = 4
"""Colors of light that are told apart; beyond, the faintest joins the nearest."""
LEAST_SHARE = 0.01
"""A light with a smaller part in the light on a material is left out of its matching."""
_LEAST_OF_LIGHT = 4
_DARK = 0.01
"""Part of the median irradiance below which a place counts as dark: its color shows little."""


@dataclass(frozen=True)
class Samples:
    """Ways of light: from a lamp over a surface into the camera; arrays of shape (ways,).

    Parameters
    ----------
    theta_i, theta_r, delta_phi
        Radians.
    hit
        Index of the place on the surface.
    lamp
        Index of the lamp.
    light
        Luminance that arrives.
    toward
        Where it comes from, unit vectors of shape (ways, 3).
    """

    theta_i: Array
    theta_r: Array
    delta_phi: Array
    hit: Array
    lamp: Array
    light: Array
    toward: Array

    def __getitem__(self, kept: Array) -> Samples:
        """Give some of the ways."""
        return Samples(*(array[kept] for array in self.__dict__.values()))


def angles(normals: Array, view: Array, toward: Array) -> tuple[Array, Array, Array]:
    """θi, θr and Δφ of unit vectors of shape (ways, 3), no steeper than models hold."""
    cos_i, cos_r, cos = (
        np.clip(np.einsum("ij,ij->i", *pair), -1, 1)
        for pair in ((toward, normals), (view, normals), (toward, view))
    )
    theta_i, theta_r = np.arccos(cos_i), np.arccos(cos_r)
    level = np.sin(theta_i) * np.sin(theta_r)
    along = (cos - cos_i * cos_r) / np.maximum(level, 1e-9)
    # Straight down the normal azimuth has no meaning.
    phi = np.where(level > 1e-6, np.arccos(np.clip(along, -1, 1)), 0)
    return np.minimum(theta_i, STEEPEST), np.minimum(theta_r, STEEPEST), phi


def per_place(samples: Samples, hits: int, materials: Array) -> Array:
    """Give each way its part in the light at its place.

    Places in the dark have none, unless all of their material lie in the dark.

    Parameters
    ----------
    samples
        Ways of light.
    hits
        How many places there are.
    materials
        Index of the material of each, shape (hits,).
    """
    total = np.bincount(samples.hit, samples.light, minlength=hits)
    lit = total[total > 0]
    if not lit.size:
        return np.zeros(samples.light.size)
    bright = total > _DARK * np.median(lit)
    counted = bright | ~np.isin(materials, materials[bright])
    return np.asarray(
        np.where(counted[samples.hit], samples.light / np.maximum(total[samples.hit], 1e-300), 0)
    )


def group_colors(xyz: Array, power: Array) -> Array:
    """Put lamps of one color together.

    Parameters
    ----------
    xyz
        Colors of the lamps, shape (lamps, 3).
    power
        Their part in the picture's light, shape (lamps,).

    Returns
    -------
    Number of each lamp's group, shape (lamps,), 0 for the group with most light; -1 for lamps
    without light.
    """
    uv = light_spectrum.to_uv(xyz)
    groups = np.full(len(power), -1)
    leaders: list[int] = []
    for lamp in np.argsort(-power, kind="stable"):
        if not power[lamp] > 0:
            break
        apart = [float(np.linalg.norm(uv[lamp] - uv[leader])) for leader in leaders]
        nearest = int(np.argmin(apart)) if apart else -1
        faint = power[lamp] < LEAST_SHARE * power.sum()
        if apart and (apart[nearest] < SAME_COLOR or len(leaders) == MOST_LIGHTS or faint):
            groups[lamp] = nearest
        else:
            groups[lamp] = len(leaders)
            leaders.append(int(lamp))
    return groups


def reduce(samples: Samples, weights: Array, groups: Array) -> tuple[Array, Array]:
    """Choose a few ways that stand for all of one material's.

    Within a light, ways are put in order of view, light and azimuth, and taken where the sum of
    weights passes even steps: each stands for as much light as the next.

    Parameters
    ----------
    samples, weights
        Of one material.
    groups
        Color group of each way.

    Returns
    -------
    chosen, weight
        Indices of ways, and the weight of each; weights add up to 1.
    """
    total = weights.sum()
    shares = np.bincount(groups, weights) / total
    kept = np.flatnonzero(shares >= LEAST_SHARE)
    shares = shares / shares[kept].sum()
    chosen, weight = [], []
    for light in kept:
        mine = np.flatnonzero((groups == light) & (weights > 0))
        count = max(_LEAST_OF_LIGHT, round(GEOMETRIES * shares[light]))
        ordered = mine[_winding(samples[mine])]
        passed = np.cumsum(weights[ordered])
        steps = (np.arange(count) + 0.5) / count * passed[-1]
        picked, times = np.unique(np.searchsorted(passed, steps), return_counts=True)
        chosen.append(ordered[picked])
        weight.append(shares[light] * times / count)
    return np.concatenate(chosen), np.concatenate(weight)


def _winding(samples: Samples) -> Array:
    """Order in which neighbors are alike in all three angles: a boustrophedon of cells."""
    view = np.floor(samples.theta_r / STEEPEST * 3.999)
    light = np.floor(samples.theta_i / STEEPEST * 3.999)
    light = np.where(view % 2 == 1, 3 - light, light)
    azimuth = np.where((view + light) % 2 == 1, -samples.delta_phi, samples.delta_phi)
    return np.lexsort((azimuth, light, view))
