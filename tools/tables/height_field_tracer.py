# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Light on a rough surface given as heights, all bounces, compiled by numba.

The surface is the triangulated height field z = h[i, j] over a square grid of spacing 1 that
continues periodically; each cell is split along the diagonal from (i, j) to (i + 1, j + 1). Along
a straight line over it the height is linear between the crossings with the grid's lines and
diagonals, so that horizons and hits are exact.

A walk starts anywhere on the surface, with the same chance for the same area, and goes on by
cosine-distributed rays until it leaves. Where its points x_0, x_1 … see light and view, with
f(x) = max(n · d, 0) for a visible direction d and 0 for a hidden one, the mean of

    f_light(x_0) f_view(x_k) / (n_z(x_0) cos θi cos θr)

is a_(k+1), the weight of ρ^(k+1) in the reflectance factor. So one walk serves every pair of
directions and every albedo. A horizon, the steepest slope toward an azimuth, tells for all polar
angles at once which are hidden.
"""

from __future__ import annotations

import numba
import numpy as np

from core.numerics.arrays import Array

TILE = 8
"""Cells of a tile, whose highest point lets a line skip it."""

AZIMUTHS = 48
"""Azimuths in which horizons are found: every 7.5°."""

LIGHTS = 12
"""Of them, those from which light comes, for the mean over all orientations."""

_compiled = numba.njit(cache=True, fastmath={"contract", "arcp", "nsz"})


def tiles(heights: Array) -> Array:
    """Highest point of each tile of cells, shape (n / TILE, n / TILE).

    A cell reaches to the next row and column, and so does a tile.
    """
    n = heights.shape[0]
    reach = heights
    for axis in (0, 1):
        reach = np.maximum(reach, np.roll(reach, -1, axis=axis))
    return np.ascontiguousarray(reach.reshape(n // TILE, TILE, n // TILE, TILE).max(axis=(1, 3)))


@_compiled
def _start(at, step):
    """Distance along a line to the next integer of a coordinate, and between two of them."""
    if step > 1e-12:
        return (np.floor(at) + 1 - at) / step, 1 / step
    if step < -1e-12:
        return (np.ceil(at) - 1 - at) / step, -1 / step
    return np.inf, np.inf


@_compiled
def _along(heights, highest, top, x, y, z, dx, dy, slope, find_hit, before=0.0):
    """Follow a line over the surface from a point of it, or from above if `before` is negative.

    `find_hit`: distance at which a ray of that slope meets the surface, or -1 if it leaves.
    Otherwise: the steepest slope under which the surface is seen from there, at least `slope`.
    `before` is the surface's height over the ray where that starts.
    """
    n = heights.shape[0]
    mask = n - 1
    tx, gx = _start(x, dx)
    ty, gy = _start(y, dy)
    td, gd = _start(x - y, dx - dy)
    before_at = 0.0
    while True:
        # The next crossing of a line x = i, y = j or x - y = k.
        if tx <= ty and tx <= td:
            s = tx
            i = int(np.rint(x + dx * s))
            py = y + dy * s
            j = int(np.floor(py))
            f = py - j
            h = heights[i & mask, j & mask]
            h += f * (heights[i & mask, (j + 1) & mask] - h)
            tx += gx
            enters = (i % TILE) == 0
            ci = i if dx > 0 else i - 1
            cj = j
        elif ty <= td:
            s = ty
            j = int(np.rint(y + dy * s))
            px = x + dx * s
            i = int(np.floor(px))
            f = px - i
            h = heights[i & mask, j & mask]
            h += f * (heights[(i + 1) & mask, j & mask] - h)
            ty += gy
            enters = (j % TILE) == 0
            ci = i
            cj = j if dy > 0 else j - 1
        else:
            s = td
            px = x + dx * s
            i = int(np.floor(px))
            j = i - int(np.rint(x - y + (dx - dy) * s))
            f = px - i
            h = heights[i & mask, j & mask]
            h += f * (heights[(i + 1) & mask, (j + 1) & mask] - h)
            td += gd
            enters = False
            ci = i
            cj = j
        line = z + slope * s
        if find_hit:
            over = h - line
            if over > 0:
                return before_at + (s - before_at) * before / (before - over)
            before, before_at = over, s
        elif h > line:
            slope = (h - z) / s
            line = h
        if slope > 0 and line > top:
            return -1.0 if find_hit else slope
        if enters and slope > 0:
            # Tiles that lie below the line are skipped.
            moved = False
            while highest[(ci & mask) // TILE, (cj & mask) // TILE] <= line:
                ti, tj = ci // TILE, cj // TILE
                sx = np.inf
                if dx > 1e-12:
                    sx = ((ti + 1) * TILE - x) / dx
                elif dx < -1e-12:
                    sx = (ti * TILE - x) / dx
                sy = np.inf
                if dy > 1e-12:
                    sy = ((tj + 1) * TILE - y) / dy
                elif dy < -1e-12:
                    sy = (tj * TILE - y) / dy
                s = min(sx, sy)
                line = z + slope * s
                moved = True
                if line > top:
                    return -1.0 if find_hit else slope
                if sx <= sy:
                    ci = (ti + 1) * TILE if dx > 0 else ti * TILE - 1
                    cj = int(np.floor(y + dy * s))
                else:
                    cj = (tj + 1) * TILE if dy > 0 else tj * TILE - 1
                    ci = int(np.floor(x + dx * s))
            if moved:
                # Go on with the crossings that lie behind: the surface there is below the line.
                px, py = x + dx * s, y + dy * s
                tx, ty = np.inf, np.inf
                if gx < np.inf:
                    a = ci + 1 if dx > 0 else ci
                    tx = (a - x) / dx
                if gy < np.inf:
                    a = cj + 1 if dy > 0 else cj
                    ty = (a - y) / dy
                if gd < np.inf:
                    r = dx - dy
                    d = px - py
                    k = np.floor(d) + 1 if r > 0 else np.ceil(d) - 1
                    td = (k - (x - y)) / r
                before, before_at = -1e-9, s
                if find_hit:
                    # Height right here, so that the next piece starts where it does.
                    fi, fj = px - ci, py - cj
                    h00 = heights[ci & mask, cj & mask]
                    h11 = heights[(ci + 1) & mask, (cj + 1) & mask]
                    if fi >= fj:
                        h10 = heights[(ci + 1) & mask, cj & mask]
                        h = h00 + fi * (h10 - h00) + fj * (h11 - h10)
                    else:
                        h01 = heights[ci & mask, (cj + 1) & mask]
                        h = h00 + fj * (h01 - h00) + fi * (h11 - h01)
                    before = min(h - line, -1e-12)


@_compiled
def _place(heights, x, y):
    """Height and unit normal of the surface at a point seen from above."""
    mask = heights.shape[0] - 1
    i, j = int(np.floor(x)), int(np.floor(y))
    fx, fy = x - i, y - j
    h00 = heights[i & mask, j & mask]
    h11 = heights[(i + 1) & mask, (j + 1) & mask]
    if fx >= fy:
        h10 = heights[(i + 1) & mask, j & mask]
        sx, sy = h10 - h00, h11 - h10
    else:
        h01 = heights[i & mask, (j + 1) & mask]
        sx, sy = h11 - h01, h01 - h00
    nz = 1 / np.sqrt(1 + sx * sx + sy * sy)
    return h00 + fx * sx + fy * sy, -sx * nz, -sy * nz, nz


@_compiled
def _bounce(heights, highest, top, x, y, z, nx, ny, nz):
    """Follow a cosine-distributed ray; return whether it hits, and where."""
    while True:
        r = np.sqrt(np.random.random())
        turn = 2 * np.pi * np.random.random()
        u, v = r * np.cos(turn), r * np.sin(turn)
        w = np.sqrt(max(0.0, 1 - r * r))
        # An orthonormal frame around the normal, which points up.
        a = 1 / (1 + nz)
        b = -nx * ny * a
        dx = u * (1 - nx * nx * a) + v * b + w * nx
        dy = u * b + v * (1 - ny * ny * a) + w * ny
        dz = -u * nx - v * ny + w * nz
        flat = np.sqrt(dx * dx + dy * dy)
        if w > 1e-9:
            break
    if flat < 1e-9:
        return False, x, y
    s = _along(heights, highest, top, x, y, z, dx / flat, dy / flat, dz / flat, True)
    if s < 0:
        return False, x, y
    return True, x + dx / flat * s, y + dy / flat * s


@_compiled
def walk(heights, highest, polar, count, seed, orders):
    """Sum over walks what directions exchange: see the module.

    Parameters
    ----------
    heights, highest
        The field, (n, n) with n a power of two, and its `tiles`.
    polar
        Polar angles (α, β) of `tabulate`: radians, (alphas, 1 + ratios); the first of each row
        is α, the others are the β.
    count, seed
        Walks, and what the random numbers start from.
    orders
        Bounces kept apart; the last takes all later ones.

    Returns
    -------
    float64 sums (orders, alphas, AZIMUTHS, ratios); divided by count · LIGHTS they are a_k.
    """
    np.random.seed(seed)
    n = heights.shape[0]
    top = heights.max()
    alphas, width = polar.shape
    ratios = width - 1
    sine, cosine = np.sin(polar), np.cos(polar)
    cotangent = cosine / np.maximum(sine, 1e-12)
    lowest = cotangent.min()
    out = np.zeros((orders, alphas, AZIMUTHS * ratios))
    first = np.zeros((alphas, LIGHTS))
    seen = np.zeros((alphas, AZIMUTHS * ratios), np.float64)
    side = int(np.sqrt(count))
    stride = AZIMUTHS // LIGHTS
    for index in range(count):
        # One walk in each cell of a coarser grid.
        x = ((index // side) % side + np.random.random()) / side * n
        y = (index % side + np.random.random()) / side * n
        turn = 2 * np.pi * np.random.random()
        z, nx, ny, nz = _place(heights, x, y)
        weight = 1 / nz
        order = 0
        while True:
            for azimuth in range(AZIMUTHS):
                angle = turn + 2 * np.pi * azimuth / AZIMUTHS
                dx, dy = np.cos(angle), np.sin(angle)
                horizon = _along(heights, highest, top, x, y, z, dx, dy, lowest, False)
                tilt = nx * dx + ny * dy
                for a in range(alphas):
                    for b in range(ratios):
                        value = tilt * sine[a, b + 1] + nz * cosine[a, b + 1]
                        hidden = cotangent[a, b + 1] < horizon - 1e-9
                        seen[a, azimuth * ratios + b] = 0.0 if hidden or value < 0 else value
                    if order == 0 and azimuth % stride == 0:
                        value = tilt * sine[a, 0] + nz * cosine[a, 0]
                        hidden = cotangent[a, 0] < horizon - 1e-9
                        value = 0.0 if hidden or value < 0 else value * weight
                        first[a, azimuth // stride] = value
            kept = min(order, orders - 1)
            for a in range(alphas):
                for light in range(LIGHTS):
                    value = first[a, light]
                    if value > 0:
                        turned = light * stride * ratios
                        rest = AZIMUTHS * ratios - turned
                        for k in range(rest):
                            out[kept, a, k] += value * seen[a, turned + k]
                        for k in range(turned):
                            out[kept, a, rest + k] += value * seen[a, k]
            hit, x, y = _bounce(heights, highest, top, x, y, z, nx, ny, nz)
            if not hit:
                break
            z, nx, ny, nz = _place(heights, x, y)
            order += 1
    for a in range(alphas):
        for b in range(ratios):
            scale = 1 / (cosine[a, 0] * cosine[a, b + 1] * count * LIGHTS)
            for azimuth in range(AZIMUTHS):
                out[:, a, azimuth * ratios + b] *= scale
    return out.reshape(orders, alphas, AZIMUTHS, ratios)


@_compiled
def looks(heights, highest, directions, count, seed, orders):
    """Trace paths from the eye: a_1 … in each direction, by another way than `walk`.

    Rays come down from the eye to the surface, go on cosine-distributed, and at every point a ray
    to the light tells whether it is lit. Parameters as in `walk`, but for

    directions
        θi, θr and Δφ, radians, shape (n, 3).

    Returns
    -------
    float64, shape (orders, n).
    """
    np.random.seed(seed)
    n = heights.shape[0]
    top = heights.max() + 1e-6
    out = np.zeros((orders, len(directions)))
    side = int(np.sqrt(count))
    for which in range(len(directions)):
        theta_i, theta_r, delta_phi = directions[which]
        for index in range(side * side):
            x = ((index // side) + np.random.random()) / side * n
            y = (index % side + np.random.random()) / side * n
            turn = 2 * np.pi * np.random.random()
            if theta_r > 1e-6:
                # The eye is at azimuth `turn`: its rays go the other way.
                dx, dy = -np.cos(turn), -np.sin(turn)
                height = _place(heights, x, y)[0]
                slope = -1 / np.tan(theta_r)
                s = _along(heights, highest, top, x, y, top, dx, dy, slope, True, height - top)
                x, y = x + dx * s, y + dy * s
            lx, ly = np.cos(turn + delta_phi), np.sin(turn + delta_phi)
            sine, cosine = np.sin(theta_i), np.cos(theta_i)
            order = 0
            while True:
                z, nx, ny, nz = _place(heights, x, y)
                value = (nx * lx + ny * ly) * sine + nz * cosine
                if value > 0 and theta_i > 1e-6:
                    rise = cosine / sine
                    if _along(heights, highest, top, x, y, z, lx, ly, rise, True) >= 0:
                        value = 0.0
                if value > 0:
                    out[min(order, orders - 1), which] += value / cosine
                hit, x, y = _bounce(heights, highest, top, x, y, z, nx, ny, nz)
                if not hit:
                    break
                order += 1
        out[:, which] /= side * side
    return out
