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

import numpy as np

from ..gloss import Gloss
from ..instruments.geometries import Beam, Instrument
from ..numerics.arrays import Array
from .gloss_lobe import Layer, Lobe, compose, gained, reflection, shadowing

_RADII, _TURNS = 24, 48
"""Facets over the disk that the view sees them on."""
_VIEW_RADII, _VIEW_TURNS = 2, 4
"""Views within a detector's cone."""


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
    theta, phi = _views(instrument.view)
    trap, tilt = math.radians(instrument.trap), math.radians(instrument.view.tilt)
    dark = np.array([-math.sin(tilt), 0.0, math.cos(tilt)])

    def lit(light: Array) -> Array:
        return np.asarray(light @ dark < math.cos(trap))

    found = through(gloss, theta, phi, lit if trap else None)
    # A white reads 1 all the same.
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
    cosine = np.cos(theta)

    def seen(lobe: Lobe) -> Array:
        half, light = _mirrored(lobe, theta, phi)
        # What the view sees of facets, it sees lit by as much as the light is not shadowed.
        up = light[..., 2]
        to_view = 1 + shadowing(lobe.square, cosine)[:, np.newaxis]
        part = to_view / (to_view + shadowing(lobe.square, np.maximum(up, 1e-6)))
        part = np.where(up > 0, part, 0.0)
        if lit is not None:
            part = part * lit(light)
        mean = (reflection(lobe, half) * part[..., np.newaxis]).mean(axis=1)
        return np.asarray(mean * gained(lobe, cosine))

    return compose(gloss, cosine, seen)


def _mirrored(lobe: Lobe, theta: Array, phi: Array) -> tuple[Array, Array]:
    """Cosine from each facet to the view, (views, facets), and where it mirrors that to."""
    alpha = math.sqrt(lobe.square)
    view = np.stack((np.sin(theta), np.zeros_like(theta), np.cos(theta)), axis=-1)
    stretched = view * [alpha, alpha, 1]
    stretched /= np.linalg.norm(stretched, axis=-1, keepdims=True)
    along = stretched[:, 2:3]  # cosine of the stretched view
    radius = np.sqrt((np.arange(_RADII) + 0.5) / _RADII)[:, np.newaxis]
    turn = (np.arange(_TURNS) + 0.5) * (2 * np.pi / _TURNS)
    across, up = (radius * np.cos(turn)).ravel(), (radius * np.sin(turn)).ravel()
    rim = np.sqrt(1 - across**2)
    up = rim + (up - rim) * (1 + along) / 2
    ahead = np.sqrt(np.maximum(1 - across**2 - up**2, 0))
    # The stretched view lies in the plane y = 0: one axis of the disk is y, the other is across.
    sine = np.sqrt(np.maximum(1 - along**2, 0))
    facet = np.stack(
        (-up * along + ahead * sine, np.broadcast_to(across, up.shape), up * sine + ahead * along),
        axis=-1,
    )
    facet *= [alpha, alpha, 1]
    facet /= np.linalg.norm(facet, axis=-1, keepdims=True)
    half = np.einsum("vfx,vx->vf", facet, view)
    light = 2 * half[..., np.newaxis] * facet - view[:, np.newaxis]
    x, y = light[..., 0], light[..., 1]
    cos, sin = np.cos(phi)[:, np.newaxis], np.sin(phi)[:, np.newaxis]
    turned = np.stack((x * cos - y * sin, x * sin + y * cos, light[..., 2]), axis=-1)
    return half, turned


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
