# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sample's set says of its gloss: from SCI and SCE, and from gloss units."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...core import gloss_readings
from ...core.gloss_readings import GlossReadings, Specular, SphereGloss
from ...core.instruments import HEMISPHERE, REGISTRY
from ...core.limits import COLOR_NM
from . import sets
from .sample import Sample

_LEAST_BANDS = 2


def of_sample(sample: Sample) -> GlossReadings | None:
    """Return what the readings of a sample's surface say of gloss; None where nothing does.

    The difference is taken where both have bands between 400 and 700 nm, at those of SCE.
    """
    found = GlossReadings(_of_spheres(sample), dict(sample.gloss))
    return found if found.sphere or found.units else None


def sentences(sample: Sample) -> Iterator[str]:
    """Say it in words."""
    found = of_sample(sample)
    if found is None:
        return
    sphere = found.sphere
    if sphere:
        low, high = sphere.lowest, sphere.highest
        yield (
            f"SCI less SCE is {sphere.reflectance:.4f} ({low:.4f} to {high:.4f} over the bands): "
            + (f"{sphere.doubt}." if sphere.doubt else _smooth(sphere))
        )
    for angle, units in sample.gloss:
        told = gloss_readings.of_units(units, angle)
        read = f"{units:g} GU at {angle:g}° are a reflection of {told.reflectance:.4f}"
        yield f"{read}: {_smooth(told)}"


def _smooth(told: Specular) -> str:
    if math.isnan(told.f0):
        return "more than any dielectric's."
    index = "" if math.isnan(told.index) else f", as of an index of {told.index:.3f}"
    return f"F0 is {told.f0:.4f} at least{index}."


def _of_spheres(sample: Sample) -> SphereGloss | None:
    spheres = [
        reading
        for reading in sample.readings
        if REGISTRY[reading.instrument].light == HEMISPHERE and not sets.is_smooth(reading)
    ]
    sci = [reading for reading in spheres if reading.specular == "SCI"]
    sce = [reading for reading in spheres if reading.specular == "SCE"]
    if len(sci) != 1 or len(sce) != 1:
        return None
    [one], [other] = sci, sce
    nm = other.wavelengths
    low = max(COLOR_NM[0], one.wavelengths[0])
    high = min(COLOR_NM[1], one.wavelengths[-1])
    both = (nm >= low) & (nm <= high)
    if both.sum() < _LEAST_BANDS:
        return None
    # Values, and not reflectance: what is a little below 0 is noise that a mean evens out.
    included = np.interp(nm[both], one.wavelengths, one.values * one.scale)
    return gloss_readings.of_sphere(included, other.values[both] * other.scale)
