# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What light may meet on its way through a scene of which only the surfaces' albedos are known.

A pixel shows one surface, lit by the lamps and by what others reflect. Their light has met one,
two, three … surfaces, each time a mixture of some of the scene's. Nothing is rendered: the mixtures
are drawn once, from a fixed seed, and can then be followed at any wavelengths, or in red, green and
blue, so that a few bands are compared with the whole spectrum on the very same ways of light.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..numerics.arrays import Array

_BOUNCES = 3
"""After as many surfaces what is left is taken for a geometric series of the scene's mean."""
_MIXED = 3
"""Surfaces that mostly light a pixel in the first place: its neighbors."""
_NEIGHBORS = 0.5
"""Part of them in the light that surfaces send; the rest comes from all of the scene."""
_SPREAD = 0.5
"""Standard deviation of the logarithm of how much light of a lamp reaches a place."""
_SHADOW = 0.15
"""Part of the places that a lamp does not reach."""


@dataclass(frozen=True, eq=False)
class Paths:
    """Ways of light to some pixels.

    Parameters
    ----------
    own
        Surface that each pixel shows, shape (pixels,).
    mixtures
        Parts of the surfaces that light met before, last first, shape (bounces, pixels, surfaces).
    shares
        Parts of the surfaces in the scene, shape (surfaces,).
    direct
        Light of each lamp that comes to each pixel at once, shape (lamps, pixels).
    around
        Light of each lamp that comes to the surfaces around it, shape (lamps, pixels).
    enclosed
        Part of the light leaving a surface that meets another one.
    """

    own: Array
    mixtures: Array
    shares: Array
    direct: Array
    around: Array
    enclosed: float

    def transport(self, albedos: Array) -> tuple[Array, Array]:
        """Follow them in some bands.

        Parameters
        ----------
        albedos
            Of the surfaces, shape (surfaces, bands).

        Returns
        -------
        direct, indirect
            What a pixel shows of a lamp that sends 1 in each band: of light that met its surface
            alone, and of all other. Shape (lamps, pixels, bands) each.
        """
        shown = albedos[self.own]
        # 0.98 of a white closed room's light goes on: without it a furnace would never end.
        mean = np.minimum(self.enclosed * (self.shares @ albedos), 0.98)
        met = self.mixtures @ albedos * self.enclosed
        arriving = met[-1] / (1 - mean)
        for mixture in met[-2::-1]:
            arriving = mixture * (1 + arriving)
        return (
            self.direct[..., np.newaxis] * shown,
            self.around[..., np.newaxis] * (shown * arriving),
        )


def draw(
    pixels: int, surfaces: int, lamps: int, seed: int, shares: Array, enclosed: float
) -> Paths:
    """Draw ways of light; equal arguments give equal ways.

    Parameters
    ----------
    pixels, surfaces, lamps
        How many.
    seed
        Of the random numbers.
    shares, enclosed
        As in `Paths`.

    Examples
    --------
    >>> ways = draw(4, 2, 1, 7, np.array([0.5, 0.5]), 1.0)
    >>> direct, indirect = ways.transport(np.array([[0.5], [0.5]]))
    >>> direct.shape, bool(np.allclose(indirect, 0.5 * ways.around[..., np.newaxis]))
    ((1, 4, 1), True)
    """
    random = np.random.default_rng(seed)
    own = np.arange(pixels) % surfaces if (shares == shares[0]).all() else None
    if own is None:
        own = random.choice(surfaces, pixels, p=shares)
    mixtures = np.empty((_BOUNCES, pixels, surfaces))
    for bounce in range(_BOUNCES):
        # With each bounce light comes from more of the scene.
        near = np.zeros((pixels, surfaces))
        rows = np.arange(pixels)
        for part in random.dirichlet(np.ones(_MIXED), pixels).T:
            np.add.at(near, (rows, random.choice(surfaces, pixels, p=shares)), part)
        kept = _NEIGHBORS ** (bounce + 1)
        mixtures[bounce] = kept * near + (1 - kept) * shares
    reach = np.exp(random.normal(-(_SPREAD**2) / 2, _SPREAD, (2, lamps, pixels)))
    lit = random.random((lamps, pixels)) >= _SHADOW
    return Paths(own, mixtures, shares, reach[0] * lit, reach[1], enclosed)
