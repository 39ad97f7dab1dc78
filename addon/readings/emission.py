# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What rough samples emit, as a document: by wavelength and direction, and in bands."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.numerics.arrays import Array


@dataclass(frozen=True)
class InBand:
    """One sample in one band.

    Parameters
    ----------
    name
        The band, or the filter, as the user called it.
    first, last
        Its ends, nanometers.
    directional
        Mean emissivity in each direction.
    hemispherical
        Mean emissivity into the whole hemisphere.
    apparent
        Temperature that a radiometer tells from each direction, kelvin; NaN where noise leaves
        none.
    """

    name: str
    first: float
    last: float
    directional: tuple[float, ...]
    hemispherical: float
    apparent: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Emissivity:
    """One sample at one roughness.

    Parameters
    ----------
    sample, source
        Its name, and where the spectrum comes from.
    sigma
        Roughness σ, radians.
    model
        One of `core.emissivity.MODELS`.
    angles
        From the normal, radians.
    temperature, background
        Of the surface and of what surrounds it, kelvin.
    wavelengths
        Nanometers, shape (bands,).
    facets
        Emissivity of the smooth material, shape (bands,).
    directional
        Of the rough surface in each direction, shape (angles, bands).
    hemispherical
        Of the rough surface into the whole hemisphere, shape (bands,).
    bands
        The same and what follows from it, in bands.
    warnings
        What to know of the sample.
    """

    sample: str
    source: str
    sigma: float
    model: str
    angles: tuple[float, ...]
    temperature: float
    background: float
    wavelengths: Array
    facets: Array
    directional: Array
    hemispherical: Array
    bands: tuple[InBand, ...]
    warnings: tuple[str, ...]
