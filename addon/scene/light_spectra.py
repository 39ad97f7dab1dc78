# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a lamp sends, where that is known: an illuminant of the CIE, or what was measured.

No Blender data here.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.errors import DomainError, InputError
from ...core.numerics import wavelength_grid
from ...core.numerics.arrays import Array
from ..colorimetry import cie_tables, illuminant_spectra
from ..samples import light_source
from ..samples.light_source import LightSource

KnownLight = tuple[Array, str]
"""A spectrum at `illuminant_spectra.GRID` with a luminance of 1, and what it is.

Times a reflectance and a color matching function at `GRID`, and summed up, it is what the lamp
shows of them, wherever its lines are: by the cubic through the four nodes around each (ASTM E2022),
which takes nodes beside a narrow line a little below 0.
"""

_FINE = 0.25
"""Nanometers at which a table is read: a line of a lamp is narrower than a step of `GRID`."""
SODIUM = "sodium"
"""Sodium at low pressure, which shines by its two D lines alone."""
_D_LINES = ((588.9950, 2.0), (589.5924, 1.0))
"""Nanometers and power of sodium's D lines (NIST Atomic Spectra Database). Pressure changes the
ratio, which no eye sees."""
NAMES = (*cie_tables.ILLUMINANTS, *cie_tables.LAMPS, SODIUM)
"""Lights that are known by their name."""


def find(name: str) -> KnownLight:
    """Give what is known of a light.

    Parameters
    ----------
    name
        One of `NAMES`, or the path of a file that `light_source.read` reads; nothing shines
        outside of its wavelengths.

    Raises
    ------
    DomainError
        If it is neither, or nothing of it is seen.
    InputError
        If the file cannot be read.
    """
    if name == SODIUM:
        return measured(_sodium())[0], "sodium at low pressure"
    if name in NAMES:
        return illuminant_spectra.cie(name), f"CIE {name}"
    path = Path(name)
    if not path.exists():
        choices = ", ".join(NAMES)
        msg = f"{name!r} is neither a file nor an illuminant that is known: {choices}."
        raise DomainError(msg)
    return measured(light_source.read(path))


def measured(source: LightSource) -> KnownLight:
    """Give the same of a spectrum that was measured.

    Raises
    ------
    InputError
        If nothing of it is seen.
    """
    grid, step = illuminant_spectra.GRID, illuminant_spectra.GRID[1] - illuminant_spectra.GRID[0]
    fine = np.arange(grid[0], grid[-1] + _FINE / 2, _FINE)
    power = np.interp(fine, source.wavelengths, source.power, 0, 0)
    unit = np.eye(grid.size)
    to_fine = wavelength_grid.resample(unit, grid, fine, method="cubic", ends="hold")
    spectrum = to_fine @ power * _FINE / step
    luminance = illuminant_spectra.to_xyz(spectrum)[1]
    if not luminance > 0:
        msg = f"{source.name}: nothing of this light is seen; give wavelengths in nanometers."
        raise InputError(msg)
    return spectrum / luminance, f"measured: {source.name}"


def _sodium() -> LightSource:
    """Give the D lines, each as wide as a table is read."""
    nm, power = [], []
    for line, sent in _D_LINES:
        nm += [line - _FINE, line, line + _FINE]
        power += [0.0, sent, 0.0]
    return LightSource("sodium", np.array(nm), np.array(power))
