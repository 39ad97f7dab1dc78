# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an instrument reads from Cycles' Diffuse closure.

The closure takes two numbers from a direction, tilt and spread (`core.cycles.directions`), and is
linear in both. So the mean over an instrument's directions is the closure at their means: one
evaluation, whatever the number of directions, and one inverse for all instruments.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..instruments import quadrature
from ..numerics.arrays import Array, spectrum
from .lobe import (
    check_roughness,
    directions,
    lobe,
    reflected,
)


def reflectance(color: npt.ArrayLike, roughness: npt.ArrayLike, instrument: str) -> Array:
    """Predict the reading of Cycles' Diffuse BSDF at an instrument.

    Parameters
    ----------
    color
        Color socket in scene-linear RGB, shape (..., 3); any number of channels works.
    roughness
        The socket Roughness, 0 to 1, not σ; broadcasts against the leading axes of `color`.
    instrument
        One of `core.instruments.REGISTRY`.

    Returns
    -------
    Array of shape (..., 3), in the precision of `color`. Where light and view are one direction
    each, `core.cycles.reflectance` to the last bit.

    Raises
    ------
    DomainError
        If the roughness lies outside 0 to 1 or the instrument is unknown.

    Examples
    --------
    >>> np.round(reflectance([0.2, 0.5, 0.8], 1.0, "45a:0"), 4).tolist()
    [0.157, 0.4161, 0.742]
    >>> np.round(reflectance([0.2, 0.5, 0.8], 1.0, "di:8"), 4).tolist()
    [0.1569, 0.4138, 0.7313]
    """
    c = spectrum(color, "the color")
    s = np.asarray(roughness, c.dtype)
    check_roughness(s)
    return reflected(c, lobe(s, *mean_direction(instrument, c.dtype)))


def with_directions(geometries: tuple[Array, Array, Array], instrument: str) -> tuple[Array, Array]:
    """Give tilt and spread of single directions, and those of an instrument at the end.

    What looks at a material in many directions and at its instrument evaluates the closure once.

    Parameters
    ----------
    geometries
        θi, θr and Δφ, radians, each of shape (directions,).
    instrument
        One of `core.instruments.REGISTRY`.

    Returns
    -------
    Two arrays of shape (directions + 1,), for `core.cycles.lobe`.

    Raises
    ------
    DomainError
        If a polar angle lies outside [0, π/2] or the instrument is unknown.

    Examples
    --------
    >>> tilt, spread = with_directions((np.array([0.1]), np.array([0.2]), np.zeros(1)), "di:8")
    >>> tilt.shape, spread.shape
    ((2,), (2,))
    """
    single = directions(*geometries)
    mean = mean_direction(instrument, single[0].dtype)
    tilt, spread = (np.append(one, at) for one, at in zip(single, mean, strict=True))
    return tilt, spread


def mean_direction(instrument: str, dtype: np.dtype[Any]) -> tuple[Array, Array]:
    """Give tilt and spread of an instrument: the weighted means over its directions.

    Parameters
    ----------
    instrument
        One of `core.instruments.REGISTRY`.
    dtype
        Precision that its directions are taken in.

    Returns
    -------
    Two arrays without axes, for `core.cycles.lobe`.

    Raises
    ------
    DomainError
        If the instrument is unknown.

    Examples
    --------
    >>> tilt, spread = mean_direction("45a:0", np.dtype(np.float64))
    >>> float(tilt), round(float(spread), 4)
    (0.0, 0.9928)
    """
    of = quadrature.of(instrument)
    # One direction without an axis, because numpy 1.26 computes those in another precision.
    angles = of.angles or (of.theta_i, of.theta_r, of.delta_phi)
    tilt, spread = directions(*(np.asarray(angle, dtype) for angle in angles))
    if of.angles is None:
        tilt, spread = (np.asarray(of.weights @ each, dtype) for each in (tilt, spread))
    return tilt, spread
