# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A rough surface as a table: b, a and g of the closed form in any direction, at any roughness.

Three numbers say what a surface reflects in a direction, whatever its albedo: the closed form
r = ρ (b + a / (1 + √(1 - g ρ))) led through r/ρ at ρ → 0, at one albedo m between and at ρ = 1.
The table holds their logarithms, here called anchors; b, a and g would trade off against each
other between two nodes, and follow in each direction from the interpolated anchors instead.

The nodes lie over σ, the larger polar angle α, the smaller one over it, and the azimuth Δφ. Light
and view may be swapped, so this covers all there is; and where they meet the reflectance has a
kink, which lies on the border of the table so.

- Over σ, local cubics; at σ = 0 all anchors are 0, where r = ρ to the last bit, and from there to
  the first node they are a polynomial in σ², as a surface does not know the sign of its slopes.
- Over the directions, the table is refined by local cubics once, and is linear between.
- Beyond its last polar angle it stays as it is there.

The tables that ship are `core.surface`, of traced random surfaces, and `core.vcavity.closed`, of
V-grooves.
"""

from __future__ import annotations

import bisect
import functools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import Array, polar_angle, precision, slope_deviation
from ..numerics.memoized import FEW, memoized
from .packing import unpack

ANCHORS = 3
"""ln r/ρ at ρ → 0, at the table's albedo between, and at ρ = 1."""

_CUBIC = 4
"""Nodes of a local cubic."""

_EVEN = 3
"""Nodes, σ = 0 with them, of the even polynomial between the first two."""

_FINER = 2
"""Intervals that the refinement makes of one."""

_STEEPEST, _SHALLOWEST = 0.9999, 0.01
"""Largest and smallest g. At 1 the slope of r at ρ = 1 would be infinite; near 0 a and b grow like
1/g and cancel, and what the walk adds to r/ρ is a straight line within a thousandth anyway."""

_TINY = float(np.finfo(np.float64).tiny)

_CHUNK = 1 << 13
"""Directions worked on at once: their temporaries stay in the processor's cache."""

_MANY = 1 << 11
"""Directions from which on the table is first reduced to the one σ, which costs as much."""


@dataclass(frozen=True, eq=False)
class Table:
    """One surface.

    Attributes
    ----------
    name
        The model it serves, for messages.
    sigma, polar, azimuth
        Nodes of σ, of the larger polar angle and of Δφ, degrees; the first of each is 0, the last
        of Δφ 180.
    ratio
        Nodes of the smaller polar angle over the larger one, 0 to 1.
    meeting
        The albedo m of the anchor between.
    packed
        The anchors, as `packed` makes them.
    steps
        Of which the packed integers are multiples, one for each σ but 0 and each anchor.
    """

    name: str
    sigma: tuple[float, ...]
    polar: tuple[float, ...]
    ratio: tuple[float, ...]
    azimuth: tuple[float, ...]
    meeting: float
    packed: str
    steps: tuple[float, ...]

    @functools.cached_property
    def radians(self) -> tuple[float, ...]:
        """Nodes of σ, radians."""
        return tuple(np.radians(self.sigma).tolist())

    @property
    def largest_sigma(self) -> float:
        """Radians."""
        return self.radians[-1]

    @property
    def largest_angle(self) -> float:
        """Radians."""
        return float(np.radians(self.polar[-1]))


def factors(
    table: Table,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g of the closed form.

    Parameters
    ----------
    table
        The surface.
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2]; taken as at most the table's largest.
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Roughness, radians, 0 to the table's largest. All four broadcast against each other.

    Returns
    -------
    b, a, g
        Arrays of the broadcast shape; float32 if every array given is float32, else float64.

    Raises
    ------
    DomainError
        If an angle lies outside its range. NaN passes and stays where it was.

    Examples
    --------
    >>> from core.surface import TABLE
    >>> b, a, g = factors(TABLE, 0.8, [0.0, 0.5], 0.0, 0.0)
    >>> (b + a / 2).tolist(), g.tolist()
    ([1.0, 1.0], [0.0, 0.0])
    """
    dtype = precision(theta_i, theta_r, delta_phi, sigma)
    found = anchors(table, theta_i, theta_r, delta_phi, sigma)
    b, a, g = (values.astype(dtype, copy=False) for values in through(found, table.meeting))
    return b, a, g


def anchors(
    table: Table,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Logarithms of r/ρ at ρ → 0, at the table's albedo between and at ρ = 1.

    Arguments and errors as in `factors`.

    Returns
    -------
    float64 array of the broadcast shape + (3,).

    Examples
    --------
    >>> from core.surface import TABLE
    >>> np.exp(anchors(TABLE, np.pi / 4, 0.0, 0.0, np.radians(30))).round(2).tolist()
    [0.81, 0.94, 1.01]
    """
    light = polar_angle(theta_i, "theta_i", precision(theta_i)).astype(np.float64, copy=False)
    view = polar_angle(theta_r, "theta_r", precision(theta_r)).astype(np.float64, copy=False)
    light, view, azimuth = np.broadcast_arrays(light, view, np.asarray(delta_phi, np.float64))
    weights = sigma_weights(table, sigma)
    spread, around = weights.shape[:-1], light.shape
    shape = np.broadcast_shapes(spread, around)
    if weights.size == len(table.sigma):
        if light.size > _MANY:
            reduced = _refined(table).nodes @ _each_anchor(weights)
            return _between(table, reduced, light, view, azimuth).reshape(*shape, ANCHORS)
        nodes = at_nodes(table, light, view, azimuth)
        return np.asarray((nodes @ _each_anchor(weights)).reshape(*shape, ANCHORS))
    if all(length == 1 for length in spread[len(spread) - len(around) :]):
        # Every σ in all directions is one product of two matrices.
        nodes = at_nodes(table, light, view, azimuth).reshape(-1, len(table.sigma), ANCHORS)
        rows = weights.reshape(-1, len(table.sigma)) @ np.moveaxis(nodes, 1, 0).reshape(
            len(table.sigma), -1
        )
        return np.asarray(rows.reshape(*shape, ANCHORS))
    out = np.empty((*shape, ANCHORS))
    flat = out.reshape(-1, ANCHORS)
    angles = [np.broadcast_to(angle, shape).ravel() for angle in (light, view, azimuth)]
    each = np.broadcast_to(weights, (*shape, len(table.sigma))).reshape(-1, 1, len(table.sigma))
    for start in range(0, len(flat), _CHUNK):
        part = slice(start, start + _CHUNK)
        nodes = _between(table, _refined(table).nodes, *(angle[part] for angle in angles))
        flat[part] = (each[part] @ nodes.reshape(-1, len(table.sigma), ANCHORS))[:, 0]
    return out


def at_nodes(table: Table, theta_i: Array, theta_r: Array, delta_phi: Array) -> Array:
    """Anchors in directions of one shape, at all of the table's σ: that shape + (σ · 3,).

    Whatever is linear in anchors over σ may be had of these at once; an instrument's mean is, of
    their exponentials.

    Examples
    --------
    >>> from core.surface import TABLE
    >>> light = np.array([0.8])
    >>> at_nodes(TABLE, light, light * 0, light)[0, :3].tolist()
    [0.0, 0.0, 0.0]
    """
    if theta_i.size > FEW:
        return _between(table, _refined(table).nodes, theta_i, theta_r, delta_phi)
    angles = (angle.tobytes() for angle in (theta_i, theta_r, delta_phi))
    return _of_few(table, theta_i.shape, *angles)


@memoized(maxsize=64)
def _of_few(
    table: Table, shape: tuple[int, ...], light: bytes, view: bytes, azimuth: bytes
) -> Array:
    """Keep what few directions look up: while σ is dragged they are the same at every step."""
    angles = (np.frombuffer(data).reshape(shape) for data in (light, view, azimuth))
    found = _between(table, _refined(table).nodes, *angles)
    found.setflags(write=False)
    return found


def sigma_weights(table: Table, sigma: npt.ArrayLike) -> Array:
    """Weights of the table's σ in the anchors at roughness σ: shape of `sigma` + (σ nodes,).

    Raises
    ------
    DomainError
        If σ lies outside 0 to the table's largest.

    Examples
    --------
    >>> from core.surface import TABLE
    >>> weights = sigma_weights(TABLE, [0.0, 0.3])
    >>> float(weights[0, 0]), weights.sum(axis=-1).round(12).tolist()
    (1.0, [1.0, 1.0])
    """
    spread = slope_deviation(sigma, precision(sigma)).astype(np.float64, copy=False)
    beyond = spread > table.largest_sigma * (1 + 1e-6)
    if np.count_nonzero(beyond):
        worst = float(np.degrees(spread[beyond].flat[0]))
        msg = (
            f"The roughness σ is {worst:.4g}°, and the model {table.name!r} ends at "
            f"{table.sigma[-1]:g}°; the published models go on to 90°."
        )
        raise DomainError(msg)
    if spread.size == 1:
        return _weights_of_one(table, float(spread.flat[0])).reshape(*spread.shape, -1)
    nodes = np.radians(table.sigma)
    weights = _cubic_weights(nodes, spread)
    onset = spread < nodes[1]
    if np.count_nonzero(onset):
        first = nodes[:_EVEN] ** 2
        weights[onset] = 0
        weights[onset, :_EVEN] = _weights_of(first, spread[onset][:, np.newaxis] ** 2)
    return weights


def _weights_of_one(table: Table, sigma: float) -> Array:
    """Give the same for one σ, in plain Python: numpy takes twenty times as long."""
    nodes = table.radians
    first = min(max(bisect.bisect_left(nodes, sigma) - _CUBIC // 2, 0), len(nodes) - _CUBIC)
    near, place = nodes[first : first + _CUBIC], sigma
    if sigma < nodes[1]:
        near, place = tuple(node * node for node in nodes[:_EVEN]), sigma * sigma
    out = np.zeros(len(nodes))
    for own, node in enumerate(near):
        weight = 1.0
        for other in near[:own] + near[own + 1 :]:
            weight *= (place - other) / (node - other)
        out[first + own] = weight
    return out


def through(found: Array, meeting: float) -> tuple[Array, Array, Array]:
    """Lead b, a and g through anchors (..., 3).

    What the walk adds to r/ρ at the albedo m is m ((1 + v)/(1 + w))² of what it adds at 1, with
    v = √(1 - g) and w = √(1 - g m). With the square root k of that ratio over m,
    1 + v = k (1 + w), and g drops out of 1 - w² = m (1 - v²).

    Examples
    --------
    >>> rho = np.array([1e-12, 0.7, 1.0])
    >>> bracket = 0.3 + 1.1 / (1 + np.sqrt(1 - 0.6 * rho))
    >>> [round(float(value), 9) for value in through(np.log(bracket), 0.7)]
    [0.3, 1.1, 0.6]
    """
    first, between, white = np.moveaxis(np.exp(found), -1, 0)
    later = np.maximum(white - first, 0)
    with np.errstate(invalid="ignore"):  # NaN stays NaN, and needs no warning beside it
        share = np.sqrt(np.maximum(between - first, 0) / (np.maximum(later, _TINY) * meeting))
    steepest, shallowest = (
        (1 + math.sqrt(1 - g)) / (1 + math.sqrt(1 - g * meeting)) for g in (_STEEPEST, _SHALLOWEST)
    )
    share = np.minimum(np.maximum(share, steepest), shallowest)
    slope = meeting * share
    root = (1 + slope * (share - 2)) / (1 - slope * share)
    ratio = (1 - root * root) / meeting
    back = share * (1 + root)
    walk = 2 * later * back * back / ratio
    # A level surface: r = ρ to the last bit.
    ratio = np.where(walk == 0, 0, ratio)
    return np.asarray(first - walk / 2), np.asarray(walk), np.asarray(ratio)


@dataclass(frozen=True, eq=False)
class _Refined:
    """The table on its finer nodes over the directions.

    Attributes
    ----------
    polar, ratio, azimuth
        Nodes; angles in radians.
    nodes
        Anchors of every direction, shape (directions, σ · 3).
    """

    polar: Array
    ratio: Array
    azimuth: Array
    nodes: Array


@memoized(maxsize=None)
def _refined(table: Table) -> _Refined:
    """Unpack and refine a table, once."""
    coarse = unpacked(table)
    axes = []
    for axis, nodes in enumerate(
        (np.radians(table.polar), np.array(table.ratio), np.radians(table.azimuth))
    ):
        finer = np.interp(
            np.arange((nodes.size - 1) * _FINER + 1) / _FINER, np.arange(nodes.size), nodes
        )
        coarse = np.moveaxis(
            np.tensordot(_cubic_weights(nodes, finer), coarse, axes=(1, axis)), 0, axis
        )
        axes.append(finer)
    width = len(table.sigma) * ANCHORS
    polar, ratio, azimuth = axes
    return _Refined(polar, ratio, azimuth, np.ascontiguousarray(coarse.reshape(-1, width)))


def unpacked(table: Table) -> Array:
    """Anchors at the nodes: shape (polar, ratio, azimuth, σ, 3).

    Examples
    --------
    >>> from core.surface import TABLE
    >>> float(np.abs(unpacked(TABLE)[:, :, :, 0]).max())
    0.0
    """
    polar, ratio, azimuth = len(table.polar), len(table.ratio), len(table.azimuth)
    rows = unpack(table.packed, table.steps)
    # Along the normal azimuth has no meaning, and with both along it neither has the ratio.
    out = np.zeros((polar, ratio, azimuth, len(table.sigma), ANCHORS))
    rows = rows.reshape(len(rows), -1, ANCHORS)
    out[0, :, :, 1:] = rows[0]
    inner = rows[1:].reshape(polar - 1, 1 + (ratio - 1) * azimuth, *rows.shape[1:])
    out[1:, 0, :, 1:] = inner[:, :1]
    out[1:, 1:, :, 1:] = inner[:, 1:].reshape(polar - 1, ratio - 1, azimuth, *rows.shape[1:])
    return out


def packable(values: Array) -> Array:
    """Give what of anchors (polar, ratio, azimuth, σ without 0, 3) a table holds, as rows.

    Examples
    --------
    >>> packable(np.zeros((2, 2, 3, 1, 3))).shape
    (5, 3)
    """
    width = values.shape[-2] * values.shape[-1]
    inner = values[1:].reshape(len(values) - 1, values.shape[1], values.shape[2], width)
    rows = np.concatenate(
        (inner[:, 0, :1], inner[:, 1:].reshape(len(inner), -1, width)), axis=1
    ).reshape(-1, width)
    return np.concatenate((values[0, 0, 0].reshape(1, width), rows))


def _between(table: Table, nodes: Array, light: Array, view: Array, azimuth: Array) -> Array:
    """Interpolate columns of the refined table, (nodes, n), in directions: their shape + (n,)."""
    fine = _refined(table)
    shape, width = light.shape, nodes.shape[1]
    light, view, azimuth = light.ravel(), view.ravel(), azimuth.ravel()
    out = np.empty((light.size, width))
    across, along = fine.azimuth.size, fine.azimuth.size * fine.ratio.size
    for start in range(0, light.size, _CHUNK):
        part = slice(start, start + _CHUNK)
        upper, lower = np.maximum(light[part], view[part]), np.minimum(light[part], view[part])
        larger = np.minimum(upper, fine.polar[-1])
        ratio = np.minimum(lower, larger) / np.maximum(larger, 1e-300)
        with np.errstate(invalid="ignore"):  # an infinite azimuth is NaN, like a missing one
            turned = np.arccos(np.cos(azimuth[part]))
        i, by_polar = _place(fine.polar, larger)
        j, by_ratio = _place(fine.ratio, ratio)
        k, by_azimuth = _place(fine.azimuth, turned)
        corner = i * along + j * across + k
        total = out[part]
        total[:] = 0
        for p, r, a in np.ndindex(2, 2, 2):
            weight = by_polar[p] * by_ratio[r]
            weight *= by_azimuth[a]
            found = nodes.take(corner + (p * along + r * across + a), axis=0)
            found *= weight[:, np.newaxis]
            total += found
    return out.reshape(*shape, width)


def _place(nodes: Array, at: Array) -> tuple[Array, tuple[Array, Array]]:
    """Interval of each place, and the weights of its two ends; NaN goes into the last."""
    index = np.minimum(nodes[1:].searchsorted(at), nodes.size - 2)
    share = (at - nodes[index]) / (nodes[index + 1] - nodes[index])
    return index, (1 - share, share)


def _cubic_weights(nodes: Array, at: Array) -> Array:
    """Weights of all nodes in the local cubic at each place: shape of `at` + (nodes,)."""
    first = np.clip(nodes.searchsorted(at) - _CUBIC // 2, 0, nodes.size - _CUBIC)
    index = first[..., np.newaxis] + np.arange(_CUBIC)
    out = np.zeros((*at.shape, nodes.size))
    np.put_along_axis(out, index, _weights_of(nodes[index], at[..., np.newaxis]), axis=-1)
    return out


def _weights_of(nodes: Array, at: Array) -> Array:
    """Lagrange's weights of nodes (..., n) at places (..., 1): shape (..., n)."""
    count = nodes.shape[-1]
    apart = at - nodes
    weights = []
    for own in range(count):
        others = [other for other in range(count) if other != own]
        gaps = nodes[..., own, np.newaxis] - nodes[..., others]
        weights.append((apart[..., others] / gaps).prod(axis=-1))
    return np.stack(weights, axis=-1)


def _each_anchor(weights: Array) -> Array:
    """Weights (1, σ) of σ as a matrix (σ · 3, 3) that leaves the anchors apart."""
    return np.kron(weights.reshape(-1, 1), np.eye(ANCHORS))
