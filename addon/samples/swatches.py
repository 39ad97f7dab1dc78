# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The color of samples for lists and for searching: under D65 for the 2° observer, as a rule."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ...core.color import color_difference
from ...core.errors import DomainError
from ...core.numerics.arrays import Array
from ..colorimetry import srgb, tristimulus
from .sample import Sample


def of_samples(
    samples: Sequence[Sample], illuminant: str = "D65", observer: int = 2
) -> tuple[Array, Array]:
    """Return gamma-encoded sRGB, clipped to 0 to 1, and CIE L*a*b* of readings or albedos.

    sRGB is that of a picture whose white is the light's.

    Returns
    -------
    Two arrays of shape (samples, 3); NaN where the bands do not cover the visible range, and of
    emissivities.
    """
    xyz = np.full((len(samples), 3), np.nan)
    grids: dict[bytes, list[int]] = {}
    for i, sample in enumerate(samples):
        if sample.has_color:
            grids.setdefault(sample.wavelengths.tobytes(), []).append(i)
    white = tristimulus.white(illuminant, observer)
    for members in grids.values():
        try:
            matrix = tristimulus.weights(samples[members[0]].wavelengths, illuminant, observer)
        except DomainError:
            continue
        # Whites of different grids differ in the last digits; each swatch of white is white.
        matrix = matrix * (white / matrix.sum(axis=0))
        xyz[members] = np.stack([samples[i].reflectance for i in members]) @ matrix
    known = np.isfinite(xyz[:, 0])
    rgb, lab = np.full_like(xyz, np.nan), np.full_like(xyz, np.nan)
    if known.any():
        rgb[known] = srgb.encode(xyz[known] @ srgb.from_xyz(white).T)
        lab[known] = color_difference.xyz_to_lab(xyz[known], white)
    return np.clip(rgb, 0, 1), lab


def to_lab(rgb: npt.ArrayLike) -> Array:
    """Return CIE L*a*b* of gamma-encoded sRGB, 0 to 1, shape (..., 3)."""
    white = tristimulus.white("D65", 2)
    xyz = srgb.decode(np.asarray(rgb, np.float64)) @ np.linalg.inv(srgb.from_xyz(white)).T
    return color_difference.xyz_to_lab(xyz, white)
