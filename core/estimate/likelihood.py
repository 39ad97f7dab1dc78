# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How well a roughness explains readings, once every albedo is the one that suits it best.

For a given σ the albedo of each material and band is a least-squares problem of one number, so all
bands, all σ and all draws of noise are solved at once. What is left of χ² is a function of σ alone,
its profile:

    χ²(σ) = Σ_bands min_ρ Σ_readings (r - R(ρ, σ))² / s²

σ enters through σ² wherever it is small, so steps and slopes are taken in x = σ².
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .. import ladder, reading
from ..numerics.arrays import Array
from .readings import Directions, Measured

STEPS = 3
"""Of Gauss and Newton toward an albedo; the first guess is the readings' own mean albedo."""

FEW_STEPS = 2
"""Where the albedo of a σ nearby is known."""

_ALBEDO_STEP = 1e-5
"""Difference of albedo for dR/dρ."""

_ROUGHNESS_STEP = 1e-6
"""Difference of σ² for dR/dσ², and its share of σ² besides 1e-4."""


class Fitted(NamedTuple):
    """Readings explained by a roughness; leading axes are those of σ.

    Attributes
    ----------
    albedo
        By material, shape (..., materials, bands).
    predicted, slope
        R and dR/dρ, shape (..., readings, bands).
    chi_square
        Shape (...).
    """

    albedo: Array
    predicted: Array
    slope: Array
    chi_square: Array


def predict(measured: Measured, model: str, albedo: Array, sigma: Array) -> Array:
    """Predict all readings: shape (..., readings, bands).

    Examples
    --------
    >>> from .readings import Reading, prepare
    >>> pair = prepare([Reading([0.5], rough=False), Reading([0.4])])
    >>> np.round(predict(pair, "two-bounce", np.array([[0.5]]), np.array(0.5)), 3).tolist()
    [[0.5], [0.42]]
    """
    bands = measured.values.shape[1]
    lead = np.broadcast_shapes(albedo.shape[:-2], sigma.shape)
    out = np.empty((*lead, len(measured.instruments), bands))
    for material, rows in enumerate(measured.materials.values()):
        rho = np.broadcast_to(albedo[..., material, :], (*lead, bands))
        known: dict[str | Directions | None, Array] = {None: rho}
        for row in rows:
            instrument = measured.instruments[row] if measured.rough[row] else None
            if instrument not in known:
                known[instrument] = _read(rho, sigma, model, measured.instruments[row])
            out[..., row, :] = known[instrument]
    return out


def fit(
    measured: Measured,
    model: str,
    values: Array,
    sigma: Array,
    albedo: Array | None = None,
    steps: int = STEPS,
) -> Fitted:
    """Find the albedos that suit each σ best.

    Parameters
    ----------
    measured
        Which reading is of what, and its weights.
    values
        The readings, or draws of them: shape (..., readings, bands).
    sigma
        Radians, shape (...), broadcasting with the leading axes of `values`.
    albedo
        To begin with; without it, what each reading says by itself.
    steps
        Of Gauss and Newton.

    Examples
    --------
    >>> from .readings import Reading, prepare
    >>> pair = prepare([Reading([0.5], rough=False), Reading([0.42])])
    >>> found = fit(pair, "two-bounce", pair.values, np.array([0.0, 0.5]))
    >>> np.round(found.albedo[1], 3).tolist(), found.chi_square.round(0).tolist()
    ([[0.5]], [14337.0, 0.0])
    """
    rho = _guess(measured, model, values, sigma) if albedo is None else albedo
    for _ in range(steps):
        predicted, slope = _slope(measured, model, rho, sigma)
        pull = measured.weights * slope
        along = _by_material(measured, pull * (values - predicted))
        rho = rho + along * _inverse(_by_material(measured, pull * slope))
    predicted, slope = _slope(measured, model, rho, sigma)
    chi_square = np.sum(measured.weights * (values - predicted) ** 2, axis=(-2, -1))
    return Fitted(rho, predicted, slope, np.asarray(chi_square))


def sensitivity(measured: Measured, model: str, fitted: Fitted, square: Array) -> Array:
    """Give dR/dσ² at σ² = `square`, less what the albedos take up: shape (..., readings, bands).

    The sum of its squares times the weights is the Fisher information about σ².

    Examples
    --------
    >>> from .readings import Reading, prepare
    >>> alone = prepare([Reading([0.4])])
    >>> found = fit(alone, "two-bounce", alone.values, np.array(0.5))
    >>> float(np.abs(sensitivity(alone, "two-bounce", found, np.array(0.25))).max()) < 1e-9
    True
    """
    step = _ROUGHNESS_STEP + 1e-4 * square
    rougher = predict(measured, model, fitted.albedo, np.sqrt(square + step))
    return unexplained(
        measured, fitted, (rougher - fitted.predicted) / step[..., np.newaxis, np.newaxis]
    )


def unexplained(measured: Measured, fitted: Fitted, change: Array) -> Array:
    """Give what of a change of readings no albedo explains; shapes (..., readings, bands).

    Examples
    --------
    >>> from .readings import Reading, prepare
    >>> pair = prepare([Reading([0.5], False, deviation=0.1), Reading([0.5], deviation=0.1)])
    >>> found = fit(pair, "two-bounce", pair.values, np.array(0.0))
    >>> np.round(unexplained(pair, found, np.array([[1.0], [0.0]])), 6).tolist()
    [[0.5], [-0.5]]
    """
    pull = measured.weights * fitted.slope
    share = _by_material(measured, pull * change) * _inverse(
        _by_material(measured, pull * fitted.slope)
    )
    return np.asarray(change - fitted.slope * _by_reading(measured, share))


def allowing(measured: Measured, fitted: Fitted, error: float) -> Array:
    """Give χ² where the model itself may miss: shape (...).

    Parameters
    ----------
    error
        Standard deviation of what a model misses of a rough surface, as a share of the reading:
        one number at each instrument for dark facets, another for bright ones, and in between
        what lies between the two.

    Examples
    --------
    >>> from .readings import Reading, prepare
    >>> pair = prepare([Reading([0.5], rough=False), Reading([0.495])])
    >>> found = fit(pair, "two-bounce", pair.values, np.array(0.0))
    >>> float(found.chi_square.round(0)), float(allowing(pair, found, 0.01).round(1))
    (49.0, 1.9)
    """
    used = dict.fromkeys(
        instrument
        for instrument, rough in zip(measured.instruments, measured.rough, strict=True)
        if rough
    )
    count = 2 * len(used)
    shift = np.zeros((*fitted.predicted.shape[:-2], count, *fitted.predicted.shape[-2:]))
    bright = np.clip(_by_reading(measured, fitted.albedo), 0, 1) * fitted.predicted
    for number, instrument in enumerate(used):
        for row, own in enumerate(measured.instruments):
            if measured.rough[row] and own == instrument:
                shift[..., 2 * number, row, :] = bright[..., row, :]
                shift[..., 2 * number + 1, row, :] = (fitted.predicted - bright)[..., row, :]
    expanded = Fitted(*(np.expand_dims(part, -3) for part in fitted[:3]), fitted.chi_square)
    free = unexplained(measured, expanded, shift)
    rest = measured.values - fitted.predicted
    along = np.einsum("...krb,rb,...rb->...k", free, measured.weights, rest)
    inner = np.einsum("...krb,rb,...lrb->...kl", free, measured.weights, free)
    inner = inner + np.eye(count) / error**2
    taken = np.linalg.solve(inner, along[..., np.newaxis])[..., 0]
    return np.asarray(fitted.chi_square - np.sum(along * taken, axis=-1))


def _slope(measured: Measured, model: str, rho: Array, sigma: Array) -> tuple[Array, Array]:
    """R and dR/dρ, for one look at what depends on σ alone."""
    lead = np.broadcast_shapes(rho.shape[:-2], sigma.shape)
    own = np.broadcast_to(rho, (*lead, *rho.shape[-2:]))
    predicted, brighter = predict(measured, model, np.stack((own, own + _ALBEDO_STEP)), sigma)
    return predicted, (brighter - predicted) / _ALBEDO_STEP


def _guess(measured: Measured, model: str, values: Array, sigma: Array) -> Array:
    """Begin with the weighted mean of the albedos that the readings of a material say."""
    lead = np.broadcast_shapes(values.shape[:-2], sigma.shape)
    alone = np.array(np.broadcast_to(values, (*lead, *values.shape[-2:])))
    for row, instrument in enumerate(measured.instruments):
        if measured.rough[row] and isinstance(instrument, str):
            found = reading.to_albedo(values[..., row, :], sigma, model, instrument)
            alone[..., row, :] = np.where(np.isnan(found), values[..., row, :], found)
    total = _by_material(measured, np.broadcast_to(measured.weights, alone.shape))
    return _by_material(measured, measured.weights * alone) * _inverse(total)


def _read(rho: Array, sigma: Array, model: str, instrument: str | Directions) -> Array:
    if isinstance(instrument, str):
        return reading.from_albedo(rho, sigma, model, instrument)
    return ladder.reflectance(model, rho, *instrument, sigma)


def _by_material(measured: Measured, terms: Array) -> Array:
    """Sum (..., readings, bands) over the readings of each material."""
    rows = measured.materials.values()
    return np.stack([terms[..., row, :].sum(axis=-2) for row in rows], axis=-2)


def _by_reading(measured: Measured, of_material: Array) -> Array:
    """Give each reading what is of its material."""
    owner = np.empty(len(measured.instruments), int)
    for material, rows in enumerate(measured.materials.values()):
        owner[rows] = material
    return np.asarray(of_material[..., owner, :])


def _inverse(total: Array) -> Array:
    """1 over it; 0 where nothing was read."""
    return np.divide(1, total, out=np.zeros_like(total), where=total > 0)
