# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From spectra to XYZ and Lab.

XYZ is linear in reflectance, so observer, illuminant and the ASTM E308 rules shrink to one matrix
a wavelength grid; it is made once and a spectrum then costs one small matrix product.
XYZ here has Y = 1 for the perfect white diffuser.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...core.color import color_difference
from ...core.errors import DomainError
from ...core.limits import COLOR_NM, E308_NM
from ...core.numerics import wavelength_grid
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from . import astm_e308, cie_tables

ILLUMINANTS = cie_tables.ILLUMINANTS
OBSERVERS = cie_tables.OBSERVERS

_E308_STEPS = (5, 10, 20)
"""Intervals in nanometers for which ASTM E308 gives weights; at 1 nm it is the plain sum."""
_LARGEST_HELD_SHARE = 0.1
"""A color of which more than a tenth comes from bands nobody measured is not a measurement."""


def weights(wavelengths: npt.ArrayLike, illuminant: str = "D65", observer: int = 2) -> Array:
    """Give the matrix that turns spectra into XYZ: `values @ weights(...)`.

    Even grids of 5, 10 or 20 nm follow ASTM E308's weights; any other grid is first brought to
    1 nm by local cubic interpolation. Visible bands that were not measured count as equal to the
    nearest one that was, as E308 prescribes; `held_share` tells how much that matters.

    Parameters
    ----------
    wavelengths
        Nanometers, strictly increasing, shape (bands,). Bands outside 360-780 nm get no weight.
    illuminant, observer
        One of `ILLUMINANTS` and of `OBSERVERS`.

    Returns
    -------
    float64 array, shape (bands, 3), read-only; its column sums are the white point.

    Raises
    ------
    DomainError
        If illuminant or observer is unknown, or the grid leaves more than a tenth of the color
        unmeasured.
    """
    bands = tuple(np.asarray(wavelengths, np.float64).ravel().tolist())
    return _sufficient_weights(bands, _known_illuminant(illuminant), observer)


@memoized(maxsize=256)
def _sufficient_weights(bands: tuple[float, ...], illuminant: str, observer: int) -> Array:
    measured = wavelength_grid.check_wavelengths(bands)
    # Before the weights: ASTM E308 needs more bands than the few of such grids.
    held = held_share(measured, illuminant, observer)
    if held > _LARGEST_HELD_SHARE:
        msg = (
            f"The bands from {measured[0]:g} to {measured[-1]:g} nm leave {held:.0%} of the color "
            f"unmeasured; a color needs about {COLOR_NM[0]:g} to {COLOR_NM[1]:g} nm."
        )
        raise DomainError(msg)
    return _weights(bands, illuminant, observer)


@memoized(maxsize=32)
def white(illuminant: str = "D65", observer: int = 2) -> Array:
    """XYZ of the perfect white diffuser, Y = 1, from the 5 nm weights. Shape (3,), read-only."""
    full = np.arange(E308_NM[0], E308_NM[1] + 1, 5.0)
    found = np.asarray(weights(full, illuminant, observer).sum(axis=0))
    found.setflags(write=False)
    return found


def held_share(wavelengths: npt.ArrayLike, illuminant: str = "D65", observer: int = 2) -> float:
    """Tell how much of X, Y or Z, whichever is largest, lies outside the measured range."""
    full = np.arange(E308_NM[0], E308_NM[1] + 1, 5.0)
    share = _weights(tuple(full.tolist()), _known_illuminant(illuminant), observer)
    outside = ~wavelength_grid.covered(wavelengths, full)
    # The nearest full band stands for half a step beyond the last measured one.
    return float((share[outside].sum(axis=0) / share.sum(axis=0)).max())


def spectrum_to_lab(
    values: npt.ArrayLike, wavelengths: npt.ArrayLike, illuminant: str = "D65", observer: int = 2
) -> Array:
    """CIE 1976 L*a*b* of reflectance spectra (..., bands), shape (..., 3)."""
    matrix = weights(wavelengths, illuminant, observer)
    return color_difference.xyz_to_lab(np.asarray(values, np.float64) @ matrix, matrix.sum(axis=0))


def _known_illuminant(illuminant: str) -> str:
    if illuminant not in ILLUMINANTS:
        msg = f"Illuminant {illuminant!r} is not known; choose one of {', '.join(ILLUMINANTS)}."
        raise DomainError(msg)
    return illuminant


@memoized(maxsize=256)
def _weights(wavelengths: tuple[float, ...], illuminant: str, observer: int) -> Array:
    if observer not in OBSERVERS:
        msg = f"Observer {observer!r} is not known; choose 2 or 10 degrees."
        raise DomainError(msg)
    matrix = _weights_of_grid(np.asarray(wavelengths), illuminant, observer)
    matrix.setflags(write=False)
    return matrix


def _weights_of_grid(measured: Array, illuminant: str, observer: int) -> Array:
    step = wavelength_grid.step(measured) if measured.size > 1 else None
    # The steps of files are even to a millionth of a nanometer.
    nominal = np.round(measured)
    close = np.allclose(measured, nominal, rtol=0, atol=1e-3)
    if step is not None and close and _is_e308_step(step) and nominal[0] % round(step) == 0:
        return astm_e308.weights(nominal, illuminant, observer)
    units, fine = np.eye(measured.size), cie_tables.GRID
    to_fine = wavelength_grid.resample(units, measured, fine, method="cubic", ends="hold")
    return np.asarray(to_fine @ astm_e308.integration(illuminant, observer))


def _is_e308_step(step: float) -> bool:
    return any(abs(step - known) < 1e-4 * known for known in _E308_STEPS)
