# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two materials that look alike in one light are apart in other lights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core.color import color_difference, metamerism
from ...core.models import TARGET
from ...core.numerics.arrays import Array
from ..colorimetry import tristimulus
from ..samples.sample import Sample
from . import surface_spectra
from .request import AUTO, Request
from .scene_view import SceneLight

LIGHTS = ("A", "F11", "LED-B3")
"""Illuminants that stand for lamps: incandescent, fluorescent with three bands, white LED."""

Light = str | SceneLight
"""An illuminant by its name, or a light of a scene."""


@dataclass(frozen=True)
class InLight:
    """Two materials in a light.

    Attributes
    ----------
    light
        Name of the illuminant, or of a scene's light.
    delta_e_00
        How far apart they are there, CIEDE2000.
    index
        The part of it that the reference light does not show: the special metamerism index, change
        in illuminant (CIE 15:2004), with the correction of ISO 18314-4, as CIEDE2000. 0 in the
        reference light.
    """

    light: str
    delta_e_00: float
    index: float


def compare(
    first: Request, second: Request, lights: Sequence[Light] = LIGHTS, reference: Light = "D65"
) -> tuple[InLight, ...]:
    """Compare what the virtual instrument reads of two materials in several lights.

    Parameters
    ----------
    first, second
        Each with its roughness and its own wavelengths. What they say of light is not looked at.
    lights
        Test lights.
    reference
        Light in which the two are to match.

    Returns
    -------
    The reference light, then the others in their order; for the 2° observer.

    Raises
    ------
    DomainError
        If an illuminant is not known, or a spectrum does not cover the visible range.
    """
    pair = [_flat(first), _flat(second)]
    read = [
        (request.sample, surface_spectra.readings_and_albedos([request])[0][0]) for request in pair
    ]
    here = _seen(read, reference)
    found = []
    for light in (reference, *lights):
        there = _seen(read, light)
        one, other = color_difference.xyz_to_lab(np.stack(there), np.ones(3))
        found.append(
            InLight(
                light if isinstance(light, str) else light.name,
                float(color_difference.delta_e(one, other)),
                float(metamerism.index(here, there, np.ones(3))),
            )
        )
    return tuple(found)


def _seen(read: Sequence[tuple[Sample, Array]], light: Light) -> tuple[Array, Array]:
    """Give X, Y and Z of both over those of white, each by the white of its own wavelengths."""
    found = []
    for sample, values in read:
        with surface_spectra.naming(sample):
            bands = sample.wavelengths
            if isinstance(light, str):
                weights = tristimulus.weights(bands, light)
            else:
                tristimulus.weights(bands)  # refuses what leaves too much of the color out
                weights = light.weights(bands)
        found.append(np.asarray(values @ weights / weights.sum(axis=0)))
    one, other = found
    return one, other


def _flat(request: Request) -> Request:
    """Leave out the scene, whose lights are compared one by one, and settle the model."""
    model = TARGET if request.model == AUTO else request.model
    return replace(request, model=model, scene=None, flat=False, gloss=None)
