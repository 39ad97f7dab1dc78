# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much a rough surface emits, and how warm a camera takes it for. No wavelength is special.

surface          emissivity of a rough surface by direction and over the hemisphere
v_grooves        the V-cavity as a model of it
random_surface   a random surface in three dimensions as a model of it
planck           radiance of a black body
band             means over a band, weighted with a black body's light and a filter's response
apparent         what temperature a radiometer tells, among warm or cold surroundings
"""

from .apparent import apparent_temperature
from .band import Filter, band_emissivity
from .planck import radiance
from .surface import (
    MODEL,
    MODELS,
    albedo_from_directional,
    directional,
    hemispherical,
)

__all__ = [
    "MODEL",
    "MODELS",
    "Filter",
    "albedo_from_directional",
    "apparent_temperature",
    "band_emissivity",
    "directional",
    "hemispherical",
    "radiance",
]
