# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions of an instrument as a quadrature: few geometries whose weighted mean it reads.

Seen from above, directions are points of the unit disk at the distance sin θ from the center, and
projected solid angle is area there. So

- the hemisphere is the whole disk, a ring of light is an annulus, a cone around the normal a disk;
- a cone of half-angle h around an axis tilted by t is an ellipse with the center sin t cos h and
  the semi-axes sin h cos t, along the tilt, and sin h;
- every weight is an area, and grazing light counts for as little as it brings.

The surfaces of this package are isotropic: only θi, θr and Δφ matter. Where source or detector is
symmetric about the normal, Δφ is uniform, and of the other one sin² θ alone counts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numerics.arrays import Array
from ..numerics.memoized import memoized
from .geometries import Beam, Instrument, find

QUADRATURE_ERROR = 2e-5
"""Largest relative change of a reading when the node counts are doubled: published model and
V-cavity, every σ and ρ; of Gaussian slopes σ to 60°, and 2e-4 to 80°."""

_RING_NODES = 2
_CONE_NODES = 2
_QUARTER_NODES = 3
"""Gauss nodes in each quarter of Δφ; the published model has a kink between the two."""

_SPHERE_NODES = 8
"""Gauss nodes over the polar angle of a sphere's light."""

_Rule = tuple[Array, Array]
"""Values of sin² θ and their weights, which sum to 1."""

_Cone = tuple[Array, Array, Array]
"""Directions as sin θ cos φ, sin θ sin φ and weight."""

_Geometries = tuple[Array, Array, Array, Array]
"""θi, θr, Δφ and weight, each of shape (geometries,)."""


@dataclass(frozen=True, eq=False)
class Directions:
    """Geometries whose weighted mean an instrument reads.

    Attributes
    ----------
    theta_i, theta_r, delta_phi
        Polar angles of light and view and the azimuth between them, radians, shape (geometries,).
    weights
        They sum to 1, shape (geometries,). Those of a gloss trap are negative: it is cut out of
        the hemisphere.
    """

    theta_i: Array
    theta_r: Array
    delta_phi: Array
    weights: Array

    @property
    def angles(self) -> tuple[float, float, float] | None:
        """θi, θr and Δφ where light and view are one direction each, else None."""
        if self.weights.size > 1:
            return None
        return float(self.theta_i[0]), float(self.theta_r[0]), float(self.delta_phi[0])


def of(name: str) -> Directions:
    """Give the directions of an instrument.

    Raises
    ------
    DomainError
        If there is none of this name; the message lists the names.

    Examples
    --------
    >>> [round(angle, 4) for angle in of("45as15").angles]
    [0.7854, 0.5236, 3.1416]
    >>> of("45a:0-iso").weights.size
    24
    """
    return _of(find(name))


@memoized(maxsize=None)
def _of(instrument: Instrument) -> Directions:
    return build(instrument)


def build(instrument: Instrument, refinement: int = 1) -> Directions:
    """Spread an instrument's light and view over few directions.

    Parameters
    ----------
    instrument
        Its record.
    refinement
        How many times the nodes of every kind.

    Returns
    -------
    Its directions, the same at each call.

    Examples
    --------
    >>> build(find("45a:0-iso"), refinement=2).weights.size
    192
    """
    light, view = instrument.light, instrument.view
    if light.is_symmetric or view.is_symmetric:
        if _is_one_direction(light, view):
            found = _one(light.tilt, view.tilt, 0.0)
        else:
            lit, seen = (_rule(beam, refinement) for beam in (light, view))
            found = _pairs(lit, seen, _QUARTER_NODES * refinement)
    elif light.half_angle == view.half_angle == 0:
        found = _one(light.tilt, view.tilt, instrument.azimuth)
    else:
        cone, other = (_points(beam, refinement) for beam in (light, view))
        found = _crossed(cone, other, np.radians(instrument.azimuth))
    if instrument.trap:
        found = _trapped(found, view, instrument.trap, refinement)
    return Directions(*found)


def _is_one_direction(light: Beam, view: Beam) -> bool:
    """Whether all pairs look alike: without apertures, and one of the two along the normal."""
    return light.half_angle == view.half_angle == 0 and 0 in (light.tilt, view.tilt)


def _one(light: float, view: float, azimuth: float) -> _Geometries:
    """Make the only geometry there is, of angles in degrees."""
    theta_i, theta_r, delta_phi = np.radians([[float(light)], [float(view)], [float(azimuth)]])
    return theta_i, theta_r, delta_phi, np.ones(1)


def _rule(beam: Beam, refinement: int) -> _Rule:
    """Values of sin² θ, where the other side is symmetric about the normal or this one is."""
    if beam.half_angle == 0:
        return np.sin(np.radians([beam.tilt])) ** 2, np.ones(1)
    inner, outer = beam.tilt - beam.half_angle, beam.tilt + beam.half_angle
    if not beam.is_symmetric:
        return _two_nodes(_points(beam, 2 * refinement))
    if outer >= 90:
        return _to_horizon(np.radians(inner), _SPHERE_NODES * refinement)
    nodes = _RING_NODES if beam.all_around else _CONE_NODES
    return _annulus(np.radians(max(inner, 0.0)), np.radians(outer), nodes * refinement)


def _points(beam: Beam, nodes: int) -> _Cone:
    """Directions of a cone, or the one direction that it is without a half-angle."""
    if beam.half_angle == 0:
        return np.sin(np.radians([beam.tilt])), np.zeros(1), np.ones(1)
    return _cone(np.radians(beam.tilt), np.radians(beam.half_angle), nodes)


def _annulus(inner: float, outer: float, nodes: int) -> _Rule:
    """Directions between two cones around the normal: area is uniform in sin² θ."""
    points, weights = np.polynomial.legendre.leggauss(nodes)
    low, high = np.sin(inner) ** 2, np.sin(outer) ** 2
    return low + (points + 1) / 2 * (high - low), weights / 2


def _to_horizon(inner: float, nodes: int) -> _Rule:
    """Directions from a cone around the normal down to grazing; weights up to a factor.

    Gauss nodes lie evenly in θ and not in sin² θ: toward grazing, masking goes with cos θ, whose
    slope in sin² θ is infinite.
    """
    points, weights = np.polynomial.legendre.leggauss(nodes)
    theta = inner + (points + 1) * ((np.pi / 2 - inner) / 2)
    return np.sin(theta) ** 2, weights * np.sin(2 * theta)


def _cone(tilt: float, half_angle: float, nodes: int) -> _Cone:
    """Directions of a cone around a tilted axis: sin θ cos φ, sin θ sin φ and weight.

    φ = 0 is the azimuth of the axis. Gauss nodes over the squared radius of the ellipse, even
    steps over its angle.
    """
    points, weights = np.polynomial.legendre.leggauss(nodes)
    radius = np.sqrt((points + 1) / 2)[:, np.newaxis]
    turn = (np.arange(4 * nodes) + 0.5) * (np.pi / (2 * nodes))
    x = np.sin(tilt) * np.cos(half_angle) + np.sin(half_angle) * np.cos(tilt) * radius * np.cos(
        turn
    )
    y = np.sin(half_angle) * radius * np.sin(turn)
    share = np.broadcast_to(weights[:, np.newaxis] / (2 * turn.size), x.shape)
    return x.ravel(), y.ravel(), share.ravel()


def _two_nodes(directions: _Cone) -> _Rule:
    """Gauss rule over sin² θ with the first four moments of these directions."""
    x, y, share = directions
    u = x * x + y * y
    mean = np.sum(share * u)
    spread, skew = (np.sum(share * (u - mean) ** power) for power in (2, 3))
    # The nodes are the zeros of d² - (skew/spread) d - spread, the orthogonal polynomial.
    middle = skew / spread / 2
    root = np.sqrt(middle**2 + spread)
    low, high = middle - root, middle + root
    return mean + np.array([low, high]), np.array([high, -low]) / (high - low)


def _pairs(light: _Rule, view: _Rule, quarter: int) -> _Geometries:
    """Every light with every view, at azimuths spread uniformly."""
    points, weights = np.polynomial.legendre.leggauss(quarter)
    azimuth = (np.concatenate((points, points + 2)) + 1) * (np.pi / 4)
    turns = np.concatenate((weights, weights)) / 4
    grids = np.meshgrid(light[0], view[0], azimuth, indexing="ij")
    shares = np.meshgrid(light[1], view[1], turns, indexing="ij")
    weight = np.asarray(shares[0] * shares[1] * shares[2]).ravel()
    return (
        np.arcsin(np.sqrt(grids[0])).ravel(),
        np.arcsin(np.sqrt(grids[1])).ravel(),
        grids[2].ravel(),
        weight / np.sum(weight),
    )


def _crossed(light: _Cone, view: _Cone, azimuth: float) -> _Geometries:
    """Every direction of one cone with every one of another, their axes an azimuth apart."""
    x, y, lit = light
    theta_i, phi_i = np.arcsin(np.hypot(x, y)), np.arctan2(y, x) + azimuth
    x, y, seen = view
    theta_r, phi_r = np.arcsin(np.hypot(x, y)), np.arctan2(y, x)
    turn = np.arccos(np.cos(phi_r - phi_i[:, np.newaxis]))
    found = np.broadcast_arrays(theta_i[:, np.newaxis], theta_r, turn, lit[:, np.newaxis] * seen)
    one, other, between, weight = (values.ravel() for values in found)
    return one, other, between, weight


def _trapped(whole: _Geometries, view: Beam, trap: float, refinement: int) -> _Geometries:
    """Take the light of the gloss trap, a cone in the mirror direction, from that of the sphere."""
    tilt, half_angle = np.radians(view.tilt), np.radians(trap)
    lost = _cone(tilt, half_angle, refinement)
    *angles, weight = _crossed(lost, _points(view, refinement), np.pi)
    cut = np.sin(half_angle) ** 2 * np.cos(tilt)  # area of its ellipse over that of the disk
    theta_i, theta_r, azimuth, weight = (
        np.concatenate(pair) for pair in zip(whole, (*angles, -cut * weight), strict=True)
    )
    return theta_i, theta_r, azimuth, weight / np.sum(weight)
