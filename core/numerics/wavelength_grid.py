# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavelength grids: even or uneven, and bringing spectra from one to another.

Nothing is invented without being asked for: bands outside the measured range are NaN unless the
caller chooses to hold the end values, as ASTM E308 does.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from .arrays import Array, spectrum

Method = Literal["linear", "cubic"]
Ends = Literal["nan", "hold", "error"]

_STEP_TOLERANCE = 1e-4
"""Relative unevenness that still counts as even: files print steps such as 3.3333 nm."""


def check_wavelengths(wavelengths: npt.ArrayLike) -> Array:
    """Give wavelengths as a float64 array, strictly increasing and finite.

    Raises
    ------
    DomainError
        Naming the first offending band.

    Examples
    --------
    >>> check_wavelengths([400, 410, 420]).tolist()
    [400.0, 410.0, 420.0]
    """
    grid = np.asarray(wavelengths, dtype=np.float64)
    if grid.ndim != 1 or grid.size == 0:
        msg = "Wavelengths must be a list of at least one number."
        raise DomainError(msg)
    bad = np.flatnonzero(~(np.isfinite(grid) & (grid > 0)))
    if bad.size:
        msg = f"Wavelength number {bad[0] + 1} is {grid[bad[0]]}; give positive nanometers."
        raise DomainError(msg)
    falling = np.flatnonzero(np.diff(grid) <= 0)
    if falling.size:
        first = falling[0]
        msg = (
            f"Wavelengths must increase, but {grid[first]:g} nm is followed by "
            f"{grid[first + 1]:g} nm; sort the bands and remove duplicates."
        )
        raise DomainError(msg)
    return grid


def step(wavelengths: npt.ArrayLike) -> float | None:
    """Interval of an even grid in nanometers, or None where the steps differ.

    Examples
    --------
    >>> step([400, 410, 420])
    10.0
    >>> step([400, 410, 430]) is None
    True
    """
    grid = check_wavelengths(wavelengths)
    if grid.size < 2:
        return None
    mean = float(grid[-1] - grid[0]) / (grid.size - 1)
    return mean if np.allclose(np.diff(grid), mean, rtol=_STEP_TOLERANCE, atol=0) else None


def covered(source: npt.ArrayLike, target: npt.ArrayLike) -> npt.NDArray[np.bool_]:
    """Which target wavelengths lie within the measured range. Shape (target bands,).

    Examples
    --------
    >>> covered([400, 700], [390, 400, 550, 710]).tolist()
    [False, True, True, False]
    """
    measured, wanted = check_wavelengths(source), check_wavelengths(target)
    return np.asarray((wanted >= measured[0]) & (wanted <= measured[-1]))


def resample(
    values: npt.ArrayLike,
    source: npt.ArrayLike,
    target: npt.ArrayLike,
    method: Method = "linear",
    ends: Ends = "nan",
) -> Array:
    """Interpolate spectra from one wavelength grid to another; either may be uneven.

    Parameters
    ----------
    values
        Spectra, shape (..., source bands).
    source, target
        Wavelengths in nanometers, strictly increasing.
    method
        "linear" never leaves the range of its two neighbors. "cubic" is the Lagrange polynomial
        through four neighbors that ASTM E2022 uses: closer on smooth spectra, but it may
        overshoot beside a steep edge.
    ends
        What target bands outside the source get: "nan", the nearest end value ("hold"), or a
        DomainError ("error").

    Returns
    -------
    Array of shape (..., target bands), in the precision of `values`. A NaN band makes NaN of the
    target bands that lean on it and of no others.

    Raises
    ------
    DomainError
        If a grid does not increase, `values` does not fit `source`, or with ends="error".

    Examples
    --------
    >>> resample([0.25, 0.5], [400, 410], [400, 405, 420]).tolist()
    [0.25, 0.375, nan]
    >>> resample([0.25, 0.5], [400, 410], [400, 405, 420], ends="hold").tolist()
    [0.25, 0.375, 0.5]
    """
    spectra = spectrum(values, "the spectrum")
    measured, wanted = check_wavelengths(source), check_wavelengths(target)
    if spectra.shape[-1] != measured.size:
        msg = f"{spectra.shape[-1]} values do not fit {measured.size} wavelengths."
        raise DomainError(msg)
    inside = covered(measured, wanted)
    if ends == "error" and not inside.all():
        outside = wanted[~inside][0]
        msg = (
            f"{outside:g} nm lies outside the measured {measured[0]:g} to {measured[-1]:g} nm; "
            "choose a grid within it, or hold the end values."
        )
        raise DomainError(msg)
    clamped = np.clip(wanted, measured[0], measured[-1])
    indices, weights = _lagrange(measured, clamped, 4 if method == "cubic" else 2)
    weights = weights.astype(spectra.dtype)
    out = np.zeros((*spectra.shape[:-1], wanted.size), spectra.dtype)
    for index, weight in zip(indices, weights, strict=True):
        # 0 · NaN and 0 · ∞ are NaN: a neighbor without weight must not spread it.
        with np.errstate(invalid="ignore"):
            out += np.where(weight == 0, 0, weight * spectra[..., index])
    if ends == "nan":
        out[..., ~inside] = np.nan
    return out


def _lagrange(source: Array, target: Array, points: int) -> tuple[Array, Array]:
    """Find neighbors and their weights, each (points, target bands), for local interpolation."""
    points = min(points, source.size)
    right = np.searchsorted(source, target, side="right")
    first = np.clip(right - points // 2, 0, source.size - points)
    indices = first + np.arange(points)[:, np.newaxis]
    nodes = source[indices]
    weights = np.ones(nodes.shape)
    for j in range(points):
        for k in range(points):
            if k != j:
                weights[j] *= (target - nodes[k]) / (nodes[j] - nodes[k])
    return indices, weights
