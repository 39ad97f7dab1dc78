# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What instruments read of gloss, and how much of it a reading allows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..gloss import Gloss
from ..instruments import HEMISPHERE, find, quadrature
from ..numerics.arrays import Array
from ..numerics.memoized import memoized
from . import gloss_lobe, gloss_sphere
from .gloss_lobe import Layer

_STEPS = 60
"""At most; five are usual, and nine were the most."""
_CLOSE = 1e-5
"""How close to the largest share that is possible it ends."""
_KEPT = 64


def at_instrument(gloss: Gloss, instrument: str) -> Layer:
    """Give the same for an instrument: the means over its directions, each of shape (3,).

    Exact where the instrument looks in one direction, since `passed` depends on the view alone.

    Raises
    ------
    DomainError
        If the instrument is unknown.

    Examples
    --------
    >>> np.round(at_instrument(Gloss(level=1), "45a:0").shine, 4).tolist()
    [0.0444, 0.0444, 0.0444]
    """
    return _at_instrument(gloss, instrument)


def reading(diffuse: Array, gloss: Gloss | None, instrument: str) -> Array:
    """Put gloss over what an instrument reads of the diffuse lobe, shape (..., 3).

    Examples
    --------
    >>> np.round(reading(np.full(3, 0.5), Gloss(), "45a:0"), 4).tolist()
    [0.5035, 0.5035, 0.5035]
    >>> reading(np.full(3, 0.5), None, "45a:0").tolist()
    [0.5, 0.5, 0.5]
    """
    return diffuse if gloss is None else at_instrument(gloss, instrument).over(diffuse)


def largest(
    gloss: Gloss, wanted: npt.ArrayLike, instrument: str, white: npt.ArrayLike = 1.0
) -> Gloss | None:
    """Find how much gloss leaves a reading possible.

    Parameters
    ----------
    gloss
        What is there.
    wanted
        The whole reading in scene-linear RGB, shape (3,).
    instrument
        One of `core.instruments.REGISTRY`.
    white
        Reading of the diffuse lobe alone at color 1.

    Returns
    -------
    The same gloss if some color below it gives the reading: if the gloss alone reads no more, and
    over a white no less. Else with the largest level that does, or, where even level 0 does not,
    level 0 with the largest weight of the coat. None where the reading fits no gloss, nor none.

    Examples
    --------
    >>> found = largest(Gloss(level=0.8), [0.02, 0.03, 0.03], "45a:0")
    >>> round(found.level, 3)
    0.45
    """
    goal = np.asarray(wanted, np.float64)
    most = np.broadcast_to(np.asarray(white, np.float64), goal.shape)
    if not ((goal > 0) & (goal <= most)).all():
        return None

    def room(tried: Gloss) -> float:
        """Give what is left until it fits no more, below 0 beyond."""
        found = at_instrument(tried, instrument)
        return float(np.minimum(goal - found.shine, found.over(most) - goal).min())

    missing = room(gloss)
    if missing >= 0:
        return gloss
    level_free = gloss._replace(level=0.0)
    left = room(level_free)
    if left >= 0:
        steps = (left, missing)
        return _most(lambda share: gloss._replace(level=share * gloss.level), room, steps)
    steps = (room(level_free._replace(coat=0.0)), left)
    return _most(lambda share: level_free._replace(coat=share * gloss.coat), room, steps)


def _most(
    of_share: Callable[[float], Gloss], room: Callable[[Gloss], float], ends: tuple[float, float]
) -> Gloss:
    """Find the largest share that leaves room, by false position between 0 and 1.

    An end that stays counts for less, by how much the other one gained: Anderson and Björck, "A new
    high order method of regula falsi type for computing a root of an equation" (1973).
    """
    low, high = 0.0, 1.0
    at_low, at_high = ends
    moved = 0
    for _ in range(_STEPS):
        if high - low <= _CLOSE or at_low <= 0:
            break
        share = low + (high - low) * at_low / (at_low - at_high)
        # Ever so little on the side of what fits: both ends then close in.
        share = min(max(share, low + _CLOSE / 2), high - _CLOSE / 2)
        found = room(of_share(share))
        if found >= 0:
            at_high *= _less(found / at_low) if moved > 0 else 1.0
            low, at_low, moved = share, found, 1
        else:
            at_low *= _less(found / at_high) if moved < 0 else 1.0
            high, at_high, moved = share, found, -1
    return of_share(low)


def _less(gained: float) -> float:
    return 1 - gained if gained < 1 else 0.5


@memoized(maxsize=_KEPT)
def _at_instrument(gloss: Gloss, instrument: str) -> Layer:
    """Compute it; while σ is dragged, the gloss stays as it is."""
    found = _mean(gloss, instrument)
    for array in found:
        array.setflags(write=False)
    return found


def _mean(gloss: Gloss, instrument: str) -> Layer:
    if find(instrument).light == HEMISPHERE:
        return gloss_sphere.layer(gloss, find(instrument))
    of = quadrature.of(instrument)
    if of.angles is not None:
        return gloss_lobe.layer(gloss, *of.angles)
    found = gloss_lobe.layer(gloss, of.theta_i, of.theta_r, of.delta_phi)
    return Layer(np.asarray(of.weights @ found.shine), np.asarray(of.weights @ found.passed))
