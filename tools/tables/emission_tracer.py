# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How often light from a direction meets a random surface before it leaves, compiled by numba.

A walk starts anywhere on the surface, as in `height_field_tracer`, with the weight of the light
that falls there: f_light(x) / n_z. It goes on by cosine-distributed rays until it leaves. The sum
of the weights of walks that meet the surface for the k-th time, over that of all, is P_k, the part
of the light that white facets see k times. Nothing is lost: P_1 = 1, and an albedo ρ absorbs
(1 - ρ) Σ P_k ρ^(k-1).
"""

from __future__ import annotations

import numba
import numpy as np

from .height_field_tracer import _along, _bounce, _place

AZIMUTHS = 4
"""Of the light, evenly around each start."""

_compiled = numba.njit(cache=True, fastmath={"contract", "arcp", "nsz"})


@_compiled
def arrivals(heights, highest, polar, count, seed, orders):
    """Sum the weights of walks at each hit.

    Parameters
    ----------
    heights, highest
        The field, (n, n) with n a power of two, and its `height_field_tracer.tiles`.
    polar
        Polar angles of the light, radians below π/2, (angles,).
    count, seed
        Walks, and what the random numbers start from.
    orders
        Hits kept apart; the last takes all later ones.

    Returns
    -------
    float64 sums (angles, orders). The first, over count and cos θ, is 1 but for noise.
    """
    np.random.seed(seed)
    n = heights.shape[0]
    top = heights.max()
    sine, cosine = np.sin(polar), np.cos(polar)
    cotangent = cosine / np.maximum(sine, 1e-12)
    lowest = cotangent.min()
    out = np.zeros((polar.size, orders))
    weight = np.zeros(polar.size)
    side = int(np.sqrt(count))
    for index in range(count):
        # One walk in each cell of a coarser grid.
        x = ((index // side) % side + np.random.random()) / side * n
        y = (index % side + np.random.random()) / side * n
        turn = 2 * np.pi * np.random.random()
        z, nx, ny, nz = _place(heights, x, y)
        weight[:] = 0
        for azimuth in range(AZIMUTHS):
            angle = turn + 2 * np.pi * azimuth / AZIMUTHS
            dx, dy = np.cos(angle), np.sin(angle)
            horizon = _along(heights, highest, top, x, y, z, dx, dy, lowest, False)
            tilt = nx * dx + ny * dy
            for a in range(polar.size):
                value = tilt * sine[a] + nz * cosine[a]
                if value > 0 and cotangent[a] >= horizon - 1e-9:
                    weight[a] += value / (nz * AZIMUTHS)
        order = 0
        while True:
            kept = min(order, orders - 1)
            for a in range(polar.size):
                out[a, kept] += weight[a]
            hit, x, y = _bounce(heights, highest, top, x, y, z, nx, ny, nz)
            if not hit:
                break
            z, nx, ny, nz = _place(heights, x, y)
            order += 1
    return out
