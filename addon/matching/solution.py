# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What matching a request gives: a color, a roughness, and how far they are from the target."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...core.numerics.arrays import Array

if TYPE_CHECKING:
    pass


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
    model, model_reason
        The model that gave the target, and why it was taken.
    delta_e_instrument
        ΔE00 predicted between target and Cycles at the instrument; in a scene, under its main
        light.
    delta_e_mean, delta_e_95
        Mean and 95th percentile over the hemisphere below 80°, or over the scene's directions.
    shader_reason
        Whether the material is Lambertian or rough, and why.
    delta_e_lambert
        Mean of the same for the Lambertian material with the same reading.
    warnings
        Sentences about what could not be met.
    sigma_max
        Largest σ, degrees, at which white facets read no less than the sample; None without one.
    delta_e_lights
        Name and mean ΔE00 of each of the scene's lights; empty without a scene.
    scene_reason
        One sentence about what the scene decided; empty without a scene.
    """

    color: Array
    roughness: float
    target: Array
    model: str
    model_reason: str
    delta_e_instrument: float
    delta_e_mean: float
    delta_e_95: float
    delta_e_lambert: float
    shader_reason: str
    warnings: tuple[str, ...]
    sigma_max: float | None = None
    delta_e_lights: tuple[tuple[str, float], ...] = ()
    scene_reason: str = ""
