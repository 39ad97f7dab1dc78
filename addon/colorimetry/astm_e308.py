# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of ASTM E308, those of the usual grids from a file that colour-science wrote.

Importing colour-science takes half a second, after installing two and more, in which the window
would stand still. At 5 and 10 nm the weights of every grid follow from those of the whole visible
range: bands that were not measured count as equal to the nearest one that was. What was measured
every 20 nm is brought to 10 nm first. `tools/tables/make_e308_weights.py` writes the file.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.limits import E308_NM
from ...core.numerics.arrays import Array
from . import cie_tables
from .cie_tables import ILLUMINANTS, OBSERVERS

TABLED_STEPS = (5, 10)
"""Nanometers."""
FILE = Path(__file__).with_name("e308_weights.npy")


def weights(wavelengths: Array, illuminant: str, observer: int) -> Array:
    """Weights of a grid of 5, 10 or 20 nm, shape (bands, 3): `values @ weights` is XYZ, Y ≤ 1.

    Parameters
    ----------
    wavelengths
        Multiples of the step, nanometers, some of them visible, shape (bands,).
    illuminant, observer
        One of `ILLUMINANTS` and of `OBSERVERS`.
    """
    matrix = np.zeros((wavelengths.size, 3))
    visible = (wavelengths >= E308_NM[0]) & (wavelengths <= E308_NM[1])
    seen = wavelengths[visible]
    step = round(float(wavelengths[1] - wavelengths[0]))
    if step in TABLED_STEPS:
        matrix[visible] = _folded(seen, step, illuminant, observer)
    else:
        fine = np.arange(seen[0], seen[-1] + 1, 10.0)
        matrix[visible] = _halved(seen.size).T @ _folded(fine, 10, illuminant, observer)
    return matrix


def integration(illuminant: str, observer: int) -> Array:
    """Weights of the plain sum over `cie_tables.GRID`, with which ASTM E308 begins."""
    light = cie_tables.illuminant(illuminant)
    matrix = np.asarray(cie_tables.observer(observer) * light[:, np.newaxis])
    return np.asarray(matrix / matrix[:, 1].sum())


def whole(step: int) -> Array:
    """Bands of the whole visible range, nanometers."""
    return np.arange(E308_NM[0], E308_NM[1] + 1, step)


def _folded(seen: Array, step: int, illuminant: str, observer: int) -> Array:
    """Weights from the file, those of missing bands added to the nearest."""
    start = sum(whole(finer).size for finer in TABLED_STEPS if finer < step)
    lights = _file()[OBSERVERS.index(observer), ILLUMINANTS.index(illuminant)]
    full = lights[start : start + whole(step).size]
    first = round((float(seen[0]) - E308_NM[0]) / step)
    end = first + seen.size
    found = full[first:end].copy()
    found[0] += full[:first].sum(axis=0)
    found[-1] += full[end:].sum(axis=0)
    return np.asarray(found)


def _halved(count: int) -> Array:
    """Matrix, shape (2 count - 1, count), that puts a band between every two.

    By the cubic through the four bands around it; at the ends that of a band beyond, which
    continues the parabola of the last three (ASTM E308-15, 7.3.2.2 and 7.3.2.3).
    """
    bands = np.eye(count)
    before = 3 * bands[0] - 3 * bands[1] + bands[2]
    after = 3 * bands[-1] - 3 * bands[-2] + bands[-3]
    padded = np.vstack((before, bands, after))
    found = np.empty((2 * count - 1, count))
    found[::2] = bands
    found[1::2] = (9 * (padded[1:-2] + padded[2:-1]) - padded[:-3] - padded[3:]) / 16
    return found


def _file() -> Array:
    """Weights, shape (observers, illuminants, bands of all steps in a row, 3)."""
    return np.asarray(np.load(FILE, allow_pickle=False))
