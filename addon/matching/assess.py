# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far what is in the shader node now is from the target, edited or not."""

from __future__ import annotations

import numpy as np

from ...core import cycles, ladder
from ...core.color import color_difference
from ...core.cycles import gloss_reading, instrument_lobe
from ...core.numerics import direction_grid
from ...core.numerics.arrays import Array
from ..colorimetry.rgb_space import WorkingSpace
from . import glossy, scene_match, solve
from .scene_view import SceneView
from .solve import MATCH_GEOMETRIES, Request

Differences = tuple[float, float, float]
"""ΔE00 at the instrument, and mean and 95th percentile over all angles."""


def differences(
    request: Request, spectra: tuple[Array, Array], shader: tuple[Array, float], space: WorkingSpace
) -> Differences:
    """Compare a shader with the target.

    Parameters
    ----------
    request
        With a settled model.
    spectra
        Reading of the virtual instrument and albedo, each of shape (bands,).
    shader
        Color, shape (3,), and Cycles' roughness.
    space
        The working space that the color is in.
    """
    (seen, albedo), (color, roughness) = spectra, shader
    bands = request.sample.wavelengths
    gloss, read_at = request.gloss, request.read_at
    diffuse = instrument_lobe.reflectance(color, roughness, read_at)
    at_instrument = gloss_reading.reading(diffuse, gloss, read_at)
    if request.scene is not None:
        view, light = request.scene, request.scene.lights[0]
        wanted = color_difference.xyz_to_lab(seen @ light.weights(bands), light.white)
        apart = color_difference.delta_e(scene_match.to_lab(at_instrument, light, space), wanted)
        over = solve.differences(request, view, color, roughness, space)
        high = scene_match.percentile(over, view.place_weights, 0.95)
        return float(apart), float(np.average(over, weights=view.place_weights)), high
    angles = direction_grid.hemisphere(MATCH_GEOMETRIES)
    reflected = np.vstack((in_directions(request, albedo, angles), seen))
    rgb = reflected @ space.rgb_weights(bands, request.illuminant)
    targets = glossy.target(gloss, rgb[-1], rgb[:-1], angles, read_at)
    wanted = space.to_lab(np.vstack((targets, rgb[-1])), request.illuminant)
    shown = cycles.reflectance(color, np.full(MATCH_GEOMETRIES, roughness), *angles)
    shown = glossy.over(gloss, shown, angles)
    found = space.to_lab(np.vstack((shown, at_instrument)), request.illuminant)
    *over_angles, apart = color_difference.delta_e(found, wanted)
    return float(apart), float(np.mean(over_angles)), float(np.percentile(over_angles, 95))


def under_main_light(
    view: SceneView, seen: Array, bands: Array, shown: Array, space: WorkingSpace
) -> tuple[Array, Array]:
    """Give target and shader as the eye that is used to a scene's main light sees them.

    Parameters
    ----------
    view
        The scene.
    seen, bands
        Reading of the target and its wavelengths, shape (bands,).
    shown
        Reflectance of the shader in scene-linear RGB, shape (3,).
    space
        The working space.

    Returns
    -------
    Scene-linear RGB, shape (3,), adapted to the working space's white: it can be put on a screen.
    """
    light = view.lights[0]
    adapt = space.from_xyz @ color_difference.adaptation(light.white, space.white)
    return adapt @ (seen @ light.weights(bands)), adapt @ scene_match.to_xyz(shown, light, space)


def in_directions(request: Request, rho: Array, angles: tuple[Array, Array, Array]) -> Array:
    """Reflectance factor in all directions, (angles, bands)."""
    found = ladder.reflectance(request.model, np.minimum(rho, 1), *angles, request.sigma)
    return np.asarray(found * np.maximum(rho, 1))
