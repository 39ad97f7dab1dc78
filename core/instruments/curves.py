# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each model says of an instrument: coefficients as functions of roughness alone.

Whatever averages geometries averages coefficients, so an instrument is for every model a set of
curves over σ, found once and cached:

- Published model. F1 is C1(σ) plus a geometric factor times σ²/(σ² + 0.09), and F2 is a geometric
  factor times 0.17 σ²/(σ² + 0.13). The two factors are averaged; over σ nothing is interpolated.
- Reference. The mean series of the V-cavity, from a table of `core.vcavity.sigma_tables`, within
  `INTERPOLATION_ERROR` of the solver, for either slope law.
- Closure and surface, tabulated in closed form, r = ρ (b + a / (1 + √(1 - gρ))). The three
  values of r/ρ that determine b, a and g are averaged, so that the form is led through those of the
  instrument.

Where light and view are 45° apart and one of them is the normal, all of this is the formula of
45a:0 to the last bit.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .. import oren_nayar
from ..closure import table as tables
from ..numerics.arrays import Array, precision, slope_deviation
from ..numerics.memoized import memoized
from ..vcavity import sigma_tables, slope_law
from . import quadrature

CLOSURE_ERROR = 0.02
"""Largest relative error of the closure against the reference, σ ≤ 50°, 0 < ρ ≤ 1, whatever the
instrument; for 45a:0 and its equals it is 0.001."""

INTERPOLATION_ERROR = 1e-10
"""Largest difference in any entry between a table and the solver. Measured: 6e-11 for spheres,
whose grazing light finds shadows in the shallowest grooves, below 1e-12 for all others."""


def first_and_second(sigma: npt.ArrayLike, instrument: str) -> tuple[Array, Array]:
    """Weights f1 and f2 of ρ and ρ² in the published model: see `core.reading.coefficients`.

    Examples
    --------
    >>> [round(float(weight), 4) for weight in first_and_second(np.pi / 2, "45a:0")]
    [0.559, 0.1615]
    """
    tilted, second = _published_factors(instrument)
    dtype = precision(sigma)
    s2 = slope_deviation(sigma, dtype) ** 2
    f1 = oren_nayar.first_bounce_at_normal(s2) + tilted * (s2 / (s2 + 0.09))
    f2 = second * oren_nayar.second_bounce_at_normal(s2)
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(f1, dtype), np.asarray(f2, dtype)


def of_table(
    table: tables.Table, sigma: npt.ArrayLike, instrument: str
) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g, float64, of a tabulated surface: the mean over its directions.

    What is averaged at each σ of the table are the values of r/ρ that b, a and g are led through.
    Arrays of the shape of `sigma`; those of a single σ are kept, and read-only.

    Examples
    --------
    >>> from core.surface import TABLE
    >>> single, walk, ratio = of_table(TABLE, 0.0, "45as110")
    >>> float(single + walk / 2), float(ratio)
    (1.0, 0.0)
    """
    spread = np.asarray(sigma)
    if spread.size != 1 or spread.dtype == np.float32:
        return _of_table(table, spread, instrument)
    # White facets, a reading's albedo and what another instrument reads ask for the same σ.
    one = _of_one_sigma(table, float(spread.reshape(())), instrument)
    single, walk, ratio = (coefficient.reshape(spread.shape) for coefficient in one)
    return single, walk, ratio


@memoized(maxsize=64)
def _of_one_sigma(table: tables.Table, sigma: float, instrument: str) -> tuple[Array, ...]:
    found = _of_table(table, np.array([sigma]), instrument)
    for coefficient in found:
        coefficient.setflags(write=False)
    return found


def _of_table(table: tables.Table, sigma: Array, instrument: str) -> tuple[Array, Array, Array]:
    found = tables.sigma_weights(table, sigma) @ _mean_anchors(table, instrument)
    return tables.through(found, table.meeting)


@memoized(maxsize=None)
def _mean_anchors(table: tables.Table, instrument: str) -> Array:
    """Anchors of an instrument at a table's σ: shape (σ, 3)."""
    of = quadrature.of(instrument)
    nodes = tables.at_nodes(table, of.theta_i, of.theta_r, of.delta_phi)
    if len(nodes) > 1:
        mean = of.weights @ np.exp(nodes)
        nodes = np.log(mean / mean[0])  # at σ = 0 the weights' sum, which is 1 but for rounding
    return np.asarray(nodes.reshape(len(table.sigma), tables.ANCHORS))


@memoized(maxsize=None)
def series(instrument: str, slopes: str = slope_law.DEFAULT) -> sigma_tables.SigmaTable:
    """Table of the V-cavity's series; made on first use, which takes up to two seconds.

    Raises
    ------
    DomainError
        If there is no instrument of this name, or no slope law of the name `slopes`.

    Examples
    --------
    >>> rows = series("45a:0").rows(np.radians([0.0, 30.0]))
    >>> np.round(rows[:, 0], 4).tolist()
    [1.0, 0.8101]
    """
    if _is_ring(instrument):
        return sigma_tables.ring(slopes)
    of = quadrature.of(instrument)
    # Swapping light and view changes nothing; one order makes that exact.
    upper, lower = np.maximum(of.theta_i, of.theta_r), np.minimum(of.theta_i, of.theta_r)
    return sigma_tables.build(upper, lower, of.delta_phi, of.weights, slopes=slopes)


def _is_ring(instrument: str) -> bool:
    """Whether the instrument is 45a:0 but for its name."""
    angles = quadrature.of(instrument).angles
    # At the normal azimuth has no meaning.
    return angles is not None and sorted(angles[:2]) == [0.0, np.pi / 4]


@memoized(maxsize=None)
def _published_factors(instrument: str) -> tuple[float, float]:
    """Means of what multiplies σ²/(σ² + 0.09) in F1 and of F2 over its value at the normal."""
    of = quadrature.of(instrument)
    sigma = np.asarray(np.pi / 2)
    f1, f2 = oren_nayar.factors(of.theta_i, of.theta_r, of.delta_phi, sigma)
    s2 = sigma * sigma
    tilted = (f1 - oren_nayar.first_bounce_at_normal(s2)) * ((s2 + 0.09) / s2)
    second = f2 / oren_nayar.second_bounce_at_normal(s2)
    return float(np.sum(of.weights * tilted)), float(np.sum(of.weights * second))
