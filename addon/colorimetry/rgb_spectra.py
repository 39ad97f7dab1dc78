# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra for colors that are known as red, green and blue alone. No Blender data here.

Three spectra, each as much as its channel: sums of them are smooth, and a reflectance from 0 to 1
stays there, gray stays gray. Being sums, they turn any texture into bands by a 3 × 3 matrix. Light
of a color has the same spectra times that of D65, which white then has.

Source: I. Mallett and C. Yuksel, "Spectral Primary Decomposition for Rendering with sRGB
Reflectance", EGSR 2019; their table comes with colour-science.
"""

from __future__ import annotations

import numpy as np

from ...core.numerics.arrays import Array
from ..support.colour_science import colour
from . import illuminant_spectra, srgb
from .rgb_space import WorkingSpace


def reflectances(space: WorkingSpace) -> Array:
    """Spectra at `illuminant_spectra.GRID` of red, green and blue of a working space, (3, bands).

    Colors of wide spaces that Rec.709 has not may come out below 0 in places.
    """
    return np.asarray(to_rec709(space).T @ basis())


def lights(space: WorkingSpace) -> Array:
    """Give the same of light for red, green and blue of Rec.709; white has a luminance of 1.

    White is D65, but for the last digits of the working space's white.
    """
    white, _ = illuminant_spectra.like(space.white)
    return np.asarray(basis() * white)


def to_rec709(space: WorkingSpace) -> Array:
    """Matrix from a working space to linear Rec.709, (3, 3), which keeps white."""
    return srgb.from_xyz(np.ones(3), np.linalg.inv(space.from_xyz))


def basis() -> Array:
    """Give the three spectra of red, green and blue of Rec.709, which add up to 1, (3, bands)."""
    table = colour().recovery.MSDS_BASIS_FUNCTIONS_sRGB_MALLETT2019
    grid = illuminant_spectra.GRID
    found = np.stack([np.interp(grid, table.wavelengths, each) for each in table.values.T])
    # They add up to 1 within the digits of the table.
    return np.asarray(found / found.sum(axis=0))
