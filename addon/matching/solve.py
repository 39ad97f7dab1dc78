# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From measured spectra to the color and roughness of a Cycles shader. No Blender data here.

The targets are computed spectrally and turned into RGB at the end: RGB(ρ²) is not RGB(ρ)².
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...core import cycles, instruments, ladder, reading
from ...core.choice import SLANTING_DEGREES, choose_shader
from ...core.color import color_difference
from ...core.cycles import gloss_reading, instrument_lobe, matching
from ...core.gloss import Gloss
from ...core.limits import COLOR_NM
from ...core.models import TARGET
from ...core.numerics import direction_grid
from ...core.numerics.arrays import Array
from ..colorimetry import tristimulus
from ..colorimetry.rgb_space import WorkingSpace
from ..samples import quality, sets
from . import glossy, scene_match, surface_spectra
from . import outside as outside_words
from .request import AUTO, Request
from .scene_view import SceneView
from .solution import Solution

__all__ = [
    "ASKED_FOR",
    "AUTO",
    "BY_DEFAULT",
    "MATCH_GEOMETRIES",
    "Request",
    "differences",
    "remarks",
    "settle",
    "solve",
    "target_reading",
]

MATCH_GEOMETRIES = 32
"""Directions the roughness is matched over. Against 2,000 of them the mean ΔE00 of
patches comes out within 0.12; three times as many come no nearer."""

ASKED_FOR = "asked for"
"""Reason of a model that was named; its material is then matched, however smooth."""

BY_DEFAULT = f"{TARGET}: random rough geometry, all bounces"
"""Reason of a model that was not."""

_ROUGH = "rough{}: matched to the model asked for"

_CHUNK = 64
"""Materials whose spectra in all directions are held at once: about 2 MB."""

_ENOUGH = 1e-6
"""Overshoot of gamut or albedo that is rounding, not a fact about the material."""


def target_reading(request: Request) -> Array:
    """r(λ) that the material has to show at the virtual instrument, shape (bands,)."""
    [(settled, _)] = settle([request])
    return np.asarray(surface_spectra.readings_and_albedos([settled])[0][0])


def settle(requests: Sequence[Request]) -> list[tuple[Request, str]]:
    """Replace "auto" by the model it means, and say why; other models stay as asked for.

    Of a set, the reading at the virtual instrument comes first: what was read there is the target.
    """
    return [_settled(request) for request in requests]


def _settled(request: Request) -> tuple[Request, str]:
    sample = sets.at(request.sample, request.read_at)
    if sample is not request.sample:
        request = replace(request, sample=sample)
    if request.model == AUTO:
        return replace(request, model=TARGET), BY_DEFAULT
    return request, ASKED_FOR


def solve(requests: Sequence[Request], space: WorkingSpace) -> list[Solution]:
    """Match Cycles to every request, all in one go.

    Raises
    ------
    DomainError
        If a spectrum does not cover the visible range, or σ, model or illuminant is unknown.
    """
    settled = settle(requests)
    solutions: list[Solution | None] = [None] * len(requests)
    for i, (request, reason) in enumerate(settled):
        if request.scene is not None:
            solutions[i] = _solve_in_scene(request, reason, request.scene, space)
    open_ones = [i for i, solution in enumerate(solutions) if solution is None]
    for under in dict.fromkeys(_under(requests[i]) for i in open_ones):
        members = [i for i in open_ones if _under(requests[i]) == under]
        alike = _solve([settled[i] for i in members], space, *under)
        for i, solution in zip(members, alike, strict=True):
            solutions[i] = solution
    return [solution for solution in solutions if solution is not None]


def _under(request: Request) -> tuple[str, str, Gloss | None]:
    """Give what has to be the same of all materials that are matched in one go."""
    return request.illuminant, request.read_at, request.gloss


def _solve(
    settled: list[tuple[Request, str]],
    space: WorkingSpace,
    illuminant: str,
    read_at: str,
    gloss: Gloss | None,
) -> list[Solution]:
    requests = [request for request, _ in settled]
    geometries = direction_grid.hemisphere(MATCH_GEOMETRIES)
    readings, targets = _colors(requests, geometries, space)

    below, layer = readings, None
    if gloss is not None:
        layer, there = glossy.with_instrument(gloss, geometries, read_at)
        below, targets = glossy.body(there, readings, targets)

    def perceive(rgb: Array) -> Array:
        """Of the diffuse lobe in the first directions of all: gloss lies over it."""
        if layer is not None:
            shine, passed = (each[: rgb.shape[-2]] for each in layer)
            rgb = shine + passed * rgb
        return space.to_lab(rgb, illuminant)

    matched, roughness = matching.match(below, targets, geometries, perceive, read_at)
    color, smooth = np.clip(matched, 0.0, 1.0), np.clip(below, 0.0, 1.0)
    # The instrument comes last. Both materials in one call, which is most of what they cost.
    everywhere = instrument_lobe.with_directions(geometries, read_at)
    wanted = perceive(np.concatenate((targets, below[:, np.newaxis]), axis=1))
    terms = cycles.lobe(roughness[:, np.newaxis], *everywhere)
    rough = cycles.reflected(color[:, np.newaxis], terms)
    flat = np.broadcast_to(smooth[:, np.newaxis], rough.shape)
    apart = color_difference.delta_e(perceive(np.stack((rough, flat))), wanted)
    (over_hemisphere, lambert), (met, met_smooth) = apart[..., :-1], apart[..., -1]
    slanting = np.maximum(*geometries[:2]) > math.radians(SLANTING_DEGREES)
    shaders = [
        choose_shader(
            *(lambert[i], over_hemisphere[i], request.tolerance),
            gloss=gloss is not None,
            slanting=slanting,
        )
        if reason != ASKED_FOR
        else None
        for i, (request, reason) in enumerate(settled)
    ]
    judged = quality.check_each([request.sample for request in requests])
    is_lambert = np.array([found is not None and found.model == "lambert" for found in shaders])
    color[is_lambert], roughness[is_lambert] = smooth[is_lambert], 0
    over_hemisphere[is_lambert], met[is_lambert] = lambert[is_lambert], met_smooth[is_lambert]
    high = _percentile(over_hemisphere, 0.95)
    return [
        Solution(
            color=color[i],
            roughness=float(roughness[i]),
            target=readings[i],
            model=request.model,
            model_reason=reason,
            delta_e_instrument=float(met[i]),
            delta_e_mean=float(over_hemisphere[i].mean()),
            delta_e_95=float(high[i]),
            delta_e_lambert=float(lambert[i].mean()),
            shader_reason=_rough(gloss) if (found := shaders[i]) is None else found.reason,
            sigma_max=surface_spectra.sigma_max(request),
            warnings=(
                *request.sample.altered,
                *judged[i],
                *_warnings(request, space, matched[i], float(met[i]), readings[i], roughness[i]),
            ),
        )
        for i, (request, reason) in enumerate(settled)
    ]


def differences(
    request: Request, view: SceneView, color: Array, roughness: float, space: WorkingSpace
) -> Array:
    """ΔE00 of a shader's color and roughness in each of a scene's places."""
    [(settled, _)] = settle([replace(request, scene=view)])
    [albedo] = surface_spectra.albedos([settled], settled.model)
    gloss = None
    if settled.gloss is not None:
        gloss = settled.gloss, surface_spectra.readings_and_albedos([settled])[0][0]
    what = (albedo, settled.model, settled.sigma, settled.sample.wavelengths)
    shader = (color, roughness)
    return scene_match.differences(view, shader, *what, space, settled.read_at, gloss)


def remarks(request: Request) -> tuple[str, ...]:
    """Say what is to be known of spectrum and target, whatever shader shows them.

    `request` has a settled model.
    """
    [judged] = quality.check_each([request.sample])
    infeasible = _infeasible(request)
    return (*request.sample.altered, *judged, *([infeasible] if infeasible else []))


def _solve_in_scene(
    request: Request, reason: str, view: SceneView, space: WorkingSpace
) -> Solution:
    sample = request.sample
    with surface_spectra.naming(sample):
        tristimulus.weights(sample.wavelengths)
    [read], [albedo] = surface_spectra.readings_and_albedos([request])
    rough, lambert, target = scene_match.match(
        view,
        albedo,
        read,
        request.model,
        request.sigma,
        sample.wavelengths,
        space,
        request.read_at,
        request.gloss,
    )
    taken, shader_reason = rough, _rough(request.gloss)
    if request.flat:
        taken, shader_reason = lambert, scene_match.FLAT
    elif reason != ASKED_FOR:
        taken, shader_reason = scene_match.choose_shader(
            view, lambert, rough, request.tolerance, request.gloss is not None
        )
    per_light = scene_match.mean_of_lights(view, taken.over_scene)
    [judged] = quality.check_each([sample])
    found = (
        *(space.warning, _infeasible(request), scene_match.gamut(sample.name, target, space, read)),
        glossy.too_much(sample.name, request.gloss, target, request.read_at),
    )
    return Solution(
        color=taken.color,
        roughness=taken.roughness,
        target=target,
        model=request.model,
        model_reason=reason,
        delta_e_instrument=float(taken.instrument[0]),
        delta_e_mean=float(np.average(taken.over_scene, weights=view.place_weights)),
        delta_e_95=scene_match.percentile(taken.over_scene, view.place_weights, 0.95),
        delta_e_lambert=float(np.average(lambert.over_scene, weights=view.place_weights)),
        shader_reason=shader_reason,
        warnings=(*sample.altered, *judged, *(sentence for sentence in found if sentence)),
        sigma_max=surface_spectra.sigma_max(request),
        delta_e_lights=per_light,
        scene_reason=scene_match.explain(view, per_light),
    )


def _rough(gloss: Gloss | None) -> str:
    return _ROUGH.format("" if gloss is None else " with gloss")


def _colors(
    requests: list[Request], geometries: tuple[Array, Array, Array], space: WorkingSpace
) -> tuple[Array, Array]:
    """RGB of the readings (M, 3) and of the targets in other directions (M, G, 3)."""
    readings = np.empty((len(requests), 3))
    targets = np.empty((len(requests), geometries[0].size, 3))
    for members in surface_spectra.alike(requests):
        first = requests[members[0]]
        with surface_spectra.naming(first.sample):
            weights = space.rgb_weights(first.sample.wavelengths, first.illuminant)
        measured, rho = surface_spectra.readings_and_albedos([requests[i] for i in members])
        readings[members] = measured @ weights
        sigma = np.array([requests[i].sigma for i in members])
        for start in range(0, len(members), _CHUNK):
            chunk = slice(start, start + _CHUNK)
            albedo = rho[chunk, np.newaxis]
            spread = ladder.reflectance(
                first.model, np.minimum(albedo, 1), *geometries, sigma[chunk, np.newaxis]
            )
            # No model holds for facets that return more than reaches them: see `surface_spectra`.
            targets[members[chunk]] = (spread * np.maximum(albedo, 1)) @ weights
    # The published model turns negative at grazing opposite directions; no surface does. A channel
    # that is negative in the reading itself is out of gamut, which is another matter.
    targets = np.where(readings[:, None] >= 0, np.maximum(targets, 0), targets)
    return readings, targets


def _percentile(values: Array, share: float) -> Array:
    """Give what `numpy.percentile` does of each row, at a tenth of its cost for a few numbers."""
    place = share * (values.shape[-1] - 1)
    below = int(place)
    ordered = np.sort(values, axis=-1)
    low, high = ordered[..., below], ordered[..., min(below + 1, values.shape[-1] - 1)]
    return np.asarray(low + (high - low) * (place - below))


def _warnings(
    request: Request,
    space: WorkingSpace,
    color: Array,
    missed: float,
    read: Array,
    roughness: float,
) -> tuple[str, ...]:
    found = [space.warning, _infeasible(request)]
    if request.gloss is not None:
        shown = (request.gloss, read, color, roughness, request.read_at)
        too_much = glossy.warning(request.sample.name, *shown)
        if too_much:
            nearest = f"The nearest color misses the reading by ΔE00 {missed:.2f}."
            return tuple(sentence for sentence in (*found, f"{too_much} {nearest}") if sentence)
    outside = np.maximum(-color, color - 1)
    channel = int(np.argmax(outside))
    if outside[channel] > _ENOUGH:
        name, value = request.sample.name, float(color[channel])
        beyond = _beyond_white(request, roughness, missed) if value > 1 else ""
        found.append(
            beyond or outside_words.of_gamut(name, space.name, "RGB"[channel], value, missed)
        )
    return tuple(sentence for sentence in found if sentence)


def _beyond_white(request: Request, roughness: float, missed: float) -> str:
    """Say when a band reads more than a white material of this roughness does; empty if none."""
    read, nm = target_reading(request), request.sample.wavelengths
    lit = (nm >= COLOR_NM[0]) & (nm <= COLOR_NM[1])
    band = int(np.argmax(np.where(lit, read, -np.inf)))
    matte = instrument_lobe.reflectance(np.ones(3), roughness, request.read_at)
    white = float(gloss_reading.reading(matte, request.gloss, request.read_at).max())
    if read[band] <= white * (1 + _ENOUGH):
        return ""
    peak, where = (float(read[band]), float(nm[band])), instruments.spoken(request.read_at)
    return outside_words.beyond_white(request.sample.name, peak, where, white, missed)


def _infeasible(request: Request) -> str:
    """Say when no surface of this roughness can give the reading; nothing is clipped."""
    sample = request.sample
    # Of a level surface `quality` says so: it reads more than white.
    if sample.kind == "albedo" or request.model == "lambert" or request.sigma == 0:
        return ""
    peak = int(np.argmax(sample.reflectance))
    value = float(sample.reflectance[peak])
    limit = float(reading.white_reading(request.sigma, request.model, sample.instrument))
    if value <= limit * (1 + _ENOUGH):
        return ""
    bound = ""
    if request.model == "two-bounce" and sample.instrument == instruments.DEFAULT:
        bound = f", and at most {np.degrees(reading.sigma_max(value)):.1f}° would fit"
    return (
        f"{sample.name!r} reads {value:.3f} at {sample.wavelengths[peak]:g} nm, but white facets "
        f"give {limit:.3f} at σ = {np.degrees(request.sigma):.1f}°{bound}; the reading is kept as "
        "measured and its albedo exceeds 1."
    )
