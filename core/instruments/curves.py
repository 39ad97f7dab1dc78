# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each model says of an instrument: coefficients as functions of roughness alone.

Whatever averages geometries averages coefficients, so an instrument is for every model a set of
curves over σ, found once and cached:

- Published model. F1 is C1(σ) plus a geometric factor times σ²/(σ² + 0.09), and F2 is a geometric
  factor times 0.17 σ²/(σ² + 0.13). The two factors are averaged; over σ nothing is interpolated.
- Reference. The mean series of the V-cavity, from a table of `core.vcavity.sigma_tables`, within
  `INTERPOLATION_ERROR` of the solver, for either slope law.
- Closure. The form of `core.closure`, r = ρ (b + a / (1 + √(1 - gρ))), led through three facts of
  that series: its slope at ρ = 0, its value for white facets, and its value at one albedo between
  them. That determines b, a and g in closed form.

Where light and view are 45° apart and one of them is the normal, all of this is the formula of
45a:0 to the last bit.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from .. import closure, oren_nayar
from ..closure import table as tables
from ..numerics.arrays import Array, precision, slope_deviation
from ..numerics.memoized import memoized
from ..vcavity import bounce_series, sigma_tables, slope_law
from . import quadrature

CLOSURE_ERROR = 0.02
"""Largest relative error of the closure against the reference, σ ≤ 50°, 0 < ρ ≤ 1, whatever the
instrument; for 45a:0 and its equals it is `core.closure.RING_ERROR`."""

INTERPOLATION_ERROR = 1e-10
"""Largest difference in any entry between a table and the solver. Measured: 6e-11 for spheres,
whose grazing light finds shadows in the shallowest grooves, below 1e-12 for all others."""

_SHALLOW = 0.01
"""σ below which the coefficients are taken to go with σ², as they do in the limit. What later
bounces add is 1e-4 there, and the table's error would soon be all that is left of g."""

_MEETING = np.linspace(0.55, 0.95, 9)
"""Albedos tried as the one at which the closure meets the reference."""

_STEEPEST = 0.9999
"""Largest g: at 1 the slope of r at ρ = 1 would be infinite."""


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


def closure_coefficients(sigma: npt.ArrayLike, instrument: str) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g of the closure, float64: see `core.closure.coefficients`.

    Arrays of the shape of `sigma`; those of a single σ are kept, and read-only.

    Examples
    --------
    >>> single, walk, ratio = closure_coefficients(0.0, "45as110")
    >>> float(single + walk / 2)
    1.0
    """
    spread = np.asarray(sigma)
    if spread.size != 1 or spread.dtype == np.float32:
        return _closure_coefficients(spread, instrument)
    # White facets, a reading's albedo and what another instrument reads ask for the same σ.
    one = _closure_of_one(float(spread.reshape(())), instrument)
    single, walk, ratio = (coefficient.reshape(spread.shape) for coefficient in one)
    return single, walk, ratio


@memoized(maxsize=64)
def _closure_of_one(sigma: float, instrument: str) -> tuple[Array, Array, Array]:
    found = _closure_coefficients(np.array([sigma]), instrument)
    for coefficient in found:
        coefficient.setflags(write=False)
    return found


def _closure_coefficients(sigma: Array, instrument: str) -> tuple[Array, Array, Array]:
    if _is_ring(instrument):
        return closure.coefficients(np.asarray(sigma, np.float64))
    table, meeting = _closure_table(instrument)
    spread = slope_deviation(sigma, precision(sigma)).astype(np.float64)
    shrink = np.minimum(spread / _SHALLOW, 1) ** 2
    first, between, later = np.moveaxis(table.rows(np.maximum(spread, _SHALLOW)), -1, 0)
    walk, ratio = _through(between, later, meeting)
    # 1 - a/2 + a/2 is 1 to the last bit only where a is 0.
    walk = np.where(shrink == 0, 0, walk)
    return 1 - (1 - first) * shrink - walk / 2, walk, ratio * shrink


def of_table(
    table: tables.Table, sigma: npt.ArrayLike, instrument: str
) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g, float64, of a tabulated surface: the mean over its directions.

    What is averaged at each σ of the table are the values of r/ρ that b, a and g are led through.
    Arrays of the shape of `sigma`.

    Examples
    --------
    >>> from core.surface import TABLE
    >>> single, walk, ratio = of_table(TABLE, 0.0, "45as110")
    >>> float(single + walk / 2), float(ratio)
    (1.0, 0.0)
    """
    found = tables.sigma_weights(table, sigma) @ _mean_anchors(table, instrument)
    return tables.through(found, table.meeting)


@memoized(maxsize=None)
def _mean_anchors(table: tables.Table, instrument: str) -> Array:
    """Anchors of an instrument at a table's σ: shape (σ, 3)."""
    of = quadrature.of(instrument)
    nodes = tables.at_nodes(table, of.theta_i, of.theta_r, of.delta_phi)
    if len(nodes) > 1:
        nodes = np.log(of.weights @ np.exp(nodes))
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


@memoized(maxsize=None)
def _closure_table(instrument: str) -> tuple[sigma_tables.SigmaTable, float]:
    """Table of a_1, and of r/ρ - a_1 at the meeting albedo and at 1; and that albedo.

    All three are linear in the series, so that the table of the one gives that of the other.
    """
    # The constants of `core.closure`, to which this adds instruments, are fitted to this law.
    whole = series(instrument, slope_law.OREN_NAYAR)
    sigma = np.radians(np.arange(1.0, 51.0))
    albedo = np.concatenate((np.linspace(0.05, 0.9, 18), 1 - np.geomspace(0.07, 0.005, 6)))
    expected = bounce_series.evaluate(whole.rows(sigma), albedo) / albedo
    worst, tables = [], []
    for meeting in _MEETING:
        tables.append(replace(whole, coefficients=whole.coefficients @ _functionals(meeting)))
        first, between, later = (
            column[:, np.newaxis] for column in np.moveaxis(tables[-1].rows(sigma), -1, 0)
        )
        walk, ratio = _through(between, later, meeting)
        found = first - walk / 2 + walk / (1 + np.sqrt(1 - ratio * albedo))
        worst.append(np.max(np.abs(found / expected - 1)))
    best = int(np.argmin(worst))
    return tables[best], float(_MEETING[best])


def _functionals(meeting: float) -> Array:
    """Weights of a series' entries in a_1, r(m)/m - a_1 and r(1) - a_1: shape (K + J, 3)."""
    entries = np.eye(sigma_tables.SERIES_BOUNCES + bounce_series.TAIL_RATIOS.size)
    columns = bounce_series.evaluate(entries, np.array([meeting, 1.0])) / [meeting, 1.0]
    columns[0] = 0  # a_1 itself, which is taken off without a difference
    return np.concatenate((entries[:, :1], columns), axis=1)


def _through(between: Array, later: Array, meeting: float) -> tuple[Array, Array]:
    """Find a and g of the closure that adds `between` to a_1 at the albedo m, `later` at 1.

    With v = √(1 - g) and w = √(1 - g m), what it adds at m is m ((1 + v)/(1 + w))² of what it adds
    at 1. With the square root k of that ratio over m, 1 + v = k (1 + w), and g drops out of
    1 - w² = m (1 - v²).
    """
    share = np.sqrt(between / later / meeting)
    # These are g = _STEEPEST and next to g = 0; no instrument goes beyond either.
    steepest = (1 + np.sqrt(1 - _STEEPEST)) / (1 + np.sqrt(1 - _STEEPEST * meeting))
    share = np.clip(share, steepest, 1 - 1e-9)
    root = (1 + meeting * share * (share - 2)) / (1 - meeting * share * share)
    ratio = (1 - root * root) / meeting
    walk = 2 * later * (1 + np.sqrt(1 - ratio)) ** 2 / ratio
    return np.asarray(walk), np.asarray(ratio)
