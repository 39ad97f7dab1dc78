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
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..closure.packing import unpack
from ..gloss import Gloss
from ..numerics.arrays import Array
from ..numerics.memoized import FEW, memoized
from . import gloss_data

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


class Lobe(NamedTuple):
    """One GGX lobe.

    Parameters
    ----------
    roughness
        As its socket has it.
    refraction
        Index of refraction.
    at_normal
        Reflection at the normal, shape (3,).
    multiscatter
        Whether it is scaled for what its facets send to each other.
    """

    roughness: float
    refraction: float
    at_normal: Array
    multiscatter: bool

    @property
    def square(self) -> float:
        """α², as GGX counts roughness: the fourth power of the socket's."""
        return min(max(self.roughness, 0.0), 1.0) ** 4


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
    angles = np.broadcast_arrays(
        *(np.asarray(given, np.float64) for given in (theta_i, theta_r, delta_phi))
    )
    if angles[0].size > FEW:
        return _layer(gloss, *angles)
    return _of_few(gloss, np.array(angles).tobytes(), angles[0].shape)


@memoized(maxsize=_KEPT)
def _of_few(gloss: Gloss, angles: bytes, shape: tuple[int, ...]) -> Layer:
    """Compute it for the bytes of all angles: while σ is dragged, the gloss stays as it is."""
    found = _layer(gloss, *np.frombuffer(angles).reshape(3, *shape))
    for array in found:
        array.setflags(write=False)
    return found


def _layer(gloss: Gloss, light: Array, view: Array, around: Array) -> Layer:
    at = _geometry(light, view, around)

    def seen(lobe: Lobe) -> Array:
        return _seen(lobe, at)

    return compose(gloss, at.view, seen)


def compose(gloss: Gloss, view: Array, seen: Callable[[Lobe], Array]) -> Layer:
    """Lay coat and specular lobe over each other, as Cycles does.

    Parameters
    ----------
    gloss
        The node's sockets.
    view
        Cosine of the view, any shape (...).
    seen
        Gives what one lobe reads, shape (..., 3): of a direction of light, or of many together.

    Examples
    --------
    >>> found = compose(Gloss(), np.ones(2), lambda lobe: np.full((2, 3), 0.5))
    >>> found.shine.tolist()
    [[0.5, 0.5, 0.5], [0.5, 0.5, 0.5]]
    """
    shine, weight = np.zeros((*view.shape, 3)), np.ones((*view.shape, 3))
    if gloss.coat > _FAINT:
        index = max(gloss.coat_ior, 1.0)
        if index > 1:
            coat = Lobe(gloss.coat_roughness, index, np.full(3, _at_normal(index)), True)
            shine += gloss.coat * seen(coat)
            taken = gloss.coat * _albedo(coat, view).max(axis=-1, keepdims=True)
            weight *= np.clip(1 - taken, 0, 1)
        # Beer's law along the refracted view.
        depth = 1 / np.sqrt(1 - (1 - view[..., np.newaxis] ** 2) / index**2)
        tint = np.maximum(gloss.coat_tint, 0)
        weight *= 1 + gloss.coat * (tint**depth - 1)
    index, own = _specular(gloss)
    if index != 1:
        tinted = np.clip(own * np.maximum(gloss.tint, 0), 0, 1)
        lobe = Lobe(gloss.roughness, index, tinted, gloss.multiscatter)
        shine += weight * seen(lobe)
        weight *= np.clip(1 - _albedo(lobe, view).max(axis=-1, keepdims=True), 0, 1)
    return Layer(shine, weight)


class _Geometry(NamedTuple):
    """Cosines of light and view to the normal, and of the half vector to normal and view."""

    light: Array
    view: Array
    normal: Array
    half: Array


def _geometry(theta_i: Array, theta_r: Array, delta_phi: Array) -> _Geometry:
    light, view = (np.maximum(np.cos(theta), _GRAZING) for theta in (theta_i, theta_r))
    between = light * view + np.sin(theta_i) * np.sin(theta_r) * np.cos(delta_phi)
    # |light + view| is twice the cosine from either to the middle.
    half = np.sqrt(np.maximum((1 + between) / 2, _GRAZING**2))
    return _Geometry(light, view, np.minimum((light + view) / (2 * half), 1), half)


def _seen(lobe: Lobe, at: _Geometry) -> Array:
    """Reflectance factor of a GGX lobe, (..., 3)."""
    square = lobe.square
    if square <= _MIRROR:
        return np.zeros((*at.view.shape, 3))
    spread = square / (1 - at.normal**2 + square * at.normal**2) ** 2
    shadow = 1 + shadowing(square, at.light) + shadowing(square, at.view)
    shape = (spread / (4 * at.light * at.view * shadow))[..., np.newaxis]
    return np.asarray(reflection(lobe, at.half) * shape * gained(lobe, at.view))


def reflection(lobe: Lobe, half: Array) -> Array:
    """Reflection of facets (..., 3) at cosines of the angle to them, of any shape (...).

    Examples
    --------
    >>> lobe = Lobe(0.5, 1.5, np.full(3, 0.04), True)
    >>> np.round(reflection(lobe, np.array([0.0, 1.0])), 4)[:, 0].tolist()
    [1.0, 0.04]
    """
    bent = _remapped(_fresnel(half, lobe.refraction), lobe.refraction)[..., np.newaxis]
    return np.asarray(lobe.at_normal + (1 - lobe.at_normal) * bent)


def gained(lobe: Lobe, view: Array) -> Array:
    """Give by how much a lobe is scaled for what its facets send to each other, (..., 3).

    Examples
    --------
    >>> white = Lobe(1.0, 1.5, np.ones(3), True)
    >>> np.round(gained(white, np.array(1.0)), 2).tolist()
    [3.26, 3.26, 3.26]
    """
    if not lobe.multiscatter:
        return np.ones((*view.shape, 3))
    scale, dimming = _kept(lobe, view)
    return np.asarray(scale * dimming)


def _albedo(lobe: Lobe, view: Array) -> Array:
    """Give what Cycles takes a lobe to send on in all, (..., 3)."""
    share = _over_view("share", view, lobe.roughness, _place(lobe.refraction))[..., np.newaxis]
    albedo = lobe.at_normal + (1 - lobe.at_normal) * share
    return np.asarray(albedo * _kept(lobe, view)[1] if lobe.multiscatter else albedo)


def _kept(lobe: Lobe, view: Array) -> tuple[Array, Array]:
    """Give what makes up for light that is lost between facets, and how much of it they absorb."""
    kept = _over_view("kept", view, lobe.roughness)[..., np.newaxis]
    mean_kept = float(_between(_TABLES["mean kept"], lobe.roughness))
    missing = (1 - kept) / kept
    share = _remapped(np.asarray(_mean_fresnel(lobe.refraction)), lobe.refraction)
    single = lobe.at_normal + (1 - lobe.at_normal) * share
    multiple = single * mean_kept / (1 - single * (1 - mean_kept))
    return 1 + missing, (1 + multiple * missing) / (1 + missing)


def _specular(gloss: Gloss) -> tuple[float, float]:
    """Index of refraction and reflection at the normal that level and IOR make together."""
    index = max(gloss.ior, 1e-5)
    own = _at_normal(index)
    if gloss.level == 0.5:
        return index, own
    own *= 2 * max(gloss.level, 0.0)
    root = math.sqrt(min(own, 0.99))
    found = (1 + root) / (1 - root)
    return (1 / found if index < 1 else found), own


def _at_normal(index: float) -> float:
    return ((index - 1) / (index + 1)) ** 2


def _fresnel(cosine: Array, index: float) -> Array:
    """Fresnel reflection of unpolarized light on a dielectric."""
    inside = index**2 - 1 + cosine**2
    bent = np.sqrt(np.maximum(inside, 0))
    across = (cosine - bent) / (cosine + bent)
    along = (bent - index**2 * cosine) / (bent + index**2 * cosine)
    return np.where(inside > 0, (across**2 + along**2) / 2, 1.0)


def _remapped(fresnel: Array, index: float) -> Array:
    """Where a reflection lies between that at the normal, 0, and the whole, 1."""
    own = _at_normal(index)
    return np.asarray(np.clip((fresnel - own) / (1 - own), 0, 1))


def _mean_fresnel(index: float) -> float:
    """Fresnel reflection over the hemisphere, in Kulla and Conty's fit."""
    if index < 1:
        return 0.997118 + index * (0.1014 - index * (0.965241 + index * 0.130607))
    return (index - 1) / (4.08567 + 1.00071 * index)


def shadowing(square: float, cosine: Array) -> Array:
    """Smith's Λ for GGX, of α² and cosines.

    Examples
    --------
    >>> shadowing(0.25, np.array([1.0, 0.5])).round(4).tolist()
    [0.0, 0.1614]
    """
    return np.asarray((np.sqrt(1 + square * (1 / cosine**2 - 1)) - 1) / 2)


def _place(index: float) -> float:
    """Where an index of refraction lies in `gloss_data.SHARE`."""
    return math.sqrt(abs(index - 1) / (index + 1))


def _over_view(name: str, view: Array, *places: float) -> Array:
    """Read a table linearly between its entries, as Cycles does, at the cosines of a view.

    `places`, from 0 to 1, are those of roughness and, where the table has it, refraction: its last
    axis and its first. They are one number each, so that a line over the view is left.
    """
    line = _TABLES[name]
    line = _between(np.moveaxis(line, -1, 0), places[0])
    if len(places) > 1:
        line = _between(line, places[1])
    return np.interp(view, np.linspace(0, 1, line.size), line)


def _between(table: Array, place: float) -> Array:
    """Read the first axis of a table at a place from 0 to 1."""
    along = min(max(place, 0.0), 1.0) * (len(table) - 1)
    low = min(int(along), len(table) - 2)
    return np.asarray(table[low] * (1 - (along - low)) + table[low + 1] * (along - low))


def _unpacked(size: int, packed: str) -> Array:
    values = unpack(packed, (gloss_data.STEP,))[:, 0]
    axes = round(math.log(values.size, size))
    return np.asarray(values.reshape((size,) * axes))


_TABLES = {name: _unpacked(*table) for name, table in gloss_data.TABLES.items()}
