# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From rays to a few weighted directions a material. No Blender here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.numerics.arrays import Array
from ...core.numerics.direction_grid import STEEPEST
from ..colorimetry import illuminant_spectra

SHADING_POINTS = 24
"""Places of a material that stand for all of it."""
SAME_COLOR = 0.003
"""Distance in u'v' below which lights count as one color; eyes tell apart about 0.002."""
MOST_LIGHTS = 4
"""Colors of light that are told apart; beyond, the faintest joins the nearest."""
LEAST_SHARE = 0.01
"""A light with a smaller part in the light on a material is left out of its matching."""
_LEAST_PART = 0.02
"""A light with a smaller part in the light at a place is left out there."""
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


def group_colors(xyz: Array, power: Array, spectra: Array) -> Array:
    """Put lamps of one color together.

    Parameters
    ----------
    xyz
        Colors of the lamps, shape (lamps, 3).
    power
        Their part in the picture's light, shape (lamps,).
    spectra
        Number of the spectrum that is known of each, -1 for none: lamps of different ones stay
        apart, whatever their color. Shape (lamps,).

    Returns
    -------
    Number of each lamp's group, shape (lamps,), 0 for the group with most light; -1 for lamps
    without light.
    """
    uv = illuminant_spectra.to_uv(xyz)
    groups = np.full(len(power), -1)
    leaders: list[int] = []
    for lamp in np.argsort(-power, kind="stable"):
        if not power[lamp] > 0:
            break
        apart = np.array([np.linalg.norm(uv[lamp] - uv[leader]) for leader in leaders])
        alike = spectra[leaders] == spectra[lamp]
        faint = power[lamp] < LEAST_SHARE * power.sum()
        is_known = bool((alike & (apart < SAME_COLOR)).any())
        if leaders and (is_known or len(leaders) == MOST_LIGHTS or faint):
            nearest = int(np.argmin(np.where(alike | (not is_known), apart, np.inf)))
            groups[lamp] = nearest
        else:
            groups[lamp] = len(leaders)
            leaders.append(int(lamp))
    return groups


def reduce(samples: Samples, weights: Array, groups: Array) -> tuple[Array, Array, Array]:
    """Choose a few places that stand for all of one material's.

    Places are put in order of the light that is strongest there, then of view, light and azimuth,
    and taken in even steps. At each, one way of every color of light stands for all of its color.

    Parameters
    ----------
    samples, weights
        Of one material; the weights of the ways at one place add up to 1.
    groups
        Color group of each way.

    Returns
    -------
    chosen, weight, place
        Indices of ways, the weight of each, and the number of its place; weights add up to 1.
    """
    lit = np.flatnonzero((weights > 0) & (groups >= 0))
    # One way for each color at each place: the strongest, with the weight of all.
    order = lit[np.lexsort((-weights[lit], groups[lit], samples.hit[lit]))]
    starts = _starts(samples.hit[order] * (MOST_LIGHTS + 1) + groups[order])
    ways, part = order[starts], np.add.reduceat(weights[order], starts)
    shares = np.bincount(groups[ways], part) / part.sum()
    kept = (shares[groups[ways]] >= LEAST_SHARE) & (part >= _LEAST_PART)
    ways, part = ways[kept], part[kept]
    _, hit = np.unique(samples.hit[ways], return_inverse=True)
    part = part / np.bincount(hit, part)[hit]
    # The strongest way at each place stands for it in the order.
    by_part = np.lexsort((-part, hit))
    main = ways[by_part[_starts(hit[by_part])]]
    ordered = _winding(samples[main], groups[main])
    steps = (np.arange(SHADING_POINTS) + 0.5) / SHADING_POINTS * len(ordered)
    picked, times = np.unique(ordered[steps.astype(int)], return_counts=True)
    number = np.full(len(main), -1)
    number[picked] = np.arange(len(picked))
    chosen = np.flatnonzero(number[hit] >= 0)
    place = number[hit[chosen]]
    return ways[chosen], part[chosen] * times[place] / SHADING_POINTS, place


def _starts(of: Array) -> Array:
    """Where each number begins in a sorted array."""
    return np.flatnonzero(np.r_[True, np.diff(of) != 0])


def _winding(samples: Samples, groups: Array) -> Array:
    """Order by color, then so that neighbors are alike in all angles: a boustrophedon of cells."""
    view = np.floor(samples.theta_r / STEEPEST * 3.999)
    light = np.floor(samples.theta_i / STEEPEST * 3.999)
    light = np.where(view % 2 == 1, 3 - light, light)
    azimuth = np.where((view + light) % 2 == 1, -samples.delta_phi, samples.delta_phi)
    return np.lexsort((azimuth, light, view, groups))
