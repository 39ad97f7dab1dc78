# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Many materials in many directions under lights, with what several models need of them.

Choosing a model compares the colors of all of them. XYZ is linear in reflectance: where a model is
a polynomial in ρ, two colors a material serve all directions, and no band has to be looked at. The
file of such a model has a function `colors` that takes a `Surface` and gives XYZ, which broadcasts
to (materials, geometries, 3 · lights).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .. import oren_nayar
from ..numerics.arrays import Array


@dataclass(frozen=True, eq=False)
class Surface:
    """Materials, directions and lights.

    Attributes
    ----------
    albedo
        ρ(λ), shape (materials, bands).
    theta_i, theta_r, delta_phi
        Radians, shape (geometries,) or (materials, geometries).
    sigma
        Roughness, radians, shape (materials, 1).
    weights
        From reflectance to XYZ under each light, shape (bands, 3 · lights).
    """

    albedo: Array
    theta_i: Array
    theta_r: Array
    delta_phi: Array
    sigma: Array
    weights: Array

    @cached_property
    def flat(self) -> Array:
        """XYZ of ρ, shape (materials, 1, 3 · lights)."""
        return np.asarray((self.albedo @ self.weights)[:, np.newaxis])

    @cached_property
    def squared(self) -> Array:
        """XYZ of ρ², of the same shape."""
        return np.asarray(((self.albedo * self.albedo) @ self.weights)[:, np.newaxis])

    @cached_property
    def published(self) -> tuple[Array, Array]:
        """F1 and F2 of the published model, each of shape (materials, geometries, 1)."""
        f1, f2 = oren_nayar.factors(self.theta_i, self.theta_r, self.delta_phi, self.sigma)
        return f1[..., np.newaxis], f2[..., np.newaxis]

    @cached_property
    def single(self) -> Array:
        """XYZ of F1 ρ, shape (materials, geometries, 3 · lights)."""
        return np.asarray(self.published[0] * self.flat)
