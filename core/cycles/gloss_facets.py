# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The facets of one GGX lobe as Cycles has them: what they mirror, shadow and send to each other.

The formulas are those of `kernel/closure/bsdf_microfacet.h` in Blender 4.5 and 5.2; see
`core.cycles.gloss_lobe`, which lays two such lobes over a diffuse one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..closure.packing import unpack
from ..numerics.arrays import Array
from . import gloss_data


class Lobe(NamedTuple):
    """One GGX lobe.

    Parameters
    ----------
    roughness
        As its socket has it.
    refraction
        Index of refraction.
    at_normal
        Reflection at the normal, of each channel, or one number of all: a lobe without a tint is
        the same in all three, and computed once.
    multiscatter
        Whether it is scaled for what its facets send to each other.
    """

    roughness: float
    refraction: float
    at_normal: tuple[float, ...]
    multiscatter: bool

    @property
    def square(self) -> float:
        """α², as GGX counts roughness: the fourth power of the socket's."""
        return min(max(self.roughness, 0.0), 1.0) ** 4


def rise(lobe: Lobe, half: Array) -> Array:
    """Where the reflection of facets lies between that at the normal, 0, and the whole, 1.

    Of cosines of the angle to them, of any shape.

    Examples
    --------
    >>> rise(Lobe(0.5, 1.5, (0.04,), True), np.array([0.0, 1.0])).round(4).tolist()
    [1.0, 0.0]
    """
    own = at_normal(lobe.refraction)
    bent = (_fresnel(half, lobe.refraction) - own) / (1 - own)
    return np.asarray(np.minimum(np.maximum(bent, 0), 1))


def scaled(lobe: Lobe, view: Array) -> tuple[Array, Array]:
    """Give by how much a lobe is scaled for what its facets send to each other, and what it sends.

    Parameters
    ----------
    lobe
        The lobe.
    view
        Cosines of the view, of any shape (...).

    Returns
    -------
    gained, sent
        The scale, shape (..., channels) or a 1 for all, and what Cycles takes the lobe to send on
        in all, shape (..., 1): of the channel that most of is sent.

    Examples
    --------
    >>> gained, sent = scaled(Lobe(1.0, 1.5, (1.0,), True), np.array(1.0))
    >>> np.round(gained, 2).tolist(), np.round(sent, 2).tolist()
    ([3.26], [1.0])
    """
    own = np.array(lobe.at_normal)
    sent = own + (1 - own) * _over_view("share", view, lobe.roughness, _place(lobe.refraction))
    if not lobe.multiscatter:
        return np.ones(1), sent.max(axis=-1, keepdims=True)
    kept = _over_view("kept", view, lobe.roughness)
    mean_kept = float(_between(_TABLES["mean kept"], lobe.roughness))
    single = own + (1 - own) * _mean_rise(lobe.refraction)
    multiple = single * mean_kept / (1 - single * (1 - mean_kept))
    # 1/kept makes up for what is lost between facets, of which they absorb a part.
    gained = 1 + multiple * ((1 - kept) / kept)
    return gained, np.asarray((sent * gained * kept).max(axis=-1, keepdims=True))


def shadowing(square: float, cosine: Array) -> Array:
    """Smith's Λ for GGX, of α² and cosines.

    Examples
    --------
    >>> shadowing(0.25, np.array([1.0, 0.5])).round(4).tolist()
    [0.0, 0.1614]
    """
    return np.asarray((np.sqrt(1 + square * (1 / cosine**2 - 1)) - 1) / 2)


def at_normal(index: float) -> float:
    """Reflection at the normal of an index of refraction.

    Examples
    --------
    >>> round(at_normal(1.5), 9)
    0.04
    """
    return ((index - 1) / (index + 1)) ** 2


def _fresnel(cosine: Array, index: float) -> Array:
    """Fresnel reflection of unpolarized light on a dielectric."""
    inside = index**2 - 1 + cosine**2
    bent = np.sqrt(np.maximum(inside, 0))
    across = (cosine - bent) / (cosine + bent)
    steep = index**2 * cosine
    along = (bent - steep) / (bent + steep)
    return np.where(inside > 0, (across**2 + along**2) / 2, 1.0)


def _mean_rise(index: float) -> float:
    """Give the mean of `rise` over the hemisphere, in Kulla and Conty's fit."""
    if index < 1:
        mean = 0.997118 + index * (0.1014 - index * (0.965241 + index * 0.130607))
    else:
        mean = (index - 1) / (4.08567 + 1.00071 * index)
    own = at_normal(index)
    return min(max((mean - own) / (1 - own), 0.0), 1.0)


def _place(index: float) -> float:
    """Where an index of refraction lies in `gloss_data.SHARE`."""
    return math.sqrt(abs(index - 1) / (index + 1))


def _over_view(name: str, view: Array, *places: float) -> Array:
    """Read a table linearly between its entries, as Cycles does, at the cosines of a view (...).

    `places`, from 0 to 1, are those of roughness and, where the table has it, refraction: its first
    axes here. They are one number each, so that a line over the view is left. Shape (..., 1).
    """
    line = _TABLES[name]
    for place in places:
        line = _between(line, place)
    return np.asarray(np.interp(view, _COSINES[line.size], line)[..., np.newaxis])


def _between(table: Array, place: float) -> Array:
    """Read the first axis of a table at a place from 0 to 1."""
    along = min(max(place, 0.0), 1.0) * (len(table) - 1)
    low = min(int(along), len(table) - 2)
    return np.asarray(table[low] * (1 - (along - low)) + table[low + 1] * (along - low))


def _unpacked(size: int, packed: str) -> Array:
    """Unpack a table, and put the roughness, which runs fastest in it, first."""
    values = unpack(packed, (gloss_data.STEP,))[:, 0]
    axes = round(math.log(values.size, size))
    return np.ascontiguousarray(np.moveaxis(values.reshape((size,) * axes), -1, 0))


_TABLES = {name: _unpacked(*table) for name, table in gloss_data.TABLES.items()}
_COSINES = {size: np.linspace(0, 1, size) for size, _ in gloss_data.TABLES.values()}
