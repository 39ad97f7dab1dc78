# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""sRGB, in which screens and pictures hold colors: IEC 61966-2-1.

Linear values are relative to a white of 1; encoded ones are what a file or a screen holds.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...core.numerics.arrays import Array

FROM_XYZ = np.array(
    ((3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570))
)
"""Linear sRGB from XYZ under D65, Y = 1 for white, as the standard prints it: to four places."""

LUMINANCE = (0.2126, 0.7152, 0.0722)
"""What linear red, green and blue add to luminance."""


def from_xyz(white: npt.ArrayLike, of: npt.ArrayLike | None = None) -> Array:
    """Give the matrix, shape (3, 3), to linear sRGB, of which a white is exactly (1, 1, 1).

    Parameters
    ----------
    white
        In the coordinates that the matrix is applied to, shape (3,).
    of
        Matrix, shape (3, 3), from these coordinates to XYZ under D65; None where they are XYZ.
    """
    matrix = FROM_XYZ if of is None else FROM_XYZ @ np.asarray(of)
    # The standard's matrix is rounded, and D65 differs in the last digits from table to table.
    return np.asarray(matrix / (matrix @ np.asarray(white))[:, np.newaxis])


def encode(linear: npt.ArrayLike) -> Array:
    """Encode linear values, any shape; those below 0 stay below 0."""
    values = np.asarray(linear)
    curve = 1.055 * np.maximum(values, 0) ** (1 / 2.4) - 0.055
    return np.asarray(np.where(values <= 0.0031308, 12.92 * values, curve))


def decode(encoded: npt.ArrayLike) -> Array:
    """Undo `encode`, but for values below 0, which encode no color."""
    values = np.asarray(encoded)
    return np.asarray(
        np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    )
