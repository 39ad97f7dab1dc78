# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The temperature that a radiometer tells of a surface: that of a black body as bright.

What reaches the radiometer is what the surface emits and what it reflects of its surroundings,

    L = ∫ R(λ) (ε(λ) B(λ, T) + (1 - ε(λ)) B(λ, T_s)) dλ

with R the radiometer's response and B a black body's radiance. For surroundings of one temperature
the second term is exact for rough surfaces too: ε is that of the direction, and by reciprocity
1 - ε is what the surface shows in this direction of a hemisphere of even brightness.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array, spectrum
from . import planck
from .band import Band, Rule, rule_of

_STEPS = 100
"""Newton steps at most; from 300 K seven are taken, from the cold of space twenty."""

_CLOSE = 1e-13
"""Relative step at which the temperature stands."""


def apparent_temperature(
    emissivity: npt.ArrayLike,
    wavelengths: npt.ArrayLike,
    temperature: npt.ArrayLike,
    band: Band,
    background: npt.ArrayLike = 0.0,
) -> Array:
    """Brightness temperature of a surface in a band.

    Parameters
    ----------
    emissivity
        ε(λ) in the direction of the radiometer, shape (..., bands).
    wavelengths
        Nanometers, increasing, shape (bands,).
    temperature
        Of the surface, kelvin, 0 or more; broadcasts against the leading axes of `emissivity`.
    band
        First and last wavelength in nanometers, or a `core.emissivity.Filter`.
    background
        Temperature of the surroundings, taken as black, kelvin, 0 or more; broadcasts as well.
        0 reflects nothing.

    Returns
    -------
    Kelvin, float64 array of the leading shape; 0 where nothing shines, and NaN where noise makes
    the light negative.

    Raises
    ------
    DomainError
        If the spectrum does not cover the band, or an argument lies outside its range.

    Examples
    --------
    >>> nm, half = [8000.0, 14000.0], [0.5, 0.5]
    >>> round(float(apparent_temperature(half, nm, 300.0, (8000.0, 14000.0))), 1)
    260.1
    >>> round(float(apparent_temperature(half, nm, 300.0, (8000.0, 14000.0), 300.0)), 9)
    300.0
    """
    epsilon = spectrum(emissivity, "the emissivity").astype(np.float64, copy=False)
    rule = rule_of(wavelengths, epsilon.shape[-1], band)
    kelvin = planck.checked(temperature)
    around = planck.checked(background, "the background's temperature")
    at_nodes = rule.at_nodes(epsilon)
    own, reflected = (
        planck.log_radiance(rule.nm, np.asarray(each)[..., np.newaxis]) for each in (kelvin, around)
    )
    # Scaled by the largest, so that the cold stay apart from nothing.
    top = np.max(np.maximum(own, reflected), axis=-1, keepdims=True)
    top = np.where(np.isfinite(top), top, 0.0)
    light = np.exp(own - top) * at_nodes + np.exp(reflected - top) * (1 - at_nodes)
    with np.errstate(divide="ignore", invalid="ignore"):
        target = np.log(np.sum(light * rule.weight, axis=-1)) + top[..., 0]
    hotter = np.broadcast_to(np.maximum(kelvin, around), target.shape)
    return _temperature(rule, target, hotter)


def _temperature(rule: Rule, target: Array, start: Array) -> Array:
    """Kelvin at which a black body sends this much through the band, by its logarithm.

    That logarithm is convex in 1/T and falls, so Newton's steps from the hot side never overshoot.
    """
    out = np.where(target == -np.inf, 0.0, np.nan)
    open_ones = np.isfinite(target)
    wanted, inverse = target[open_ones], 1 / start[open_ones]
    # Hotter than both only where an emissivity is above 1.
    while (cold := _value_and_slope(rule, inverse)[0] < wanted).any():
        inverse = np.where(cold, inverse / 2, inverse)
    for _ in range(_STEPS):
        value, slope = _value_and_slope(rule, inverse)
        step = (value - wanted) / slope
        inverse = inverse - step
        if np.all(np.abs(step) <= _CLOSE * inverse):
            break
    out[open_ones] = 1 / inverse
    return np.asarray(out)


def _value_and_slope(rule: Rule, inverse: Array) -> tuple[Array, Array]:
    """Logarithm of the band's radiance at 1/T (n,), and its derivative by 1/T."""
    logs = planck.log_radiance(rule.nm, 1 / inverse[:, np.newaxis])
    top = np.max(logs, axis=-1, keepdims=True)
    light = np.exp(logs - top) * rule.weight
    total = np.sum(light, axis=-1)
    per_inverse = planck.SECOND / rule.nm
    # d ln B / d(1/T) = -(hc/λk) / (1 - e⁻ˣ)
    slopes = per_inverse / np.expm1(-per_inverse * inverse[:, np.newaxis])
    return np.log(total) + top[:, 0], np.sum(light * slopes, axis=-1) / total
