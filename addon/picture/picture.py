# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spectral picture, and how far the ordinary one is from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...core.bands import Error
from ...core.color import color_difference
from ...core.numerics.arrays import Array
from .spectra import Spectra

_USUAL = 0.95
SEEN = 0.5
"""Least alpha of a pixel that counts in a comparison."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """How far the ordinary picture is from the spectral one.

    Parameters
    ----------
    plain
        The ordinary picture, scene-linear RGB and alpha, shape (rows, columns, 4), bottom up.
    delta_e
        ΔE00 of each pixel, shape (rows, columns); 0 where nothing is.
    mean, usual, largest
        Its mean, 95th percentile and maximum over what is there.
    where
        Column and row, from the bottom left, of the largest.
    """

    plain: Array
    delta_e: Array
    mean: float
    usual: float
    largest: float
    where: tuple[int, int]


@dataclass(frozen=True, eq=False)
class SpectralPicture:
    """A spectral picture.

    Parameters
    ----------
    rgb
        Scene-linear RGB of the file's working space and alpha, as a render has them, shape (rows,
        columns, 4), from the bottom up.
    xyz
        By the observer, shape (rows, columns, 3), in the scene's units: white is Y = 1.
    observer
        2 or 10 degrees.
    wavelengths
        Nanometers of the bands.
    direct
        Whether direct light was rendered apart.
    predicted
        How far the colors are off from those of the whole spectrum, as was foretold.
    enough
        Whether that is within the tolerance.
    comparison
        With the ordinary picture, or None where that was not asked for.
    rules
        By the names of materials, lamps and world, how they got their spectra.
    untranslated
        By name, what of them stayed red, green and blue.
    seconds
        Of each render, the ordinary one first where there is one.
    spectra
        From which each pixel's spectrum comes.
    direct_words
        Why direct light was rendered apart, where that was decided for it.
    white
        XYZ of white by the observer under the scene's light, with a Y of 1, shape (3,).
    touched
        Part of the picture that shows materials of which something stayed red, green and blue;
        None where there are none.
    processor_seconds
        As `seconds`, those of all processor cores together.
    """

    rgb: Array
    xyz: Array
    observer: int
    wavelengths: Array
    direct: bool
    predicted: Error
    enough: bool
    comparison: Comparison | None
    rules: Mapping[str, tuple[str, ...]]
    untranslated: Mapping[str, tuple[str, ...]]
    seconds: tuple[float, ...]
    spectra: Spectra | None = None
    direct_words: str = ""
    white: Array | None = None
    touched: float | None = None
    processor_seconds: tuple[float, ...] = ()


def compare(plain: Array, shown: Array, xyz: Array, plain_xyz: Array, white: Array) -> Comparison:
    """Compare two pictures.

    Parameters
    ----------
    plain, shown
        The ordinary and the spectral one, RGB and alpha, shape (rows, columns, 4).
    xyz, plain_xyz
        XYZ of the spectral and of the ordinary one, shape (rows, columns, 3).
    white
        XYZ of white under the scene's light, shape (3,).
    """
    labs = (color_difference.xyz_to_lab(each, white) for each in (xyz, plain_xyz))
    there = shown[..., 3] >= SEEN
    apart = np.where(there, color_difference.delta_e(*labs), 0)
    values = apart[there] if there.any() else np.zeros(1)
    row, column = np.unravel_index(int(np.argmax(apart)), apart.shape)
    return Comparison(
        plain,
        apart,
        float(values.mean()),
        float(np.quantile(values, _USUAL)),
        float(values.max()),
        (int(column), int(row)),
    )
