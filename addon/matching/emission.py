# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From a sample to what its rough surface emits; any wavelength will do, as no color is asked."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...core import emissivity, instruments, reading
from ...core.errors import DomainError
from ...core.limits import LARGEST_SIGMA
from ...core.numerics.arrays import Array
from ..readings.emission import Emissivity, InBand
from ..samples import quality
from ..samples.sample import Sample
from .surface_spectra import naming

ANGLES = tuple(math.radians(degrees) for degrees in (0, 30, 60, 80))
"""Directions unless others are given, radians from the normal."""

WINDOWS = ((3000.0, 5000.0), (8000.0, 14000.0))
"""Bands that thermal cameras see through the air, nanometers: those that a spectrum covers are
meant where none is given."""

TEMPERATURE = 300.0
"""Kelvin, unless another is given."""

Named = tuple[str, emissivity.Band]
"""A band and what to call it."""


def compute(
    sample: Sample,
    sigma: float,
    *,
    angles: Sequence[float] = ANGLES,
    temperature: float = TEMPERATURE,
    background: float = 0.0,
    bands: Sequence[Named] | None = None,
    model: str = emissivity.MODEL,
) -> Emissivity:
    """Compute what a sample emits.

    A reading is first turned into the albedo of facets at this roughness, and an emissivity, too:
    it is that of the rough surface as it was measured.

    Parameters
    ----------
    sample
        Of any kind and any wavelengths.
    sigma
        Roughness σ, radians.
    angles
        From the normal, radians.
    temperature, background
        Of the surface and of what surrounds it, kelvin; from 0 K nothing comes.
    bands
        Each with its name; None for those of `WINDOWS` that the spectrum covers.
    model
        One of `core.emissivity.MODELS`.

    Raises
    ------
    DomainError
        If an argument lies outside its range, a band is not covered, or the model loses light.
    """
    emissivity.check_model(model)
    if not 0 <= sigma <= LARGEST_SIGMA:
        msg = f"σ is {sigma:g} radians; give 0 to π/2, as math.radians(30) is."
        raise DomainError(msg)
    nm = sample.wavelengths
    if bands is None:
        bands = [(f"{a:g}-{b:g} nm", (a, b)) for a, b in WINDOWS if nm[0] <= a and b <= nm[-1]]
    with naming(sample):
        albedo = _albedo(sample, sigma, model)
        directions = np.array(angles, np.float64)
        directional = emissivity.directional(albedo, directions, sigma, model=model)
        hemispherical = emissivity.hemispherical(albedo, sigma, model=model)
        found = []
        for name, band in bands:
            both = np.concatenate((directional, hemispherical[np.newaxis]))
            *mean, whole = emissivity.band_emissivity(both, nm, temperature, band).tolist()
            seen = emissivity.apparent_temperature(directional, nm, temperature, band, background)
            ends = band.wavelengths if isinstance(band, emissivity.Filter) else band
            ends = (float(np.min(ends)), float(np.max(ends)))
            found.append(InBand(name, *ends, tuple(mean), whole, tuple(seen.tolist())))
    return Emissivity(
        sample=sample.name,
        source=sample.source,
        sigma=float(sigma),
        model=model,
        angles=tuple(directions.tolist()),
        temperature=float(temperature),
        background=float(background),
        wavelengths=nm,
        facets=1 - albedo,
        directional=directional,
        hemispherical=hemispherical,
        bands=tuple(found),
        warnings=(
            *sample.altered,
            *(s for s in quality.check_each([sample])[0] if quality.NO_COLOR not in s),
            *_beyond(sample, albedo, sigma),
        ),
    )


def _albedo(sample: Sample, sigma: float, model: str) -> Array:
    """ρ(λ) of the facets, shape (bands,)."""
    if sample.kind == "albedo":
        return np.asarray(sample.reflectance)
    if sample.kind == "emissivity":
        tilt = math.radians(instruments.find(sample.instrument).view.tilt)
        seen = 1 - sample.reflectance
        return emissivity.albedo_from_directional(seen, tilt, sigma, model=model)
    return reading.to_albedo(sample.reflectance, sigma, model, sample.instrument)


def _beyond(sample: Sample, albedo: Array, sigma: float) -> list[str]:
    above = albedo > 1 + 1e-9
    if not above.any():
        return []
    count, peak = int(above.sum()), int(albedo.argmax())
    bands = "one band" if count == 1 else f"{count} bands"
    return [
        f"{sample.name!r} reads more than white facets at σ = {math.degrees(sigma):g}° in {bands}, "
        f"most at {sample.wavelengths[peak]:g} nm; the emissivity there is below 0 and means "
        "nothing."
    ]
