# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of ASTM E308 by colour-science, those of the usual grids from a file.

Importing colour-science and computing one matrix takes half a second, in which a panel would stand
still at its first use. At 5 and 10 nm the weights of every grid follow from those of the whole
visible range: bands that were not measured count as equal to the nearest one that was.
`tools/tables/make_e308_weights.py` writes the file.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ...core.limits import E308_NM
from ...core.numerics.arrays import Array
from ..support.colour_science import colour

ILLUMINANTS = ("A", "D50", "D55", "D65", "D75", "E", "F2", "F7", "F11", "LED-B3")
OBSERVERS = (2, 10)
"""CIE 1931 (2°) and CIE 1964 (10°)."""

TABLED_STEPS = (5, 10)
"""Nanometers. At 20 nm the first and last weights follow another rule."""
FILE = Path(__file__).with_name("e308_weights.npy")

_OBSERVER_NAMES = {
    2: "CIE 1931 2 Degree Standard Observer",
    10: "CIE 1964 10 Degree Standard Observer",
}


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
        matrix[visible] = by_science(seen, illuminant, observer)
    return matrix


def by_science(seen: Array, illuminant: str, observer: int) -> Array:
    """Compute the weights of visible bands, by ASTM E308 of every unit spectrum."""
    science = colour()
    xyz = science.msds_to_XYZ(
        science.MultiSpectralDistributions(np.eye(seen.size), seen),
        cmfs=science.MSDS_CMFS[_OBSERVER_NAMES[observer]],
        illuminant=science.SDS_ILLUMINANTS[_science_name(illuminant)],
        method="ASTM E308",
    )
    return np.asarray(xyz) / 100


def integration(wavelengths: Array, illuminant: str, observer: int) -> Array:
    """Weights of the plain sum over a 1 nm grid, with which ASTM E308 begins."""
    matching = matching_functions(wavelengths, observer)
    matrix = np.asarray(matching * spectrum(illuminant, wavelengths)[:, np.newaxis])
    return np.asarray(matrix / matrix[:, 1].sum())


def matching_functions(wavelengths: Array, observer: int) -> Array:
    """Color matching functions of one of `OBSERVERS` on an even grid, shape (bands, 3)."""
    functions = colour().MSDS_CMFS[_OBSERVER_NAMES[observer]].copy()
    return np.asarray(functions.align(_shape(wavelengths)).values)


def spectrum(illuminant: str, wavelengths: Array) -> Array:
    """Spectrum of one of `ILLUMINANTS` on an even grid, shape (bands,)."""
    found = colour().SDS_ILLUMINANTS[_science_name(illuminant)].copy()
    return np.asarray(found.align(_shape(wavelengths)).values)


def _shape(wavelengths: Array) -> Any:
    step = wavelengths[1] - wavelengths[0]
    return colour().SpectralShape(wavelengths[0], wavelengths[-1], step)


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


def _file() -> Array:
    """Weights, shape (observers, illuminants, bands of all steps in a row, 3)."""
    return np.asarray(np.load(FILE, allow_pickle=False))


def _science_name(illuminant: str) -> str:
    return illuminant.replace("F", "FL", 1) if illuminant[0] == "F" else illuminant
