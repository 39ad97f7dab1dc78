# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Observers, illuminants and the parts of daylight as the CIE tabulates them, every nanometer.

From a file that colour-science wrote: importing that takes half a second, after installing two and
more. `tools/tables/make_cie_tables.py` writes the file.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.limits import E308_NM
from ...core.numerics.arrays import Array

ILLUMINANTS = ("A", "D50", "D55", "D65", "D75", "E", "F2", "F7", "F11", "LED-B3")
LAMPS = ("HP1",)
"""Those that no material is matched under: HP1 is sodium at high pressure."""
OBSERVERS = (2, 10)
"""CIE 1931 (2°) and CIE 1964 (10°)."""

GRID = np.arange(E308_NM[0], E308_NM[1] + 1)
"""Nanometers."""
FILE = Path(__file__).with_name("cie_tables.npy")


def observer(degrees: int) -> Array:
    """Color matching functions of one of `OBSERVERS` at `GRID`, shape (wavelengths, 3)."""
    first = 3 * OBSERVERS.index(degrees)
    return _rows()[first : first + 3].T


def illuminant(name: str) -> Array:
    """Spectrum of one of `ILLUMINANTS` or `LAMPS` at `GRID`, shape (wavelengths,)."""
    return np.asarray(_rows()[3 * len(OBSERVERS) + (*ILLUMINANTS, *LAMPS).index(name)])


def daylight_parts() -> Array:
    """S0, S1 and S2 of CIE daylight at `GRID`, shape (3, wavelengths)."""
    return _rows()[-3:]


def _rows() -> Array:
    """All of them, shape (rows, wavelengths): observers, illuminants, daylight."""
    return np.asarray(np.load(FILE, allow_pickle=False))
