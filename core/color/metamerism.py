# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two colors that match in one light are apart in another: illuminant metamerism.

CIE 15:2004 calls it the special metamerism index: change in illuminant; ISO 18314-4:2024 says how
to take pairs that match nearly.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array
from .color_difference import delta_e, xyz_to_lab


def index(
    here: tuple[npt.ArrayLike, npt.ArrayLike],
    there: tuple[npt.ArrayLike, npt.ArrayLike],
    white: npt.ArrayLike,
) -> Array:
    """Compute the special metamerism index, change in illuminant, as CIEDE2000.

    What remains between the two in the reference light is taken out first, by the multiplicative
    correction in XYZ that ISO 18314-4 recommends: the second color's X, Y and Z in the test light
    are multiplied by what they are off in the reference light. The index is 0 where the spectra
    are equal or in proportion.

    Parameters
    ----------
    here
        XYZ of the two in the reference light, shape (..., 3) each.
    there
        XYZ of the same two in the test light.
    white
        XYZ of the perfect diffuser in the test light, shape (3,).

    Returns
    -------
    ΔE00, shape (...). Where X, Y or Z of the second is 0 in the reference light, nothing is to be
    multiplied, and it is taken as it is.

    Examples
    --------
    >>> pair = [0.40, 0.40, 0.30], [0.42, 0.41, 0.31]
    >>> float(index(pair, pair, [0.95, 1.0, 1.09]))
    0.0
    >>> other = [0.50, 0.42, 0.10], [0.50, 0.42, 0.12]
    >>> round(float(index(pair, other, [1.10, 1.0, 0.36])), 1)
    4.9
    """
    first, second = (np.asarray(xyz, np.float64) for xyz in here)
    first_there, second_there = (np.asarray(xyz, np.float64) for xyz in there)
    black = second == 0
    corrected = second_there * np.where(black, 1.0, first / np.where(black, 1.0, second))
    return delta_e(xyz_to_lab(first_there, white), xyz_to_lab(corrected, white))
