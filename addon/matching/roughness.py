# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ of samples, from what instruments read of them: `core.estimate` for samples of files."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core import estimate
from ...core.errors import DomainError
from ...core.estimate import Estimate
from ...core.instruments import HEMISPHERE, REGISTRY
from ..samples import sets
from ..samples.sample import Sample

Readings = Sample | Sequence[Sample] | None
"""One sample, several, or none."""


@dataclass(frozen=True)
class Used:
    """Readings of one material that are used, and sentences on those that aren't."""

    smooth: list[Sample]
    rough: list[Sample]
    notes: tuple[str, ...]


def of_samples(
    materials: Iterable[tuple[Readings, Readings]],
    model: str = estimate.MODEL,
    relative: float = estimate.RELATIVE,
    absolute: float = estimate.ABSOLUTE,
    others: Sequence[str] = estimate.SPREAD,
) -> Estimate:
    """Estimate the one σ of some rough surfaces.

    Parameters
    ----------
    materials
        Of each material what was read of a smooth surface, which may be its albedo or None, and of
        the rough one, by one instrument or by several. A set counts as its readings: see `used`.
    model
        One of `core.models.NAMES` that knows roughness.
    relative, absolute
        Repeatability of the readings: see `core.estimate.repeatability`.
    others
        Models whose σ is given beside it.

    Raises
    ------
    DomainError
        If the samples cannot be used together; the sentence names them.
    """
    for what, share in (("relative", relative), ("absolute", absolute)):
        if not (math.isfinite(share) and share >= 0):
            raise DomainError(f"The {what} repeatability is {share:g}; give 0 or more.")
    if relative == absolute == 0:
        raise DomainError("The repeatability is 0; no reading is exact, so give what it is.")
    readings, notes = [], list[str]()
    for number, pair in enumerate(materials, 1):
        found = used(*pair)
        name = _material(number, *found.smooth, *found.rough)
        readings += [_reading(s, False, name, relative, absolute) for s in found.smooth]
        readings += [_reading(s, True, name, relative, absolute) for s in found.rough]
        notes += found.notes
    told = estimate.sigma(readings, model, others)
    return replace(told, notes=(*told.notes, *notes)) if notes else told


def used(smooth: Readings, rough: Readings) -> Used:
    """Give which readings of samples and their sets tell a roughness.

    Of a rough sample's set all count whose geometry is computed as stated, that have no specular
    light in them as far as their instrument can leave it out, and whose wavelengths are the
    sample's own; and its smooth readings, where no others are given. Of a smooth sample just the
    reading that its color is made from counts.
    """
    rough_ones: list[Sample] = []
    own: list[Sample] = []
    notes: list[str] = []
    for sample in _listed(rough):
        if not sample.others:
            rough_ones.append(sample)
            continue
        rough_ones.append(_alone(sample, sample))
        for other in sample.others:
            why = _useless(other, sample)
            if why:
                notes.append(f"{_named(other, sample)} was left out of the estimate: {why}.")
            else:
                (own if sets.is_smooth(other) else rough_ones).append(_alone(other, sample))
    smooth_ones = [replace(s, others=(), gloss=()) if s.others else s for s in _listed(smooth)]
    return Used(smooth_ones or own, rough_ones, tuple(notes))


def tells(sample: Sample) -> bool:
    """Return whether a sample's set alone may tell a roughness: it has two readings or more."""
    found = used(None, sample)
    return sample.kind == "reading" and len(found.smooth) + len(found.rough) > 1


def summary(found: Estimate) -> str:
    """Say σ with what noise and the models leave open; or why it can't be told."""
    if not found.is_told:
        return found.reason
    sentence = f"σ {_degrees(found.sigma)}: {_range(found.interval)} by noise (95 %)"
    if len(found.by_model) > 1:
        sentence += f", {_range(found.spread)} over the models {', '.join(found.by_model)}"
    sentence += "."
    if found.interval[0] == 0 or found.interval[1] >= estimate.LARGEST:
        sentence += f" {found.reason}"
    return sentence


def source(found: Estimate, materials: Iterable[tuple[Readings, Readings]]) -> str:
    """Give the sentence that is kept with a material whose σ was estimated."""
    given = [used(*pair) for pair in materials]
    of = [sample.name for each in given for sample in (*each.smooth, *each.rough)]
    return (
        f"Estimated from {', '.join(of[:4])}{', …' if len(of) > 4 else ''} "
        f"by the model {found.model}: {_range(found.interval)} by noise (95 %), "
        f"{_range(found.spread)} over models."
    )


def _reading(
    sample: Sample, rough: bool, material: str, relative: float, absolute: float
) -> estimate.Reading:
    if rough and sample.kind == "albedo":
        msg = (
            f"{sample.name} is an albedo, which does not depend on roughness; give what an "
            "instrument read of the rough surface."
        )
        raise DomainError(msg)
    return estimate.Reading(
        sample.values,
        rough,
        sample.instrument,
        material,
        estimate.repeatability(sample.values, relative, absolute),
        sample.wavelengths,
        sample.name,
    )


def _useless(other: Sample, main: Sample) -> str:
    """Say why a reading of a set tells nothing of σ; empty where it does."""
    if not np.array_equal(other.wavelengths, main.wavelengths):
        return "its wavelengths are others than those of the rest"
    instrument = REGISTRY[other.instrument]
    if instrument.light == HEMISPHERE and not instrument.trap:
        return "specular light is in it"
    if not sets.is_exact(other):
        return "its geometry is not among the instruments"
    return ""


def _named(reading: Sample, sample: Sample) -> str:
    return f"{sample.name} at {sets.label(reading)}"


def _alone(reading: Sample, sample: Sample) -> Sample:
    return replace(reading, name=_named(reading, sample), called="", others=(), gloss=())


def _material(number: int, *samples: Sample) -> str:
    """Name a material by its first sample; the number keeps equal names apart."""
    return f"{number} {samples[0].name}" if samples else f"{number}"


def _listed(given: Readings) -> Sequence[Sample]:
    if given is None:
        return ()
    return (given,) if isinstance(given, Sample) else given


def _range(ends: tuple[float, float]) -> str:
    return f"{_degrees(ends[0])} to {_degrees(ends[1])}"


def _degrees(sigma: float) -> str:
    return f"{math.degrees(sigma):.1f}°"
