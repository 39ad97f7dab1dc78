# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ of samples, from what instruments read of them: `core.estimate` for samples of files."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ...core import estimate
from ...core.errors import DomainError
from ...core.estimate import Estimate
from ..samples.sample import Sample

Readings = Sample | Sequence[Sample] | None
"""One sample, several, or none."""


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
        the rough one, by one instrument or by several.
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
    readings = []
    for number, (smooth, rough) in enumerate(materials, 1):
        name = _material(number, *_listed(smooth), *_listed(rough))
        readings += [_reading(s, False, name, relative, absolute) for s in _listed(smooth)]
        readings += [_reading(s, True, name, relative, absolute) for s in _listed(rough)]
    return estimate.sigma(readings, model, others)


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
    of = [sample.name for pair in materials for given in pair for sample in _listed(given)]
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
