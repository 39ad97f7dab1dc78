# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sample's set says of its gloss: from SCI and SCE, and from gloss units.

`of_sample` tells what each reading says by itself, `estimate` which gloss of a Principled BSDF
reads all of it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...core import gloss_readings
from ...core.cycles import gloss_estimate
from ...core.cycles.gloss_estimate import GlossEstimate
from ...core.errors import DomainError
from ...core.gloss import Gloss
from ...core.gloss_readings import GlossReadings, Specular, SphereGloss
from ...core.instruments import HEMISPHERE, REGISTRY
from ...core.instruments.gloss import METERS
from ...core.limits import COLOR_NM
from ..colorimetry import tristimulus
from . import sets
from .sample import Sample

_LEAST_BANDS = 2


_NEAR = 30.0
"""Degrees from the mirror direction up to which an angle sees the lobe."""
_MORE = 1.01
"""How much more it has to read than all others: a matte surface sends more back to the light."""


def tells(sample: Sample) -> bool:
    """Return whether `estimate` has something to tell gloss from."""
    return bool(of_sample(sample) or _angles(sample))


def of_sample(sample: Sample) -> GlossReadings | None:
    """Return what the readings of a sample's surface say of gloss; None where nothing does.

    The difference is taken where both have bands between 400 and 700 nm, at those of SCE.
    """
    found = GlossReadings(_of_spheres(sample), dict(sample.gloss))
    return found if found.sphere or found.units else None


def estimate(
    sample: Sample, level: float | None = None, gloss: Gloss | None = None
) -> GlossEstimate:
    """Find level and roughness of a Principled BSDF that reads what a sample's set says.

    Of a reading its luminance counts, as D65 shows it. Where there is no SCI, the body below the
    gloss follows from the reading that the color is made from.

    Parameters
    ----------
    sample
        A set with SCI and SCE, with gloss units at 20, 60 or 85° beside any reading, or with angles
        near the mirror direction that read more than the others.
    level, gloss
        As of `core.cycles.gloss_estimate.estimate`.

    Raises
    ------
    DomainError
        If the set says nothing of gloss, or that there is none.
    """
    spheres, angles = _spheres(sample), _angles(sample)
    units = {int(angle): units for angle, units in sample.gloss if angle in METERS}
    try:
        if spheres is None and not (units or angles):
            others = ", ".join(f"{angle:g}°" for angle, _ in sample.gloss)
            msg = "There is nothing to tell gloss from; give SCI and SCE, or gloss units"
            raise DomainError(f"{msg} at 20, 60 or 85°{f' and not at {others}' if others else ''}.")
        if spheres is None:
            read = gloss_estimate.GlossReadings(
                _luminance(sample), None, units, sample.instrument, angles
            )
        else:
            sci, sce = map(_luminance, spheres)
            read = gloss_estimate.GlossReadings(sci, sce, units, angles=angles)
        return gloss_estimate.estimate(read, level, gloss)
    except DomainError as error:
        msg = f"Sample {sample.name!r}: {error}"
        raise DomainError(msg) from error


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


def _angles(sample: Sample) -> dict[str, float]:
    """Give the luminance at the angles beside the first reading, if those near gloss read more."""
    angles = {
        each.instrument: _luminance(each)
        for each in sample.readings
        if REGISTRY[each.instrument].aspecular is not None
        and sets.is_exact(each)
        and not sets.is_smooth(each)
    }
    near = {name for name in angles if abs(REGISTRY[name].aspecular or 0.0) < _NEAR}
    far = [value for name, value in angles.items() if name not in near]
    if not near or not far or max(angles[name] for name in near) < _MORE * max(far):
        return {}
    return {name: value for name, value in angles.items() if name != sample.instrument}


def _luminance(sample: Sample) -> float:
    """Give the luminance factor of a reading, of the light D65."""
    nm, values = sample.wavelengths, sample.values * sample.scale
    return float(values @ tristimulus.weights(nm, "D65", 2)[:, 1])


def _spheres(sample: Sample) -> tuple[Sample, Sample] | None:
    """Give SCI and SCE of the rough surface; None where there are not just these two."""
    spheres = [
        reading
        for reading in sample.readings
        if REGISTRY[reading.instrument].light == HEMISPHERE and not sets.is_smooth(reading)
    ]
    sci = [reading for reading in spheres if reading.specular == "SCI"]
    sce = [reading for reading in spheres if reading.specular == "SCE"]
    if len(sci) != 1 or len(sce) != 1:
        return None
    return sci[0], sce[0]


def _of_spheres(sample: Sample) -> SphereGloss | None:
    pair = _spheres(sample)
    if pair is None:
        return None
    one, other = pair
    nm = other.wavelengths
    low = max(COLOR_NM[0], one.wavelengths[0])
    high = min(COLOR_NM[1], one.wavelengths[-1])
    both = (nm >= low) & (nm <= high)
    if both.sum() < _LEAST_BANDS:
        return None
    # Values, and not reflectance: what is a little below 0 is noise that a mean evens out.
    included = np.interp(nm[both], one.wavelengths, one.values * one.scale)
    return gloss_readings.of_sphere(included, other.values[both] * other.scale)
