# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene-linear RGB spaces as matrices: reflectance to RGB, RGB to XYZ and Lab."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...core.color import color_difference
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from . import tristimulus


@dataclass(frozen=True, eq=False)
class WorkingSpace:
    """A scene-linear RGB space.

    Parameters
    ----------
    name
        Blender's name of it, such as "Linear Rec.709" or "ACEScg".
    from_xyz
        Matrix, shape (3, 3): `xyz @ from_xyz.T` for XYZ seen under D65, Y = 1.
    warning
        What the user has to know about it, or an empty string.
    """

    name: str
    from_xyz: Array
    warning: str = ""

    @cached_property
    def white(self) -> Array:
        """XYZ of RGB (1, 1, 1), shape (3,)."""
        return np.asarray(np.linalg.solve(self.from_xyz, np.ones(3)))

    @cached_property
    def key(self) -> bytes:
        """Key of what is kept for a space; `matrix_of` gives `from_xyz` back."""
        return np.asarray(self.from_xyz, np.float64).tobytes()

    def rgb_weights(self, wavelengths: Array, illuminant: str) -> Array:
        """Give the matrix, shape (bands, 3), read-only, from reflectance to scene-linear RGB.

        Seen by the 2° observer under `illuminant` and adapted with Bradford, so that a neutral
        spectrum has equal R, G and B. Scene RGB is always of the 2° observer: 10° values passed
        through a 2° matrix are another color.
        """
        bands = np.asarray(wavelengths, np.float64)
        return _rgb_weights(bands.tobytes(), self.key, illuminant)

    def to_xyz(self, rgb: Array, illuminant: str) -> Array:
        """XYZ (2° observer, Y = 1 for white) of scene-linear RGB (..., 3) under `illuminant`."""
        matrix = _to_xyz(self.key, illuminant)
        return np.asarray(np.asarray(rgb, np.float64) @ matrix)

    def to_lab(self, rgb: Array, illuminant: str) -> Array:
        """L*a*b* (2° observer) of scene-linear RGB (..., 3), seen under `illuminant`."""
        return color_difference.xyz_to_lab(
            self.to_xyz(rgb, illuminant), tristimulus.white(illuminant)
        )


def matrix_of(key: bytes) -> Array:
    """Give a space's matrix from XYZ, shape (3, 3), of its `WorkingSpace.key`."""
    return np.frombuffer(key).reshape(3, 3)


@memoized(maxsize=32)
def _rgb_weights(wavelengths: bytes, key: bytes, illuminant: str) -> Array:
    """Matrix of `rgb_weights`, for the bytes of wavelengths and a space's key."""
    weights = tristimulus.weights(np.frombuffer(wavelengths), illuminant, observer=2)
    matrix = matrix_of(key)
    adapt = color_difference.adaptation(weights.sum(axis=0), np.linalg.solve(matrix, np.ones(3)))
    found = np.asarray(weights @ (matrix @ adapt).T)
    found.setflags(write=False)
    return found


@memoized(maxsize=32)
def _to_xyz(key: bytes, illuminant: str) -> Array:
    """Matrix of `to_xyz`, for a space's key: a match asks for it at every step."""
    back = np.linalg.inv(matrix_of(key))
    adapt = color_difference.adaptation(back @ np.ones(3), tristimulus.white(illuminant))
    return np.asarray((adapt @ back).T)
