# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral radiance of a black body.

Source: M. Planck, "Über das Gesetz der Energieverteilung im Normalspectrum" (Annalen der Physik
309, 1901), with the constants that define the units of the SI since 2019 and are therefore exact
(BIPM, "The International System of Units", 9th edition).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import Array

PLANCK = 6.62607015e-34
"""h, J s, exact."""

LIGHT_SPEED = 299_792_458.0
"""c, m/s, exact."""

BOLTZMANN = 1.380649e-23
"""k, J/K, exact."""

FIRST = 2 * PLANCK * LIGHT_SPEED**2 * 1e24
"""2 h c² for wavelengths in micrometers, W µm⁴ m⁻² sr⁻¹."""

SECOND = PLANCK * LIGHT_SPEED / BOLTZMANN * 1e9
"""h c / k, nm K."""


def radiance(wavelengths: npt.ArrayLike, temperature: npt.ArrayLike) -> Array:
    """Spectral radiance of a black body in vacuum.

    Parameters
    ----------
    wavelengths
        Nanometers, any shape.
    temperature
        Kelvin, 0 or more; broadcasts against `wavelengths`.

    Returns
    -------
    W m⁻² sr⁻¹ µm⁻¹, float64 of the broadcast shape; 0 at 0 K.

    Raises
    ------
    DomainError
        If a wavelength is not above 0, or a temperature below 0.

    Examples
    --------
    >>> round(float(radiance(10_000.0, 300.0)), 3)
    9.924
    """
    nm = np.asarray(wavelengths, np.float64)
    if not np.all(nm > 0):
        msg = "a wavelength is not above 0; give nanometers."
        raise DomainError(msg)
    with np.errstate(under="ignore"):
        return np.asarray(np.exp(log_radiance(nm, checked(temperature))))


def log_radiance(nm: Array, kelvin: Array) -> Array:
    """Logarithm of `radiance`, which underflows long before this does; -∞ at 0 K.

    Examples
    --------
    >>> round(float(log_radiance(np.array(10_000.0), np.array(1.0))), 1)
    -1431.7
    """
    with np.errstate(divide="ignore", over="ignore"):
        x = SECOND / (nm * kelvin)
        # ln(eˣ - 1) = x + ln(1 - e⁻ˣ), without the overflow of eˣ.
        return np.asarray(np.log(FIRST) - 5 * np.log(nm * 1e-3) - x - np.log(-np.expm1(-x)))


def checked(temperature: npt.ArrayLike, what: str = "the temperature") -> Array:
    """Give temperatures as float64, all 0 K or more; NaN passes.

    Raises
    ------
    DomainError
        If one is below 0 K or infinite.

    Examples
    --------
    >>> checked([0, 300]).tolist()
    [0.0, 300.0]
    """
    kelvin = np.asarray(temperature, np.float64)
    bad = (kelvin < 0) | np.isinf(kelvin)
    if bad.any():
        msg = (
            f"{what} is {float(kelvin[bad].flat[0]):g} K; give kelvin, which is degrees Celsius "
            "and 273.15."
        )
        raise DomainError(msg)
    return kelvin
