# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Match a material to the lights and directions of its scene. No Blender data here.

The color seen in each of the scene's directions, under the light that comes from there, is to be
the spectrum's; color and roughness are chosen for the least mean ΔE00 over all of them. A reading
at the instrument is then no longer met by itself: what the material reads there follows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import cycles, instruments, ladder
from ...core.color import color_difference
from ...core.cycles import (
    derivatives,
    gloss_lobe,
    gloss_reading,
    instrument_lobe,
    least_mean_fit,
    matching,
)
from ...core.gloss import Gloss
from ...core.numerics import direction_grid
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from ..colorimetry.perceptibility import SIDE_BY_SIDE
from ..colorimetry.rgb_space import WorkingSpace, matrix_of
from . import glossy
from . import outside as outside_words
from .scene_view import SceneLight, SceneView

_ELSEWHERE = 12
"""Directions all over the hemisphere, which decide what the scene leaves open."""
_WEIGHT_ELSEWHERE = 0.03
"""Their part in the mean: the scene's directions win wherever they have a say."""
_STARTS = (0.1, 0.5, 0.9, 0.0)
"""Cycles' roughnesses that the search starts from; the last is of the material without any."""
_FREE = [[True, True, True, start > 0] for start in _STARTS]
"""What may change from each of `_STARTS`: red, green, blue and roughness."""
FLAT = "lambert: the render engine ignores diffuse roughness; the color is right for its scene."
_ENOUGH = 1e-4
"""Overshoot of the gamut that nobody sees."""
_FAINT = 0.01
"""Part of a light's strongest channel below which its color hangs on almost nothing."""
_KEPT = 32
"""Views of which `_ShadingPoints` are kept, some 100 kB each: a dragged slider asks for them
again."""


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
        ΔE00 at the instrument under each of the view's lights, shape (lights,).
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
    read_at: str = instruments.DEFAULT,
    gloss: Gloss | None = None,
) -> tuple[Match, Match, Array]:
    """Match one material, with roughness and without.

    Parameters
    ----------
    view
        Its lights and directions.
    albedo, read
        ρ(λ), and r(λ) at the virtual instrument, each of shape (bands,).
    model
        One of `core.models.NAMES`.
    sigma
        Roughness, radians.
    bands
        Wavelengths, nanometers, shape (bands,).
    space
        The working space.
    read_at
        The virtual instrument.
    gloss
        What lies over the diffuse lobe, or None.

    Returns
    -------
    rough, lambert, target
        The two materials, and the reading at the instrument as RGB, unclipped: the mean over the
        lights.
    """
    places = _places(view, bands.tobytes(), space.key, read_at, gloss)
    wanted = places.relative(_reflected(albedo, model, sigma, places), read)
    mean, target = (places.to_means @ wanted.ravel()).reshape(2, 3)
    roots, _ = color_difference.roots(wanted)
    lab = color_difference.roots_to_lab(roots)
    color = np.clip(
        matching.color_for_reading(np.clip(mean, 1e-4, 1)[np.newaxis], _STARTS, read_at), 0, 1
    )
    starts = [[*own, start] for own, start in zip(color.tolist(), _STARTS, strict=True)]
    found = least_mean_fit.fit(places.distance_to(roots, lab), places.weights, starts, _FREE)
    apart = color_difference.delta_e(places.perceive(found), lab)
    searched, in_view = len(places.weights), len(view.place_weights)
    best = int(np.argmin(apart[:-1, :searched] @ places.weights))
    rough, lambert = (
        Match(np.array(found[row][:3]), found[row][3], apart[row, :in_view], apart[row, searched:])
        for row in (best, len(found) - 1)
    )
    return rough, lambert, target


def differences(
    view: SceneView,
    shader: tuple[Array, float],
    albedo: Array,
    model: str,
    sigma: float,
    bands: Array,
    space: WorkingSpace,
    read_at: str = instruments.DEFAULT,
    gloss: tuple[Gloss, Array] | None = None,
) -> Array:
    """ΔE00 of a given color and roughness in each of the view's places; see `match`.

    `gloss` is what lies over them, and r(λ) at the virtual instrument, shape (bands,).
    """
    cycles.check_roughness(np.asarray(shader[1]))
    over, read = gloss or (None, None)
    places = _places(view, bands.tobytes(), space.key, read_at, over)
    wanted = places.relative(_reflected(albedo, model, sigma, places), read)
    wanted = wanted[: len(places.weights)]
    seen = places.perceive([[*shader[0].tolist(), shader[1]]])
    lab = color_difference.roots_to_lab(color_difference.roots(wanted)[0])
    return color_difference.delta_e(seen[0, : len(wanted)], lab)[: len(view.place_weights)]


def choose_shader(
    view: SceneView, lambert: Match, rough: Match, tolerance: float, gloss: bool = False
) -> tuple[Match, str]:
    """Choose the material without roughness where that is good enough, else the closer one.

    Closer on average: where several lights contradict each other, they and not the roughness make
    up the largest error. With `gloss` both lie under one, which is kept.

    Returns
    -------
    The material, and one sentence for a person.
    """
    worst = float(lambert.over_scene.max())
    kept = " with gloss" if gloss else ""
    if worst <= tolerance:
        words = f"at most ΔE00 {worst:.2f} off in its scene, within {tolerance:g}."
        return lambert, f"lambert{kept}: {words}"
    weights = view.place_weights / view.place_weights.sum()
    flat, bent = (float(each.over_scene @ weights) for each in (lambert, rough))
    if bent <= flat:
        words = "rough{}: ΔE00 {:.2f} off on average in its scene; without roughness it is {:.2f}."
        return rough, words.format(kept, bent, flat)
    words = "lambert{}: ΔE00 {:.2f} off on average in its scene; with roughness it is {:.2f}."
    return lambert, words.format(kept, flat, bent)


def mean_of_lights(view: SceneView, apart: Array) -> tuple[tuple[str, float], ...]:
    """Mean ΔE00 where each light shines, with the light's name.

    A place counts by the part of its light that comes from there; `apart` has shape (places,).
    """
    return tuple(
        (light.name, float(parts @ apart))
        for light, parts in zip(view.lights, view.light_parts, strict=True)
        if parts.any()
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


def gamut(name: str, target: Array, space: WorkingSpace, read: Array) -> str:
    """Say when the reading needs a channel below 0 or above 1; an empty sentence if not.

    `read` is its spectrum, shape (bands,): above 1, no working space helps.
    """
    outside = np.maximum(-target, target - 1)
    channel = int(np.argmax(outside))
    if outside[channel] <= _ENOUGH:
        return ""
    value, peak = float(target[channel]), float(read.max())
    beyond = value > 1 and peak > 1 + _ENOUGH
    return outside_words.in_scene(name, space.name, "RGB"[channel], value, peak, beyond)


def promised(
    color: Array,
    roughness: float,
    view: SceneView,
    space: WorkingSpace,
    read_at: str,
    gloss: Gloss | None = None,
) -> Array:
    """Lab at an instrument of a shader under the view's main light, shape (3,)."""
    diffuse = instrument_lobe.reflectance(color, roughness, read_at)
    seen = gloss_reading.reading(diffuse, gloss, read_at)
    return to_lab(seen, view.lights[0], space)


def to_lab(rgb: Array, light: SceneLight, space: WorkingSpace) -> Array:
    """L*a*b* of a surface's scene-linear reflectance (..., 3), rendered under a light."""
    return color_difference.xyz_to_lab(to_xyz(rgb, light, space), light.white)


def to_xyz(rgb: Array, light: SceneLight, space: WorkingSpace) -> Array:
    """XYZ (Y = 1 for white) of a surface's reflectance (..., 3), rendered under a light."""
    return np.asarray(rgb @ _rendered(light, space.key))


def _rendered(light: SceneLight, key: bytes) -> Array:
    """Matrix of `to_xyz`, for a working space's key."""
    matrix = matrix_of(key)
    return np.asarray(light_rgb(light.white, matrix)[:, np.newaxis] * np.linalg.inv(matrix).T)


def light_rgb(white: Array, from_xyz: Array) -> Array:
    """Scene-linear RGB of lights of XYZ (..., 3); never negative, as in Blender."""
    return np.maximum(white @ from_xyz.T, 0)


@dataclass(frozen=True, eq=False)
class _ShadingPoints:
    """Where materials are looked at in a scene, and all of it that no material changes.

    First come the places of the view and, with little weight, one for each of some directions all
    around: these are searched. Last comes the instrument under each of the lights.

    Parameters
    ----------
    angles
        θi, θr and Δφ of the ways of light to what is searched, shape (3, ways).
    weights
        Of what is searched, shape (searched,).
    colors
        From spectra to XYZ under each light, shape (bands, 3 lights).
    own
        Where each way and its light are in an array of (ways · lights), shape (ways,).
    mixing
        Part of each way in the light of what is searched, shape (searched, ways).
    whites
        XYZ of the light, shape (places, 3).
    to_relative
        From coefficients of Cycles' closure, by channel and function, to XYZ relative to white, by
        place and X, Y or Z: shape (3 places, 9).
    to_means
        From XYZ relative to white to two means of RGB, by mean and channel: over what is searched,
        and over the lights at the instrument. Shape (6, 3 places).
    under
        What gloss adds and lets pass; None without.
    """

    angles: Array
    weights: Array
    colors: Array
    own: Array
    mixing: Array
    whites: Array
    to_relative: Array
    to_means: Array
    under: _Under | None

    def relative(self, reflected: Array, read: Array | None = None) -> Array:
        """XYZ relative to white of spectra (ways, bands) and a reading (bands,): (places, 3).

        Without a reading, only of what is searched. Under gloss there has to be one.
        """
        ways = (reflected @ self.colors).reshape(-1, 3).take(self.own, axis=0)
        at_instrument = None if read is None else (read @ self.colors).reshape(-1, 3)
        if self.under is not None and at_instrument is not None:
            ways = self.under.target(ways, at_instrument)
        xyz = self.mixing @ ways
        if at_instrument is not None:
            xyz = np.concatenate((xyz, at_instrument))
        return np.asarray(xyz / self.whites[: len(xyz)])

    def perceive(self, parameters: list[least_mean_fit.Numbers]) -> Array:
        """Lab, shape (materials, places, 3), of materials as `derivatives` takes them."""
        parts = derivatives.coefficients(parameters)
        relative = parts[:, 0].reshape(-1, 9) @ self.to_relative.T
        relative = relative.reshape(len(parameters), -1, 3)
        if self.under is not None:
            relative = relative + self.under.added
        return color_difference.roots_to_lab(color_difference.roots(relative)[0])

    def distance_to(self, roots: Array, lab: Array) -> least_mean_fit.Distance:
        """Give what `least_mean_fit.fit` searches: how far materials are from wanted colors.

        Parameters
        ----------
        roots, lab
            The same colors in all places, each of shape (places, 3).
        """
        count = len(self.weights)
        wanted, to_relative = roots[:count, :, np.newaxis], self.to_relative[: 3 * count]
        added = None if self.under is None else self.under.added[:count, :, np.newaxis]
        metric = least_mean_fit.whitener(lab[:count]) @ color_difference.LAB_FROM_ROOTS

        def distance(parameters: list[least_mean_fit.Numbers]) -> Array:
            parts = derivatives.coefficients(parameters)
            found = (to_relative @ parts.reshape(-1, 9).T).reshape(count, 3, len(parameters), -1)
            if added is not None:
                found[..., 0] += added
            bent, slope = color_difference.roots(found[..., 0])
            np.subtract(bent, wanted, out=found[..., 0])
            found[..., 1:] *= slope[..., np.newaxis]
            return (metric @ found.reshape(count, 3, -1)).reshape(found.shape)

        return distance


@dataclass(frozen=True, eq=False)
class _Under:
    """A gloss over all ways of light of `_ShadingPoints`.

    Parameters
    ----------
    there
        What it adds and lets pass at the instrument.
    layer
        What it adds and lets pass on the ways to what is searched, each of shape (ways, 3).
    added
        XYZ relative to white that it adds in all places, shape (places, 3).
    light
        Scene-linear RGB of each light, shape (lights, 3).
    lights
        Index of each way's light, shape (ways,).
    from_xyz
        Matrix from XYZ to scene-linear RGB.
    """

    there: gloss_lobe.Layer
    layer: gloss_lobe.Layer
    added: Array
    light: Array
    lights: Array
    from_xyz: Array

    def target(self, matte: Array, read: Array) -> Array:
        """Put it over matte targets, XYZ (ways, 3), with readings under each light, (lights, 3)."""
        light = np.maximum(self.light, _FAINT * self.light.max(axis=1, keepdims=True))
        _, share = glossy.share_below(self.there, read @ self.from_xyz.T / light)
        body = matte @ self.from_xyz.T * share[self.lights]
        seen = self.layer.passed * body + self.layer.shine * self.light[self.lights]
        return np.asarray(seen @ np.linalg.inv(self.from_xyz).T)


def _layer(gloss: Gloss, angles: Array, read_at: str, lights: int) -> gloss_lobe.Layer:
    """Give what lies over all ways and, for each of the lights, over the instrument."""
    elsewhere, there = gloss_lobe.layer(gloss, *angles), gloss_reading.at_instrument(gloss, read_at)
    shine, passed = (
        np.vstack((all_ways, np.tile(at, (lights, 1))))
        for all_ways, at in zip(elsewhere, there, strict=True)
    )
    return gloss_lobe.Layer(shine, passed)


@memoized(maxsize=_KEPT)
def _places(
    view: SceneView, bands: bytes, key: bytes, read_at: str, gloss: Gloss | None
) -> _ShadingPoints:
    """Make them, for the bytes of wavelengths, a working space's key and an instrument."""
    matrix, wavelengths = matrix_of(key), np.frombuffer(bands)
    angles, lights, mixing = _ways(view)
    white = np.stack([light.white for light in view.lights])[lights]
    rgb = light_rgb(white, matrix)
    whites = mixing @ white
    at = instrument_lobe.mean_direction(read_at, angles.dtype)
    instrument = derivatives.of_directions(*(np.full(len(view.lights), each) for each in at))
    functions = np.concatenate((derivatives.functions(*angles), instrument), axis=1).T
    to_xyz = np.linalg.inv(matrix).T / whites[:, np.newaxis]
    layer = None if gloss is None else _layer(gloss, angles, read_at, len(view.lights))
    below = rgb if layer is None else rgb * layer.passed
    mixed = mixing @ (below[..., np.newaxis] * functions[:, np.newaxis]).reshape(-1, 9)

    scene = view.place_weights / view.place_weights.sum() * (1 - _WEIGHT_ELSEWHERE)
    weights = np.append(scene, np.full(_ELSEWHERE, _WEIGHT_ELSEWHERE / _ELSEWHERE))
    searched, ways = len(weights), len(view.weights) + _ELSEWHERE
    share = np.array([light.share for light in view.lights])
    means = np.zeros((2, len(mixing)))
    means[0, :searched], means[1, searched:] = weights, share / share.sum()
    to_ratio = _to_ratio(matrix, mixing @ rgb) * whites[:, np.newaxis]
    under = None
    if gloss is not None and layer is not None:
        under = _Under(
            gloss_reading.at_instrument(gloss, read_at),
            gloss_lobe.Layer(layer.shine[:ways], layer.passed[:ways]),
            np.einsum("pc,pcx->px", mixing @ (rgb * layer.shine), to_xyz),
            light_rgb(np.stack([light.white for light in view.lights]), matrix),
            lights[:ways],
            matrix,
        )
    return _ShadingPoints(
        angles=angles,
        weights=weights,
        colors=np.concatenate([light.weights(wavelengths) for light in view.lights], axis=1),
        own=np.arange(ways) * len(view.lights) + lights[:ways],
        mixing=mixing[:searched, :ways],
        whites=whites,
        to_relative=np.einsum("pcx,pcf->pxcf", to_xyz, mixed.reshape(-1, 3, 3)).reshape(-1, 9),
        to_means=np.einsum("mp,pcx->mcpx", means, to_ratio).reshape(6, -1),
        under=under,
    )


def _ways(view: SceneView) -> tuple[Array, Array, Array]:
    """Give the ways of light to all places of `_ShadingPoints`.

    Returns
    -------
    angles, lights, mixing
        θi, θr and Δφ of what is searched, shape (3, searched ways); index of the light, shape
        (ways,); and the part of each way in the light of each place, shape (places, ways).
    """
    count = len(view.lights)
    angles: Array = np.concatenate((view.angles, direction_grid.hemisphere(_ELSEWHERE)), axis=1)
    elsewhere = np.zeros(_ELSEWHERE, int)
    lights = np.concatenate((view.light_indices, elsewhere, np.arange(count)))
    # Beyond the view each way has a place of its own.
    places, ways = len(view.place_weights), len(view.weights)
    mixing = np.zeros((places + _ELSEWHERE + count, len(lights)))
    mixing[view.places, np.arange(ways)] = view.weights / view.place_weights[view.places]
    mixing[places:, ways:] = np.eye(_ELSEWHERE + count)
    return angles, lights, mixing


def _to_ratio(from_xyz: Array, light: Array) -> Array:
    """Matrices, shape (places, 3, 3), from XYZ to the per-channel ratio to the light.

    Where a light lacks a channel, to that of its luminance.
    """
    faint = (light < _FAINT * light.max(axis=1, keepdims=True))[..., np.newaxis]
    luminance = np.array((0.0, 1.0, 0.0))
    return np.where(faint, luminance, from_xyz / np.where(faint, 1, light[..., np.newaxis]))


def _reflected(albedo: Array, model: str, sigma: float, places: _ShadingPoints) -> Array:
    light, view, azimuth = places.angles
    spread = ladder.reflectance(model, np.minimum(albedo, 1), light, view, azimuth, sigma)
    # The published model turns negative at grazing opposite directions; no surface does. Facets
    # that return more light than reaches them are kept in proportion, as in `solve`.
    return np.maximum(spread * np.maximum(albedo, 1), np.minimum(albedo, 0))
