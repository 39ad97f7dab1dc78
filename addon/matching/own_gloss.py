# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The gloss that a sample says it has, as a Principled BSDF is to be set for it."""

from __future__ import annotations

import json

from ...core import gloss
from ...core.cycles import gloss_estimate
from ...core.gloss import Gloss
from ...core.instruments import HEMISPHERE, REGISTRY
from ...core.instruments import gloss as meters
from ..colorimetry import tristimulus
from ..samples import preset_index, sets
from ..samples.sample import Sample

_LEAST = 0.25
"""Gloss units above those of the matte body that are gloss, and not the body or rounding."""


def of_sample(sample: Sample) -> Gloss | None:
    """Find the gloss that reads as the sample's gloss units and, if it has them, SCI and SCE do.

    Parameters
    ----------
    sample
        With `gloss` at the angles of ISO 2813; others are not looked at. Without gloss units there
        is no gloss: a sphere's trap alone tells too little of it (`docs/gloss.md`).

    Returns
    -------
    None where it is matte or says nothing, and where a matte body reads as many units.
    """
    found = readings(sample)
    return None if found is None else _found(*found)


def readings(
    sample: Sample,
) -> tuple[float, float | None, tuple[tuple[int, float], ...]] | None:
    """Return what gloss is found from: luminance with and without specular light, and units."""
    units = {round(angle): read for angle, read in sample.gloss if angle in meters.METERS}
    if not units or not sample.has_color:
        return None
    sphere = {
        reading.specular: _luminance(reading)
        for reading in sample.readings
        if REGISTRY[reading.instrument].light == HEMISPHERE and not sets.is_smooth(reading)
    }
    included = sphere.get("SCI", _luminance(sample))
    excluded = sphere.get("SCE") if "SCI" in sphere else None
    if excluded is not None and excluded >= included:
        excluded = None
    return round(included, 4), excluded, tuple(sorted(units.items()))


def is_stated(sample: Sample) -> bool:
    """Whether a sample says how it shines, be it not at all."""
    return readings(sample) is not None or bool(sample.gloss_source and not sample.gloss)


def key_of(included: float, excluded: float | None, units: tuple[tuple[int, float], ...]) -> str:
    """Return the name under which `preset_index` keeps what was found from readings."""
    return json.dumps([included, excluded, units])


def _found(
    included: float, excluded: float | None, units: tuple[tuple[int, float], ...]
) -> Gloss | None:
    key = key_of(included, excluded, units)
    known = preset_index.glosses()
    return (
        gloss.from_numbers(tuple(known[key]))
        if key in known
        else estimated(included, excluded, units)
    )


def estimated(
    included: float, excluded: float | None, units: tuple[tuple[int, float], ...]
) -> Gloss | None:
    """Find the gloss from readings, which takes a tenth of a second and more."""
    angles = tuple(angle for angle, _ in units)
    matte = gloss_estimate.readings(Gloss(level=0.0), included, angles).units
    if all(read < matte[angle] + _LEAST for angle, read in units):
        return None
    read = gloss_estimate.GlossReadings(included, excluded, dict(units))
    return gloss_estimate.estimate(read).gloss


def _luminance(sample: Sample) -> float:
    weights = tristimulus.weights(sample.wavelengths, "D65", 2)[:, 1]
    return float(sample.reflectance @ weights)
