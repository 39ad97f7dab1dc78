# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much more a random surface in three dimensions absorbs and emits than its facets.

The surface is that of `core.surface`: Gaussian height fields whose rms slope along a profile is
tan σ. Light was followed from each direction until it left (`tools/tables/make_emission_table`), so
none is lost; the integral of the reflectance in `core.surface` over the view would have to meet
grazing views, where that table is noisy. Of light that meets white facets P_k times in the mean for
the k-th time, facets of albedo ρ absorb

    ε = (1 - ρ) S(ρ),   S(ρ) = Σ P_k ρ^(k-1),   P_1 = 1.

ln S is tabulated over θ and σ at a few albedos and interpolated by local cubics; over ρ it is one
polynomial in 1 - √(1 - ρ), in which it is smooth up to ρ = 1. At σ = 0, S is 1 to the last bit, and
at ρ = 1 nothing is emitted.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..closure.packing import unpack
from ..errors import DomainError
from ..numerics.arrays import Array, polar_angle, precision, slope_deviation
from ..numerics.memoized import memoized
from ..vcavity.slope_law import GAUSSIAN
from . import random_surface_data as data

ERROR_BOUND = 2e-3
"""Absolute error of ε, θ ≤ 80°, every σ and albedo, against other surfaces of the same kind."""

PLACES = (1 - np.cos(np.pi * np.arange(6) / 5)) / 2
"""Values of 1 - √(1 - ρ) at which ln S is tabulated; at the first one it is 0."""

ALBEDOS = 1 - (1 - PLACES) ** 2
"""The ρ of them."""

LARGEST_SIGMA = np.radians(data.SIGMA[-1])
"""Where the table ends, radians."""

_CUBIC = 4
"""Nodes of a local cubic."""

_STEPS = 60
"""Halvings at most when an albedo is sought; each makes it known to one more binary digit."""


def of_direction(theta: npt.ArrayLike, sigma: npt.ArrayLike, slopes: str = GAUSSIAN) -> Array:
    """S of a direction at `ALBEDOS`: the gains.

    Parameters
    ----------
    theta
        Polar angle, radians in [0, π/2]; beyond the last node, 89°, taken as there.
    sigma
        Roughness, radians, 0 to `LARGEST_SIGMA`; broadcasts against `theta`.
    slopes
        The surface has Gaussian slopes, and there is no other.

    Returns
    -------
    float64 array of the broadcast shape + (6,). The mean over directions is that of light from all
    of them.

    Raises
    ------
    DomainError
        If an angle lies outside its range, or other slopes are asked for. NaN gives NaN.

    Examples
    --------
    >>> of_direction(0.3, [0.0, 0.5])[:, [0, -1]].round(1).tolist()
    [[1.0, 1.0], [1.0, 1.3]]
    """
    if slopes != GAUSSIAN:
        msg = f"The model 'surface' has {GAUSSIAN} slopes; {slopes!r} is for 'reference'."
        raise DomainError(msg)
    light = polar_angle(theta, "theta", precision(theta)).astype(np.float64)
    spread = slope_deviation(sigma, precision(sigma)).astype(np.float64)
    beyond = spread > LARGEST_SIGMA * (1 + 1e-6)
    if beyond.any():
        worst = float(np.degrees(spread[beyond].flat[0]))
        msg = (
            f"The roughness σ is {worst:.4g}°, and the emissivity of the model 'surface' ends at "
            f"{data.SIGMA[-1]:g}°; that of 'reference' goes on to 90°."
        )
        raise DomainError(msg)
    by_theta = _weights(np.radians(data.POLAR), np.minimum(light, np.radians(data.POLAR[-1])))
    by_sigma = _weights(np.radians(data.SIGMA), spread)
    return np.asarray(np.exp(np.einsum("...s,spa,...p->...a", by_sigma, _logs(), by_theta)))


def emissivity(found: Array, rho: Array) -> Array:
    """ε of gains (..., 6) at albedos (..., bands); leading axes broadcast.

    Above ρ = 1 and below 0, where there is no physics, S stays as it is there.

    Examples
    --------
    >>> emissivity(np.ones(6), np.array([0.25, 1.0])).tolist()
    [0.75, 0.0]
    """
    over = np.einsum("...k,k...b->...b", polynomial(np.log(found)), powers(rho))
    return np.asarray((1 - rho) * np.exp(over))


def albedo(found: Array, epsilon: Array) -> Array:
    """Find ρ with `emissivity(found, ρ)` = ε, which falls with ρ; shapes as there.

    Examples
    --------
    >>> albedo(np.ones(6), np.array([0.25, -0.5, 1.5])).round(12).tolist()
    [0.75, 1.5, -0.5]
    """
    shape = np.broadcast_shapes((*found.shape[:-1], 1), epsilon.shape)
    target = np.broadcast_to(epsilon, shape)
    coefficients = polynomial(np.log(found))
    low, high = np.zeros(shape), np.ones(shape)
    for _ in range(_STEPS):
        middle = (low + high) / 2
        over = np.einsum("...k,k...b->...b", coefficients, powers(middle))
        brighter = (1 - middle) * np.exp(over) > target
        low, high = np.where(brighter, middle, low), np.where(brighter, high, middle)
    inside = (low + high) / 2
    # Beyond both ends S stays, so ε is a straight line there.
    at_white = np.broadcast_to(found[..., -1:], shape)
    out = np.where(target > 1, 1 - target, np.where(target < 0, 1 - target / at_white, inside))
    return np.asarray(np.where(np.isfinite(target), out, np.nan))


def polynomial(logs: Array) -> Array:
    """Coefficients over powers of 1 - √(1 - ρ) through ln S at `ALBEDOS`: the same shape.

    Examples
    --------
    >>> polynomial(2 * PLACES).round(9).tolist()
    [0.0, 2.0, 0.0, 0.0, 0.0, 0.0]
    """
    return np.asarray(logs @ np.linalg.inv(np.vander(PLACES, increasing=True)).T + 0.0)


def powers(rho: Array) -> Array:
    """Powers of 1 - √(1 - ρ), which `polynomial` goes with: (6, ...) of albedos (...).

    Examples
    --------
    >>> powers(np.array([0.0, 0.75]))[:3].tolist()
    [[1.0, 1.0], [0.0, 0.5], [0.0, 0.25]]
    """
    place = 1 - np.sqrt(1 - np.clip(rho, 0, 1))
    return np.stack([place**power for power in range(PLACES.size)])


@memoized(maxsize=1)
def _logs() -> Array:
    """Values of ln S at the nodes: (σ, θ, albedos)."""
    columns = PLACES.size - 1
    rows = unpack(data.PACKED, (data.STEP,) * columns)
    out = np.zeros((len(data.SIGMA), len(data.POLAR), columns + 1))
    out[1:, :, 1:] = rows.reshape(len(data.SIGMA) - 1, len(data.POLAR), columns)
    return out


def _weights(nodes: Array, at: Array) -> Array:
    """Weights of all nodes in the local cubic at each place: shape of `at` + (nodes,)."""
    first = np.clip(nodes.searchsorted(at) - _CUBIC // 2, 0, nodes.size - _CUBIC)
    index = first[..., np.newaxis] + np.arange(_CUBIC)
    near = nodes[index]
    apart = at[..., np.newaxis] - near
    out = np.zeros((*at.shape, nodes.size))
    for own in range(_CUBIC):
        others = [other for other in range(_CUBIC) if other != own]
        gaps = near[..., own, np.newaxis] - near[..., others]
        weight = (apart[..., others] / gaps).prod(axis=-1)
        np.put_along_axis(out, index[..., own, np.newaxis], weight[..., np.newaxis], axis=-1)
    return out
