# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the gloss of Cycles' Principled BSDF adds to its diffuse lobe, and what it takes from it.

    r = shine + passed · r_d(color, diffuse roughness)

with r_d that of `core.cycles.lobe`. Neither `shine` nor `passed` depends on color or diffuse
roughness, and `passed` depends on the view alone. The formulas are those of Blender 4.5 and 5.2,
`kernel/svm/closure.h` and `kernel/closure/bsdf_microfacet.h`: a GGX lobe with Smith's shadowing
(Walter et al. 2007; Heitz 2014), scaled so that no light is lost between facets after Kulla and
Conty, "Revisiting physically based shading at Imageworks" (2017), and below it the rest. Both
versions have the same tables.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..gloss import WHITE, Gloss
from ..numerics.arrays import Array
from ..numerics.memoized import FEW, memoized
from .gloss_facets import Lobe, at_normal, rise, scaled, shadowing

_KEPT = 64
_MIRROR = 2e-10
"""Fourth power of the roughness up to which Cycles has no lobe, only a mirror: a light without
width does not show in that."""
_FAINT = 1e-5
"""Weight up to which Cycles leaves a layer out."""
_GRAZING = 1e-6


class Layer(NamedTuple):
    """What lies over the diffuse lobe in some directions.

    Parameters
    ----------
    shine
        Reflectance factor of gloss and coat, scene-linear RGB, shape (..., 3).
    passed
        What the diffuse lobe is multiplied with, shape (..., 3).
    """

    shine: Array
    passed: Array

    def over(self, diffuse: Array) -> Array:
        """Reflectance factor with the diffuse lobe (..., 3) below."""
        return np.asarray(self.shine + self.passed * diffuse)

    def below(self, reading: Array) -> Array:
        """Give what the diffuse lobe has to read for a reading (..., 3); below 0 where it can't."""
        return np.asarray((reading - self.shine) / self.passed)


@dataclass(frozen=True, eq=False)
class Directions:
    """What gloss wants of directions, for who keeps them: `in_directions` then keeps their lobes.

    Parameters
    ----------
    light, view
        Cosines to the normal, any shape (...).
    normal, half
        Cosines of the half vector to the normal, and to light and view.
    """

    light: Array
    view: Array
    normal: Array
    half: Array


def layer(
    gloss: Gloss, theta_i: npt.ArrayLike, theta_r: npt.ArrayLike, delta_phi: npt.ArrayLike
) -> Layer:
    """Compute what gloss adds and lets pass.

    Parameters
    ----------
    gloss
        The node's sockets.
    theta_i, theta_r, delta_phi
        Light, view and the azimuth between them, radians; they broadcast. The light may not be
        swapped with the view.

    Examples
    --------
    >>> found = layer(Gloss(), np.pi / 4, 0.0, 0.0)
    >>> np.round(found.shine, 4).tolist()
    [0.0222, 0.0222, 0.0222]
    >>> np.round(layer(Gloss(level=0), np.pi / 4, 0.0, 0.0).passed, 4).tolist()
    [1.0, 1.0, 1.0]
    """
    angles = np.array(np.broadcast_arrays(theta_i, theta_r, delta_phi), np.float64)
    if angles[0].size <= FEW:
        return in_directions(gloss, _of_few(angles.tobytes(), angles.shape))
    at = directions(*angles)
    return compose(gloss, at.view, lambda lobe: _read(lobe, at))


@memoized(maxsize=_KEPT)
def in_directions(gloss: Gloss, at: Directions) -> Layer:
    """Do the same for directions that are asked for again: while σ is dragged, the gloss stays.

    While one socket of it is dragged, what hangs on others stays: each lobe is kept, too.

    Examples
    --------
    >>> at = directions(np.array([np.pi / 4]), np.zeros(1), np.zeros(1))
    >>> np.round(in_directions(Gloss(), at).shine, 4).tolist()
    [[0.0222, 0.0222, 0.0222]]
    """
    found = compose(gloss, at.view, lambda lobe: _kept_read(lobe, at))
    for array in found:
        array.setflags(write=False)
    return found


def compose(gloss: Gloss, view: Array, read: Callable[[Lobe], tuple[Array, Array]]) -> Layer:
    """Lay coat and specular lobe over each other, as Cycles does.

    Parameters
    ----------
    gloss
        The node's sockets.
    view
        Cosine of the view, any shape (...).
    read
        Gives what one lobe reads, of a direction of light, or of many together, and what Cycles
        takes it to send on in all: shapes (..., channels) and (..., 1).

    Examples
    --------
    >>> half = np.full((2, 1), 0.5)
    >>> found = compose(Gloss(), np.ones(2), lambda lobe: (half, half / 2))
    >>> found.shine[0].tolist(), found.passed[0].tolist()
    ([0.5, 0.5, 0.5], [0.75, 0.75, 0.75])
    """
    shine, weight = np.zeros((*view.shape, 1)), np.ones((*view.shape, 1))
    if gloss.coat > _FAINT:
        index = max(gloss.coat_ior, 1.0)
        if index > 1:
            coat = Lobe(gloss.coat_roughness, index, (at_normal(index),), True)
            shown, sent = read(coat)
            shine, weight = gloss.coat * shown, _left(gloss.coat * sent)
        if gloss.coat_tint != WHITE:
            # Beer's law along the refracted view.
            depth = 1 / np.sqrt(1 - (1 - view[..., np.newaxis] ** 2) / index**2)
            tint = np.maximum(gloss.coat_tint, 0)
            weight = weight * (1 + gloss.coat * (tint**depth - 1))
    index, own = _specular(gloss)
    if index != 1:
        tinted = tuple(min(max(own * max(part, 0.0), 0.0), 1.0) for part in gloss.tint)
        own_channels = tinted[:1] if len(set(tinted)) == 1 else tinted
        shown, sent = read(Lobe(gloss.roughness, index, own_channels, gloss.multiscatter))
        shine, weight = shine + weight * shown, weight * _left(sent)
    shine, weight = (
        each.repeat(3, axis=-1) if each.shape[-1] == 1 else each for each in (shine, weight)
    )
    return Layer(shine, weight)


def directions(theta_i: Array, theta_r: Array, delta_phi: Array) -> Directions:
    """Give what gloss wants of light, view and the azimuth between them, radians, of one shape.

    Examples
    --------
    >>> at = directions(np.array([0.3]), np.array([0.3]), np.array([np.pi]))
    >>> at.normal.round(6).tolist(), at.half.round(6).tolist()
    ([1.0], [0.955336])
    """
    light, view = (np.maximum(np.cos(theta), _GRAZING) for theta in (theta_i, theta_r))
    between = light * view + np.sin(theta_i) * np.sin(theta_r) * np.cos(delta_phi)
    # |light + view| is twice the cosine from either to the middle.
    half = np.sqrt(np.maximum((1 + between) / 2, _GRAZING**2))
    return Directions(light, view, np.minimum((light + view) / (2 * half), 1), half)


@memoized(maxsize=_KEPT)
def _of_few(angles: bytes, shape: tuple[int, ...]) -> Directions:
    """Give them for the bytes of all angles."""
    return directions(*np.frombuffer(angles).reshape(shape))


@memoized(maxsize=_KEPT)
def _kept_read(lobe: Lobe, at: Directions) -> tuple[Array, Array]:
    return _read(lobe, at)


def _read(lobe: Lobe, at: Directions) -> tuple[Array, Array]:
    """Reflectance factor of a GGX lobe, (..., channels), and what it sends on in all, (..., 1)."""
    gained, sent = scaled(lobe, at.view)
    square = lobe.square
    if square <= _MIRROR:
        return np.zeros((*at.view.shape, 1)), sent
    spread = square / (1 - at.normal**2 + square * at.normal**2) ** 2
    shadow = 1 + shadowing(square, at.light) + shadowing(square, at.view)
    shape = (spread / (4 * at.light * at.view * shadow))[..., np.newaxis]
    own = np.array(lobe.at_normal)
    reflected = own + (1 - own) * rise(lobe, at.half)[..., np.newaxis]
    return np.asarray(reflected * shape * gained), sent


def _left(taken: Array) -> Array:
    """Share of what is below that passes where so much is taken."""
    return np.asarray(np.minimum(np.maximum(1 - taken, 0), 1))


def _specular(gloss: Gloss) -> tuple[float, float]:
    """Index of refraction and reflection at the normal that level and IOR make together."""
    index = max(gloss.ior, 1e-5)
    own = at_normal(index)
    if gloss.level == 0.5:
        return index, own
    own *= 2 * max(gloss.level, 0.0)
    root = math.sqrt(min(own, 0.99))
    found = (1 + root) / (1 - root)
    return (1 / found if index < 1 else found), own
