# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How different two colors look: L*a*b*, CIEDE2000, and Bradford's adaptation to another white.

XYZ has Y = 1 for the perfect white diffuser. Where XYZ comes from, illuminants and observers, is
the business of others; here are numbers alone.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array

LAB_FROM_ROOTS = np.array(((0.0, 116, 0), (500, -500, 0), (0, 200, -200)))
"""From roots of X, Y and Z (see `roots`) to L*a*b*, but for the 16 that L* is less."""

_DARK = (6 / 29) ** 3
"""Below this share of the white, CIE Lab goes on as a straight line."""
_TURN = 2 * np.pi
_BLUE, _BLUE_WIDTH = np.radians(275), np.radians(25)
_HUE_TERMS = tuple(
    0.0075 * part * complex(np.exp(1j * np.radians(shift)))
    for part, shift in ((-0.17, -30), (0.24, 0), (0.32, 6), (-0.20, -63))
)
"""Of cos h, cos 2h, cos 3h and cos 4h in `_hue_weight`, with their shifts."""
_BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)


def xyz_to_lab(xyz: npt.ArrayLike, white_xyz: npt.ArrayLike) -> Array:
    """CIE 1976 L*a*b* of XYZ (..., 3) against a white of Y = 1, shape (3,).

    Examples
    --------
    >>> white = [0.9505, 1.0, 1.089]
    >>> np.round(xyz_to_lab([white, [0.0, 0.0, 0.0], [0.2, 0.3, 0.1]], white), 2).tolist()
    [[100.0, 0.0, 0.0], [0.0, 0.0, 0.0], [61.65, -37.32, 43.66]]
    """
    ratio = np.asarray(xyz, np.float64) / np.asarray(white_xyz)
    return roots_to_lab(_bent(ratio, np.cbrt(ratio)))


def roots_to_lab(bent: Array) -> Array:
    """CIE 1976 L*a*b* of what `roots` gives of X, Y and Z, (..., 3); grays are exactly gray.

    Examples
    --------
    >>> roots_to_lab(np.array([0.5, 0.5, 0.5])).tolist()
    [42.0, 0.0, 0.0]
    """
    x, y, z = bent[..., 0], bent[..., 1], bent[..., 2]
    lab = np.empty_like(bent)
    lab[..., 0], lab[..., 1], lab[..., 2] = 116 * y - 16, 500 * (x - y), 200 * (y - z)
    return lab


def roots(relative: Array) -> tuple[Array, Array]:
    """Cube roots of X, Y or Z relative to white, straight near black as in L*a*b*; and slopes.

    Examples
    --------
    >>> root, slope = roots(np.array([0.125, 1.0]))
    >>> np.round(root, 12).tolist(), np.round(slope, 4).tolist()
    ([0.5, 1.0], [1.3333, 0.3333])
    """
    root = np.cbrt(relative)
    dark = relative <= _DARK
    if not np.count_nonzero(dark):
        return root, root / (3 * relative)
    slope = np.full_like(root, 841 / 108)
    np.divide(root, 3 * relative, out=slope, where=~dark)
    return _bent(relative, root), slope


def _bent(relative: Array, root: Array) -> Array:
    return np.where(relative > _DARK, root, relative * (841 / 108) + 4 / 29)


def delta_e(lab_a: npt.ArrayLike, lab_b: npt.ArrayLike) -> Array:
    """CIEDE2000 of Lab (..., 3) and (..., 3), shape (...).

    colour-science has it too, at twice the time: a material is matched while a slider is dragged,
    and takes hundreds of differences. The tests hold the two against each other.

    Source: G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000 color-difference formula" (2005);
    variables are named as there.

    Examples
    --------
    >>> round(float(delta_e([50, 2.6772, -79.7751], [50, 0, -82.7485])), 4)
    2.0425
    >>> delta_e(np.zeros((4, 3)), np.zeros(3)).shape
    (4,)
    """
    one, other = np.asarray(lab_a, np.float64), np.asarray(lab_b, np.float64)
    l_1, a_1, b_1 = one[..., 0], one[..., 1], one[..., 2]
    l_2, a_2, b_2 = other[..., 0], other[..., 1], other[..., 2]
    # Means are taken as sums with their factors halved. For so few numbers as a slider asks for it
    # is the calls of numpy that take the time.
    # Blue-green grays are stretched along a*.
    square_1, square_2 = b_1 * b_1, b_2 * b_2
    plain = np.sqrt(a_1 * a_1 + square_1) + np.sqrt(a_2 * a_2 + square_2)
    stretch = 1.5 - 0.5 * _saturation(plain)
    a_1, a_2 = stretch * a_1, stretch * a_2
    c_1, c_2 = np.sqrt(a_1 * a_1 + square_1), np.sqrt(a_2 * a_2 + square_2)
    sum_c = c_1 + c_2
    half_turn, hue = _hues(a_1, b_1, a_2, b_2)

    sum_l = l_1 + l_2 - 100
    darkness = sum_l * sum_l
    lightness = (l_2 - l_1) / (1 + 0.0075 * darkness / np.sqrt(80 + darkness))
    chroma = (c_2 - c_1) / (1 + 0.0225 * sum_c)
    across = np.sqrt(4 * c_1 * c_2) * np.sin(half_turn) / (1 + sum_c * _hue_weight(hue))
    from_blue = (hue - _BLUE) / _BLUE_WIDTH
    blue = np.exp(from_blue * -from_blue)
    rotation = _saturation(sum_c) * np.sin(np.pi / 3 * blue)
    squared = lightness * lightness + chroma * chroma + across * (across - 2 * rotation * chroma)
    # The form is never negative, but its rounding is.
    return np.asarray(np.sqrt(np.maximum(squared, 0)))


def _hues(a_1: Array, b_1: Array, a_2: Array, b_2: Array) -> tuple[Array, Array]:
    """Give half the turn from one hue to the other, and the hue there, 0 to 2π, on the shorter arc.

    The sine and the cosine of the turn say it, and thereby which arc is shorter. Of opposite hues,
    such as (2.49, -0.001) and (-2.49, 0.001), neither is: there the one that does not pass 0 is
    taken, as the difference of angles from 0 to 2π would be.

    A gray has no hue, and where there is one, hues weigh nothing.
    """
    cross, along = a_1 * b_2 - a_2 * b_1, a_1 * a_2 + b_1 * b_2
    half_turn = np.arctan2(cross, along) / 2
    if not cross.all():
        from_below = np.where(b_1 == 0, a_1 > 0, b_1 > 0)
        quarter = np.where(from_below, np.pi / 2, -np.pi / 2)
        half_turn = np.where((cross == 0) & (along < 0), quarter, half_turn)
    hue = np.arctan2(b_1, a_1) + half_turn
    return half_turn, np.where(hue < 0, hue + _TURN, hue)


def _hue_weight(hue: Array) -> Array:
    """0.0075 (1 - 0.17 cos(h - 30°) + 0.24 cos 2h + 0.32 cos(3h + 6°) - 0.20 cos(4h - 63°)).

    As the real part of a polynomial in exp(ih): four cosines would take a third of the whole time.
    """
    turned = np.empty(hue.shape, np.complex128)
    turned.real, turned.imag = np.cos(hue), np.sin(hue)
    once, twice, thrice, four_times = _HUE_TERMS
    return np.asarray(
        0.0075 + (turned * (once + turned * (twice + turned * (thrice + turned * four_times)))).real
    )


def _saturation(sum_c: Array) -> Array:
    """√(C⁷/(C⁷ + 25⁷)), with C half of a sum."""
    square = sum_c * sum_c
    seventh = square * square * square * sum_c
    return np.asarray(np.sqrt(seventh / (seventh + 50.0**7)))


def adaptation(source_white: npt.ArrayLike, target_white: npt.ArrayLike) -> Array:
    """Bradford matrix, shape (3, 3): `xyz @ matrix.T` seen under the other white.

    Examples
    --------
    >>> lamp, day = np.array([1.0985, 1.0, 0.3558]), np.array([0.9505, 1.0, 1.089])
    >>> np.round(lamp @ adaptation(lamp, day).T, 6).tolist()
    [0.9505, 1.0, 1.089]
    """
    gain = (_BRADFORD @ np.asarray(target_white)) / (_BRADFORD @ np.asarray(source_white))
    return np.asarray(np.linalg.inv(_BRADFORD) @ (gain[:, np.newaxis] * _BRADFORD))
