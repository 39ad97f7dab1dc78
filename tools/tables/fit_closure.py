# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fit the closure of `core.closure` to the V-cavity reference; needs numpy alone.

    python -m tools.tables.fit_closure            print the errors of the constants in use
    python -m tools.tables.fit_closure --write    write core/closure/fitted.py first

The 45a:0 reading: r(1) over σ by least squares; then a and g so that the largest relative error
over σ and ρ is smallest (Gauss-Newton steps on ever higher powers of the error).

Any geometry: at each of 2,007 geometries and 14 σ the best r'(0) and g with r(1) kept, then
polynomials through them by least squares. Takes about a minute.
"""

from __future__ import annotations

import argparse
import importlib
import sys
from pathlib import Path

import numpy as np

from core import closure, oren_nayar
from core.closure import fitted as closure_coefficients
from core.closure import formula
from core.numerics.arrays import Array
from core.vcavity import (
    bounce_series,
    sigma_tables,
    slope_law,
    surface,
)

SLOPES = slope_law.OREN_NAYAR

ROUGHNESS_SCALE = 0.2
"""c of t = σ²/(σ² + c): of 0.1 to 0.6 the one with the smallest error at 45a:0."""

RING_SIGMAS = np.radians(np.concatenate((np.arange(1.0, 51), np.arange(52.0, 91, 2))))
RING_ALBEDOS = np.concatenate((np.linspace(0.01, 0.9, 40), 1 - np.geomspace(0.09, 1e-3, 20), [1.0]))
WHITE_DEGREE = 6
WALK_AT_ZERO = 1.75
"""a at σ = 0. Its value there is free (g = 0); one with few binary digits keeps r = ρ exact."""
WALK_DEGREE, RATIO_DEGREE = 2, 2
BEYOND_50 = 0.7
"""Weight of errors at σ > 50°, which the requirement does not name."""
NORMS = (2, 4, 8, 16, 32, 64)
"""Powers of the error whose sum is made smallest in turn; the last is the maximum in effect."""
STEPS = 40

ANGLES = np.radians(np.arange(0.0, 86, 5))
AZIMUTHS = np.radians([0.0, 5, 10, 20, 35, 50, 70, 90, 110, 130, 150, 165, 180])
SIGMAS = np.radians([3.0, 6, 10, 15, 20, 25, 30, 35, 40, 45, 50, 60, 75, 90])
ALBEDOS = np.array([0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.94, 0.97, 0.985, 1])
FIRST_DEGREE, OTHER_DEGREE = 5, 4
ROUGHNESS_POWERS = 5
NEAR_GRAZING = 0.3
"""Weight of geometries beyond 77°, where values range over two decades and would rule the fit."""
LATER_FLOOR = 0.003
"""Weight of what white facets add where it is next to nothing, so that it stays bounded."""


def main() -> int:
    """Run the fit."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--write", action="store_true", help="write core/closure/fitted.py")
    write = parser.parse_args().write
    text = render(*fit_ring(), fit_geometry())
    target = Path(closure_coefficients.__file__)
    if write:
        target.write_text(text, encoding="utf-8")
        importlib.reload(closure_coefficients)
    elif text != target.read_text(encoding="utf-8"):
        sys.stdout.write(
            "The constants found here differ from those in use in some digit; --write takes them.\n"
        )
    report()
    return 0


def fit_ring() -> tuple[Array, Array, Array]:
    """Polynomials in t of r(1), a and the logarithm of g / ((1 - g) t)."""
    t = RING_SIGMAS**2 / (RING_SIGMAS**2 + ROUGHNESS_SCALE)
    readings = bounce_series.evaluate(sigma_tables.ring(SLOPES).rows(RING_SIGMAS), RING_ALBEDOS)
    powers = t[:, np.newaxis] ** np.arange(1, WHITE_DEGREE + 1)
    white = np.concatenate(([1.0], np.linalg.lstsq(powers, readings[:, -1] - 1, rcond=None)[0]))
    white_values = np.polynomial.polynomial.polyval(t, white)

    def split(parameters: Array) -> tuple[Array, Array]:
        return (
            np.concatenate(([WALK_AT_ZERO], parameters[:WALK_DEGREE])),
            parameters[WALK_DEGREE:],
        )

    weight = np.where(np.degrees(RING_SIGMAS) > 50.5, BEYOND_50, 1.0)[:, np.newaxis]

    def residual(parameters: Array) -> Array:
        walk, odds = (np.polynomial.polynomial.polyval(t, p) for p in split(parameters))
        ratio = t * np.exp(odds) / (1 + t * np.exp(odds))
        single = white_values - walk / (1 + np.sqrt(1 - ratio))
        fitted = form(single, walk, ratio, RING_ALBEDOS)
        return np.asarray(((fitted / readings - 1) * weight).ravel())

    parameters = np.zeros(WALK_DEGREE + RATIO_DEGREE + 1)
    shifts = np.eye(parameters.size) * 1e-6
    for power in NORMS:
        for _ in range(STEPS):
            error = residual(parameters)
            jacobian = np.stack([(residual(parameters + s) - error) / 1e-6 for s in shifts], -1)
            # Weighted least squares whose fixed point is the smallest sum of |error|^power.
            root = (np.abs(error) / np.abs(error).max()) ** (power / 2 - 1)
            move = np.linalg.lstsq(jacobian * root[:, np.newaxis], -error * root, rcond=None)[0]
            parameters = parameters + np.clip(move / (power - 1), -0.5, 0.5)
    return white, *split(parameters)


def fit_geometry() -> Array:
    """Coefficients of `core.closure.combine`'s three functions: (3, terms, powers of t)."""
    geometry, rows = solve_grid()
    readings = evaluate_rows(rows, ALBEDOS)
    first, white, ratio = best_of_form(rows, readings)
    t = closure.roughness_variable(SIGMAS)
    later = white - first
    steepest = formula._STEEPEST
    share = np.minimum(ratio / steepest, steepest)
    weight = np.where(geometry[:, :1] > np.radians(77), NEAR_GRAZING, 1.0)
    later_weight = (np.minimum(later / white, 1) + LATER_FLOOR) * weight
    half = np.tan(geometry[:, :2] / 2)
    out = np.zeros((0, 0, 0))
    for index, (target, target_weight, degree) in enumerate(
        (
            (np.log(first) / t, t * weight, FIRST_DEGREE),
            (np.log(later / t), later_weight, OTHER_DEGREE),
            (np.log(share / (1 - share) / t), later_weight, OTHER_DEGREE),
        )
    ):
        terms = closure.monomials(half[:, 0], half[:, 1], np.cos(geometry[:, 2]), degree)
        if not out.size:
            out = np.zeros((3, terms.shape[0], ROUGHNESS_POWERS))
        powers = t[:, np.newaxis] ** np.arange(ROUGHNESS_POWERS)
        design = (
            np.einsum("ig,sk->gsik", terms, powers) * target_weight[..., np.newaxis, np.newaxis]
        )
        design = design.reshape(-1, terms.shape[0] * ROUGHNESS_POWERS)
        values = (target * target_weight).ravel()
        solved = np.linalg.lstsq(design, values, rcond=1e-12)[0]
        out[index, : terms.shape[0]] = solved.reshape(-1, ROUGHNESS_POWERS)
    return out


def solve_grid() -> tuple[Array, Array]:
    """Geometries (n, 3) and the reference's series for every σ, (n, σ, K + J)."""
    geometry = np.array(
        [
            (light, view, azimuth)
            for index, light in enumerate(ANGLES)
            for view in ANGLES[: index + 1]
            for azimuth in (AZIMUTHS if view > 0 else AZIMUTHS[:1])
        ]
    )
    weights = slope_law.weights(SIGMAS, surface.STANDARD.slopes, SLOPES)
    rows = [
        weights @ surface.response(part[:, 0], part[:, 1], part[:, 2], sigma_tables.SERIES_BOUNCES)
        for part in np.array_split(geometry, geometry.shape[0] // 2)
    ]
    return geometry, np.concatenate(rows)


def evaluate_rows(rows: Array, albedos: Array) -> Array:
    """Evaluate r of rows (..., K + J) at albedos (bands,): shape (..., bands)."""
    return bounce_series.evaluate(rows, albedos)


def form(single: Array, walk: Array, ratio: Array, albedos: Array) -> Array:
    """Evaluate the closure for parameters (...,) at albedos (bands,): shape (..., bands)."""
    single, walk, ratio = (p[..., np.newaxis] for p in (single, walk, ratio))
    return np.asarray(albedos * (single + walk / (1 + np.sqrt(1 - ratio * albedos))))


def best_of_form(rows: Array, readings: Array) -> tuple[Array, Array, Array]:
    """r'(0), r(1) and g of the closest closure at each geometry and σ, by Gauss-Newton steps."""
    white = readings[..., -1]
    first = rows[..., 0].copy()
    start = np.clip(2 * rows[..., 2] / np.maximum(rows[..., 1], 1e-300), 1e-6, 0.97)
    logit = np.log(start / (1 - start))

    def residual(first: Array, logit: Array) -> Array:
        ratio = 1 / (1 + np.exp(-logit))
        walk = 2 * (white - first) * (1 + np.sqrt(1 - ratio)) ** 2 / ratio
        return form(first - walk / 2, walk, ratio, ALBEDOS) / readings - 1

    for _ in range(40):
        error = residual(first, logit)
        by_first = (residual(first * (1 + 1e-6), logit) - error) / 1e-6
        by_logit = (residual(first, logit + 1e-5) - error) / 1e-5
        ff, gg = (by_first**2).sum(-1), (by_logit**2).sum(-1) * (1 + 1e-9) + 1e-30
        fg = (by_first * by_logit).sum(-1)
        fe, ge = -(by_first * error).sum(-1), -(by_logit * error).sum(-1)
        determinant = ff * gg - fg * fg
        first = first * (1 + np.clip((gg * fe - fg * ge) / determinant, -0.05, 0.05))
        logit = np.clip(logit + np.clip((ff * ge - fg * fe) / determinant, -0.3, 0.3), -20, 7)
    return first, white, 1 / (1 + np.exp(-logit))


def render(white: Array, walk: Array, ratio: Array, geometry: Array) -> str:
    """Source of core/closure/fitted.py."""

    def numbers(values: Array, indent: str = "    ") -> str:
        return "".join(f"{indent}{value:.9g},\n" for value in values)

    table = "".join(
        "    [\n"
        + "".join(f"        [{', '.join(f'{v:.9g}' for v in row)}],\n" for row in rows)
        + "    ],\n"
        for rows in geometry
    )
    return f'''# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Constants of `core.closure`, written by tools/tables/fit_closure.py; not by hand."""

import numpy as np

ROUGHNESS_SCALE = {ROUGHNESS_SCALE}
"""c of t = σ²/(σ² + c), radians squared."""

# Polynomials in t, constant term first.
RING_WHITE = (
{numbers(white)})
"""r(ρ = 1) at 45a:0."""

RING_WALK = (
{numbers(walk)})
"""a at 45a:0."""

RING_RATIO = (
{numbers(ratio)})
"""Logarithm of g / ((1 - g) t) at 45a:0."""

DEGREE = {FIRST_DEGREE}
"""Degree of the monomials in GEOMETRY."""

# fmt: off
GEOMETRY = np.array([
{table}])
"""Three functions, their monomials as in `core.closure.monomials`, and of each the powers of t:
the logarithm of r'(0) over t, of what white facets add over t, and of the odds of g over t."""
'''


def report() -> None:
    """Print the worst errors of what core/closure/fitted.py holds."""
    sigma = np.radians(np.concatenate((np.arange(0.5, 50.1, 0.5), np.arange(51.0, 91))))
    readings = evaluate_rows(sigma_tables.ring(SLOPES).rows(sigma), RING_ALBEDOS)
    fitted = form(*closure.coefficients(sigma), RING_ALBEDOS)
    error = np.abs(fitted / readings - 1)
    inner = sigma < np.radians(50.1)
    sys.stdout.write(
        f"45a:0: worst {error[inner].max():.4%} for σ ≤ 50°, {error.max():.4%} for σ ≤ 90°; "
        f"at ρ = 1 {error[:, -1].max():.5%}\n"
    )
    geometry, rows = solve_grid()
    readings = evaluate_rows(rows, ALBEDOS)
    angles = (geometry[:, :1], geometry[:, 1:2], geometry[:, 2:])
    ours = np.abs(form(*closure.factors(*angles, SIGMAS), ALBEDOS) / readings - 1)
    published = oren_nayar.reflectance(ALBEDOS, *angles, SIGMAS) / readings - 1
    inner = np.degrees(SIGMAS) < 50.1
    for limit in (75, 80, 85):
        near = geometry[:, 0] < np.radians(limit + 1)
        line = [f"polar angles to {limit}°, σ ≤ 50°, over ρ, mean / 95 % / 99 % / worst:"]
        for name, values in (("closure", ours), ("published", np.abs(published))):
            worst = values[near][:, inner].max(axis=-1)
            quantiles = np.quantile(worst, [0.95, 0.99, 1])
            line.append(f"{name} {worst.mean():.2%} " + " ".join(f"{q:.2%}" for q in quantiles))
        better = ours[near][:, inner].max(-1) < np.abs(published)[near][:, inner].max(-1)
        line.append(f"closer at {better.mean():.2%} of geometry and σ,")
        whole = ours[near][:, inner].max((1, 2)) < np.abs(published)[near][:, inner].max((1, 2))
        line.append(f"{whole.mean():.2%} of geometries")
        sys.stdout.write("  ".join(line) + "\n")


if __name__ == "__main__":
    sys.exit(main())
