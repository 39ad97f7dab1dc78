# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From measured spectra to the color and roughness of a Cycles shader. No Blender data here.

RGB is linear in reflectance, so a rough spectral surface seen from anywhere is
F1 · RGB(ρ) + F2 · RGB(ρ²), with two colors a material and not one spectrum a geometry.
RGB(ρ²) is not RGB(ρ)².
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core import cycles, geometry, oren_nayar, reading
from ..core.arrays import Array
from ..core.errors import DomainError
from . import colorimetry, judgement
from .sample import Sample
from .working_space import WorkingSpace

MATCH_GEOMETRIES = 32
"""Directions the roughness is matched over. Against 2,000 of them the mean ΔE00 of the
ColorChecker comes out within 0.03."""

_ENOUGH = 1e-6
"""Overshoot of gamut or albedo that is rounding, not a fact about the material."""


@dataclass(frozen=True)
class Request:
    """What to make of one sample.

    Parameters
    ----------
    sample
        The measured spectrum.
    sigma
        Roughness σ, radians.
    model
        One of `core.reading.MODELS`.
    illuminant
        The light under which the color is right.
    observer
        Of the colorimetry in reports; scene RGB is always of the 2° observer.
    """

    sample: Sample
    sigma: float
    model: str = "two-bounce"
    illuminant: str = "D65"
    observer: int = 2


@dataclass(frozen=True, eq=False)
class Solution:
    """A matched material.

    Parameters
    ----------
    color
        Socket color in scene-linear RGB within 0 to 1, shape (3,).
    roughness
        Cycles' diffuse roughness.
    target
        RGB of the target reading at the instrument, unclipped, shape (3,).
    delta_e_instrument
        ΔE00 predicted between target and Cycles at the instrument.
    delta_e_mean, delta_e_95
        Mean and 95th percentile over the hemisphere below 80°.
    delta_e_lambert
        Mean of the same for the Lambertian material with the same reading.
    warnings
        Sentences about what could not be met.
    """

    color: Array
    roughness: float
    target: Array
    delta_e_instrument: float
    delta_e_mean: float
    delta_e_95: float
    delta_e_lambert: float
    warnings: tuple[str, ...]


def albedo(request: Request) -> Array:
    """ρ(λ) of the sample's facets, shape (bands,); above 1 where the reading is infeasible."""
    sample = request.sample
    if sample.kind == "albedo":
        return sample.values
    return reading.to_albedo(sample.values, request.sigma, request.model, sample.instrument)


def target_reading(request: Request) -> Array:
    """r(λ) that the material has to show at the instrument, shape (bands,)."""
    sample = request.sample
    if sample.kind == "reading":
        return sample.values
    return reading.from_albedo(sample.values, request.sigma, request.model, sample.instrument)


def solve(requests: Sequence[Request], space: WorkingSpace) -> list[Solution]:
    """Match Cycles to every request, all in one go.

    Raises
    ------
    DomainError
        If a spectrum does not cover the visible range, or σ, model or illuminant is unknown.
    """
    solutions: list[Solution | None] = [None] * len(requests)
    for illuminant in sorted({request.illuminant for request in requests}):
        members = [i for i, request in enumerate(requests) if request.illuminant == illuminant]
        for i, solution in zip(
            members, _solve([requests[i] for i in members], space, illuminant), strict=True
        ):
            solutions[i] = solution
    return [solution for solution in solutions if solution is not None]


def _solve(requests: list[Request], space: WorkingSpace, illuminant: str) -> list[Solution]:
    readings, bases = _colors(requests, space)
    sigma = np.array([request.sigma for request in requests])[:, np.newaxis]
    geometries = geometry.hemisphere(MATCH_GEOMETRIES)
    f1, f2 = oren_nayar.factors(*geometries, sigma)
    targets = f1[..., None] * bases[:, None, 0] + f2[..., None] * bases[:, None, 1]
    # The published model turns negative at grazing opposite directions; no surface does. A channel
    # that is negative in the reading itself is out of gamut, which is another matter.
    targets = np.where(readings[:, None] >= 0, np.maximum(targets, 0), targets)

    def perceive(rgb: Array) -> Array:
        return space.to_lab(rgb, illuminant)

    matched, roughness = cycles.match(readings, targets, geometries, perceive, colorimetry.delta_e)
    color = np.clip(matched, 0.0, 1.0)
    wanted = perceive(targets)
    rough = cycles.reflectance(color[:, None], roughness[:, None], *geometries)
    over_hemisphere = colorimetry.delta_e(perceive(rough), wanted)
    flat = np.clip(readings, 0, 1)[:, None] * np.ones((1, MATCH_GEOMETRIES, 1))
    lambert = colorimetry.delta_e(perceive(flat), wanted).mean(axis=-1)
    at_instrument = cycles.reflectance(color, roughness, *reading.INSTRUMENT_ANGLES["45a:0"])
    met = colorimetry.delta_e(perceive(at_instrument), perceive(readings))
    return [
        Solution(
            color=color[i],
            roughness=float(roughness[i]),
            target=readings[i],
            delta_e_instrument=float(met[i]),
            delta_e_mean=float(over_hemisphere[i].mean()),
            delta_e_95=float(np.percentile(over_hemisphere[i], 95)),
            delta_e_lambert=float(lambert[i]),
            warnings=_warnings(requests[i], space, readings[i], matched[i], float(met[i])),
        )
        for i in range(len(requests))
    ]


def _colors(requests: list[Request], space: WorkingSpace) -> tuple[Array, Array]:
    """RGB of the readings (M, 3) and of the two bases ρ and ρ² or its closure (M, 2, 3).

    Requests on one wavelength grid share one matrix.
    """
    readings, bases = np.empty((len(requests), 3)), np.empty((len(requests), 2, 3))
    groups: dict[tuple[bytes, str], list[int]] = {}
    for i, request in enumerate(requests):
        key = (request.sample.wavelengths.tobytes(), request.model)
        groups.setdefault(key, []).append(i)
    for (_, model), members in groups.items():
        first = requests[members[0]]
        try:
            weights = space.rgb_weights(first.sample.wavelengths, first.illuminant)
        except DomainError as error:
            msg = f"{first.sample.source or 'Sample'}, {first.sample.name!r}: {error}"
            raise DomainError(msg) from error
        sigma = np.array([requests[i].sigma for i in members])
        values = np.stack([requests[i].sample.values for i in members])
        is_albedo = np.array([requests[i].sample.kind == "albedo" for i in members])[:, None]
        rho = np.where(is_albedo, values, reading.to_albedo(values, sigma, model))
        measured = np.where(is_albedo, reading.from_albedo(values, sigma, model), values)
        second = np.zeros_like(rho) if model == "first-order" else rho * rho
        if model == "closure":
            second = second / (1 - reading.bounce_ratio(sigma)[:, np.newaxis] * rho)
        readings[members] = measured @ weights
        bases[members] = np.stack((rho @ weights, second @ weights), axis=1)
    return readings, bases


def _warnings(
    request: Request, space: WorkingSpace, target: Array, color: Array, missed: float
) -> tuple[str, ...]:
    found = [space.warning, judgement.contradiction(request.sample), _infeasible(request)]
    outside = np.maximum(-color, color - 1)
    channel = int(np.argmax(outside))
    if outside[channel] > _ENOUGH:
        side = "below 0" if color[channel] < 0 else "above 1"
        found.append(
            f"{request.sample.name!r} lies outside the gamut of {space.name}: "
            f"{'RGB'[channel]} would be {color[channel]:.4f}, {outside[channel]:.4f} {side}; "
            f"with the nearest value the reading misses its target by ΔE00 {missed:.2f}."
        )
    return tuple(sentence for sentence in found if sentence)


def _infeasible(request: Request) -> str:
    """Say when no surface of this roughness can give the reading; nothing is clipped."""
    sample = request.sample
    if sample.kind == "albedo":
        return ""
    peak = int(np.argmax(sample.values))
    value = float(sample.values[peak])
    limit = float(reading.white_reading(request.sigma, request.model, sample.instrument))
    if value <= limit * (1 + _ENOUGH):
        return ""
    bound = ""
    if request.model == "two-bounce":
        bound = f", and at most {np.degrees(reading.sigma_max(value)):.1f}° would fit"
    return (
        f"{sample.name!r} reads {value:.3f} at {sample.wavelengths[peak]:g} nm, but white facets "
        f"give {limit:.3f} at σ = {np.degrees(request.sigma):.1f}°{bound}; the reading is kept as "
        "measured and its albedo exceeds 1."
    )
