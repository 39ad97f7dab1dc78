# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a reading is from being a scaled albedo: the share of light between facets.

Light that met one facet reads in proportion to the albedo, a_1 ρ: as long as there is no other, a
rough surface has the color of a level one and is only darker. What departs from that line is light
that met several facets. What it does to the color is told by `core.color.chromaticity`.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import models, reading
from .numerics.arrays import Array, spectrum

_DARK = 2.0**-40
"""An albedo so low that all light has met one facet; a power of 2 scales without rounding."""


def first_bounce(
    sigma: npt.ArrayLike, model: str = models.TARGET, instrument: str = "45a:0"
) -> Array:
    """Slope a_1 of the reading over the albedo where that is 0: what the first bounce weighs.

    Returns an array of the shape of `sigma`; arguments and errors as in `core.reading.from_albedo`.

    Examples
    --------
    >>> round(float(first_bounce(np.pi / 4, "two-bounce")), 4)
    0.6743
    """
    dark = reading.from_albedo(np.array([_DARK]), sigma, model, instrument)
    return np.asarray(dark[..., 0] / _DARK)


def share(
    albedo: npt.ArrayLike,
    sigma: npt.ArrayLike,
    model: str = models.TARGET,
    instrument: str = "45a:0",
) -> Array:
    """Share of a reading, per band, that met more than one facet.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    sigma, model, instrument
        As in `core.reading.from_albedo`.

    Returns
    -------
    1 - a_1 ρ / r, shape (..., bands): 0 of a level or black surface. It is what interreflection
    does to the shape of the spectrum: where it is the same in all bands, the color is only darker.

    Raises
    ------
    DomainError
        If σ is out of range, or model or instrument unknown.

    Examples
    --------
    >>> np.round(share([0.0, 0.2, 0.6], np.pi / 4, "two-bounce"), 3).tolist()
    [0.0, 0.04, 0.111]
    """
    rho = spectrum(albedo, "the albedo")
    read = reading.from_albedo(rho, sigma, model, instrument)
    return _beyond(_first(rho, sigma, model, instrument), read)


def overall_share(
    albedo: npt.ArrayLike,
    sigma: npt.ArrayLike,
    weights: npt.ArrayLike | None = None,
    model: str = models.TARGET,
    instrument: str = "45a:0",
) -> Array:
    """Share of all light of a reading that met more than one facet.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    sigma
        As in `core.reading.from_albedo`.
    weights
        What each band counts, shape (bands,), such as those of luminance; all alike if left out.
    model, instrument
        As in `core.reading.from_albedo`.

    Returns
    -------
    Shape (...); 0 where nothing is reflected.

    Raises
    ------
    DomainError
        As in `share`.

    Examples
    --------
    >>> round(float(overall_share([0.2, 0.6], np.pi / 4, model="two-bounce")), 3)
    0.094
    """
    rho = spectrum(albedo, "the albedo")
    counted = np.ones(rho.shape[-1], rho.dtype) if weights is None else np.asarray(weights)
    read = reading.from_albedo(rho, sigma, model, instrument)
    return _beyond(_first(rho, sigma, model, instrument) @ counted, read @ counted)


def _first(rho: Array, sigma: npt.ArrayLike, model: str, instrument: str) -> Array:
    return np.asarray(first_bounce(sigma, model, instrument)[..., np.newaxis] * rho, rho.dtype)


def _beyond(first: Array, read: Array) -> Array:
    """1 - first / read, and 0 where nothing is read."""
    dark = read == 0
    return np.asarray(np.where(dark, 0, (read - first) / np.where(dark, 1, read)))
