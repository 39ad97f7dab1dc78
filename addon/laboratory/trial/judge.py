# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hold readings of rough surfaces against the models, and infer σ and albedo back from them.

A σ that helped to find itself would prove nothing. Where the albedo of a material is inferred, σ
comes from the other materials of its surface: they are dealt into `FOLDS` hands, and each hand
gets the σ of the others.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from ....core import estimate, models, reading
from ....core.color import color_difference
from ....core.errors import DomainError
from ....core.numerics.arrays import Array
from ...colorimetry import tristimulus
from ...matching import roughness
from ...samples.sample import Sample
from .results import Inferred, Read
from .surfaces import Material, Surface, check

FOLDS = 4
"""Hands that materials are dealt into."""

DARK = 0.01
"""Readings below it count in colors, and not in percent, where noise alone would tell."""

ASKED = (*models.NAMES[1:], *(name for name in estimate.SPREAD if name not in models.NAMES))
"""Models whose σ is asked: all that know roughness, and the slope laws besides."""


def judge(
    surfaces: Sequence[Surface],
    relative: float = estimate.RELATIVE,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[list[Read], list[Inferred]]:
    """Hold all surfaces against all models.

    Parameters
    ----------
    surfaces
        With their readings.
    relative
        Standard deviation of repeated readings, as a share of the reading.
    progress
        Called with surfaces done and surfaces in all.

    Raises
    ------
    DomainError
        If readings of one surface or material cannot be used together; the sentence names them.
    """
    for surface in surfaces:
        check(surface)
    reads, inferred = [], []
    for number, surface in enumerate(surfaces):
        if progress is not None:
            progress(number, len(surfaces))
        try:
            reads += _reads(surface, relative)
            inferred.append(_inferred(surface, relative))
        except DomainError as error:
            msg = f"Surface {surface.name!r}: {error}"
            raise DomainError(msg) from error
    return reads, inferred


def _reads(surface: Surface, relative: float) -> list[Read]:
    own = _from_others(surface, relative)
    stated = dict.fromkeys(models.NAMES, math.nan if surface.sigma is None else surface.sigma)
    return [
        _read(surface, material, sample, stated, sigma)
        for material, sigma in zip(surface.materials, own, strict=True)
        for sample in material.rough
    ]


def _read(
    surface: Surface,
    material: Material,
    sample: Sample,
    stated: dict[str, float],
    own: dict[str, float],
) -> Read:
    about = (surface.name, material.name, sample.name, sample.instrument)
    albedo, seen = material.albedo, sample.reflectance
    if albedo is None:
        none = dict.fromkeys(models.NAMES, math.nan)
        return Read(*about, math.nan, none, none, none, none, none)
    weights = tristimulus.weights(sample.wavelengths)

    def apart(one: Array, other: Array) -> float:
        lab = color_difference.xyz_to_lab(np.stack((one, other)) @ weights, weights.sum(axis=0))
        return float(color_difference.delta_e(*lab))

    def each(sigmas: dict[str, float], compare: Callable[[str, float], float]) -> dict[str, float]:
        return {m: compare(m, s) if _holds(m, s) else math.nan for m, s in sigmas.items()}

    def predicted(model: str, sigma: float) -> Array:
        return reading.from_albedo(albedo, sigma, model, sample.instrument)

    def behind(model: str, sigma: float) -> Array:
        return reading.to_albedo(seen, sigma, model, sample.instrument)

    return Read(
        *about,
        raw=apart(albedo, seen),
        stated=each(stated, lambda m, s: apart(predicted(m, s), seen)),
        stated_percent=each(stated, lambda m, s: _percent(predicted(m, s), seen)),
        own=each(own, lambda m, s: apart(predicted(m, s), seen)),
        albedo_stated=each(stated, lambda m, s: apart(behind(m, s), albedo)),
        albedo_own=each(own, lambda m, s: apart(behind(m, s), albedo)),
    )


def _percent(predicted: Array, seen: Array) -> float:
    """Give what a prediction is off by, mean over the bands that are no darkness."""
    kept = seen >= DARK
    if not kept.any():
        return math.nan
    return 100 * float(np.mean(np.abs(predicted[kept] / seen[kept] - 1)))


def _holds(model: str, sigma: float) -> bool:
    """Whether there is a σ, and the model goes so far."""
    return math.isfinite(sigma) and math.degrees(sigma) <= models.find(model).largest_sigma


def _from_others(surface: Surface, relative: float) -> list[dict[str, float]]:
    """Give σ by model for each material, from the surface's other ones."""
    count = len(surface.materials)
    folds = min(FOLDS, count)
    nothing = dict.fromkeys(models.NAMES, math.nan) | {"lambert": 0.0}
    of_fold = []
    for fold in range(folds):
        others = [m for i, m in enumerate(surface.materials) if i % folds != fold and m.smooth]
        found = _estimate(others, relative, ASKED) if others else None
        told = {} if found is None else found.by_model
        of_fold.append(nothing | {name: told[name] for name in models.NAMES if name in told})
    return [of_fold[number % folds] for number in range(count)]


def _inferred(surface: Surface, relative: float) -> Inferred:
    found = _estimate(surface.materials, relative, ASKED)
    paired = [material for material in surface.materials if material.smooth]
    alone = np.degrees([_estimate([material], relative, ()).sigma for material in paired])
    told = alone[np.isfinite(alone)]
    known = math.nan if surface.sigma is None else math.degrees(surface.sigma)
    least, median, most = (
        (float(of(told)) if told.size else math.nan) for of in (np.min, np.median, np.max)
    )
    low, high = (math.degrees(end) for end in found.interval)
    return Inferred(
        surface=surface.name,
        stated=known,
        sigma=math.degrees(found.sigma),
        low=low,
        high=high,
        reason=found.reason,
        notes=" ".join(found.notes),
        materials=len(paired),
        told=int(told.size),
        least=least,
        median=median,
        most=most,
        by_model={name: math.degrees(sigma) for name, sigma in found.by_model.items()},
    )


def _estimate(
    materials: Sequence[Material], relative: float, others: Sequence[str]
) -> estimate.Estimate:
    pairs = [(material.smooth, material.rough) for material in materials]
    return roughness.of_samples(pairs, relative=relative, others=others)
