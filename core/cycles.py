# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Cycles computes for its rough Diffuse closure, and matching it to a target.

Holds for the Diffuse BSDF, and for the Principled BSDF at Specular IOR Level 0, in Blender 4.5
and 5.2: the energy-preserving Oren-Nayar closure of `kernel/closure/bsdf_oren_nayar.h`, itself
after Y. Fujii, "A tiny improvement of Oren-Nayar reflectance model" (2012), with a term for
multiple scattering.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Array, polar_angle, precision, spectrum
from .color_difference import delta_e
from .errors import DomainError
from .reading import INSTRUMENT_ANGLES
from .remembered import remembered

ALBEDO_SPAN = np.pi / 2 - 2 / 3
"""How much a rough surface's directional albedo can lose; Fujii's normalization."""
MEAN_SPAN = ALBEDO_SPAN - (2 * np.pi - 5.6) / 3
"""The same, averaged over the hemisphere; 5.6 is Cycles' rounded constant."""

_NEWTON_STEPS = 12
"""Newton on a convex cubic from above needs at most 7 steps to full double precision for c ≤ 1."""
_SURE_STEPS = 2
"""Steps taken by all: to ask whether a color needs them costs nearly as much as a step."""

Lobe = tuple[Array, Array, Array]
"""A, B and D of `_lobe`."""

_RING = "45a:0"
"""Geometry whose reading a match meets exactly."""

_PLACES = 9
"""Roughnesses tried at once, both ends of an interval among them."""
_KNOWN = np.arange(_PLACES) % (_PLACES // 2) == 0
"""Those of them that were tried before in the interval twice around."""
_SHARES = np.linspace(0, 1, _PLACES)
_AROUND = np.arange(-1, 2)
_ZOOMS = 2
"""Times that the interval shrinks to two steps of the one before: the last step is 0.008, and a
parabola goes on from there."""
_CHUNK = 64
"""Materials matched at once: 1 to 2 MB of colors."""


def reflectance(
    color: npt.ArrayLike,
    roughness: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
) -> Array:
    """Reflectance factor of Cycles' Diffuse BSDF.

    Parameters
    ----------
    color
        Color socket in scene-linear RGB, shape (..., 3); any number of channels works.
    roughness
        The socket Roughness (Diffuse Roughness in the Principled BSDF), 0 to 1. Not σ.
    theta_i, theta_r, delta_phi
        Geometry, radians; these and `roughness` broadcast against the leading axes of `color`.

    Returns
    -------
    Array of shape (..., 3), in the precision of `color`.

    Raises
    ------
    DomainError
        If a polar angle lies outside [0, π/2] or the roughness outside 0 to 1.
    """
    c = spectrum(color, "the color")
    s, *angles = (np.asarray(x, c.dtype) for x in (roughness, theta_i, theta_r, delta_phi))
    check_roughness(s)
    return _reflected(c, _lobe(s, *directions(*angles)))


def color_for_reading(
    reading: npt.ArrayLike, roughness: npt.ArrayLike, instrument: str = _RING
) -> Array:
    """Socket color whose reading in Cycles is the given one, channel by channel.

    Parameters
    ----------
    reading
        Reflectance factor in scene-linear RGB, shape (..., 3).
    roughness
        Cycles' roughness, broadcast against the leading axes of `reading`.
    instrument
        Where the reading is taken.

    Returns
    -------
    Color, shape (..., 3). Above 1 where no color reaches the reading, negative where the reading
    is: nothing is clipped. NaN where the reading is NaN or infinite.
    """
    r = spectrum(reading, "the reading")
    s, *angles = (np.asarray(x, r.dtype) for x in (roughness, *INSTRUMENT_ANGLES[instrument]))
    check_roughness(s)
    return _color(r, _lobe(s, *directions(*angles)))


def match(
    reading: npt.ArrayLike,
    targets: npt.ArrayLike,
    geometries: tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike],
    perceive: Callable[[Array], Array],
) -> tuple[Array, Array]:
    """Choose color and roughness so that Cycles reads the same as the target.

    The reading at 45°/0° is met exactly; the one scalar roughness then brings the other geometries
    closest, in the mean of CIEDE2000. A reading of at most 1 needs no color above 1, because a
    white lobe of any roughness reads at least 1 there.

    Parameters
    ----------
    reading
        Target reading at 45°/0° in scene-linear RGB, shape (materials, 3).
    targets
        Target reflectance factor at other geometries, shape (materials, geometries, 3).
    geometries
        θi, θr and Δφ of those geometries, radians, each of shape (geometries,).
    perceive
        Turns scene-linear RGB (..., 3) into L*a*b*.

    Returns
    -------
    color, roughness
        Shapes (materials, 3) and (materials,). The color is unclipped, as in
        `color_for_reading`.
    """
    r = spectrum(reading, "the reading")
    wanted = spectrum(targets, "the targets")
    others, instrument = (
        directions(*(np.asarray(angles, r.dtype) for angles in where))
        for where in (geometries, INSTRUMENT_ANGLES[_RING])
    )
    roughness = np.empty(len(r), r.dtype)
    for start in range(0, len(r), _CHUNK):
        chunk = slice(start, start + _CHUNK)
        of_chunk, goal = r[chunk, np.newaxis], perceive(wanted[chunk, np.newaxis])

        def cost(tried: Array, of_chunk: Array = of_chunk, goal: Array = goal) -> Array:
            color = _color(of_chunk, _lobe(tried, *instrument))
            seen = _reflected(color[..., np.newaxis, :], _lobe(tried[..., np.newaxis], *others))
            return np.asarray(delta_e(perceive(seen), goal).mean(axis=-1))

        roughness[chunk] = _least(cost, len(of_chunk), r.dtype)
    return color_for_reading(r, roughness), roughness


def _least(cost: Callable[[Array], Array], count: int, dtype: np.dtype[Any]) -> Array:
    """Find where between 0 and 1 each of `count` costs is least; (count, n) -> (count, n).

    Many places a call and few calls: numpy spends more on a call than on a hundred numbers.
    """
    shares = _SHARES.astype(dtype)
    tried = np.tile(shares, (count, 1))
    costs = cost(tried)
    for _ in range(_ZOOMS):
        near, known = _around_least(tried, costs)
        low, high = near[:, :1], near[:, 2:]
        tried = low + (high - low) * shares
        costs = np.empty_like(tried)
        costs[:, _KNOWN], costs[:, ~_KNOWN] = known, cost(tried[:, ~_KNOWN])
    (a, b, c), (at_a, at_b, at_c) = (x.T for x in _around_least(tried, costs))
    # The vertex of the parabola through the last three; where all are alike, the middle.
    bend = at_a - 2 * at_b + at_c
    vertex = b + (c - a) / 4 * (at_a - at_c) / np.where(bend > 0, bend, np.inf)
    return np.asarray(
        np.where((at_b <= at_a) & (at_b <= at_c), vertex, np.where(at_a < at_c, a, c))
    )


def _around_least(tried: Array, costs: Array) -> tuple[Array, Array]:
    """Give three neighbors with the least cost among them, and in the middle unless at an end."""
    middle = np.minimum(np.maximum(costs.argmin(axis=1), 1), _PLACES - 2)
    row, column = np.arange(len(costs))[:, np.newaxis], middle[:, np.newaxis] + _AROUND
    return tried[row, column], costs[row, column]


def check_roughness(roughness: Array) -> None:
    """Refuse what is no roughness of Cycles; NaN passes.

    Raises
    ------
    DomainError
        If one lies outside 0 to 1.
    """
    outside = (roughness < 0) | (roughness > 1)
    if np.count_nonzero(outside):
        first = float(roughness[outside].flat[0])
        msg = f"Cycles' diffuse roughness holds {first:.6g}; it runs from 0 to 1 and is not σ."
        raise DomainError(msg)


@remembered
def directions(theta_i: Array, theta_r: Array, delta_phi: Array) -> tuple[Array, ...]:
    """Tilt of the facets in a direction, and how much of the light lost elsewhere leaves there.

    All that the closure takes from a geometry: θi, θr and Δφ in radians, which broadcast.
    """
    dtype = precision(theta_i, theta_r, delta_phi)
    light = polar_angle(theta_i, "theta_i", dtype)
    view = polar_angle(theta_r, "theta_r", dtype)
    with np.errstate(invalid="ignore"):  # an infinite azimuth is NaN, like a missing one
        tilt = np.sin(light) * np.sin(view) * np.cos(delta_phi)
    tilt = np.where(tilt > 0, tilt / np.maximum(np.cos(light), np.cos(view)), tilt)
    spread = (ALBEDO_SPAN - albedo_shape(light)) * (ALBEDO_SPAN - albedo_shape(view))
    # numpy 1.26 promotes scalars on the way.
    return np.asarray(tilt, dtype), np.asarray(spread / MEAN_SPAN, dtype)


def _lobe(roughness: Array, tilt: Array, spread: Array) -> Lobe:
    """Compute A, B and D of r = c (A + c² B / (1 - c D)), each with an axis for the channels.

    The closure weight multiplies a term that already holds c², hence c³ in the second term.
    Written so that roughness 0 is not 0/0: 1 - E = a s (k - G) with k the albedo span.
    """
    dtype = roughness.dtype
    a = 1 / (np.pi + roughness * dtype.type(ALBEDO_SPAN))
    single = np.pi * a * (1 + roughness * tilt)
    lost = a * roughness
    mean_lost = lost * dtype.type(MEAN_SPAN)
    multiple = lost * (1 - mean_lost) * spread
    # numpy 1.26 promotes scalars on the way.
    return (
        np.asarray(single, dtype)[..., np.newaxis],
        np.asarray(multiple, dtype)[..., np.newaxis],
        np.asarray(mean_lost, dtype)[..., np.newaxis],
    )


def _reflected(color: Array, lobe: Lobe) -> Array:
    single, multiple, ratio = lobe
    # An infinite color is NaN there, and needs no warning beside it.
    with np.errstate(invalid="ignore"):
        return np.asarray(color * (single + color * color * multiple / (1 - color * ratio)))


def _color(r: Array, lobe: Lobe) -> Array:
    """Invert `_reflected` by Newton's method.

    r (1 - D c) = A c (1 - D c) + B c³. The start lies above the root and the cubic is convex there,
    so Newton comes down to the root without overshooting.
    """
    single, multiple, ratio = lobe
    c = r / single
    # The step after one this small is below the last place: Newton doubles the digits.
    settled, moving = np.sqrt(np.finfo(r.dtype).eps) / 8, np.True_
    with np.errstate(invalid="ignore"):
        square, line = -single * ratio, single + r * ratio
        slope_cube, slope_square = 3 * multiple, 2 * square

        def step(c: Array) -> Array:
            value = ((multiple * c + square) * c + line) * c - r
            return np.asarray(value / ((slope_cube * c + slope_square) * c + line))

        for _ in range(_SURE_STEPS):
            c = c - step(c)
        for _ in range(_NEWTON_STEPS - _SURE_STEPS):
            last = np.where(moving, step(c), 0)
            c = c - last
            moving = np.abs(last) > settled * np.abs(c)
            if not np.count_nonzero(moving):
                break
    return np.asarray(c)


def albedo_shape(theta: Array) -> Array:
    """G(θ): how the directional albedo rises towards grazing.

    (sin θ / cos θ)(1 - sin³ θ) is ∞ · 0 at θ = π/2; with 1 - sin θ = cos² θ / (1 + sin θ) the
    cosine cancels.
    """
    sin, cos = np.sin(theta), np.cos(theta)
    tail = sin * cos * (1 + sin + sin * sin) / (1 + sin)
    return np.asarray(sin * (theta - 2 / 3 - sin * cos) + 2 / 3 * tail)
