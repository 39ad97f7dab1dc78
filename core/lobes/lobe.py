# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a diffuse lobe of another renderer is, and what its color makes of it.

All of them have one form, r = c (A + c B / (1 - c D)), with A, B and D of roughness and directions:
single scattering in proportion to the color, and where a lobe has more, what bounces on. So there
is one reflectance and one inverse, in closed form, for all.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..instruments import quadrature
from ..numerics.arrays import Array

Terms = tuple[Array, Array, Array]
"""A, B and D, each with an axis for the channels at its end."""


@dataclass(frozen=True)
class Lobe:
    """A renderer's diffuse lobe.

    Parameters
    ----------
    name
        What code calls it.
    title
        What a person does.
    source
        Where its formula comes from.
    largest
        Largest roughness, in the renderer's own unit; 0 where the lobe has none.
    terms
        A, B and D of `Terms` from roughness, θi, θr and Δφ, which broadcast, in radians.
    """

    name: str
    title: str
    source: str
    largest: float
    terms: Callable[[Array, Array, Array, Array], Terms]

    def reflectance(
        self,
        color: npt.ArrayLike,
        roughness: npt.ArrayLike,
        theta_i: npt.ArrayLike,
        theta_r: npt.ArrayLike,
        delta_phi: npt.ArrayLike,
    ) -> Array:
        """Give the reflectance factor, shape (..., channels), of a color (..., channels).

        Roughness and angles, radians, broadcast against the leading axes of the color.
        """
        four = (np.asarray(x, np.float64) for x in (roughness, theta_i, theta_r, delta_phi))
        return reflected(np.asarray(color, np.float64), self.terms(*four))

    def at(self, roughness: npt.ArrayLike, instrument: str) -> Terms:
        """Give the terms of what an instrument reads: A and B are means over its directions."""
        of = quadrature.of(instrument)
        s = np.asarray(roughness, np.float64)[..., np.newaxis]
        single, multiple, ratio = self.terms(s, of.theta_i, of.theta_r, of.delta_phi)
        shape = np.broadcast_shapes(s.shape, of.theta_i.shape)
        means = (np.broadcast_to(x[..., 0], shape) @ of.weights for x in (single, multiple))
        a, b = (np.asarray(mean)[..., np.newaxis] for mean in means)
        return a, b, np.broadcast_to(ratio[..., 0], shape)[..., :1]


def reflected(color: Array, terms: Terms) -> Array:
    """Give r of a color and of terms, which broadcast.

    Examples
    --------
    >>> reflected(np.array([0.5]), (np.array([1.0]), np.array([0.1]), np.array([0.0]))).tolist()
    [0.525]
    """
    single, multiple, ratio = terms
    return np.asarray(color * (single + color * multiple / (1 - color * ratio)))


def color_for(reading: npt.ArrayLike, terms: Terms) -> Array:
    """Give the color whose reflectance is the reading: a quadratic, without a cancelling root.

    Unclipped: above 1 where no color reads so, below 0 where the reading is.

    Examples
    --------
    >>> terms = np.array([0.9]), np.array([0.2]), np.array([0.1])
    >>> color_for(reflected(np.array([0.2, 0.8]), terms), terms).round(12).tolist()
    [0.2, 0.8]
    """
    single, multiple, ratio = terms
    r = np.asarray(reading)
    # r (1 - D c) = A c (1 - D c) + B c²
    square, line = multiple - single * ratio, single + ratio * r
    return np.asarray(2 * r / (line + np.sqrt(np.maximum(line * line + 4 * square * r, 0))))


def flat(like: Any) -> Array:
    """Give zeros with an axis for the channels: B and D of a lobe without later bounces.

    Examples
    --------
    >>> flat(np.ones(2)).shape
    (2, 1)
    """
    return np.zeros((*np.shape(like), 1))
