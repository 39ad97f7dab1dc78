# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Monte-Carlo simulation of the V-cavity surface: rays traced in grooves, nothing else assumed.

Shares no code and no formula with core.vcavity. A groove is three planes in space: two walls and
the mouth. A path enters the mouth where the eye looks, and at every wall it meets it asks by a
shadow ray whether it sees the light; then it goes on in a direction drawn from the cosine lobe of
the wall, until it leaves. With white walls the mean of what the k-th hit sees of the light is a_k.

    python tests/core/vcavity_monte_carlo.py

traces what tests/core/vcavity_traced.csv holds and writes it anew: both slope laws, 4 million paths
each, five minutes on one core.
"""

from __future__ import annotations

import csv
import itertools
import sys
from pathlib import Path

import numpy as np

LAWS = ("gaussian", "oren-nayar")
GEOMETRIES = ((45, 0, 0), (60, 30, 0), (60, 30, 180), (75, 45, 90), (50, 50, 45))
SIGMAS = (10, 20, 30, 40, 50)
ALBEDOS = (0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
TRACED = Path(__file__).with_name("vcavity_traced.csv")
RUNS, PATHS = 4, 1 << 20

BLOCK = 1 << 16
"""Paths traced together: their arrays stay in a core's cache."""


def bounce_coefficients(theta_i, theta_r, delta_phi, sigma, slopes, *, paths, bounces=256, seed=0):
    """Estimate a_1 … a_K for one geometry (radians): the mean, shape (bounces,)."""
    random = np.random.default_rng(seed)
    total = np.zeros(bounces)
    blocks = -(-paths // BLOCK)
    for block in range(blocks):
        slope_rank, azimuth_rank, place = _stratified(random, block, blocks)
        slope = SLOPES[slopes](slope_rank, sigma)
        # The groove is fixed along y; light and view turn together around z.
        azimuth = 2 * np.pi * azimuth_rank
        light = _direction(theta_i, azimuth)
        view = _direction(theta_r, azimuth + delta_phi)
        total += _trace(random, slope, light, view, 2 * place - 1, bounces) / np.cos(theta_i)
    return total / (blocks * BLOCK)


def reflectance(coefficients, albedo):
    """Sum a_k ρ^k; beyond the last bounce each octave of k holds a fixed share of the one before.

    The share is seen in the last two octaves. Leaving the rest out would take 1 % from white
    facets at σ = 50°, and the law a_k ~ 1/k² would still take 0.3 %.
    """
    count = coefficients.size
    albedo = np.asarray(albedo, dtype=float)
    powers = albedo[..., np.newaxis] ** np.arange(1, count + 1)
    last = coefficients[count // 2 :].sum()
    before = coefficients[count // 4 : count // 2].sum()
    share = min(last / before, 0.9) if before > 0 else 0.0
    octave = np.arange(1, 60)
    beyond = albedo[..., np.newaxis] ** (0.75 * count * 2.0**octave) @ (last * share**octave)
    return powers @ coefficients + beyond


def _stratified(random, block, blocks):
    """Three uniform numbers a path: slope and azimuth jittered on a grid, the third at random."""
    side = int(np.sqrt(BLOCK))
    cell = np.arange(BLOCK)
    slope_cell, azimuth_cell = cell // side, cell % side
    slope_rank = (slope_cell + (block + random.random(BLOCK)) / blocks) / side
    azimuth_rank = (azimuth_cell + random.random(BLOCK)) / side
    return slope_rank, azimuth_rank, random.random(BLOCK)


def _gaussian(rank, sigma):
    """Slopes with density tan θ sec²θ exp(-tan²θ / 2 tan²σ), which has a running sum to invert."""
    return np.arctan(np.tan(sigma) * np.sqrt(-2 * np.log1p(-rank)))


def _oren_nayar(rank, sigma):
    """Slopes with density exp(-θ²/2σ²) sin θ on [0, π/2), by inverting its running sum."""
    grid = np.linspace(0, min(np.pi / 2, 10 * sigma), 20001)
    density = np.exp(-0.5 * (grid / sigma) ** 2) * np.sin(grid)
    running = np.concatenate(([0], np.cumsum((density[1:] + density[:-1]) / 2)))
    return np.interp(rank, running / running[-1], grid)


SLOPES = dict(zip(LAWS, (_gaussian, _oren_nayar), strict=True))


def _direction(theta, azimuth):
    """Unit vectors, shape (3, n)."""
    return np.stack(
        (
            np.sin(theta) * np.cos(azimuth),
            np.sin(theta) * np.sin(azimuth),
            np.full_like(azimuth, np.cos(theta)),
        )
    )


def _trace(random, slope, light, view, mouth_x, bounces):
    """Sum over paths of cos(wall, light) at each hit that sees the light, shape (bounces,)."""
    seen = np.zeros(bounces)
    # The walls meet in the y axis; the mouth of half width 1 is the plane z = tan θ.
    sine, cosine = np.sin(slope), np.cos(slope)
    height = np.tan(slope)
    x, z = mouth_x, height.copy()
    dx, dz = -view[0], -view[2]
    lx, lz = light[0], light[2]
    last = np.zeros(slope.size)  # side of the wall just left: -1, +1; 0 is the mouth
    for bounce in range(bounces):
        side, distance = _nearest(x, z, dx, dz, sine, cosine, height, last)
        inside = side != 0
        if not np.all(inside):
            sine, cosine, height, x, z, dx, dz, lx, lz, side, distance = (
                a[inside] for a in (sine, cosine, height, x, z, dx, dz, lx, lz, side, distance)
            )
        if not side.size:
            break
        x, z = x + distance * dx, z + distance * dz
        # The wall at x < 0 has side -1 and the normal (sin θ, 0, cos θ).
        normal_x, normal_z = -side * sine, cosine
        facing = normal_x * lx + normal_z * lz
        blocker, _ = _nearest(x, z, lx, lz, sine, cosine, height, side)
        seen[bounce] = np.sum(facing[(facing > 0) & (blocker == 0)])
        # Cosine lobe: a uniform point on the unit disk, lifted to the hemisphere of the wall. Only
        # x and z of the new direction are needed; the groove looks the same all along y.
        radius = np.sqrt(random.random(side.size))
        turn = 2 * np.pi * random.random(side.size)
        across, up = radius * np.cos(turn), np.sqrt(1 - radius * radius)
        dx = across * normal_z + up * normal_x
        dz = -across * normal_x + up * normal_z
        last = side
    return seen


def _nearest(x, z, dx, dz, sine, cosine, height, last):
    """First plane a ray meets: -1 or +1 for a wall, 0 for the mouth; and the distance to it."""
    distances = []
    for side in (-1, 1):
        off = -side * sine * x + cosine * z
        toward = -side * sine * dx + cosine * dz
        with np.errstate(divide="ignore", invalid="ignore"):
            hit = off / -toward
        distances.append(np.where((toward < 0) & (last != side), hit, np.inf))
    with np.errstate(divide="ignore", invalid="ignore"):
        out = np.where(dz > 0, (height - z) / dz, np.inf)
    left, right = distances
    wall = np.minimum(left, right)
    side = np.where(left < right, -1, 1)
    return np.where(wall < out, side, 0), wall


def traced():
    """Give what the file holds: law, geometry, σ (degrees), r over ALBEDOS, its standard error."""
    with TRACED.open(encoding="utf-8", newline="") as lines:
        for law, *numbers in itertools.islice(csv.reader(lines), 1, None):
            values = [float(number) for number in numbers]
            r, error = np.array(values[4:]).reshape(2, len(ALBEDOS))
            yield law, tuple(values[:3]), values[3], r, error


def main():
    """Write the file."""
    header = ["slopes", "theta_i", "theta_r", "delta_phi", "sigma"]
    header += [f"r({rho})" for rho in ALBEDOS] + [f"error({rho})" for rho in ALBEDOS]
    with TRACED.open("w", encoding="utf-8", newline="") as lines:
        rows = csv.writer(lines, lineterminator="\n")
        rows.writerow(header)
        for law, geometry, sigma in itertools.product(LAWS, GEOMETRIES, SIGMAS):
            angles = np.radians([*geometry, sigma])
            runs = [
                reflectance(bounce_coefficients(*angles, law, paths=PATHS, seed=1 + run), ALBEDOS)
                for run in range(RUNS)
            ]
            mean, error = np.mean(runs, axis=0), np.std(runs, axis=0, ddof=1) / np.sqrt(RUNS)
            numbers = [f"{r:.5f}" for r in mean] + [f"{r:.5f}" for r in error]
            rows.writerow([law, *geometry, sigma, *numbers])
            lines.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
