# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find, for each material in the picture, its lights and the directions that matter.

Rays go from the camera to what it sees, and from there to the lamps; first bounce only, nothing
is rendered, and nothing in the file changes.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...core.numerics.arrays import Array
from ...core.numerics.direction_grid import hemisphere
from ..blender import working_space
from ..colorimetry import illuminant_spectra, rgb_space
from ..matching.scene_view import SceneView, make_light
from . import (
    camera,
    sampling,
    sources,
    surfaces,
)
from .camera import View
from .lamps import Dome, Sampled
from .sampling import Samples
from .sources import Lamp
from .surfaces import Hits

__all__ = ["SceneReport", "View", "analyze", "look"]

_HITS_A_MATERIAL = 32
"""Places of a material from which lamps are looked for."""
_RAYS = 48_000
"""Looks for lamps altogether. Too few at one place, and a light that is seldom met there has too
small a part: a part is never below 0, and cannot be as much too large."""
_LOOKS = (8, 48)
"""Looks from one place, least and most: the lamp is chosen by what it would shed there."""
_EVEN = 0.25
"""Part of the looks that choose among the lamps at even odds."""
_SEED = 20
_OFFSET = 1e-5
"""Start of a shadow ray above the surface, in diagonals of the scene."""


@dataclass(frozen=True)
class SceneReport:
    """What an analysis found.

    Parameters
    ----------
    views
        Material and its view, for each that the camera sees, unless the scene has no light.
    unlit
        Materials that are seen, but no lamp reaches except by way of other surfaces. Their view
        has the whole picture's lights, from all around.
    pixels
        Share of the picture that each seen material covers, 0 to 1.
    warnings
        Sentences for the user.
    seconds
        How long it took.
    """

    views: dict[Any, SceneView]
    unlit: tuple[Any, ...] = ()
    pixels: dict[Any, float] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0


def analyze(depsgraph: Any, scene: Any, view: View | None = None) -> SceneReport:
    """Look at a scene through its camera, or a viewport.

    Parameters
    ----------
    depsgraph
        Evaluated `bpy.types.Depsgraph` of the scene.
    scene
        A `bpy.types.Scene`.
    view
        What looks at it, or None for the scene's camera.

    Raises
    ------
    InputError
        If there is nothing to look through.
    """
    start = time.perf_counter()
    random = np.random.default_rng(_SEED)
    origins, ways = camera.rays(depsgraph, scene, view, random)
    found = surfaces.gather(depsgraph)
    space = working_space.current()
    lamps, warnings = sources.find(depsgraph, scene, found, space)
    hits = found.hit(origins, ways)
    counts = np.bincount(hits.materials[hits.materials >= 0], minlength=len(found.materials))
    seen = np.flatnonzero(counts)
    samples, places = look(found, hits, ways, lamps, space, random)
    views, unlit = _views(
        scene.name, samples, hits.materials[places], found.materials, lamps, space
    )
    return SceneReport(
        views,
        tuple(unlit),
        {found.materials[i]: float(counts[i]) / len(ways) for i in seen},
        tuple(warnings),
        time.perf_counter() - start,
    )


def look(
    found: surfaces.Surfaces,
    hits: Hits,
    ways: Array,
    lamps: list[Lamp],
    space: rgb_space.WorkingSpace,
    random: np.random.Generator,
) -> tuple[Samples, Array]:
    """Send rays towards lamps; gives the ways that arrive and the hits they start from."""
    places = _some_of_each(hits.materials, random)
    points, normals, facing = hits.points[places], hits.normals[places], hits.facing[places]
    view = -ways[hits.ray[places]]
    parts = []
    if lamps and len(places):
        luminance = np.array([np.linalg.solve(space.from_xyz, lamp.rgb)[1] for lamp in lamps])
        linked = _linked(lamps, found, hits.objects[places], hits.materials[places])
        start = points + facing * (_OFFSET * found.scale)
        looks = int(np.clip(_RAYS // len(places), *_LOOKS))
        for number in range(looks):
            # In even steps: the parts of lights that nothing hides then come out without noise.
            choice = (number + random.uniform(size=len(start))) / looks
            sampled = [lamp.source.sample(start, normals, random) for lamp in lamps]
            parts.append(
                _one_look(
                    found, lamps, sampled, choice, luminance, linked, start, normals, facing, view
                )
            )
    if not parts:
        none, no_index = np.zeros(0), np.zeros(0, int)
        return Samples(none, none, none, no_index, no_index, none, np.zeros((0, 3))), places
    seen = Samples(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))
    return replace(seen, light=seen.light / looks), places


def _one_look(
    found: surfaces.Surfaces,
    lamps: list[Lamp],
    sampled: list[Sampled],
    choice: Array,
    luminance: Array,
    linked: Array,
    start: Array,
    normals: Array,
    facing: Array,
    view: Array,
) -> tuple[Array, ...]:
    count = len(start)
    would = np.stack([part.irradiance for part in sampled]) * luminance[:, np.newaxis] * linked
    above = np.stack([np.einsum("ij,ij->i", part.toward, facing) > 0 for part in sampled])
    would = np.where(above, would, 0)
    total = would.sum(axis=0)
    # Mostly by what they would shed; some at even odds, since the brightest may be hidden.
    able = (would > 0) / np.maximum((would > 0).sum(axis=0), 1)
    odds = (1 - _EVEN) * would / np.maximum(total, 1e-300) + _EVEN * able
    lamp = (np.cumsum(odds, axis=0) < choice).sum(axis=0)
    lamp = np.minimum(lamp, len(lamps) - 1)
    own = np.arange(count)
    arrives = would[lamp, own] / np.maximum(odds[lamp, own], 1e-300)
    toward = np.stack([part.toward for part in sampled])[lamp, own]
    distance = np.stack([part.distance for part in sampled])[lamp, own]
    tried = np.flatnonzero((arrives > 0) & ((view * normals).sum(axis=1) > 0))
    shadowed = tried[np.array([one.shadow for one in lamps])[lamp[tried]]]
    # Ends short of the lamp, whose own surface would be in the way.
    hidden = found.blocked(start[shadowed], toward[shadowed], distance[shadowed] * (1 - 1e-3))
    free = np.setdiff1d(tried, shadowed[hidden], assume_unique=True)
    angles = sampling.angles(normals[free], view[free], toward[free])
    return (*angles, free, lamp[free], arrives[free], toward[free])


def _some_of_each(materials: Array, random: np.random.Generator) -> Array:
    """Choose at most so many hits of each material."""
    order = random.permutation(len(materials))
    order = order[np.argsort(materials[order], kind="stable")]
    sorted_ = materials[order]
    first = np.searchsorted(sorted_, sorted_, side="left")
    kept = (np.arange(len(order)) - first < _HITS_A_MATERIAL) & (sorted_ >= 0)
    return order[kept]


def _linked(lamps: list[Lamp], found: surfaces.Surfaces, objects: Array, materials: Array) -> Array:
    """Which lamps may reach which places, shape (lamps, places)."""
    rows = []
    for lamp in lamps:
        if lamp.receivers is None and not lamp.excluded:
            row = np.ones(len(objects), bool)
        else:
            row = np.array([lamp.lights(name) for name in found.objects], bool)[objects]
        rows.append(row & (materials != lamp.emitter))
    return np.stack(rows)


def _views(
    scene: str,
    samples: Samples,
    material_of_place: Array,
    materials: list[Any],
    lamps: list[Lamp],
    space: rgb_space.WorkingSpace,
) -> tuple[dict[Any, SceneView], list[Any]]:
    """Give views of the materials that are seen, and those that no lamp reaches."""
    weights = sampling.per_place(samples, len(material_of_place), material_of_place)
    power = np.bincount(samples.lamp, weights, minlength=len(lamps))
    seen = np.unique(material_of_place)
    if not power.sum() > 0:
        return {}, [materials[index] for index in seen]
    xyz = np.array([_arriving(i, lamp, samples, weights, space) for i, lamp in enumerate(lamps)])
    groups = sampling.group_colors(xyz, power, _numbered(lamps))
    colors = [_color(groups == light, xyz, power, lamps) for light in range(groups.max() + 1)]
    names = [name for name, _, _ in colors]
    for light, (name, words, spd) in enumerate(colors):
        # A lamp and the world may have the same name; by their names lights are told apart.
        earlier = names[:light].count(name)
        colors[light] = (f"{name} ({earlier + 1})" if earlier else name, words, spd)
    views, unlit = {}, []
    of_material = material_of_place[samples.hit]
    for index in seen:
        mine = np.flatnonzero((of_material == index) & (weights > 0))
        if not mine.size:
            unlit.append(materials[index])
            continue
        own = samples[mine]
        chosen, weight, place = sampling.reduce(own, weights[mine], groups[own.lamp])
        ways = np.column_stack((own.theta_i, own.theta_r, own.delta_phi))[chosen]
        views[materials[index]] = _view(
            scene, ways, groups[own.lamp[chosen]], weight, place, colors
        )
    if unlit:
        overall = _overall(scene, np.bincount(groups[groups >= 0], power[groups >= 0]), colors)
        views |= dict.fromkeys(unlit, overall)
    return views, unlit


def _overall(scene: str, power: Array, colors: list[tuple[str, str, Array]]) -> SceneView:
    """All lights of the picture, from all around: for what only gets light from surfaces."""
    shares = np.where(power >= sampling.LEAST_SHARE * power.sum(), power, 0)
    kept = np.flatnonzero(shares)
    ways = np.column_stack(hemisphere(sampling.SHADING_POINTS // len(kept)))
    weight = np.repeat(shares[kept] / shares.sum() / len(ways), len(ways))
    ways, light = np.tile(ways, (len(kept), 1)), np.repeat(kept, len(ways))
    return _view(scene, ways, light, weight, np.arange(len(ways)), colors)


def _numbered(lamps: list[Lamp]) -> Array:
    """Give each lamp the number of the spectrum that was chosen for it, -1 for none."""
    found: list[Array] = []
    numbers = []
    for lamp in lamps:
        number = -1
        if lamp.known is not None:
            alike = [np.array_equal(lamp.known[0], spectrum) for spectrum in found]
            number = [*alike, True].index(True)
            found += [] if True in alike else [lamp.known[0]]
        numbers.append(number)
    return np.array(numbers, int)


def _arriving(
    index: int, lamp: Lamp, samples: Samples, weights: Array, space: rgb_space.WorkingSpace
) -> Array:
    """XYZ of a lamp; of a picture around the scene, the mean of what arrives from it."""
    if lamp.known is not None:
        return illuminant_spectra.to_xyz(lamp.known[0])
    mine = samples.lamp == index
    if not isinstance(lamp.source, Dome) or lamp.source.xyz is None or not weights[mine].any():
        return np.linalg.solve(space.from_xyz, lamp.rgb)
    colors = lamp.source.xyz[lamp.source.pixel(samples.toward[mine])]
    return np.average(colors / colors[:, 1:2].clip(1e-30), axis=0, weights=weights[mine])


def _view(
    scene: str,
    ways: Array,
    group: Array,
    weight: Array,
    place: Array,
    colors: list[tuple[str, str, Array]],
) -> SceneView:
    shares = np.bincount(group, weight, minlength=len(colors))
    order = [int(light) for light in np.argsort(-shares, kind="stable") if shares[light] > 0]
    rank = {light: place for place, light in enumerate(order)}
    lights = tuple(make_light(*colors[light], float(shares[light])) for light in order)
    geometries = []
    rows = zip(ways.tolist(), group, weight, place.tolist(), strict=True)
    for (theta_i, theta_r, phi), light, part, number in rows:
        angles = round(theta_i, 4), round(theta_r, 4), round(phi, 4)
        geometries.append((*angles, rank[int(light)], round(float(part), 6), number))
    return SceneView(scene, lights, tuple(geometries))


def _color(members: Array, xyz: Array, power: Array, lamps: list[Lamp]) -> tuple[str, str, Array]:
    """Name and spectrum of the lamps of one color."""
    found = np.flatnonzero(members)
    found = found[np.argsort(-power[found], kind="stable")]
    mean = (xyz[found] / xyz[found, 1:2] * power[found, np.newaxis]).sum(axis=0)
    main = lamps[found[0]]
    spd, words = main.known or illuminant_spectra.like(mean, main.temperature)
    spd = np.maximum(spd, 0)  # beside a line it may be a little below
    spd = spd / illuminant_spectra.to_xyz(spd)[1]
    others = "" if len(found) == 1 else f" and {len(found) - 1} more"
    if len(found) == 2:
        others = f" and {lamps[found[1]].name}"
    return main.name + others, words, spd
