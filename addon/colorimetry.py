# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From spectra to colors, on colour-science: XYZ, Lab, ΔE00.

XYZ is linear in reflectance, so observer, illuminant and the ASTM E308 rules shrink to one matrix
a wavelength grid; it is made once and a spectrum then costs one small matrix product.
XYZ here has Y = 1 for the perfect white diffuser.
"""

from __future__ import annotations

import warnings
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from ..core import grid
from ..core.arrays import Array
from ..core.errors import DomainError
from .science import colour

ILLUMINANTS = ("A", "D50", "D55", "D65", "D75", "E", "F2", "F7", "F11", "LED-B3")
OBSERVERS = (2, 10)
"""CIE 1931 (2°) and CIE 1964 (10°)."""

_OBSERVER_NAMES = {
    2: "CIE 1931 2 Degree Standard Observer",
    10: "CIE 1964 10 Degree Standard Observer",
}
_E308_STEPS = (5, 10, 20)
"""Intervals in nanometers for which ASTM E308 gives weights; at 1 nm it is the plain sum."""
_VISIBLE = (360.0, 780.0)
"""ASTM E308's range, nanometers."""
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
    measured = grid.check_wavelengths(wavelengths)
    matrix = _weights(tuple(measured.tolist()), _known_illuminant(illuminant), observer)
    held = held_share(measured, illuminant, observer)
    if held > _LARGEST_HELD_SHARE:
        msg = (
            f"The bands from {measured[0]:g} to {measured[-1]:g} nm leave {held:.0%} of the color "
            "unmeasured; a color needs about 400 to 700 nm."
        )
        raise DomainError(msg)
    return matrix


def white(illuminant: str = "D65", observer: int = 2) -> Array:
    """XYZ of the perfect white diffuser, Y = 1, from the 5 nm weights. Shape (3,)."""
    return np.asarray(weights(np.arange(360.0, 781.0, 5.0), illuminant, observer).sum(axis=0))


def held_share(wavelengths: npt.ArrayLike, illuminant: str = "D65", observer: int = 2) -> float:
    """Tell how much of X, Y or Z, whichever is largest, lies outside the measured range."""
    full = np.arange(_VISIBLE[0], _VISIBLE[1] + 1, 5.0)
    share = _weights(tuple(full.tolist()), _known_illuminant(illuminant), observer)
    outside = ~grid.covered(wavelengths, full)
    # The nearest full band stands for half a step beyond the last measured one.
    return float((share[outside].sum(axis=0) / share.sum(axis=0)).max())


def xyz_to_lab(xyz: npt.ArrayLike, white_xyz: npt.ArrayLike) -> Array:
    """CIE 1976 L*a*b* of XYZ (..., 3) against a white of Y = 1, shape (3,)."""
    science = colour()
    chromaticity = science.XYZ_to_xy(np.asarray(white_xyz))
    return np.asarray(science.XYZ_to_Lab(np.asarray(xyz, np.float64), chromaticity))


def spectrum_to_lab(
    values: npt.ArrayLike, wavelengths: npt.ArrayLike, illuminant: str = "D65", observer: int = 2
) -> Array:
    """CIE 1976 L*a*b* of reflectance spectra (..., bands), shape (..., 3)."""
    matrix = weights(wavelengths, illuminant, observer)
    return xyz_to_lab(np.asarray(values, np.float64) @ matrix, matrix.sum(axis=0))


def delta_e(lab_a: npt.ArrayLike, lab_b: npt.ArrayLike) -> Array:
    """CIEDE2000 of Lab (..., 3) and (..., 3), shape (...)."""
    return np.asarray(colour().delta_E(np.asarray(lab_a), np.asarray(lab_b), method="CIE 2000"))


def adaptation(source_white: npt.ArrayLike, target_white: npt.ArrayLike) -> Array:
    """Bradford matrix, shape (3, 3): `xyz @ matrix.T` seen under the other white."""
    science = colour()
    return np.asarray(
        science.adaptation.matrix_chromatic_adaptation_VonKries(
            np.asarray(source_white), np.asarray(target_white), transform="Bradford"
        )
    )


def _known_illuminant(illuminant: str) -> str:
    if illuminant not in ILLUMINANTS:
        msg = f"Illuminant {illuminant!r} is not known; choose one of {', '.join(ILLUMINANTS)}."
        raise DomainError(msg)
    return illuminant


@lru_cache(maxsize=256)
def _weights(wavelengths: tuple[float, ...], illuminant: str, observer: int) -> Array:
    if observer not in OBSERVERS:
        msg = f"Observer {observer!r} is not known; choose 2 or 10 degrees."
        raise DomainError(msg)
    with warnings.catch_warnings():
        # colour-science tells on the console of every table that it aligns.
        warnings.simplefilter("ignore")
        matrix = _weights_of_grid(np.asarray(wavelengths), illuminant, observer)
    matrix.setflags(write=False)
    return matrix


def _weights_of_grid(measured: Array, illuminant: str, observer: int) -> Array:
    step = grid.step(measured) if measured.size > 1 else None
    # colour-science refuses a grid that is a millionth of a nanometer from even.
    nominal = np.round(measured)
    close = np.allclose(measured, nominal, rtol=0, atol=1e-3)
    if step is not None and close and _is_e308_step(step) and nominal[0] % round(step) == 0:
        return _e308(nominal, illuminant, observer)
    fine = np.arange(_VISIBLE[0], _VISIBLE[1] + 1)
    units = np.eye(measured.size)
    to_fine = grid.resample(units, measured, fine, method="cubic", ends="hold")
    return np.asarray(to_fine @ _integration(fine, illuminant, observer))


def _is_e308_step(step: float) -> bool:
    return any(abs(step - known) < 1e-4 * known for known in _E308_STEPS)


def _integration(wavelengths: Array, illuminant: str, observer: int) -> Array:
    """Weights of the plain sum over a 1 nm grid, with which ASTM E308 begins."""
    science = colour()
    shape = science.SpectralShape(wavelengths[0], wavelengths[-1], 1)
    matching = science.MSDS_CMFS[_OBSERVER_NAMES[observer]].copy().align(shape).values
    light = science.SDS_ILLUMINANTS[_science_name(illuminant)].copy().align(shape).values
    matrix = np.asarray(matching * light[:, np.newaxis])
    return matrix / matrix[:, 1].sum()


def _science_name(illuminant: str) -> str:
    return illuminant.replace("F", "FL", 1) if illuminant[0] == "F" else illuminant


def _e308(wavelengths: Array, illuminant: str, observer: int) -> Array:
    """ASTM E308 of every unit spectrum: one row of weights a band."""
    science = colour()
    matrix = np.zeros((wavelengths.size, 3))
    visible = (wavelengths >= _VISIBLE[0]) & (wavelengths <= _VISIBLE[1])
    if visible.sum() < 2:
        msg = (
            f"The bands from {wavelengths[0]:g} to {wavelengths[-1]:g} nm have no color; "
            "a color needs about 400 to 700 nm."
        )
        raise DomainError(msg)
    seen = wavelengths[visible]
    units = science.MultiSpectralDistributions(np.eye(seen.size), seen)
    xyz = science.msds_to_XYZ(
        units,
        cmfs=science.MSDS_CMFS[_OBSERVER_NAMES[observer]],
        illuminant=science.SDS_ILLUMINANTS[_science_name(illuminant)],
        method="ASTM E308",
    )
    matrix[visible] = np.asarray(xyz) / 100
    return matrix
