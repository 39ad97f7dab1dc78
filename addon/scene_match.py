# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Match a material to the lights and directions of its scene. No Blender data here.

The color seen in each of the scene's directions, under the light that comes from there, is to be
the spectrum's; color and roughness are chosen for the least mean ΔE00 over all of them. A reading
at 45°/0° is then no longer met by itself: what the material reads there follows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..core import compromise, cycles, cycles_slopes, geometry, ladder, reading
from ..core.arrays import Array
from . import colorimetry
from .preview.words import SIDE_BY_SIDE
from .scene_view import SceneLight, SceneView
from .working_space import WorkingSpace

_ELSEWHERE = 12
"""Directions all over the hemisphere, which decide what the scene leaves open."""
_WEIGHT_ELSEWHERE = 0.03
"""Their part in the mean: the scene's directions win wherever they have a say."""
_ROUGHNESSES = (0.1, 0.5, 0.9)
"""Cycles' roughnesses that the search starts from."""
FLAT = "lambert: the render engine ignores diffuse roughness; the color is right for its scene."
_ENOUGH = 1e-4
"""Overshoot of the gamut that nobody sees."""
_FAINT = 0.01
"""Part of a light's strongest channel below which its color hangs on almost nothing."""


@dataclass(frozen=True, eq=False)
class Match:
    """A color and roughness, and what they leave over.

    Parameters
    ----------
    color, roughness
        Of the shader; the color within 0 to 1, shape (3,).
    over_scene
        ΔE00 in each of the view's places, shape (places,).
    instrument
        ΔE00 at 45°/0° under each of the view's lights, shape (lights,).
    """

    color: Array
    roughness: float
    over_scene: Array
    instrument: Array


def match(
    view: SceneView,
    albedo: Array,
    read: Array,
    model: str,
    sigma: float,
    bands: Array,
    space: WorkingSpace,
) -> tuple[Match, Match, Array]:
    """Match one material, with roughness and without.

    Parameters
    ----------
    view
        Its lights and directions.
    albedo, read
        ρ(λ), and r(λ) at the virtual instrument, each of shape (bands,).
    model
        One of `core.ladder.RUNGS`.
    sigma
        Roughness, radians.
    bands
        Wavelengths, nanometers, shape (bands,).
    space
        The working space.

    Returns
    -------
    rough, lambert, target
        The two materials, and the reading at 45°/0° as RGB, unclipped: the mean over the lights.
    """
    places = _Places.of(view, space)
    wanted_xyz = places.under_lights(_reflected(albedo, model, sigma, places), bands)
    ratio = places.to_ratio(wanted_xyz)
    # Rows of the search: several roughnesses, and last the material without any.
    roughness = np.array([*_ROUGHNESSES, 0.0])
    mean = np.clip(places.weights @ ratio, 1e-4, 1)
    color = np.clip(cycles.color_for_reading(np.tile(mean, (len(roughness), 1)), roughness), 0, 1)
    free = np.ones((len(roughness), 4), bool)
    free[-1, 3] = False
    wanted = colorimetry.xyz_to_lab(wanted_xyz, places.whites)
    found = compromise.fit(
        places.distance_to(wanted_xyz, wanted),
        places.weights,
        np.column_stack((color, roughness)),
        free,
    )
    apart = colorimetry.delta_e(places.perceive(found), wanted)
    best = int(np.argmin((apart * places.weights).sum(axis=-1)[:-1]))
    targets = [_read_under(light, read, bands, space) for light in view.lights]
    two = [best, len(found) - 1]
    at_instrument = _at_instrument(found[two], view, read, bands, space)
    rough, lambert = (
        Match(found[row, :3], float(found[row, 3]), apart[row, : len(view.place_weights)], missed)
        for row, missed in zip(two, at_instrument, strict=True)
    )
    return rough, lambert, np.average(targets, axis=0, weights=_shares(view))


def judge(
    view: SceneView,
    shader: tuple[Array, float],
    albedo: Array,
    model: str,
    sigma: float,
    bands: Array,
    space: WorkingSpace,
) -> Array:
    """ΔE00 of a given color and roughness in each of the view's places; see `match`."""
    places = _Places.of(view, space)
    wanted = places.under_lights(_reflected(albedo, model, sigma, places), bands)
    seen = places.perceive(np.append(shader[0], shader[1]))
    apart = colorimetry.delta_e(seen, colorimetry.xyz_to_lab(wanted, places.whites))
    return np.asarray(apart[: len(view.place_weights)])


def choose_shader(
    view: SceneView, lambert: Match, rough: Match, tolerance: float
) -> tuple[Match, str]:
    """Choose the material without roughness where that is good enough, else the closer one.

    Closer on average: where several lights contradict each other, they and not the roughness make
    up the largest error.

    Returns
    -------
    The material, and one sentence for a person.
    """
    worst = float(lambert.over_scene.max())
    if worst <= tolerance:
        return lambert, f"lambert: at most ΔE00 {worst:.2f} off in its scene, within {tolerance:g}."
    flat, bent = (np.average(m.over_scene, weights=view.place_weights) for m in (lambert, rough))
    if bent <= flat:
        words = "rough: ΔE00 {:.2f} off on average in its scene; lambert would be off by {:.2f}."
        return rough, words.format(bent, flat)
    words = "lambert: ΔE00 {:.2f} off on average in its scene; rough would be off by {:.2f}."
    return lambert, words.format(flat, bent)


def mean_of_lights(view: SceneView, apart: Array) -> tuple[tuple[str, float], ...]:
    """Mean ΔE00 where each light shines, with the light's name.

    A place counts by the part of its light that comes from there; `apart` has shape (places,).
    """
    of_row = apart[view.places]
    return tuple(
        (light.name, float(np.average(of_row[mine], weights=view.weights[mine])))
        for index, light in enumerate(view.lights)
        if (mine := view.light_indices == index).any()
    )


def percentile(values: Array, weights: Array, share: float) -> float:
    """Value below which that share of the weights lies."""
    order = np.argsort(values)
    passed = np.cumsum(weights[order]) / weights.sum()
    return float(values[order][min(int(np.searchsorted(passed, share)), len(values) - 1)])


def explain(view: SceneView, per_light: tuple[tuple[str, float], ...]) -> str:
    """Say in one sentence what the scene's lights decided."""
    if len(view.lights) == 1:
        light = view.lights[0]
        return f"Matched to one color of light, {light.name} ({light.words})."
    shares = {light.name: light.share for light in view.lights}
    parts = ", ".join(
        f"{name} ΔE00 {apart:.2f} ({shares[name]:.0%} of the light)" for name, apart in per_light
    )
    apart = [delta_e for _, delta_e in per_light]
    said = (
        f"Matched to {len(view.lights)} colors of light as they mix in the picture; the mean over "
        f"it is least with {parts}."
    )
    if max(apart) - min(apart) < SIDE_BY_SIDE:
        return said
    return f"{said} No single color is right under all of them."


def gamut(name: str, target: Array, space: WorkingSpace) -> str:
    """Say when the reading needs a channel below 0 or above 1; an empty sentence if not."""
    outside = np.maximum(-target, target - 1)
    channel = int(np.argmax(outside))
    if outside[channel] <= _ENOUGH:
        return ""
    return (
        f"{name!r} lies outside the gamut of {space.name} under the scene's light: its reading "
        f"needs {'RGB'[channel]} = {target[channel]:.4f}; the nearest color was taken."
    )


def promised(color: Array, roughness: float, view: SceneView, space: WorkingSpace) -> Array:
    """Lab at 45°/0° of a shader under the view's main light, shape (3,)."""
    seen = cycles.reflectance(color, roughness, *reading.INSTRUMENT_ANGLES["45a:0"])
    return to_lab(seen, view.lights[0], space)


def to_lab(rgb: Array, light: SceneLight, space: WorkingSpace) -> Array:
    """L*a*b* of a surface's scene-linear reflectance (..., 3), rendered under a light."""
    return colorimetry.xyz_to_lab(to_xyz(rgb, light, space), light.white)


def to_xyz(rgb: Array, light: SceneLight, space: WorkingSpace) -> Array:
    """XYZ (Y = 1 for white) of a surface's reflectance (..., 3), rendered under a light."""
    return np.asarray((rgb * light_rgb(light, space)) @ np.linalg.inv(space.from_xyz).T)


def light_rgb(light: SceneLight, space: WorkingSpace) -> Array:
    """Scene-linear RGB of a light with a luminance of 1; never negative, as in Blender."""
    return np.maximum(space.from_xyz @ light.white, 0)


@dataclass(frozen=True, eq=False)
class _Places:
    """Places in a scene and, with little weight, one for each of some directions all around.

    `angles`, `index` of the light and `rgb` of it are those of the ways of light, (ways,);
    `mixing`, (places, ways), is the part of each way in the light of a place.
    """

    angles: tuple[Array, Array, Array]
    lights: tuple[SceneLight, ...]
    index: Array
    mixing: Array
    weights: Array
    whites: Array
    rgb: Array
    from_xyz: Array
    to_xyz: Array

    @classmethod
    def of(cls, view: SceneView, space: WorkingSpace) -> _Places:
        spread = geometry.hemisphere(_ELSEWHERE)
        light, view_angle, azimuth = map(np.append, view.angles, spread)
        index = np.append(view.light_indices, np.zeros(_ELSEWHERE, int))
        elsewhere = np.full(_ELSEWHERE, _WEIGHT_ELSEWHERE / _ELSEWHERE)
        scene = view.place_weights / view.place_weights.sum() * (1 - _WEIGHT_ELSEWHERE)
        weights = np.append(scene, elsewhere)
        mixing = np.zeros((len(weights), len(index)))
        count, ways = len(scene), len(view.weights)
        mixing[view.places, np.arange(ways)] = view.weights / view.place_weights[view.places]
        mixing[np.arange(count, len(weights)), np.arange(ways, len(index))] = 1
        whites = mixing @ np.stack([lamp.white for lamp in view.lights])[index]
        rgb = np.stack([light_rgb(lamp, space) for lamp in view.lights])[index]
        angles, to_xyz = (light, view_angle, azimuth), np.linalg.inv(space.from_xyz).T
        return cls(angles, view.lights, index, mixing, weights, whites, rgb, space.from_xyz, to_xyz)

    @cached_property
    def to_relative(self) -> Array:
        """Turns coefficients of Cycles' closure into XYZ relative to white.

        Shape (9, 3 places): channel and function of the closure; X, Y or Z and place.
        """
        # (ways, channel, function), then (places, …): mixed, then as XYZ relative to white.
        functions = cycles_slopes.functions(*self.angles).T
        ways = self.rgb[..., np.newaxis] * functions[:, np.newaxis]
        mixed = (self.mixing @ ways.reshape(len(ways), 9)).reshape(-1, 3, 3)
        to_xyz = self.to_xyz / self.whites[:, np.newaxis]
        return np.einsum("pcx,pcf->cfxp", to_xyz, mixed).reshape(9, -1)

    def under_lights(self, reflected: Array, bands: Array) -> Array:
        """XYZ of each place, shape (places, 3), from the spectra (ways, bands) of its ways."""
        matrices = np.stack([light.weights(bands) for light in self.lights])
        return np.asarray(self.mixing @ np.einsum("gb,gbx->gx", reflected, matrices[self.index]))

    def to_ratio(self, xyz: Array) -> Array:
        """Per-channel ratio to the light; where a light lacks a channel, that of its luminance."""
        rgb, light = xyz @ self.from_xyz.T, self.mixing @ self.rgb
        faint = light < _FAINT * light.max(axis=1, keepdims=True)
        return np.where(faint, xyz[:, 1:2], rgb / np.where(faint, 1, light))

    def perceive(self, parameters: Array) -> Array:
        """Lab of Cycles' material with parameters (..., 4), color and roughness, in all places."""
        color, roughness = parameters[..., np.newaxis, :3], parameters[..., np.newaxis, 3]
        seen = cycles.reflectance(color, roughness, *self.angles)
        return colorimetry.xyz_to_lab(self.mixing @ ((seen * self.rgb) @ self.to_xyz), self.whites)

    def distance_to(self, xyz: Array, lab: Array) -> Callable[[Array], tuple[Array, Array]]:
        """Give what `compromise.fit` searches: how far materials are from wanted colors.

        Parameters
        ----------
        xyz, lab
            The same colors in all places, each of shape (places, 3).
        """
        metric = compromise.whitener(lab, colorimetry.delta_e) @ colorimetry.LAB_FROM_ROOTS
        # One for X, Y and Z each, (3, places): the place comes last, where numpy is fast.
        of_x, of_y, of_z = np.ascontiguousarray(metric.transpose(2, 1, 0))
        roots, _ = colorimetry.roots(np.ascontiguousarray((xyz / self.whites).T))

        def distance(parameters: Array) -> tuple[Array, Array]:
            parts = cycles_slopes.coefficients(parameters[:, :3], parameters[:, 3])
            relative = parts.reshape(-1, 9) @ self.to_relative
            relative = relative.reshape(len(parameters), 5, 3, -1)
            bent, slope = colorimetry.roots(relative[:, 0])
            relative[:, 0] = bent - roots
            relative[:, 1:] *= slope[:, np.newaxis]
            x, y, z = (relative[:, :, i : i + 1] for i in range(3))
            found = of_x * x + of_y * y + of_z * z
            return found[:, 0], found[:, 1:]

        return distance


def _reflected(albedo: Array, model: str, sigma: float, places: _Places) -> Array:
    spread = ladder.reflectance(model, np.minimum(albedo, 1), *places.angles, sigma)
    # The published model turns negative at grazing opposite directions; no surface does. Facets
    # that return more light than reaches them are kept in proportion, as in `target`.
    return np.maximum(spread * np.maximum(albedo, 1), np.minimum(albedo, 0))


def _read_under(light: SceneLight, read: Array, bands: Array, space: WorkingSpace) -> Array:
    rgb = light_rgb(light, space)
    xyz = read @ light.weights(bands)
    faint = rgb < _FAINT * rgb.max()
    return np.where(faint, xyz[1], space.from_xyz @ xyz / np.where(faint, 1, rgb))


def _at_instrument(
    shaders: Array, view: SceneView, read: Array, bands: Array, space: WorkingSpace
) -> Array:
    """ΔE00 at 45°/0° of shaders (shaders, 4) under each of the lights, (shaders, lights)."""
    angles = reading.INSTRUMENT_ANGLES["45a:0"]
    seen = cycles.reflectance(shaders[:, :3], shaders[:, 3], *angles)[:, np.newaxis]
    rgb, whites, wanted = (
        np.stack(rows)
        for rows in zip(
            *(
                (light_rgb(light, space), light.white, read @ light.weights(bands))
                for light in view.lights
            ),
            strict=True,
        )
    )
    xyz = (seen * rgb) @ np.linalg.inv(space.from_xyz).T
    labs = (colorimetry.xyz_to_lab(color, whites) for color in (xyz, wanted))
    return colorimetry.delta_e(*labs)


def _shares(view: SceneView) -> Array:
    return np.array([light.share for light in view.lights])
