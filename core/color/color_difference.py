# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How different two colors look: L*a*b*, CIEDE2000, and Bradford's adaptation to another white.

XYZ has Y = 1 for the perfect white diffuser. Where XYZ comes from, illuminants and observers, is
the business of others; here are numbers alone.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import Array

LAB_FROM_ROOTS = np.array(((0.0, 116, 0), (500, -500, 0), (0, 200, -200)))
"""From roots of X, Y and Z (see `roots`) to L*a*b*, but for the 16 that L* is less."""

_DARK = (6 / 29) ** 3
"""Below this share of the white, CIE Lab goes on as a straight line."""
_PAIRS = 1 << 12
"""Pairs whose ΔE00 is computed at once: their two dozen arrays stay in the processor's cache."""


def _constants(*values: complex) -> list[Array]:
    """Give arrays without axes, which cost numpy half of what numbers of Python do."""
    return [np.array(value) for value in values]


_ZERO, _HALF, _ONE, _THREE_HALVES, _MINUS_TWO = _constants(0.0, 0.5, 1.0, 1.5, -2.0)
_EIGHTY, _HUNDRED, _FIFTY_TO_7 = _constants(80.0, 100.0, 50.0**7)
_LIGHTNESS, _CHROMA, _HUE_MEAN = _constants(0.0075, 0.0225, 0.0075 * np.sqrt(0.5))
_HALF_ROOT, _TINY = _constants(np.sqrt(0.5), 1e-200)
_ROUNDING = np.array(4 * np.finfo(np.float64).eps)
"""Products of numbers that are exactly opposite may differ by this share."""
_HUE_TERMS = _constants(
    *(
        np.sqrt(0.5) * 0.0075 * part * np.exp(1j * np.radians(shift))
        for part, shift in ((0.17, -30), (0.24, 0), (-0.32, 6), (-0.20, -63))
    )
)
"""Of cos h, cos 2h, cos 3h and cos 4h in `_hue_weight`, with their shifts; the odd ones are turned
by 180°, as the hue is."""
_BLUE, _BLUE_WIDTH = np.radians(275) - np.pi, np.radians(25)
_BLUE_TERMS = _constants(
    np.log(np.pi / 3) - (_BLUE / _BLUE_WIDTH) ** 2, 2 * _BLUE / _BLUE_WIDTH**2, -(_BLUE_WIDTH**-2)
)
"""Of 1, x and x² in log(60°) - ((x - 95°)/25°)²."""
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

    colour-science has it too, at several times the cost: a material is matched while a slider is
    dragged, and takes hundreds of differences. The tests hold the two against each other.

    Source: G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000 color-difference formula" (2005).

    Examples
    --------
    >>> round(float(delta_e([50, 2.6772, -79.7751], [50, 0, -82.7485])), 4)
    2.0425
    >>> delta_e(np.zeros((4, 3)), np.zeros(3)).shape
    (4,)
    """
    one, other = np.asarray(lab_a, np.float64), np.asarray(lab_b, np.float64)
    shape = np.broadcast(one, other).shape
    count = math.prod(shape[:-1])
    if count <= _PAIRS:
        pairs = np.empty((2, *shape))
        pairs[0], pairs[1] = one, other
        return _of_pairs(pairs.reshape(2, count, 3)).reshape(shape[:-1])
    one, other = (np.broadcast_to(lab, shape).reshape(count, 3) for lab in (one, other))
    found, copied = np.empty(count), np.empty((2, _PAIRS, 3))
    for start in range(0, count, _PAIRS):
        part = slice(start, min(start + _PAIRS, count))
        pairs = copied[:, : part.stop - start]
        pairs[0], pairs[1] = one[part], other[part]
        found[part] = _of_pairs(pairs)
    return found.reshape(shape[:-1])


def _of_pairs(pairs: Array) -> Array:
    """CIEDE2000 of Lab (2, pairs, 3).

    For as few as a slider asks for it is the calls of numpy that take the time. So a* and b* are
    one complex number, lightness and chroma lie in one array, means are sums with their factors
    halved, and what is no longer needed is overwritten.
    """
    ab = pairs[..., 1:].view(np.complex128)[..., 0].copy()
    # Blue-green grays are stretched along a*.
    plain = np.abs(ab)
    stretch = _saturation(plain[0] + plain[1])
    stretch *= _HALF
    ab.real *= _THREE_HALVES - stretch
    lc = np.empty((2, 2, pairs.shape[1]))
    lc[:, 0] = pairs[..., 0]
    chroma = np.abs(ab, out=lc[:, 1])
    total, apart = lc[0] + lc[1], lc[1] - lc[0]
    sum_l, sum_c = total

    half_turn = _half_turn(ab, chroma)
    across, back = half_turn.imag, _opposite_of_hue(ab[0] * half_turn)
    rotation = _toward_blue(back)
    rotation *= _saturation(sum_c)
    weight = _hue_weight(back)
    weight *= sum_c
    weight += _HALF_ROOT
    across /= weight

    # What L* and C* are divided by takes the place of their sums.
    sum_l -= _HUNDRED
    sum_l *= sum_l
    darkness = _LIGHTNESS * sum_l
    sum_l += _EIGHTY
    np.divide(darkness, np.sqrt(sum_l), out=sum_l)
    sum_c *= _CHROMA
    total += _ONE
    apart /= total

    # L² + C² + H (H - 2 R C). As R is at most sin 60°, rounding leaves it above 0.
    rotation *= apart[1]
    rotation *= _MINUS_TWO
    rotation += across
    rotation *= across
    apart *= apart
    rotation += apart[0]
    rotation += apart[1]
    return np.asarray(np.sqrt(rotation))


def _half_turn(ab: Array, chroma: Array) -> Array:
    """Half the turn from one hue to the other: √(2 C₁ C₂) exp(i Δh/2), -90° ≤ Δh/2 ≤ 90°.

    It is the root of the product of one and the conjugate other, which has sine and cosine of Δh.
    Of cosine and sine of the half, the one that is larger comes without cancellation, and the other
    from it. A complex root of numpy's does the same at ten times the cost.
    """
    product = ab[0].conj()
    product *= ab[1]
    cosine, sine = product.real, product.imag
    length = chroma[0] * chroma[1]
    [wide] = (cosine < _ZERO).nonzero()
    length += np.abs(cosine) if wide.size else cosine
    length += _TINY  # a gray has no hue, and weighs nothing
    np.sqrt(length, out=cosine)
    sine /= cosine
    if wide.size:
        larger, smaller = cosine[wide], np.abs(sine[wide])
        forward = sine[wide]
        opposite = smaller <= _ROUNDING * larger
        if np.count_nonzero(opposite):
            # Of opposite hues, such as (2.49, -0.001) and (-2.49, 0.001), neither arc is shorter:
            # there the one that does not pass 0 is taken, as the difference of angles from 0 to 2π
            # would be.
            one = ab[0, wide]
            from_below = np.where(one.imag == 0, one.real > 0, one.imag > 0)
            forward = np.where(opposite, np.where(from_below, 1.0, -1.0), forward)
        cosine[wide], sine[wide] = smaller, np.copysign(larger, forward)
    return np.asarray(product)


def _opposite_of_hue(hue: Array) -> Array:
    """Give -exp(ih) of complex numbers with the hue h, which may be overwritten; 0 of 0."""
    length = -_TINY - np.abs(hue)
    real, imaginary = hue.real, hue.imag
    real /= length
    imaginary /= length
    return hue


def _toward_blue(back: Array) -> Array:
    """sin(60° exp(-((h - 275°)/25°)²)) of -exp(ih), with h from 0 to 360°: it jumps at 0."""
    # The angle is h - 180°. The square is multiplied out, and holds the factor of 60°.
    angle = np.arctan2(back.imag, back.real)
    exponent = _BLUE_TERMS[2] * angle
    exponent += _BLUE_TERMS[1]
    exponent *= angle
    exponent += _BLUE_TERMS[0]
    np.exp(exponent, out=exponent)
    return np.asarray(np.sin(exponent, out=exponent))


def _hue_weight(back: Array) -> Array:
    """√½ 0.0075 (1 - 0.17 cos(h - 30°) + 0.24 cos 2h + 0.32 cos(3h + 6°) - 0.20 cos(4h - 63°)).

    As the real part of a polynomial in -exp(ih): four cosines would take a third of the whole time.
    """
    once, twice, thrice, four_times = _HUE_TERMS
    terms = four_times * back
    for term in (thrice, twice, once):
        terms += term
        terms *= back
    return np.asarray(terms.real + _HUE_MEAN)


def _saturation(sum_c: Array) -> Array:
    """√(C⁷/(C⁷ + 25⁷)), with C half of a sum."""
    seventh = sum_c * sum_c
    seventh *= seventh * seventh
    seventh *= sum_c
    seventh /= seventh + _FIFTY_TO_7
    return np.asarray(np.sqrt(seventh, out=seventh))


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
