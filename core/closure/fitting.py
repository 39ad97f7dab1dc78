# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From readings of a few grays to all albedos: the closed form that is nearest to them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import Array
from .formula import forward, over_blocks

FEWEST = 4
"""Readings that tell three numbers, and one more, to tell how well they do."""

_ROUNDS = 5
_STEPS = 41


class Fitted(NamedTuple):
    """b, a and g of r = ρ (b + a / (1 + √(1 - g ρ))), and the largest residual, relative."""

    b: float
    a: float
    g: float
    residual: float

    def reading(self, albedo: npt.ArrayLike) -> Array:
        """Give the reading of any albedo, shape of `albedo`."""
        weights = (np.asarray(self.b), np.asarray(self.a), np.asarray(self.g))
        return over_blocks(forward, weights, np.asarray(albedo, np.float64))


def fit(albedo: npt.ArrayLike, reading: npt.ArrayLike) -> Fitted:
    """Fit the closed form to readings of one surface with facets of several albedos.

    How light goes from facet to facet does not depend on their albedo, so that a few readings tell
    all others. Relative residuals are squared: dark readings count as much as bright ones.

    Parameters
    ----------
    albedo
        Of the facets, above 0 and up to 1, shape (n,), four or more.
    reading
        What was read of each, shape (n,).

    Raises
    ------
    DomainError
        If there are fewer, or they are out of range.

    Examples
    --------
    >>> albedo = np.array([0.1, 0.3, 0.5, 0.7, 0.9])
    >>> surface = Fitted(0.55, 0.5, 0.8, 0.0)
    >>> found = fit(albedo, surface.reading(albedo))
    >>> [round(number, 4) for number in found[:3]], found.residual < 1e-6
    ([0.55, 0.5, 0.8], True)
    """
    rho, read = (np.asarray(given, np.float64) for given in (albedo, reading))
    if rho.ndim != 1 or rho.shape != read.shape or rho.size < FEWEST:
        msg = f"There are readings of {rho.size} albedos; give {FEWEST} or more, one of each."
        raise DomainError(msg)
    if not ((rho > 0) & (rho <= 1) & np.isfinite(read)).all():
        msg = "An albedo is not above 0 and up to 1, or its reading no number; leave it out."
        raise DomainError(msg)
    share = read / rho
    low, high = 0.0, 1.0
    for _ in range(_ROUNDS):
        tried = np.linspace(low, high, _STEPS)
        off = [float(np.sum(_of_g(g, rho, share)[1] ** 2)) for g in tried]
        best, step = float(tried[int(np.argmin(off))]), float(tried[1] - tried[0])
        low, high = max(best - step, 0.0), min(best + step, 1.0)
    (b, a), residual = _of_g(best, rho, share)
    return Fitted(float(b), float(a), best, float(np.abs(residual).max()))


def _of_g(g: float, rho: Array, share: Array) -> tuple[Array, Array]:
    """Give b and a, in which the form is linear, for one g; and the relative residuals."""
    terms = np.stack((np.ones_like(rho), 1 / (1 + np.sqrt(1 - g * rho))), axis=1) / share[:, None]
    weights = np.linalg.lstsq(terms, np.ones_like(share), rcond=None)[0]
    return weights, terms @ weights - 1
