# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene shows of one material: its lights, and the directions they and the camera meet it.

Holds nothing of Blender's. Stored with the material as JSON text.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np

from ...core.errors import InputError
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from ..colorimetry import illuminant_spectra

SCHEMA = 1
_DIGITS = 5
"""Significant digits of a stored spectrum: a hundredth of what shows in ΔE00."""

_BELOW = 1e-3
"""Radians that a direction may lie below the surface by rounding."""


@dataclass(frozen=True)
class SceneLight:
    """One color of light in the scene.

    Parameters
    ----------
    name
        The lights that have it, such as "Lamp" or "Lamp and 5 more".
    words
        What its spectrum was taken for.
    spd
        Spectrum at `illuminant_spectra.GRID`, with a luminance Y of 1.
    share
        Its part in the light that falls on the material, 0 to 1; all lights' add up to 1.
    """

    name: str
    words: str
    spd: tuple[float, ...]
    share: float

    @cached_property
    def white(self) -> Array:
        """XYZ of the light, Y = 1, shape (3,)."""
        return illuminant_spectra.to_xyz(self.spd)

    def weights(self, wavelengths: Array) -> Array:
        """Give the matrix, shape (bands, 3), from reflectance to XYZ under this light, Y = 1."""
        return illuminant_spectra.weights(tuple(wavelengths.tolist()), self.spd)


@dataclass(frozen=True)
class SceneView:
    """Lights and directions of one material in a scene.

    Parameters
    ----------
    scene
        Name of the scene.
    lights
        Sorted by share, largest first.
    geometries
        Each θi, θr and Δφ in radians, the index of the light, a weight, and the number of the
        place on the surface; the weights of a light's directions add up to its share. Light that
        meets at one place is seen mixed. Without numbers each has a place of its own.
    """

    scene: str
    lights: tuple[SceneLight, ...]
    geometries: tuple[tuple[float, ...], ...]

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        """Of hundreds of numbers, made once: what is kept of a view is looked up by it."""
        return hash((self.scene, self.lights, self.geometries))

    @cached_property
    def angles(self) -> tuple[Array, Array, Array]:
        """θi, θr and Δφ, each of shape (geometries,)."""
        table = np.array([row[:3] for row in self.geometries])
        return table[:, 0], table[:, 1], table[:, 2]

    @cached_property
    def light_indices(self) -> Array:
        """Index of each geometry's light, shape (geometries,)."""
        return np.array([int(row[3]) for row in self.geometries])

    @cached_property
    def weights(self) -> Array:
        """Weight of each geometry; they add up to 1. Shape (geometries,)."""
        return np.array([row[4] for row in self.geometries])

    @cached_property
    def places(self) -> Array:
        """Index of each geometry's place, shape (geometries,)."""
        return np.array(
            [int(row[5]) if len(row) > 5 else i for i, row in enumerate(self.geometries)]
        )

    @cached_property
    def place_weights(self) -> Array:
        """Weight of each place, shape (places,); they add up to 1."""
        return np.bincount(self.places, self.weights)

    @cached_property
    def light_parts(self) -> Array:
        """Part of each light's own light that falls on each place, shape (lights, places)."""
        parts = np.zeros((len(self.lights), len(self.place_weights)))
        np.add.at(parts, (self.light_indices, self.places), self.weights)
        # A light may have no direction left, and its row is 0 then.
        return parts / np.maximum(parts.sum(axis=1, keepdims=True), np.finfo(float).tiny)

    def to_json(self) -> str:
        """Give the text that `from_json` reads; equal views give equal text."""
        return json.dumps({"schema": SCHEMA} | asdict(self), ensure_ascii=False)


def make_light(name: str, words: str, spd: Array, share: float) -> SceneLight:
    """Make a light with its spectrum rounded to what is stored."""
    rounded = tuple(float(f"{value:.{_DIGITS}g}") for value in spd.tolist())
    return SceneLight(name, words, rounded, round(share, 6))


@memoized(maxsize=64)
def from_json(text: str) -> SceneView:
    """Read back what `SceneView.to_json` gave.

    Raises
    ------
    InputError
        If the text is something else.
    """
    try:
        data = json.loads(text)
        if data["schema"] != SCHEMA:
            raise ValueError(f"schema {data['schema']}")
        scene = str(data["scene"])
        lights = tuple(
            SceneLight(**(light | {"spd": tuple(map(float, light["spd"]))}))
            for light in data["lights"]
        )
        geometries = tuple(
            (*map(float, angles), int(light), float(weight), *map(int, place))
            for *angles, light, weight, place in (
                (*row[:5], row[5:6]) for row in data["geometries"]
            )
        )
        known = {row[3] for row in geometries} <= set(range(len(lights)))
        lengths = {len(light.spd) for light in lights}
        if not geometries or not known or lengths != {illuminant_spectra.GRID.size}:
            raise ValueError("lights and directions do not belong together")
        numbers = [x for row in geometries for x in row] + [x for one in lights for x in one.spd]
        if not all(map(math.isfinite, (*numbers, *(float(light.share) for light in lights)))):
            raise ValueError("what should be a number is none")
        if not all(isinstance(text, str) for one in lights for text in (one.name, one.words)):
            raise TypeError("a light's name is no text")
        thetas = [theta for row in geometries for theta in row[:2]]
        if min(thetas) < -_BELOW or max(thetas) > math.pi / 2 + _BELOW:
            raise ValueError("a direction lies below the surface")
        if min(row[4] for row in geometries) < 0 or not sum(row[4] for row in geometries) > 0:
            raise ValueError("directions have no weight")
        places = {row[5] if len(row) > 5 else i for i, row in enumerate(geometries)}
        if places != set(range(len(places))):
            raise ValueError("a place has no light")
    except (
        *(ValueError, KeyError, TypeError, AttributeError, IndexError),
        *(RecursionError, OverflowError),
    ) as error:
        msg = f"The stored analysis of the scene cannot be read ({error}); analyze it again."
        raise InputError(msg) from error
    # What was rounded past the horizon or the normal is on it.
    geometries = tuple(
        (*(min(max(theta, 0.0), math.pi / 2) for theta in row[:2]), *row[2:]) for row in geometries
    )
    return SceneView(scene, lights, geometries)
