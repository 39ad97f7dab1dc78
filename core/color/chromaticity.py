# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two colors are apart once they are equally light: the report of 2007 asks this.

a* and b* shrink when a color gets darker, although its chromaticity stays what it was. With the
luminance held equal only what the shape of the spectrum does is left.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array
from .color_difference import xyz_to_lab


def equally_light(xyz: npt.ArrayLike, as_xyz: npt.ArrayLike) -> Array:
    """Scale XYZ (..., 3) to the luminance of another (..., 3): all bands by the same factor.

    Black has no chromaticity: it is NaN, unless the other is black too.

    Examples
    --------
    >>> equally_light([0.1, 0.25, 0.05], [0.4, 0.5, 0.6]).tolist()
    [0.2, 0.5, 0.1]
    """
    own, other = np.asarray(xyz, np.float64), np.asarray(as_xyz, np.float64)[..., 1:2]
    dark = own[..., 1:2] == 0
    gain = np.where(dark & (other != 0), np.nan, other / np.where(dark, 1, own[..., 1:2]))
    return np.asarray(gain * own)


def ab_distance(lab_a: npt.ArrayLike, lab_b: npt.ArrayLike) -> Array:
    """Distance in the a*b* plane of Lab (..., 3) and (..., 3), shape (...).

    Examples
    --------
    >>> float(ab_distance([50, 1, 2], [70, 4, 6]))
    5.0
    """
    apart = np.asarray(lab_a, np.float64)[..., 1:] - np.asarray(lab_b, np.float64)[..., 1:]
    return np.asarray(np.sqrt(np.sum(apart * apart, axis=-1)))


def shift(xyz_a: npt.ArrayLike, xyz_b: npt.ArrayLike, white_xyz: npt.ArrayLike) -> Array:
    """Distance in the a*b* plane once the second has the luminance of the first.

    Parameters
    ----------
    xyz_a, xyz_b
        Two colors, shapes (..., 3).
    white_xyz
        The white of both, with Y = 1, shape (3,).

    Returns
    -------
    Shape (...). It is 0 of a color and any darker one of the same chromaticity, and NaN where just
    the second is black.

    Examples
    --------
    >>> white = np.array([0.9505, 1.0, 1.089])
    >>> shift(0.5 * white, 0.1 * white, white).round(9).tolist()
    0.0
    >>> round(float(shift([0.10, 0.15, 0.06], [0.05, 0.10, 0.03], white)), 2)
    22.68
    """
    leveled = equally_light(xyz_b, xyz_a)
    return ab_distance(xyz_to_lab(xyz_a, white_xyz), xyz_to_lab(leveled, white_xyz))
