# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Emissivity as one number in a band: the mean, weighted with what a black body sends through it.

Between its bands a spectrum is taken as a straight line, and so is a filter's response; products
of the two with the black body's light are integrated by Gauss's rule between all their corners, so
that the numbers do not depend on anybody's grid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import Array, spectrum
from . import planck

_LONGEST_PIECE = 1.01
"""Largest ratio of the ends of a piece. A black body's light changes by a factor of e within one
where λT is 140 µm K, as at 10 µm and 14 K."""

_NODES = 4
"""Gauss nodes in a piece."""


@dataclass(frozen=True, eq=False)
class Filter:
    """What a radiometer lets through.

    Parameters
    ----------
    wavelengths
        Nanometers, increasing, shape (n,), at least two.
    response
        On any scale, not below 0, shape (n,); 0 outside.

    Raises
    ------
    DomainError
        If the two are not so, or nothing gets through.
    """

    wavelengths: npt.ArrayLike
    response: npt.ArrayLike

    def __post_init__(self) -> None:
        """Keep both as read-only float64 arrays, without the ends where nothing gets through."""
        nm, share = (np.array(given, np.float64) for given in (self.wavelengths, self.response))
        if nm.ndim != 1 or nm.shape != share.shape or nm.size < 2:
            msg = "A filter needs one response a wavelength, at least two; check its table."
            raise DomainError(msg)
        if not (nm[0] > 0 and np.isfinite(nm).all() and (np.diff(nm) > 0).all()):
            msg = "A filter's wavelengths are nanometers and must increase; sort its table."
            raise DomainError(msg)
        if not (np.isfinite(share).all() and (share >= 0).all() and share.any()):
            msg = "A filter's response must be 0 or more, and somewhere above 0; check its table."
            raise DomainError(msg)
        through = np.flatnonzero(share)
        kept = slice(max(through[0] - 1, 0), through[-1] + 2)
        for name, array in (("wavelengths", nm[kept]), ("response", share[kept])):
            array.flags.writeable = False
            object.__setattr__(self, name, array)


Band = tuple[float, float] | Filter
"""First and last wavelength, nanometers, of all that gets through alike; or a filter."""


@dataclass(frozen=True, eq=False)
class Rule:
    """An integral over a band of a spectrum that is given at its own wavelengths.

    Attributes
    ----------
    nm
        Nodes, shape (nodes,).
    weight
        Micrometers times response, shape (nodes,).
    below, share
        Band of the spectrum below each node, and how far the node is on the way to the next.
    """

    nm: Array
    weight: Array
    below: npt.NDArray[np.intp]
    share: Array

    def at_nodes(self, values: Array) -> Array:
        """Interpolate spectra (..., bands): (..., nodes)."""
        low = values[..., self.below]
        return np.asarray(low + self.share * (values[..., self.below + 1] - low))


def band_emissivity(
    emissivity: npt.ArrayLike,
    wavelengths: npt.ArrayLike,
    temperature: npt.ArrayLike,
    band: Band,
) -> Array:
    """Mean emissivity in a band: what the surface sends through it over what a black body does.

    Parameters
    ----------
    emissivity
        ε(λ), shape (..., bands).
    wavelengths
        Nanometers, increasing, shape (bands,).
    temperature
        Of the surface, kelvin, above 0; broadcasts against the leading axes of `emissivity`.
    band
        First and last wavelength in nanometers, or a `Filter`.

    Returns
    -------
    Array of the leading shape, float64.

    Raises
    ------
    DomainError
        If the spectrum does not cover the band, or an argument lies outside its range.

    Examples
    --------
    >>> nm = np.array([2000.0, 8000.0, 14000.0])
    >>> round(float(band_emissivity([0.5, 0.9, 0.9], nm, 300.0, (8000.0, 14000.0))), 12)
    0.9
    >>> round(float(band_emissivity([0.0, 0.5, 1.0], nm, 300.0, (8000.0, 14000.0))), 2)
    0.74
    """
    epsilon = spectrum(emissivity, "the emissivity").astype(np.float64, copy=False)
    kelvin = planck.checked(temperature)
    if (kelvin == 0).any():
        msg = "the temperature is 0 K, where nothing is emitted; give one above it."
        raise DomainError(msg)
    rule = rule_of(wavelengths, epsilon.shape[-1], band)
    logs = planck.log_radiance(rule.nm, kelvin[..., np.newaxis])
    light = np.exp(logs - np.max(logs, axis=-1, keepdims=True)) * rule.weight
    return np.asarray(np.sum(light * rule.at_nodes(epsilon), axis=-1) / np.sum(light, axis=-1))


def rule_of(wavelengths: npt.ArrayLike, bands: int, band: Band) -> Rule:
    """Make the integral over a band of spectra with these wavelengths.

    Raises
    ------
    DomainError
        If there is not one wavelength a band, they don't increase, or they don't cover the band.

    Examples
    --------
    >>> rule = rule_of([8000.0, 14000.0], 2, (9000.0, 10000.0))
    >>> round(float(rule.weight.sum()), 12)
    1.0
    """
    nm = np.asarray(wavelengths, np.float64)
    if nm.shape != (bands,) or bands < 2 or not (nm[0] > 0 and (np.diff(nm) > 0).all()):
        msg = (
            f"{nm.size} wavelengths stand against {bands} bands; give one a band, at least two, "
            "in nanometers and increasing."
        )
        raise DomainError(msg)
    through = band if isinstance(band, Filter) else _all_alike(band)
    of_filter, response = np.asarray(through.wavelengths), np.asarray(through.response)
    first, last = of_filter[0], of_filter[-1]
    if first < nm[0] or last > nm[-1]:
        msg = (
            f"The band reaches from {first:g} to {last:g} nm, and the spectrum covers "
            f"{nm[0]:g} to {nm[-1]:g} nm; choose a band within it."
        )
        raise DomainError(msg)
    inside = nm[(nm > first) & (nm < last)]
    pieces = int(np.ceil(np.log(last / first) / np.log(_LONGEST_PIECE)))
    even = first * (last / first) ** (np.arange(1, pieces) / pieces)
    corners = np.unique(np.concatenate((of_filter, inside, even)))
    points, gauss_weights = np.polynomial.legendre.leggauss(_NODES)
    width = np.diff(corners)[:, np.newaxis]
    nodes = (corners[:-1, np.newaxis] + (points + 1) / 2 * width).ravel()
    weight = (gauss_weights / 2 * width).ravel() * 1e-3  # nm to µm
    below = np.clip(np.searchsorted(nm, nodes, side="right") - 1, 0, bands - 2)
    share = (nodes - nm[below]) / (nm[below + 1] - nm[below])
    return Rule(nodes, weight * np.interp(nodes, of_filter, response), below, share)


def _all_alike(band: tuple[float, float]) -> Filter:
    first, last = band
    if not 0 < first < last < np.inf:
        msg = f"The band is {first:g} to {last:g} nm; give its first and last wavelength in nm."
        raise DomainError(msg)
    return Filter((first, last), (1.0, 1.0))
