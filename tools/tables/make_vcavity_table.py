# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the table of the model "closure" from the solver of the V-cavity; needs numpy alone.

python3 dev.py tables make_vcavity_table            print what the table in use misses
python3 dev.py tables make_vcavity_table --write    write core/vcavity/closed_data.py first

The solver is asked at the table's directions for all σ, and the closed form that misses least over
the albedos is tabulated; then the solver is asked again in random directions between. Led exactly
through three albedos the form would miss by up to 1.8 % where its best misses by 0.8 %. Takes two
minutes.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from core.closure import table
from core.numerics.arrays import Array
from core.vcavity import bounce_series, closed, closed_data, sigma_tables, slope_law, surface

from .table_file import render

TARGET = Path(closed_data.__file__)
SIGMA = (0, 2.5, 5, 7.5, 10, 14, 18, 22, 26, 30, 35, 40, 45, 50, 55, 60, 65)
"""Degrees. At 60° the form misses 45a:0 by 0.3 %, and by ten times as much at 75°."""
POLAR = (0, 8, 16, 24, 31, 38, 45, 52, 58, 64, 69, 73, 77, 81, 85)
"""Degrees, of the larger polar angle."""
RATIO = (0, 0.2, 0.4, 0.6, 0.76, 0.88, 0.95, 1)
"""The smaller polar angle over the larger one."""
AZIMUTH = (0, 7.5, 15, 22.5, 30, 45, 60, 75, 90, 105, 120, 135, 147, 157, 166, 173, 180)
"""Degrees."""
MEETING = 0.6
"""The albedo between; what is fitted does not depend on it."""

ALBEDOS = np.concatenate((np.linspace(0.02, 0.9, 20), [0.92, 0.94, 0.96, 0.975, 0.985, 0.993, 1.0]))
"""Over which the largest relative error is made smallest."""
NORMS = (2, 4, 8, 16, 32)
"""Powers of the error whose sum is made smallest in turn; the last is the maximum in effect."""
STEPS = 8
"""Gauss-Newton steps for each."""

PROBES = 600
PROBE_SIGMAS = np.radians(np.linspace(1, 65, 65))
PROBE_ALBEDOS = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.7, 0.85, 0.92, 0.96, 0.985, 1.0])
SEED = 20261


def main() -> int:
    """Make the table and say what it misses."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help=f"write {TARGET.name} first")
    if parser.parse_args().write:
        TARGET.write_text(rendered(anchors()), encoding="utf-8")
        importlib.reload(closed_data)
        importlib.reload(closed)
    report()
    return 0


def solve(geometry: Array, sigma: Array) -> Array:
    """Series of the V-cavity in directions (n, 3), radians, at every σ: shape (n, σ, K + J)."""
    weights = slope_law.weights(sigma, surface.STANDARD.slopes)
    bounces = sigma_tables.SERIES_BOUNCES
    parts = np.array_split(geometry, (len(geometry) + 1) // 2)
    columns = (part.T for part in parts)
    rows = (surface.response(light, view, turn, bounces) for light, view, turn in columns)
    return np.concatenate([weights @ row for row in rows])


def anchors() -> Array:
    """Anchors at the nodes: shape (polar, ratio, azimuth, σ without 0, 3)."""
    larger, ratio, azimuth = np.meshgrid(
        np.radians(POLAR), RATIO, np.radians(AZIMUTH), indexing="ij"
    )
    nodes = np.stack((larger, larger * ratio, azimuth), axis=-1).reshape(-1, 3)
    # Along the normal azimuth has no meaning: there each direction is solved but once.
    nodes[:, 2] *= nodes[:, 1] > 0
    geometry, which = np.unique(nodes, axis=0, return_inverse=True)
    rows = solve(geometry, np.radians(SIGMA[1:]))
    found = best_of_form(rows)
    return np.asarray(found[which.ravel()].reshape(*larger.shape, len(SIGMA) - 1, table.ANCHORS))


def best_of_form(rows: Array) -> Array:
    """Anchors of the closed forms that miss series (..., K + J) least: shape (..., 3)."""
    expected = bounce_series.evaluate(rows, ALBEDOS) / ALBEDOS
    ends = bounce_series.evaluate(rows, np.array([MEETING, 1.0])) / [MEETING, 1.0]
    found = np.log(np.concatenate((rows[..., :1], ends), axis=-1))

    def missed(anchor: Array) -> Array:
        b, a, g = (x[..., np.newaxis] for x in table.through(anchor, MEETING))
        return np.asarray((b + a / (1 + np.sqrt(1 - g * ALBEDOS))) / expected - 1)

    least, best = np.abs(missed(found)).max(axis=-1), found.copy()
    shifts = np.eye(table.ANCHORS) * 1e-6
    for power in NORMS:
        for _ in range(STEPS):
            error = missed(found)
            jacobian = np.stack([(missed(found + shift) - error) / 1e-6 for shift in shifts], -1)
            largest = np.maximum(np.abs(error).max(axis=-1, keepdims=True), 1e-12)
            weight = (np.abs(error) / largest) ** (power - 2) + 1e-9
            weighted = jacobian * weight[..., np.newaxis]
            square = np.einsum("...ak,...al->...kl", weighted, jacobian)
            # Where facets hardly see each other, g hardly matters: it stays near where it was.
            square += 1e-6 * np.einsum("...kk", square)[..., None, None] * np.eye(table.ANCHORS)
            slope = np.einsum("...ak,...a->...k", weighted, error)
            move = np.linalg.solve(square, slope[..., np.newaxis])[..., 0] / (power - 1)
            found = found - np.clip(move, -0.05, 0.05)
            worst = np.abs(missed(found)).max(axis=-1)
            better = worst < least
            best[better], least = found[better], np.minimum(worst, least)
    return best


def rendered(values: Array) -> str:
    """Text of the module that holds the table."""
    rows = table.packable(values)
    nodes: dict[str, Sequence[float]] = {
        "SIGMA": SIGMA,
        "POLAR": POLAR,
        "RATIO": RATIO,
        "AZIMUTH": AZIMUTH,
    }
    return render("closure", "tools/tables/make_vcavity_table.py", nodes, MEETING, rows)


def report() -> None:
    """Print the largest relative errors over the albedos."""
    random = np.random.default_rng(SEED)
    polar = np.arcsin(np.sqrt(random.random((PROBES, 2))) * np.sin(np.radians(80)))
    probes = np.column_stack((polar.max(axis=1), polar.min(axis=1), random.random(PROBES) * np.pi))
    # As many where light and view nearly meet.
    probes[::4, 1] = probes[::4, 0] * random.random(len(probes[::4])) ** 0.1
    probes[::4, 2] *= random.random(len(probes[::4])) ** 3
    for name, geometry in (
        ("45a:0", np.array([[np.pi / 4, 0.0, 0.0]])),
        ("below 80°", probes),
    ):
        expected = bounce_series.evaluate(solve(geometry, PROBE_SIGMAS), PROBE_ALBEDOS)
        light, view, azimuth = (geometry[:, i : i + 1] for i in range(3))
        found = closed.reflectance(PROBE_ALBEDOS, light, view, azimuth, PROBE_SIGMAS)
        worst = np.abs(found / expected - 1).max(axis=-1)
        for low, high in ((0, 10), (10, 30), (30, 50), (50, 65)):
            degrees = np.degrees(PROBE_SIGMAS)
            inside = np.abs(degrees - (low + high) / 2) < (high - low) / 2 + 0.1
            quantiles = np.quantile(worst[:, inside], [0.5, 0.95, 0.99, 1])
            sys.stdout.write(
                f"{name}, σ {low} to {high}°, worst over ρ: median / 95 % / 99 % / worst "
                + " / ".join(f"{q:.2%}" for q in quantiles)
                + "\n"
            )


if __name__ == "__main__":
    raise SystemExit(main())
