# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Cycles computes for its rough Diffuse closure.

Holds for the Diffuse BSDF, and for the Principled BSDF at Specular IOR Level 0, in Blender 4.5
and 5.2: the energy-preserving Oren-Nayar closure of `kernel/closure/bsdf_oren_nayar.h`, itself
after Y. Fujii, "A tiny improvement of Oren-Nayar reflectance model" (2012), with a term for
multiple scattering.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import (
    Array,
    polar_angle,
    precision,
    spectrum,
)
from ..numerics.memoized import remembered

ALBEDO_SPAN = np.pi / 2 - 2 / 3
"""How much a rough surface's directional albedo can lose; Fujii's normalization."""
MEAN_SPAN = ALBEDO_SPAN - (2 * np.pi - 5.6) / 3
"""The same, averaged over the hemisphere; 5.6 is Cycles' rounded constant."""

Lobe = tuple[Array, Array, Array]
"""A, B and D of `lobe`."""


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

    Examples
    --------
    >>> np.round(reflectance([0.2, 0.5, 0.8], 1.0, np.pi / 4, 0.0, 0.0), 4).tolist()
    [0.157, 0.4161, 0.742]
    >>> reflectance([0.2, 0.5, 0.8], 0.0, 0.3, 0.9, 2.0).tolist()
    [0.2, 0.5, 0.8]
    """
    c = spectrum(color, "the color")
    s, *angles = (np.asarray(x, c.dtype) for x in (roughness, theta_i, theta_r, delta_phi))
    check_roughness(s)
    return reflected(c, lobe(s, *directions(*angles)))


def check_roughness(roughness: Array) -> None:
    """Refuse what is no roughness of Cycles; NaN passes.

    Raises
    ------
    DomainError
        If one lies outside 0 to 1.

    Examples
    --------
    >>> check_roughness(np.array([0.0, 1.0]))
    >>> check_roughness(np.array(30.0))
    Traceback (most recent call last):
        ...
    core.errors.DomainError: Cycles' diffuse roughness holds 30; it runs from 0 to 1 and is not σ.
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

    Examples
    --------
    >>> tilt, spread = directions(np.array(np.pi / 4), np.array(0.0), np.array(0.0))
    >>> float(tilt), round(float(spread), 4)
    (0.0, 0.9928)
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


def lobe(roughness: Array, tilt: Array, spread: Array) -> Lobe:
    """Compute A, B and D of r = c (A + c² B / (1 - c D)), each with an axis for the channels.

    `tilt` and `spread` are those of `directions`, which broadcast with the roughness.

    The closure weight multiplies a term that already holds c², hence c³ in the second term.
    Written so that roughness 0 is not 0/0: 1 - E = a s (k - G) with k the albedo span.

    Examples
    --------
    >>> level = lobe(np.array(0.0), np.array(0.3), np.array(0.4))
    >>> [float(np.round(values[0], 12)) for values in level]
    [1.0, 0.0, 0.0]
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


def reflected(color: Array, terms: Lobe) -> Array:
    """Give r of a color and of what `lobe` gives, which broadcast.

    Examples
    --------
    >>> reflected(np.array([0.5]), (np.array([1.0]), np.array([0.1]), np.array([0.0]))).tolist()
    [0.5125]
    """
    single, multiple, ratio = terms
    # An infinite color is NaN there, and needs no warning beside it.
    with np.errstate(invalid="ignore"):
        return np.asarray(color * (single + color * color * multiple / (1 - color * ratio)))


def albedo_shape(theta: Array) -> Array:
    """G(θ): how the directional albedo rises towards grazing.

    (sin θ / cos θ)(1 - sin³ θ) is ∞ · 0 at θ = π/2; with 1 - sin θ = cos² θ / (1 + sin θ) the
    cosine cancels.

    Examples
    --------
    >>> np.round(albedo_shape(np.array([0.0, np.pi / 2])), 4).tolist()
    [0.0, 0.9041]
    >>> round(ALBEDO_SPAN, 4)
    0.9041
    """
    sin, cos = np.sin(theta), np.cos(theta)
    tail = sin * cos * (1 + sin + sin * sin) / (1 + sin)
    return np.asarray(sin * (theta - 2 / 3 - sin * cos) + 2 / 3 * tail)
