# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often light meets a wall before it leaves a groove, by following it.

Light enters the mouths of the grooves of `vcavity_monte_carlo` from one direction, and no shadow
ray is needed: what doesn't leave is absorbed. With P_k the part that meets a wall for the k-th time
on white facets, facets of albedo ρ absorb (1 - ρ) Σ P_k ρ^(k-1), which is the emissivity.
"""

from __future__ import annotations

import numpy as np
import vcavity_monte_carlo as grooves


def arrivals(theta, sigma, *, paths, bounces=400, seed=0, **law):
    """Estimate P_1 … P_K for light from `theta` (radians), shape (bounces,)."""
    random = np.random.default_rng(seed)
    total = np.zeros(bounces)
    blocks = -(-paths // grooves.BLOCK)
    for block in range(blocks):
        slope_rank, azimuth_rank, place = grooves._stratified(random, block, blocks)
        slope = grooves._slopes(slope_rank, sigma, **law)
        light = grooves._direction(theta, 2 * np.pi * azimuth_rank)
        total += _hits(random, slope, light, 2 * place - 1, bounces)
    return total / (blocks * grooves.BLOCK)


def emissivity(met, albedo):
    """Sum what is absorbed at each hit; at ρ = 0.95, 1e-9 of it would come after the last."""
    albedo = np.asarray(albedo, float)[..., np.newaxis]
    return (1 - albedo[..., 0]) * (albedo ** np.arange(met.size) @ met)


def _hits(random, slope, light, mouth_x, bounces):
    """Count paths that meet a wall for the 1st to the last time, shape (bounces,)."""
    counted = np.zeros(bounces)
    sine, cosine, height = np.sin(slope), np.cos(slope), np.tan(slope)
    x, z = mouth_x, height.copy()
    dx, dz = -light[0], -light[2]
    last = np.zeros(slope.size)  # side of the wall just left: -1, +1; 0 is the mouth
    for bounce in range(bounces):
        side, distance = grooves._nearest(x, z, dx, dz, sine, cosine, height, last)
        inside = side != 0
        sine, cosine, height, x, z, dx, dz, side, distance = (
            a[inside] for a in (sine, cosine, height, x, z, dx, dz, side, distance)
        )
        counted[bounce] = side.size
        if not side.size:
            break
        x, z = x + distance * dx, z + distance * dz
        # A uniform point on the unit disk, lifted to the hemisphere of the wall: Lambert's law.
        radius, turn = np.sqrt(random.random(side.size)), 2 * np.pi * random.random(side.size)
        across, up = radius * np.cos(turn), np.sqrt(1 - radius * radius)
        dx = across * cosine - up * side * sine
        dz = across * side * sine + up * cosine
        last = side
    return counted
