# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "two-bounce", the published one: r = F1 ρ + F2 ρ²."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..instruments import curves
from ..numerics.arrays import Array, spectrum
from ..numerics.blocks import apply_in_blocks
from ..oren_nayar import reflectance

__all__ = ["from_albedo", "over_coefficients", "reflectance", "to_albedo"]


def from_albedo(albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Give r = f1 ρ + f2 ρ²; arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> np.round(from_albedo([0.2, 0.6], 0.5, "45a:0"), 4).tolist()
    [0.1614, 0.511]
    """
    return over_coefficients(_forward, spectrum(albedo, "the albedo"), sigma, instrument)


def to_albedo(reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
    """Invert `from_albedo`; arguments and errors as in `core.reading.to_albedo`.

    Examples
    --------
    >>> np.round(to_albedo(from_albedo([0.2, 0.6], 0.5, "di:8"), 0.5, "di:8"), 12).tolist()
    [0.2, 0.6]
    """
    return over_coefficients(_inverse, spectrum(reading, "the reading"), sigma, instrument)


def over_coefficients(
    formula: Callable[..., None], values: Array, sigma: npt.ArrayLike, instrument: str
) -> Array:
    """Apply `formula(out, values, f1, f2)` to spectra, in their precision.

    Parameters
    ----------
    formula
        Writes its first argument; all four broadcast.
    values
        Spectra, shape (..., bands).
    sigma
        Roughness, radians in [0, π/2]; broadcasts against the leading axes of `values`.
    instrument
        One of `core.instruments.REGISTRY`.

    Raises
    ------
    DomainError
        If σ is out of range or the instrument unknown.

    Examples
    --------
    >>> def white(out, values, f1, f2):
    ...     np.add(f1, f2, out=out)
    >>> over_coefficients(white, np.ones(2), 0.0, "45a:0").tolist()
    [1.0, 1.0]
    """
    per_spectrum = np.asarray(sigma, dtype=values.dtype)[..., np.newaxis]
    f1, f2 = curves.first_and_second(per_spectrum, instrument)
    shape = np.broadcast_shapes(values.shape, per_spectrum.shape)
    out = np.empty(shape, values.dtype)
    # ∞ - ∞ and 0 · ∞ are NaN, and need no warning beside it.
    with np.errstate(invalid="ignore"):
        apply_in_blocks(formula, out, values, f1, f2)
    return out


def _forward(out: Array, rho: Array, f1: Array, f2: Array) -> None:
    np.multiply(f2, rho, out=out)
    out += f1
    out *= rho


def _inverse(out: Array, r: Array, f1: Array, f2: Array) -> None:
    """ρ = r / (f1/2 + √(f1²/4 + f2 r)).

    The textbook root (-f1 + √(f1² + 4 f2 r)) / 2 f2 cancels as σ → 0, where f2 → 0: at σ = 1e-8 it
    returns 0 in float64. This form of the same root has no difference in it.
    """
    np.multiply(f2, r, out=out)
    out += f1 * f1 / 4
    np.sqrt(out, out=out)
    out += f1 / 2
    np.divide(r, out, out=out)
