# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cavity reference from a table, with a bound on what the table misses.

The solver of `core.vcavity` takes milliseconds a geometry, too long to ask it which model a
material needs. Here its answer is interpolated instead, in microseconds:

    ln(r / ρ) = Σ_k G_k(θi, θr, Δφ) B_k(σ, ρ)

G and B come from a singular value decomposition of the solver's answers; 18 terms hold them within
0.1 %. G is interpolated by cubics over the larger polar angle, the ratio of the two and the
azimuth: at Δφ = 0 the answer has a kink where light and view meet, and with the ratio it lies on
the border of the table. B is interpolated by cubics over σ, and by one polynomial over
1 - √(1 - ρ), in which the bounces of steep grooves are smooth up to ρ = 1.

`tools/tables/fit_yardstick.py` makes the table, and measures the error against the solver in
directions between the nodes; `bound` gives the largest it found nearby, times 1.3.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from ..numerics.arrays import (
    Array,
    polar_angle,
    slope_deviation,
    spectrum,
)
from ..numerics.memoized import memoized, remembered
from . import tabulated_data as table

LARGEST_ANGLE = np.radians(table.POLAR[-1])
"""Polar angles up to here are tabulated; beyond, `bound` is infinite."""

_CUBIC = 4
"""Nodes of a local cubic."""

_SAFETY = 1.3
"""The bound over the largest error that was found. In as many other directions, drawn the same way,
none was more than 1.29 times as large."""

_BOUNDS = np.array(table.BOUND) * 1e-5 * _SAFETY


def reflectance(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Reflectance factors of many materials, close to those of `core.vcavity`.

    Parameters
    ----------
    albedo
        ρ(λ), shape (materials, bands).
    theta_i, theta_r, delta_phi
        Geometries, radians, shape (geometries,), or (materials, geometries) where every material
        has its own. Polar angles are taken as at most `LARGEST_ANGLE`.
    sigma
        Roughness, radians, shape (materials,) or a scalar.

    Returns
    -------
    float64 array, shape (materials, geometries, bands). NaN where a geometry is NaN.

    Raises
    ------
    DomainError
        If an angle lies outside its range.

    Examples
    --------
    >>> np.round(reflectance([[0.2, 0.6]], [np.pi / 4], [0.0], [0.0], 0.5), 2).tolist()
    [[[0.16, 0.53]]]
    """
    rho = spectrum(albedo, "the albedo").astype(np.float64, copy=False)
    spread = np.broadcast_to(slope_deviation(sigma, rho.dtype), rho.shape[:1])
    [shares] = _terms(*_as_arrays(theta_i, theta_r, delta_phi))
    # Outside 0 to 1 the reference goes on as r(1) ρ and r'(0) ρ; so does this.
    place = 1 - np.sqrt(1 - np.minimum(np.maximum(rho, 0), 1))
    index, weight = _local(table.SIGMA, np.degrees(spread))
    basis = np.einsum("mi,mikp->mkp", weight, _basis()[index])
    powers = np.ones((len(rho), basis.shape[-1], rho.shape[-1]))
    for power in range(1, basis.shape[-1]):
        np.multiply(powers[:, power - 1], place, out=powers[:, power])
    out = np.exp(shares @ basis @ powers)
    out *= rho[:, np.newaxis]
    return np.asarray(out)


def bound(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Largest relative error of `reflectance` against `core.vcavity`; arguments broadcast.

    0 where σ = 0, infinite beyond `LARGEST_ANGLE`.

    Examples
    --------
    >>> bound(0.8, 0.1, 0.0, [0.0, 0.5]).round(4).tolist()
    [0.0, 0.002]
    >>> float(bound(1.5, 0.1, 0.0, 0.5))
    inf
    """
    polar, azimuth, beyond = _bins(*_as_arrays(theta_i, theta_r, delta_phi))
    spread = np.asarray(sigma, np.float64)
    found = _BOUNDS[polar, azimuth, _bin(table.BOUND_SIGMA, spread)]
    found = np.where(beyond, np.inf, found)
    return np.asarray(np.where(spread == 0, 0.0, found))


def _bins(theta_i: Array, theta_r: Array, delta_phi: Array) -> tuple[Array, ...]:
    """Where in the table of bounds directions lie, and which of them are beyond it."""
    larger, _, azimuth = _folded(theta_i, theta_r, delta_phi)
    # A rounded 85° is still 85°.
    beyond = np.asarray(larger > LARGEST_ANGLE * (1 + 1e-6))
    return _bin(table.BOUND_POLAR, larger), _bin(table.BOUND_AZIMUTH, azimuth), beyond


def _as_arrays(*angles: npt.ArrayLike) -> Iterator[Array]:
    return (np.asarray(angle, np.float64) for angle in angles)


def _folded(theta_i: Array, theta_r: Array, delta_phi: Array) -> tuple[Array, Array, Array]:
    """Larger polar angle, smaller over larger, azimuth in 0 to π: symmetries leave no more."""
    dtype = np.dtype(np.float64)
    light, view = polar_angle(theta_i, "theta_i", dtype), polar_angle(theta_r, "theta_r", dtype)
    larger, smaller = np.maximum(light, view), np.minimum(light, view)
    ratio = smaller / np.maximum(larger, np.finfo(dtype).tiny)
    with np.errstate(invalid="ignore"):  # an infinite azimuth is NaN, like a missing one
        azimuth = np.arccos(np.cos(delta_phi))
    return larger, ratio, azimuth


@remembered
def _terms(theta_i: Array, theta_r: Array, delta_phi: Array) -> tuple[Array, ...]:
    """G_k of geometries (...,): shape (..., terms), and nothing else."""
    larger, ratio, azimuth = _folded(theta_i, theta_r, delta_phi)
    larger, ratio, azimuth = np.broadcast_arrays(np.minimum(larger, LARGEST_ANGLE), ratio, azimuth)
    i, by_polar = _local(table.POLAR, np.degrees(larger))
    j, by_ratio = _local(table.RATIO, ratio)
    k, by_azimuth = _local(table.AZIMUTH, np.degrees(azimuth))
    corner = _geometries()[
        i[..., :, np.newaxis, np.newaxis],
        j[..., np.newaxis, :, np.newaxis],
        k[..., np.newaxis, np.newaxis, :],
    ].reshape(*larger.shape, _CUBIC**3, -1)
    weight = by_polar[..., :, np.newaxis, np.newaxis] * by_ratio[..., np.newaxis, :, np.newaxis]
    weight = weight * by_azimuth[..., np.newaxis, np.newaxis, :]
    return (np.asarray((weight.reshape(*larger.shape, 1, _CUBIC**3) @ corner)[..., 0, :]),)


def _local(nodes: Sequence[float], at: Array) -> tuple[Array, Array]:
    """Find the four nodes around each place and the weights of their cubic: (..., 4)."""
    places, scale = _cubics(tuple(nodes))
    below = places.searchsorted(at) - _CUBIC // 2
    first = np.minimum(np.maximum(below, 0), places.size - _CUBIC)
    index = first[..., np.newaxis] + np.arange(_CUBIC)
    apart = at[..., np.newaxis] - places[index]
    # Of each node, the product of the distances to the other three.
    weight = np.empty_like(apart)
    a, b, c, d = (apart[..., node] for node in range(_CUBIC))
    lower, upper = a * b, c * d
    for node, product in enumerate((b * upper, a * upper, lower * d, lower * c)):
        weight[..., node] = product
    weight *= scale[first]
    return index, weight


def _cubics(nodes: tuple[float, ...]) -> tuple[Array, Array]:
    """Nodes, and what Lagrange's weights of each four in a row are divided by: shape (n - 3, 4)."""
    places = np.array(nodes)
    near = places[np.arange(places.size - _CUBIC + 1)[:, np.newaxis] + np.arange(_CUBIC)]
    gaps = near[..., np.newaxis] - near[:, np.newaxis] + np.eye(_CUBIC)
    return places, 1 / gaps.prod(axis=-1)


def _bin(edges: tuple[float, ...], at: Array) -> Array:
    """Which interval between edges (degrees) an angle lies in; NaN and what is beyond: the last."""
    return np.asarray(np.minimum(np.radians(edges[1:]).searchsorted(at), len(edges) - 2))


@memoized(maxsize=1)
def _geometries() -> Array:
    """G at the nodes: shape (polar, ratio, azimuth, terms)."""
    polar, ratio, azimuth = len(table.POLAR), len(table.RATIO), len(table.AZIMUTH)
    rows = unpack(table.GEOMETRIES, table.GEOMETRY_STEPS)
    # Along the normal azimuth has no meaning, and with both along it neither has the ratio.
    out = np.empty((polar, ratio, azimuth, rows.shape[1]))
    out[0] = rows[0]
    inner = rows[1:].reshape(polar - 1, 1 + (ratio - 1) * azimuth, -1)
    out[1:, 0] = inner[:, :1]
    out[1:, 1:] = inner[:, 1:].reshape(polar - 1, ratio - 1, azimuth, -1)
    return out


@memoized(maxsize=1)
def _basis() -> Array:
    """B at the nodes of σ by powers of the albedo's place: shape (σ, terms, powers).

    At σ = 0 all are 0: there r = ρ.
    """
    rows = unpack(table.BASIS, table.BASIS_STEPS)
    places = np.array(table.ALBEDO_PLACE)
    at_nodes = rows.reshape(-1, places.size, rows.shape[1]).swapaxes(1, 2)
    powers = at_nodes @ np.linalg.inv(np.vander(places, increasing=True)).T
    return np.concatenate((np.zeros((1, *powers.shape[1:])), powers))


def pack(values: Array, steps: Array) -> str:
    """Write columns as multiples of their steps: 16-bit integers, deflated, in base 85.

    Examples
    --------
    >>> steps = np.array([0.5, 0.25])
    >>> unpack(pack(np.array([[1.0, 2.0], [1.5, -0.3]]), steps), (0.5, 0.25)).tolist()
    [[1.0, 2.0], [1.5, -0.25]]
    """
    integers = np.rint(values / steps).astype("<i2")
    # High and low bytes apart: the high ones of small columns are all alike.
    planes = integers.T.copy().view(np.uint8).reshape(-1, 2).T
    return base64.b85encode(zlib.compress(planes.tobytes(), 9)).decode("ascii")


def unpack(text: str, steps: tuple[float, ...]) -> Array:
    """Read what `pack` wrote: shape (rows, columns).

    Examples
    --------
    >>> unpack(pack(np.array([[1.0], [-2.0]]), np.array([0.5])), (0.5,)).tolist()
    [[1.0], [-2.0]]
    """
    planes = np.frombuffer(zlib.decompress(base64.b85decode(text)), np.uint8).reshape(2, -1)
    integers = planes.T.copy().view("<i2").reshape(len(steps), -1)
    return np.asarray(integers.T * np.array(steps))
