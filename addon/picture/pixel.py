# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pixel of a spectral picture is: its spectrum, its color, and how far RGB is off there."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.color import color_difference
from ...core.errors import DomainError
from ...core.numerics.arrays import Array
from . import spectra
from .picture import SpectralPicture


@dataclass(frozen=True, eq=False)
class Pixel:
    """A pixel.

    Parameters
    ----------
    column, row
        From the bottom left.
    wavelengths, radiance
        Nanometers, and radiance per nanometer in the scene's units, shape (values,).
    xyz
        By the picture's observer; white is Y = 1.
    lab
        CIE L*a*b* against white at a radiance of 1 under the scene's light.
    delta_e
        ΔE00 of the ordinary picture, or None where there is none.
    """

    column: int
    row: int
    wavelengths: Array
    radiance: Array
    xyz: tuple[float, float, float]
    lab: tuple[float, float, float]
    delta_e: float | None


def read(picture: SpectralPicture, column: int, row: int) -> Pixel:
    """Read a pixel.

    Raises
    ------
    DomainError
        If there is none there, or the picture has no spectra.
    """
    rows, columns = picture.xyz.shape[:2]
    if not (0 <= column < columns and 0 <= row < rows):
        msg = f"There is no pixel {column}, {row}; the picture has {columns} × {rows} pixels."
        raise DomainError(msg)
    if picture.spectra is None or picture.white is None:
        raise DomainError("The picture has no spectra; render it anew.")
    xyz = picture.xyz[row, column]
    compared = picture.comparison
    return Pixel(
        column,
        row,
        spectra.NM,
        picture.spectra.at(column, row),
        tuple(xyz.tolist()),
        tuple(color_difference.xyz_to_lab(xyz, picture.white).tolist()),
        None if compared is None else float(compared.delta_e[row, column]),
    )
