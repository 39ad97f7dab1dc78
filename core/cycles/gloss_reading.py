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
from . import gloss_lobe, gloss_sphere
from .gloss_lobe import Layer

_HALVINGS = 24


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
    return Layer(*_at_instrument(gloss, instrument))


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

    def fits(tried: Gloss) -> bool:
        found = at_instrument(tried, instrument)
        return bool(((found.shine <= goal) & (goal <= found.over(most))).all())

    if fits(gloss):
        return gloss
    level_free = gloss._replace(level=0.0)
    if fits(level_free):
        return _most(lambda share: gloss._replace(level=share * gloss.level), fits)
    return _most(lambda share: level_free._replace(coat=share * gloss.coat), fits)


def _most(of_share: Callable[[float], Gloss], fits: Callable[[Gloss], bool]) -> Gloss:
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(of_share(middle)) else (low, middle)
    return of_share(low)


def _at_instrument(gloss: Gloss, instrument: str) -> tuple[Array, Array]:
    if find(instrument).light == HEMISPHERE:
        return gloss_sphere.layer(gloss, find(instrument))
    of = quadrature.of(instrument)
    if of.angles is not None:
        return gloss_lobe.layer(gloss, *of.angles)
    found = gloss_lobe.layer(gloss, of.theta_i, of.theta_r, of.delta_phi)
    return np.asarray(of.weights @ found.shine), np.asarray(of.weights @ found.passed)
