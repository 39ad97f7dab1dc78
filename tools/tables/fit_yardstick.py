# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tabulate the V-cavity reference for `core.vcavity.tabulated`; needs numpy alone.

    python -m tools.tables.fit_yardstick            print the errors of the table in use
    python -m tools.tables.fit_yardstick --write    write core/vcavity/tabulated_data.py first

The solver is asked at 1,387 geometries for all σ, and again at 9,600 geometries between them: the
largest differences there, by polar angle, azimuth and σ, are the bounds of the table. Takes one
to three minutes.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import textwrap
from itertools import pairwise
from pathlib import Path

import numpy as np

from core.numerics.arrays import Array
from core.vcavity import (
    bounce_series,
    sigma_tables,
    slope_law,
    surface,
    tabulated,
    tabulated_data,
)

TARGET = Path(tabulated_data.__file__)

POLAR = (0, 3, 8, 16, 24, 32, 40, 48, 55, 62, 68, 73, 77, 81, 85)
RATIO = (0, 0.25, 0.5, 0.7, 0.83, 0.92, 0.97, 1)
AZIMUTH = (0, 4, 10, 20, 35, 55, 80, 103, 122, 138, 150, 160, 170, 180)
SIGMA = (0, 1.5, 3, 5, 7, 9.5, 12, 15, 18, 22, 26, 31, 36, 42, 48, 54, 60, 67, 74, 82, 90)
"""Degrees; cubics between these σ miss by 2e-5 in the mean."""
ALBEDO_PLACE = (0, 0.06, 0.2, 0.4, 0.6, 0.8, 0.94, 1)
"""Nodes in 1 - √(1 - ρ), crowded at the ends as one polynomial through all needs them."""
TERMS = 18
"""Singular values kept: 12 miss by up to 1.3 % of the reflectance, 16 by 0.2 %, 20 by 0.05 %."""
FINEST_STEP = 3e-4
"""Of the integers: rounding moves the reflectance by 1e-4 at most."""

BOUND_POLAR = (0, 10, 30, 60, 72, 80, 85)
BOUND_AZIMUTH = (0, 25, 130, 160, 180)
BOUND_SIGMA = (0, 10, 25, 45, 62, 90)
PROBES = 400
"""Geometries in each interval of polar angle and azimuth."""
PROBE_SIGMAS = np.radians(np.concatenate((np.linspace(0.5, 62, 60), np.linspace(63, 90, 20))))
PROBE_ALBEDOS = np.array(
    [0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.85, 0.92, 0.96, 0.985, 0.995, 1.0]
)
SEED = 20260


def main() -> int:
    """Tabulate and measure."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write core/vcavity/tabulated_data.py")
    write = parser.parse_args().write
    if write:
        tables = fit()
        no_bounds = np.zeros([len(edges) - 1 for edges in _bound_edges()], np.int64)
        TARGET.write_text(render(*tables, no_bounds), encoding="utf-8")
        _reload()
        geometry, error = probe()
        TARGET.write_text(render(*tables, bounds(geometry, error)), encoding="utf-8")
        _reload()
    else:
        geometry, error = probe()
    report(geometry, error)
    return 0


def fit() -> tuple[Array, Array]:
    """G at the geometries and B at the nodes of σ and ρ: (n, terms) and (σ · ρ, terms)."""
    polar, azimuth = np.radians(POLAR), np.radians(AZIMUTH)
    geometry = [(0.0, 0.0, 0.0)]
    for larger in polar[1:]:
        geometry.append((larger, 0.0, 0.0))
        geometry += [(larger, larger * q, phi) for q in RATIO[1:] for phi in azimuth]
    albedo = 1 - (1 - np.array(ALBEDO_PLACE)) ** 2
    logs = log_ratio(np.array(geometry), np.radians(SIGMA[1:]), albedo)
    left, values, right = np.linalg.svd(logs.reshape(len(geometry), -1), full_matrices=False)
    return left[:, :TERMS] * values[:TERMS], right[:TERMS].T


def log_ratio(geometry: Array, sigma: Array, albedo: Array) -> Array:
    """Logarithm of r / ρ by the solver: shape (geometries, σ, ρ)."""
    weights = slope_law.weights(sigma, surface.STANDARD.slopes, slope_law.OREN_NAYAR)
    parts = np.array_split(geometry, (len(geometry) + 1) // 2)
    bounces = sigma_tables.SERIES_BOUNCES
    rows = np.concatenate(
        [weights @ surface.response(p[:, 0], p[:, 1], p[:, 2], bounces) for p in parts]
    )
    out = np.empty((*rows.shape[:2], albedo.size))
    lit = albedo > 0
    out[..., lit] = bounce_series.evaluate(rows, albedo[lit]) / albedo[lit]
    out[..., ~lit] = rows[..., :1]
    return np.asarray(np.log(out))


def probe() -> tuple[Array, Array]:
    """Random geometries (n, 3) and the table's relative error there, (n, σ, ρ)."""
    random = np.random.default_rng(SEED)
    parts = []
    for low, high in pairwise(BOUND_POLAR):
        for left, right in pairwise(BOUND_AZIMUTH):
            # Errors are largest at the ends of the intervals and where light and view meet, so
            # the directions crowd there.
            from_low, from_left = np.sin(random.uniform(0, np.pi / 2, (2, PROBES))) ** 2
            larger = np.radians(low + (high - low) * from_low)
            azimuth = np.radians(left + (right - left) * from_left)
            ratio = random.uniform(0, 1, PROBES) ** np.resize((0.5, 0.1, 0.02), PROBES)
            parts.append(np.stack((larger, larger * ratio, azimuth), axis=-1))
    geometry = np.concatenate(parts)
    expected = np.exp(log_ratio(geometry, PROBE_SIGMAS, PROBE_ALBEDOS)) * PROBE_ALBEDOS
    everywhere = np.broadcast_to(PROBE_ALBEDOS, (PROBE_SIGMAS.size, PROBE_ALBEDOS.size))
    light, view, azimuth = geometry.T
    found = tabulated.reflectance(everywhere, light, view, azimuth, PROBE_SIGMAS).swapaxes(0, 1)
    return geometry, np.asarray(found / expected - 1)


def bounds(geometry: Array, error: Array) -> Array:
    """Largest error by interval of polar angle, azimuth and σ, in units of 1e-5, rounded up."""
    worst = np.abs(error).max(axis=-1)
    out = np.zeros([len(edges) - 1 for edges in _bound_edges()], np.int64)
    which = [
        np.searchsorted(np.radians(edges[1:-1]), values)
        for edges, values in zip(
            _bound_edges(), (geometry[:, 0], geometry[:, 2], PROBE_SIGMAS), strict=True
        )
    ]
    for index in np.ndindex(*out.shape):
        rows = (which[0] == index[0]) & (which[1] == index[1])
        out[index] = np.ceil(worst[rows][:, which[2] == index[2]].max() * 1e5)
    return out


def render(geometries: Array, basis: Array, bound: Array) -> str:
    """Source of core/vcavity/tabulated_data.py."""
    listed = repr(bound.tolist()).replace("], ", "],\n    ")
    return f'''# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Table of `core.vcavity.tabulated`, written by tools/tables/fit_yardstick.py; not by hand."""

# Nodes: larger polar angle in degrees, smaller over larger, azimuth in degrees.
POLAR = (0, 3, 8, 16, 24, 32, 40, 48, 55, 62, 68, 73, 77, 81, 85)
RATIO = (0, 0.25, 0.5, 0.7, 0.83, 0.92, 0.97, 1)
AZIMUTH = (0, 4, 10, 20, 35, 55, 80, 103, 122, 138, 150, 160, 170, 180)

# Nodes: roughness in degrees, 1 - √(1 - ρ).
SIGMA = {SIGMA}
ALBEDO_PLACE = {ALBEDO_PLACE}

# Largest relative error found, in units of 1e-5, by intervals of larger polar angle, azimuth and
# roughness in degrees.
BOUND_POLAR = {BOUND_POLAR}
BOUND_AZIMUTH = {BOUND_AZIMUTH}
BOUND_SIGMA = {BOUND_SIGMA}
# fmt: off
BOUND = {listed}

# Columns of integers and what one unit of each is worth; see `core.vcavity.tabulated.unpack`.
{_columns("GEOMETRY_STEPS", "GEOMETRIES", geometries)}
{_columns("BASIS_STEPS", "BASIS", basis)}'''


def _columns(steps_name: str, name: str, values: Array) -> str:
    finest = FINEST_STEP if name == "GEOMETRIES" else 0.0
    steps = [f"{x:.6g}" for x in np.maximum(np.abs(values).max(axis=0) / 32000, finest)]
    text = tabulated.pack(values, np.array(steps, np.float64))
    lines = "".join(f'    "{text[start : start + 92]}"\n' for start in range(0, len(text), 92))
    listed = textwrap.fill(", ".join(steps), 94, initial_indent="    ", subsequent_indent="    ")
    return f"{steps_name} = (\n{listed},\n)\n{name} = (\n{lines})\n"


def _bound_edges() -> tuple[tuple[float, ...], ...]:
    return BOUND_POLAR, BOUND_AZIMUTH, BOUND_SIGMA


def _reload() -> None:
    importlib.reload(tabulated_data)
    tabulated._geometries.cache_clear()
    tabulated._basis.cache_clear()


def report(geometry: Array, error: Array) -> None:
    """Print the errors found, over σ and ρ, and the size of the table."""
    worst = np.abs(error).max(axis=-1)
    sys.stdout.write(f"{TARGET.name}: {TARGET.stat().st_size} bytes\n")
    for limit, steepest in ((80, 62), (85, 62), (85, 90)):
        near = worst[geometry[:, 0] < np.radians(limit)][:, np.radians(steepest) > PROBE_SIGMAS]
        quantiles = " / ".join(f"{q:.3%}" for q in np.quantile(near, [0.5, 0.95, 0.99, 1]))
        sys.stdout.write(
            f"polar angles to {limit}°, σ ≤ {steepest}°, worst over ρ: median / 95 % / 99 % / "
            f"worst {quantiles}\n"
        )
    exceeded = worst > tabulated.bound(
        geometry[:, :1], geometry[:, 1:2], geometry[:, 2:], PROBE_SIGMAS
    )
    sys.stdout.write(f"beyond the bound: {exceeded.mean():.3%}\n")


if __name__ == "__main__":
    sys.exit(main())
