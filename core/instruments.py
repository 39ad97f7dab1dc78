# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Instruments: from where they light a surface, and from where they look at it.

An instrument compares the flux it receives from a surface with the flux from a perfect white
diffuser under the same light. That makes its reading the mean of the reflectance factor over all
pairs of a direction of its source and one of its detector, each weighted with its projected solid
angle, cos θ dω. Seen from above, directions are points of the unit disk at the distance sin θ from
the center, and projected solid angle is area there. So

- the hemisphere is the whole disk, a ring of light is an annulus, a cone around the normal a disk;
- a cone of half-angle h around an axis tilted by t is an ellipse with the center sin t cos h and
  the semi-axes sin h cos t, along the tilt, and sin h;
- every weight is an area, and grazing light counts for as little as it brings.

The surfaces of this package are isotropic: only θi, θr and Δφ matter. Where source or detector is
symmetric about the normal, Δφ is uniform, and of the other one sin² θ alone counts.

Where the angles come from: CIE 15:2004, section 5.2, for the annulus between cones of half-angle
40° and 50° and for detectors of half-angle 5° (ISO 13655 and ISO 5-4 use the same), around the
normal or around 8°; ASTM E2194 (15°, 45°, 110°), DIN 6175-2 (25°, 75°) and ASTM E2539 (-15°) for
aspecular angles. The size of the gloss trap is ours, see `TRAP`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from .arrays import Array
from .errors import DomainError

RING = (np.radians(40.0), np.radians(50.0))
"""Half-angles of the two cones between which the light of 45a:0 comes."""

CONE = np.radians(5.0)
"""Half-angle of every detector, and of the source of 45x:0."""

SPHERE_TILT = np.radians(8.0)
"""Angle between the normal and the axis of a sphere's detector."""

TRAP = np.radians(6.0)
"""Half-angle of the gloss trap of de:8, seen from the surface. What is asked of it is that a mirror
show nothing to the detector, which the detector's cone and 1° more do; makers' sizes vary."""

ASPECULAR = (-15, 15, 25, 45, 75, 110)
"""Degrees from the mirror direction of light at 45°, positive toward the light."""

QUADRATURE_ERROR = 2e-5
"""Largest relative change of a reading when the node counts are doubled: published model and
V-cavity, every σ and ρ."""

_RING_NODES = 2
_CONE_NODES = 2
_QUARTER_NODES = 3
"""Gauss nodes in each quarter of Δφ; the published model has a kink between the two."""

_SPHERE_NODES = 8
"""Gauss nodes over the polar angle of a sphere's light."""

_Rule = tuple[Array, Array]
"""Values of sin² θ and their weights, which sum to 1."""


@dataclass(frozen=True, eq=False)
class Instrument:
    """Geometries whose weighted mean an instrument reads.

    Attributes
    ----------
    name, title
        What code and files call it, and what a person does.
    theta_i, theta_r, delta_phi
        Polar angles of light and view and the azimuth between them, radians, shape (geometries,).
    weights
        They sum to 1, shape (geometries,). Those of the gloss trap of de:8 are negative: it is cut
        out of the hemisphere.
    """

    name: str
    title: str
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


def find(name: str) -> Instrument:
    """Give the instrument of this name.

    Raises
    ------
    DomainError
        If there is none; the message lists the names.
    """
    if name not in REGISTRY:
        msg = f"Instrument {name!r} is not known; choose one of: {', '.join(REGISTRY)}."
        raise DomainError(msg)
    return REGISTRY[name]


def build(refinement: int = 1) -> dict[str, Instrument]:
    """Make all instruments, with `refinement` times the nodes of every kind."""
    ring = _annulus(*RING, _RING_NODES * refinement)
    cone = _annulus(0.0, CONE, _CONE_NODES * refinement)
    side = _two_nodes(_cone(np.pi / 4, CONE, 2 * refinement))
    sphere = _sphere(refinement)
    quarter = _QUARTER_NODES * refinement
    iso = "with the apertures of ISO 13655"
    made = [
        _direction("45a:0", "45°a:0°, ideal", 45, 0, 0),
        _direction("0:45a", "0°:45°a, ideal", 0, 45, 0),
        _direction("45x:0", "45°x:0°, ideal", 45, 0, 0),
        Instrument("45a:0-iso", f"45°a:0° {iso}", *_pairs(ring, cone, quarter)),
        Instrument("0:45a-iso", f"0°:45°a {iso}", *_pairs(cone, ring, quarter)),
        Instrument("45x:0-iso", f"45°x:0° {iso}", *_pairs(side, cone, quarter)),
        Instrument("di:8", "di:8°, sphere with specular included", *sphere),
        Instrument("de:8", "de:8°, sphere with specular excluded", *_trapped(sphere, refinement)),
    ]
    for angle in ASPECULAR:
        # The mirror direction lies at -45°, on the far side of the normal.
        view = angle - 45
        far = 180 if view < 0 else 0
        made.append(_direction(f"45as{angle}", f"45°:as{angle}°", 45, abs(view), far))
    return {instrument.name: instrument for instrument in made}


def _direction(name: str, title: str, light: int, view: int, azimuth: int) -> Instrument:
    """Make an instrument of one geometry, given in degrees."""
    theta_i, theta_r, delta_phi = np.radians([[float(light)], [float(view)], [float(azimuth)]])
    return Instrument(name, title, theta_i, theta_r, delta_phi, np.ones(1))


def _annulus(inner: float, outer: float, nodes: int) -> _Rule:
    """Directions between two cones around the normal: area is uniform in sin² θ."""
    points, weights = np.polynomial.legendre.leggauss(nodes)
    low, high = np.sin(inner) ** 2, np.sin(outer) ** 2
    return low + (points + 1) / 2 * (high - low), weights / 2


def _cone(tilt: float, half_angle: float, nodes: int) -> tuple[Array, Array, Array]:
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


def _two_nodes(directions: tuple[Array, Array, Array]) -> _Rule:
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


def _pairs(light: _Rule, view: _Rule, quarter: int) -> tuple[Array, Array, Array, Array]:
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


def _sphere(refinement: int) -> tuple[Array, Array, Array, Array]:
    """Light from the whole hemisphere, detector around 8°.

    Gauss nodes lie evenly in θ and not in sin² θ: toward grazing, masking goes with cos θ, whose
    slope in sin² θ is infinite.
    """
    points, weights = np.polynomial.legendre.leggauss(_SPHERE_NODES * refinement)
    theta = (points + 1) * (np.pi / 4)
    light = (np.sin(theta) ** 2, weights * np.sin(2 * theta))
    view = _two_nodes(_cone(SPHERE_TILT, CONE, 2 * refinement))
    return _pairs(light, view, _QUARTER_NODES * refinement)


def _trapped(
    sphere: tuple[Array, Array, Array, Array], refinement: int
) -> tuple[Array, Array, Array, Array]:
    """Take the light of the gloss trap, a cone in the mirror direction, from that of the sphere."""
    x, y, seen = _cone(SPHERE_TILT, CONE, refinement)
    theta_r, phi_r = np.arcsin(np.hypot(x, y)), np.arctan2(y, x)
    x, y, lit = _cone(SPHERE_TILT, TRAP, refinement)
    theta_i, phi_i = np.arcsin(np.hypot(x, y)), np.arctan2(y, x) + np.pi
    cut = np.sin(TRAP) ** 2 * np.cos(SPHERE_TILT)  # area of its ellipse over that of the disk
    pairs = np.broadcast_arrays(
        theta_i[:, np.newaxis],
        theta_r,
        np.arccos(np.cos(phi_r - phi_i[:, np.newaxis])),
        -cut * lit[:, np.newaxis] * seen,
    )
    theta_i, theta_r, azimuth, weight = (
        np.concatenate((whole, part.ravel())) for whole, part in zip(sphere, pairs, strict=True)
    )
    return theta_i, theta_r, azimuth, weight / np.sum(weight)


REGISTRY: Mapping[str, Instrument] = MappingProxyType(build())
"""Every instrument by its name."""
