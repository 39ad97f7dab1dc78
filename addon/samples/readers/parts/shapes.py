# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra that their shape gives away where names do not: the eye's or a camera's, not a surface's.

Color matching functions, sensitivities of the cones and the luminous efficiency are all mixtures of
three functions, which no reflectance comes near: they are next to nothing at both ends.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_FROM_NM, _TO_NM = 430.0, 660.0  # what a table has to hold for its shape to say anything
_LEAST_BANDS = 12
# How far from a mixture, of the largest value. The formula below is the 2° observer's; those of 10°
# and the cones of 2006 differ from it by up to 0.2. Of 4,300 measured surfaces none comes to 0.23.
_NEAR = 0.2
_LITTLE, _NOTHING = 0.03, 0.001  # of the largest value

# Amplitude, peak in nm, and widths to the left and the right of it in nm. C. Wyman, P.-P. Sloan and
# P. Shirley, "Simple analytic approximations to the CIE XYZ color matching functions", Journal of
# Computer Graphics Techniques 2 (2), 2013, equation 4.
_LOBES = (
    ((1.056, 599.8, 37.9, 31.0), (0.362, 442.0, 16.0, 26.7), (-0.065, 501.1, 20.4, 26.2)),
    ((0.821, 568.8, 46.9, 40.5), (0.286, 530.9, 16.3, 31.1)),
    ((1.217, 437.0, 11.8, 36.0), (0.681, 459.0, 26.0, 13.8)),
)


def are_of_the_eye(nm: NDArray[np.float64], values: NDArray[np.float64]) -> bool:
    """Return whether all spectra are mixtures of color matching functions, in whatever scale.

    Parameters
    ----------
    nm
        Increasing, shape ``(bands,)``.
    values
        Shape ``(spectra, bands)``; tables of cones have gaps, NaN, where nothing is left.
    """
    if nm.size < _LEAST_BANDS or nm[0] > _FROM_NM or nm[-1] < _TO_NM:
        return False
    values = np.nan_to_num(values)
    largest = np.abs(values).max(axis=1)
    if not (largest > 0.0).all():
        return False
    matching = np.array([sum(_lobe(nm, *lobe) for lobe in lobes) for lobes in _LOBES]).T
    mixed = matching @ np.linalg.lstsq(matching, values.T, rcond=None)[0]
    return bool((np.abs(mixed.T - values).max(axis=1) < _NEAR * largest).all())


def all_vanish(values: NDArray[np.float64]) -> bool:
    """Return whether the spectra come close to nothing somewhere, and one to nothing at all.

    So do sensitivities. Surfaces do not: their boundary reflects some percent at all wavelengths.

    Parameters
    ----------
    values
        Shape ``(spectra, bands)``; NaN counts as nothing.
    """
    values = np.nan_to_num(values)
    least = values.min(axis=1) / np.maximum(values.max(axis=1), 1e-12)
    return bool((least < _LITTLE).all() and (least < _NOTHING).any())


def _lobe(
    nm: NDArray[np.float64], amplitude: float, peak: float, left: float, right: float
) -> NDArray[np.float64]:
    return amplitude * np.exp(-0.5 * ((nm - peak) / np.where(nm < peak, left, right)) ** 2)
