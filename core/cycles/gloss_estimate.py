# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Specular level and roughness of a Principled BSDF from what instruments know of gloss.

A sphere with and without its gloss trap differ by the part of the lobe that meets the trap, and a
gloss meter reads the part that meets its window: both shrink with the level, and, since trap and
windows have different sizes and angles, at different rates with the roughness. Of a multi-angle
instrument the angles near the mirror direction read more than the others, by the lobe.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..errors import DomainError
from ..gloss import Gloss
from ..instruments import REGISTRY, find
from ..instruments import gloss as meters
from ..numerics.arrays import Array
from . import gloss_reading, gloss_sphere

LARGEST_LEVEL = 1.0
"""Of Blender's socket."""
_LEVELS = (0.05, 0.2, 0.5, LARGEST_LEVEL)
"""What the readings are computed at; between them they are nearly proportional."""
_FINE = 400
_COARSE = 17
_FINER, _ZOOMS = 7, 3
_LEAST = 1e-4
"""Reading, and hundredth of a gloss unit, below which there is nothing to fit."""
_RELATIVE = 0.01
"""How well lobe and readings are known, at best."""
_BODY = 0.02
"""The same of whole readings at angles: a rough body is no more even than that."""
_ABSOLUTE = {"trap": 0.0003}
"""The same of white, of a difference of two readings."""
_UNITS = 0.001
"""The same of readings in gloss units: a tenth of one."""
_USUAL, _SPREAD = 0.5, math.log(2)
"""Level of most dielectrics, that of their index, and by what factor others differ: it decides
where readings hardly depend on the level."""


@dataclass(frozen=True)
class GlossReadings:
    """What was read of one surface.

    Parameters
    ----------
    sci, sce
        Luminance factors of a sphere di:8 and de:8, 0 to 1.
    units
        Gloss units by the angle of the meter, degrees.
    read_at
        Where `sci` was read, if no sphere did: another of `core.instruments.REGISTRY`. There is no
        `sce` then.
    angles
        Luminance factors at further instruments, such as ``"45as15"``.
    """

    sci: float
    sce: float | None = None
    units: Mapping[int, float] = field(default_factory=dict)
    read_at: str = "di:8"
    angles: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class GlossEstimate:
    """What they tell.

    Parameters
    ----------
    gloss
        With level and roughness; the rest as given.
    misfit
        Largest relative difference of a reading from what this gloss reads.
    level_is_known
        Whether the level was found, and not given.
    """

    gloss: Gloss
    misfit: float
    level_is_known: bool


def readings(
    gloss: Gloss, diffuse: float, angles: tuple[int, ...] = (60,), at: Sequence[str] = ()
) -> GlossReadings:
    """Predict what sphere and gloss meters read of a gray body below gloss.

    Parameters
    ----------
    gloss
        The node's sockets.
    diffuse
        Reading of the body alone.
    angles
        Of gloss meters, degrees.
    at
        Further instruments.

    Examples
    --------
    >>> found = readings(Gloss(level=0.5, roughness=0.2), 0.3)
    >>> round(found.sci - found.sce, 3), round(found.units[60], 1)
    (0.021, 38.3)
    """
    included, excluded = (gloss_sphere.layer(gloss, find(name)) for name in ("di:8", "de:8"))
    sci, sce = (float(each.over(np.full(3, diffuse)).mean()) for each in (included, excluded))
    units, seen = _units(gloss, diffuse, angles), _seen(gloss, diffuse, at)
    return GlossReadings(sci, sce, units, angles=seen)


def _units(gloss: Gloss, diffuse: float, angles: tuple[int, ...]) -> dict[int, float]:
    """Predict what gloss meters read."""
    units = {}
    for angle in angles:
        meter = meters.find(angle)
        theta, phi, weights = meters.source_directions(meter)
        found = gloss_sphere.through(gloss, theta, phi, _window(meter))
        body = found.passed * diffuse * _share(meter)
        seen = weights @ (found.shine + body).mean(axis=-1)
        units[angle] = float(100 * seen / meters.black_glass(meter))
    return units


def _seen(gloss: Gloss, diffuse: float, at: Sequence[str]) -> dict[str, float]:
    """Predict what other instruments read."""
    body = np.full(3, diffuse)
    return {name: float(gloss_reading.at_instrument(gloss, name).over(body).mean()) for name in at}


def estimate(
    read: GlossReadings, level: float | None = None, gloss: Gloss | None = None
) -> GlossEstimate:
    """Find level and roughness.

    Parameters
    ----------
    read
        What was read: besides SCI, of SCE, gloss units and angles at least one; of several the
        level follows, too.
    level
        Specular IOR Level that is known. Without it, 0.5 is taken where it cannot be told.
    gloss
        IOR, coat and tints; a Principled BSDF as it is new without it.

    Raises
    ------
    DomainError
        If there is nothing to tell gloss from, or no gloss that could be read.

    Examples
    --------
    >>> found = estimate(readings(Gloss(level=0.5, roughness=0.3), 0.2)).gloss
    >>> round(found.level, 1), round(found.roughness, 2)
    (0.5, 0.3)
    """
    if read.sce is not None and read.read_at != "di:8":
        msg = f"SCE stands beside a reading at {read.read_at}; give SCI with it, or leave it out."
        raise DomainError(msg)
    base = gloss or Gloss()
    wanted = _told(read)
    if not wanted:
        msg = "There is nothing to tell gloss from; give SCE, or gloss units at 20, 60 or 85°."
        raise DomainError(msg)
    if min(wanted.values()) < _LEAST:
        msg = "These readings have no gloss: SCE is no less than SCI, or gloss units are 0."
        raise DomainError(msg)
    is_known = level is None and len(wanted) > 1
    if level is None and not is_known:
        level = base.level
    low, high, count = 0.0, 1.0, _COARSE
    for _ in range(_ZOOMS + 1):
        tried = np.linspace(low, high, count)
        fits = [_best(base._replace(roughness=float(r)), read, wanted, level) for r in tried]
        best = int(np.argmin([fit[0] for fit in fits]))
        low, high = tried[max(best - 1, 0)], tried[min(best + 1, count - 1)]
        count = _FINER
    _, misfit, found_level = fits[best]
    found = base._replace(level=found_level, roughness=float(tried[best]))
    return GlossEstimate(found, misfit, is_known)


def _told(read: GlossReadings) -> dict[str, float]:
    """Give the readings that gloss shows in, on one scale."""
    found = {f"{angle}": units / 100 for angle, units in read.units.items()}
    if read.sce is not None:
        found["trap"] = read.sci - read.sce
    return found | dict(read.angles)


def _best(
    gloss: Gloss, read: GlossReadings, wanted: Mapping[str, float], level: float | None
) -> tuple[float, float, float]:
    """Find the level that fits best at one roughness; gives cost, misfit and level."""
    angles = tuple(int(name) for name in wanted if name.isdigit())
    further = [name for name in wanted if name in REGISTRY]
    nodes = _LEVELS if level is None else (level,)
    table = []
    for node in nodes:
        tried = gloss._replace(level=node)
        whole = gloss_reading.at_instrument(tried, read.read_at)
        diffuse = float(np.maximum(whole.below(np.full(3, read.sci)), 0).mean())
        if "trap" in wanted:
            found = _told(readings(tried, diffuse, angles, further))
        else:
            units, seen = _units(tried, diffuse, angles), _seen(tried, diffuse, further)
            found = _told(GlossReadings(read.sci, units=units, angles=seen))
        table.append([found[name] for name in wanted])
    goal = np.array(list(wanted.values()))
    levels = np.array(nodes) if level is not None else np.linspace(nodes[0], nodes[-1], _FINE)
    rows = np.stack([np.interp(levels, nodes, column) for column in np.array(table).T], axis=-1)
    apart = np.log(np.maximum(rows, 1e-9) / goal)
    known = np.array([_ABSOLUTE.get(name, _UNITS) for name in wanted]) / goal
    relative = [_BODY if name in further else _RELATIVE for name in wanted]
    cost = ((apart / np.hypot(relative, known)) ** 2).sum(axis=-1)
    cost = cost + (np.log(levels / _USUAL) / _SPREAD) ** 2 if level is None else cost
    best = int(np.argmin(cost))
    return float(cost[best]), float(np.abs(apart[best]).max()), float(levels[best])


def _window(meter: meters.GlossMeter) -> Callable[[Array], Array]:
    """Give whether light goes through the window of a gloss meter's receptor."""
    tilt = math.radians(meter.angle)
    axis = np.array([-math.sin(tilt), 0.0, math.cos(tilt)])
    ahead = np.array([-math.cos(tilt), 0.0, -math.sin(tilt)])
    along, across = (math.tan(math.radians(width) / 2) for width in meter.receptor)

    def lit(light: Array) -> Array:
        far = light @ axis
        inside = np.abs(light @ ahead) < far * along
        return np.asarray(inside & (np.abs(light[..., 1]) < far * across))

    return lit


def _share(meter: meters.GlossMeter) -> float:
    """Share of the window in the light that an even diffuser sends out."""
    along, across = (math.radians(width) / 2 for width in meter.receptor)
    area = 4 * math.asin(math.sin(along) * math.sin(across))
    return area * math.cos(math.radians(meter.angle)) / math.pi
