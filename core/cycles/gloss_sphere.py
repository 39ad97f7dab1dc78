# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What gloss adds where light comes from a whole hemisphere, or through a window of it.

A quadrature over the hemisphere would miss a narrow lobe. So the facets are spread instead: evenly
over those that the view sees (Heitz, "Sampling the GGX distribution of visible normals", 2018), of
which each mirrors the view to where its light has to come from.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..gloss import Gloss
from ..instruments.geometries import Beam, Instrument
from ..numerics.arrays import Array
from ..numerics.memoized import memoized
from .gloss_facets import Lobe, rise, scaled, shadowing
from .gloss_lobe import Layer, compose

_RADII, _TURNS = 24, 48
"""Facets over the disk that the view sees them on."""
_VIEW_RADII, _VIEW_TURNS = 2, 4
"""Views within a detector's cone."""
_KEPT = 64
_SPREADS = 8
"""Some 150 kB each."""


def layer(gloss: Gloss, instrument: Instrument) -> Layer:
    """Give what gloss adds to and lets pass of the reading of a sphere, each of shape (3,).

    Parameters
    ----------
    gloss
        The node's sockets.
    instrument
        One with a hemisphere of light; behind its gloss trap it is dark.

    Examples
    --------
    >>> from ..instruments import find
    >>> found = layer(Gloss(level=0.5, roughness=0.0), find("di:8"))
    >>> np.round(found.shine, 4).tolist()
    [0.04, 0.04, 0.04]
    """
    theta, _ = _views(instrument.view)
    found = compose(gloss, np.cos(theta), lambda lobe: _at_instrument(lobe, instrument))
    # A white reads 1 behind a trap all the same.
    tilt, trap = math.radians(instrument.view.tilt), math.radians(instrument.trap)
    brighter = 1 / (1 - math.sin(trap) ** 2 * math.cos(tilt))
    return Layer(found.shine.mean(axis=0) * brighter, found.passed.mean(axis=0))


def through(
    gloss: Gloss, theta: Array, phi: Array, lit: Callable[[Array], Array] | None = None
) -> Layer:
    """Give what gloss sends from all or some of the hemisphere to each of some views.

    Parameters
    ----------
    gloss
        The node's sockets.
    theta, phi
        Polar angle and azimuth of the views, radians, shape (views,).
    lit
        Whether light comes from directions, unit vectors (..., 3); None for all of them.

    Returns
    -------
    Shapes (views, 3): its share of the light of a hemisphere that glows evenly where it is lit.

    Examples
    --------
    >>> found = through(Gloss(roughness=0.2), np.array([0.0]), np.array([0.0]))
    >>> np.round(found.shine, 3).tolist()
    [[0.04, 0.04, 0.04]]
    """
    return compose(
        gloss, np.cos(theta), lambda lobe: _read(lobe, _spread(lobe.square, theta, phi, lit))
    )


class _Facets(NamedTuple):
    """What views see of facets.

    Parameters
    ----------
    view
        Cosines of the views, shape (views,).
    half
        Cosine from each facet to the view, shape (views, facets).
    part
        How much of the light that it mirrors to the view reaches it, of the same shape.
    mean
        Of that, shape (views, 1).
    """

    view: Array
    half: Array
    part: Array
    mean: Array


@memoized(maxsize=_KEPT)
def _at_instrument(lobe: Lobe, instrument: Instrument) -> tuple[Array, Array]:
    """Give the same as `_read`; while one lobe is dragged, the other stays as it is."""
    return _read(lobe, _facets(lobe.square, instrument))


def _read(lobe: Lobe, facets: _Facets) -> tuple[Array, Array]:
    """Give what views read of a lobe, (views, channels), and what it sends on, (views, 1)."""
    own = np.array(lobe.at_normal)
    risen = np.einsum("vf,vf->v", rise(lobe, facets.half), facets.part) / facets.half.shape[1]
    gained, sent = scaled(lobe, facets.view)
    return (own * facets.mean + (1 - own) * risen[:, np.newaxis]) * gained, sent


@memoized(maxsize=_SPREADS)
def _facets(square: float, instrument: Instrument) -> _Facets:
    """Spread facets for the views of an instrument; while the level is dragged, they stay."""
    theta, phi = _views(instrument.view)
    trap, tilt = math.radians(instrument.trap), math.radians(instrument.view.tilt)
    dark = np.array([-math.sin(tilt), 0.0, math.cos(tilt)])

    def lit(light: Array) -> Array:
        return np.asarray(light @ dark < math.cos(trap))

    return _spread(square, theta, phi, lit if trap else None)


def _spread(
    square: float, theta: Array, phi: Array, lit: Callable[[Array], Array] | None
) -> _Facets:
    """Spread facets evenly over those that each view sees; parameters as in `through`."""
    # Without a window, what is left and right of the view is alike: one side is enough.
    half, light = _mirrored(square, theta, phi, _TURNS if lit is not None else _TURNS // 2)
    view, up = np.cos(theta), light[2]
    # What the view sees of facets, it sees lit by as much as the light is not shadowed.
    to_view = 1 + shadowing(square, view)[:, np.newaxis]
    part = to_view / (to_view + shadowing(square, np.maximum(up, 1e-6)))
    part = np.where(up > 0, part, 0.0)
    if lit is not None:
        part = part * lit(np.stack(light, axis=-1))
    return _Facets(view, half, part, part.mean(axis=1, keepdims=True))


def _mirrored(
    square: float, theta: Array, phi: Array, turns: int
) -> tuple[Array, tuple[Array, Array, Array]]:
    """Cosine from each facet to the view, (views, facets), and where it mirrors that to.

    The latter in its three components. `turns` of the `_TURNS` around the view are spread: the
    first half of them lies to one side of it.
    """
    alpha = math.sqrt(square)
    sine, cosine = np.sin(theta)[:, np.newaxis], np.cos(theta)[:, np.newaxis]
    stretched = np.hypot(alpha * sine, cosine)
    # Cosine and sine of the stretched view.
    along, aside = cosine / stretched, alpha * sine / stretched
    radius = np.sqrt((np.arange(_RADII) + 0.5) / _RADII)[:, np.newaxis]
    turn = (np.arange(turns) + 0.5) * (2 * np.pi / _TURNS) - np.pi / 2
    across, up = (radius * np.cos(turn)).ravel(), (radius * np.sin(turn)).ravel()
    squared = across**2
    rim = np.sqrt(1 - squared)
    up = rim + (up - rim) * (1 + along) / 2
    ahead = np.sqrt(np.maximum(1 - squared - up**2, 0))
    # The stretched view lies in the plane y = 0: one axis of the disk is y, the other is across.
    x, y = alpha * (ahead * aside - up * along), alpha * across
    z = up * aside + ahead * along
    length = np.sqrt(x**2 + y**2 + z**2)
    x, y, z = x / length, y / length, z / length
    half = x * sine + z * cosine
    x, y, z = 2 * half * x - sine, 2 * half * y, 2 * half * z - cosine
    cos, sin = np.cos(phi)[:, np.newaxis], np.sin(phi)[:, np.newaxis]
    return half, (x * cos - y * sin, x * sin + y * cos, z)


def _views(beam: Beam) -> tuple[Array, Array]:
    """Spread views over a detector's cone, evenly in projected solid angle."""
    tilt, width = math.radians(beam.tilt), math.radians(beam.half_angle)
    if width == 0:
        return np.array([tilt]), np.zeros(1)
    radius = np.sqrt((np.arange(_VIEW_RADII) + 0.5) / _VIEW_RADII)[:, np.newaxis]
    turn = (np.arange(_VIEW_TURNS) + 0.25) * (2 * np.pi / _VIEW_TURNS)
    x = math.sin(tilt) * math.cos(width)
    x = (x + math.sin(width) * math.cos(tilt) * radius * np.cos(turn)).ravel()
    y = (math.sin(width) * radius * np.sin(turn)).ravel()
    return np.arcsin(np.hypot(x, y)), np.arctan2(y, x)
