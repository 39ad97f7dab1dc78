# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spectrum for a light of which only the color is known. No Blender data here.

A white light shines like its nearest relative: a blackbody below 5000 K, daylight above, as the
color rendering index (CIE 13.3) chooses its reference. Any other light gets the exponential of a
parabola over wavelength: smooth, never negative, and able to take every color. Both are then
tilted by such a factor until their color is that of the light itself, so that light times
per-channel albedo is exact.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...core.color import color_difference
from ...core.limits import E308_NM
from ...core.numerics import wavelength_grid
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from . import cie_tables

GRID = np.arange(E308_NM[0], E308_NM[1] + 1, 5.0)
"""Nanometers at which spectra of lights are held."""

NEAR_WHITE = 0.01
"""Distance in u'v' from the locus of blackbodies and daylight within which a light counts as
white; lamps sold as white keep within about 0.009 (ANSI C78.377)."""

DAYLIGHT_FROM = 5000.0
"""Kelvin from which a white light counts as daylight rather than as a blackbody."""

_SECOND_RADIATION = 1.438776877e7
"""Planck's second constant, nm·K (CODATA 2018)."""
_FINE = cie_tables.GRID
_TEMPERATURES = 1e6 / np.linspace(1e6 / 25000, 1e6 / 1500, 1200)
"""Kelvin, even in mired, where eyes see even steps."""
_STEPS, _NEWTON_STEPS, _LARGEST_STEP = 12, 12, 3.0
_MET = 1e-9


def planck(temperature: float) -> Array:
    """Spectrum of a blackbody at `GRID`, with a mean of 1."""
    spd = GRID**-5 / np.expm1(_SECOND_RADIATION / (GRID * temperature))
    return np.asarray(spd / spd.mean())


def daylight(temperature: float) -> Array:
    """Spectrum of CIE daylight of 4000 to 25000 K at `GRID`, with a mean of 1 (CIE 15)."""
    spd = _daylight_mix(temperature) @ _daylight_parts()
    return np.asarray(spd / spd.mean())


def cie(name: str) -> Array:
    """Spectrum of one of the CIE's lights in `cie_tables` at `GRID`, with a luminance Y of 1."""
    spd = np.interp(GRID, cie_tables.GRID, cie_tables.illuminant(name))
    return np.asarray(spd / to_xyz(spd)[1])


def observer(degrees: int = 2) -> Array:
    """Color matching functions for sums over `GRID`, per nanometer, shape (wavelengths, 3).

    Spectra at `GRID` are taken as smooth in between, as everywhere here.
    """
    step = GRID[1] - GRID[0]
    return np.asarray(_to_fine() @ cie_tables.observer(degrees) / step)


def to_2_degrees(degrees: int) -> Array:
    """From XYZ of an observer to that of 2°, adapted so that D65 is white to both, shape (3, 3)."""
    if degrees == 2:
        return np.eye(3)
    light, step = cie("D65"), GRID[1] - GRID[0]
    whites = [light @ observer(each) * step for each in (degrees, 2)]
    return np.asarray(color_difference.adaptation(*whites))


def to_xyz(spd: npt.ArrayLike) -> Array:
    """XYZ (2° observer) of spectra at `GRID`, shape (..., 3), in units of the spectrum."""
    return np.asarray(np.asarray(spd, np.float64) @ _integration())


def like(xyz: npt.ArrayLike, temperature: float | None = None) -> tuple[Array, str]:
    """Give a spectrum whose color is exactly the given one.

    Parameters
    ----------
    xyz
        Color of the light, 2° observer, shape (3,). Only its ratio matters.
    temperature
        Kelvin, where it is known that the light is a blackbody.

    Returns
    -------
    spd, words
        Spectrum at `GRID` with a luminance Y of 1, and what it was taken for. Where no spectrum
        has the color, that of the nearest one on the way to it.
    """
    wanted = np.maximum(np.asarray(xyz, np.float64), 0)
    if temperature is not None:
        base, words = planck(temperature), f"blackbody of {temperature:.0f} K"
        # Out of a working space's gamut the color was clipped; the spectrum was not.
        if float(_distance(to_uv(to_xyz(base)), to_uv(wanted))) > NEAR_WHITE / 3:
            return base / to_xyz(base)[1], words
    else:
        base, words = _relative(wanted)
    return _tilted(base, wanted), words


@memoized(maxsize=512)
def weights(wavelengths: tuple[float, ...], spd: tuple[float, ...]) -> Array:
    """Give the matrix, shape (bands, 3), that turns reflectance into XYZ under a light.

    As `tristimulus.weights`, for a light of any spectrum at `GRID`; by the plain sum at 1 nm.
    """
    measured = np.asarray(wavelengths)
    to_fine = wavelength_grid.resample(
        np.eye(measured.size), measured, _FINE, method="cubic", ends="hold"
    )
    light, matching = np.asarray(spd) @ _to_fine(), cie_tables.observer(2)
    matrix = to_fine @ (matching * light[:, np.newaxis])
    matrix = np.asarray(matrix / (matching[:, 1] @ light))
    matrix.setflags(write=False)
    return matrix


def _relative(wanted: Array) -> tuple[Array, str]:
    target = to_uv(wanted)
    loci = _loci()
    nearest = int(np.argmin(_distance(loci, target)))
    if float(_distance(loci[nearest], target)) > NEAR_WHITE:
        return np.ones(GRID.size), "smooth spectrum of its color"
    temperature = float(_TEMPERATURES[nearest])
    if temperature < DAYLIGHT_FROM:
        return planck(temperature), f"like a blackbody of {temperature:.0f} K"
    return daylight(temperature), f"like daylight of {temperature:.0f} K"


def _tilted(base: Array, wanted: Array) -> Array:
    """Multiply by exp(a + b x + c x²) so that the color is met, coming nearer in steps."""
    start = base / to_xyz(base)[1]
    goal = wanted / wanted[1]
    x = np.linspace(-1, 1, GRID.size)
    powers = np.stack((np.ones_like(x), x, x * x))
    found = np.zeros(3)
    for share in np.linspace(0, 1, _STEPS + 1)[1:]:
        between = to_xyz(start) * (1 - share) + goal * share
        met = _newton(start, powers, found, between)
        if met is None:
            break
        found = met
    spd = start * np.exp(found @ powers)
    return np.asarray(spd / to_xyz(spd)[1])


def _newton(base: Array, powers: Array, start: Array, goal: Array) -> Array | None:
    found = start
    for _ in range(_NEWTON_STEPS):
        terms = base * np.exp(found @ powers)
        missed = goal - to_xyz(terms)
        if np.abs(missed).max() < _MET:
            return found
        try:
            step = np.linalg.solve(to_xyz(terms * powers).T, missed)
        except np.linalg.LinAlgError:
            return None
        found = found + step * min(1.0, _LARGEST_STEP / max(float(np.abs(step).max()), 1e-300))
        if not np.abs(found).max() < 300:
            return None
    return None


def to_uv(xyz: Array) -> Array:
    """CIE 1976 u'v' of XYZ (..., 3), shape (..., 2)."""
    total = xyz @ np.array([1.0, 15.0, 3.0])
    return np.stack((4 * xyz[..., 0] / total, 9 * xyz[..., 1] / total), axis=-1)


def _distance(uv: Array, other: Array) -> Array:
    return np.asarray(np.linalg.norm(uv - other, axis=-1))


@memoized(maxsize=1)
def _loci() -> Array:
    spectra = np.stack(
        [planck(t) if t < DAYLIGHT_FROM else daylight(t) for t in _TEMPERATURES.tolist()]
    )
    return to_uv(to_xyz(spectra))


def _to_fine() -> Array:
    return wavelength_grid.resample(np.eye(GRID.size), GRID, _FINE, method="cubic", ends="hold")


@memoized(maxsize=1)
def _integration() -> Array:
    return np.asarray(_to_fine() @ cie_tables.observer(2))


def _daylight_parts() -> Array:
    """S0, S1 and S2 of CIE daylight at `GRID`, shape (3, wavelengths)."""
    return cie_tables.daylight_parts()[:, :: round(GRID[1] - GRID[0])]


def _daylight_mix(temperature: float) -> Array:
    """Weights of S0, S1, S2 (CIE 15, equations 3.2 to 3.5)."""
    t = 1e3 / temperature
    low = 0.244063 + 0.09911 * t + 2.9678 * t**2 - 4.6070 * t**3
    high = 0.237040 + 0.24748 * t + 1.9018 * t**2 - 2.0064 * t**3
    x = low if temperature <= 7000 else high
    y = -3 * x * x + 2.87 * x - 0.275
    m = 0.0241 + 0.2562 * x - 0.7341 * y
    first = (-1.3515 - 1.7703 * x + 5.9114 * y) / m
    second = (0.03 - 31.4424 * x + 30.0717 * y) / m
    return np.array((1.0, first, second))
