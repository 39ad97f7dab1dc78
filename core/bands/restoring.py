# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From the few channels that were rendered back to a whole spectrum.

Channels are a few sums over the spectrum; what lies between them is told by what lamps send and
surfaces reflect. A matrix is fitted by least squares on ways of light through the scene, and on
waves for anything else, and corrected so that the spectrum has exactly the color that the channels
have.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..numerics.arrays import Array
from . import paths

Part = Literal["all", "direct", "indirect"]

_PIXELS, _SEED = 512, 1994
"""Ways of light that the matrix is fitted to, and the seed by which they are drawn."""
_ELSE = 17
"""Waves that stand for anything else; the first is white."""
_WEIGHT_ELSE, _WEIGHT_WHITE = 1e-4, 0.1
"""What each of them counts, and white, as a part of all pixels."""
_DAMPING = 1e-10
"""Of the squares, as a share of their mean: channels may tell the same."""


@dataclass(frozen=True, eq=False)
class Channels:
    """Some channels of a render.

    Parameters
    ----------
    taken
        From a reflectance to what stands for it in the channels, shape (wavelengths, channels).
    sent
        What each lamp sends in them, shape (lamps, channels).
    to_observer
        From the channels to the observer's values, shape (channels, 3).
    part
        Which light they are of: "direct" met one surface alone, "indirect" is all other.
    """

    taken: Array
    sent: Array
    to_observer: Array
    part: Part = "all"


def matrix(
    albedos: Array,
    lights: Array,
    channels: Sequence[Channels],
    means: Array,
    observer: Array | None = None,
) -> Array:
    """Fit the matrix from all channels to a spectrum.

    Parameters
    ----------
    albedos
        Of the scene's surfaces, 0 to 1, shape (surfaces, wavelengths).
    lights
        What its lamps send, shape (lamps, wavelengths).
    channels
        Of all renders, one after the other.
    means
        From a spectrum to the values that are wanted of it, shape (wavelengths, values).
    observer
        Sensitivities by which the values are summed up, shape (values, 3): the sums are then
        exactly those of the channels. None where the values are no whole spectrum.

    Returns
    -------
    Shape (channels, values).

    Examples
    --------
    >>> nm = np.linspace(400, 700, 7)
    >>> albedos, lamp = np.array([np.linspace(0.2, 0.8, 7), np.full(7, 0.5)]), np.ones((1, 7))
    >>> all_of_them = Channels(np.eye(7), np.ones((1, 7)), np.zeros((7, 3)))
    >>> bool(np.allclose(matrix(albedos, lamp, [all_of_them], np.eye(7)), np.eye(7), atol=1e-5))
    True
    """
    surfaces, count = albedos.shape
    ways = paths.draw(_PIXELS, surfaces, len(lights), _SEED, np.full(surfaces, 1 / surfaces), 1.0)
    turns = np.linspace(0, np.pi, count) * np.arange(_ELSE)[:, np.newaxis]
    waves = (1 + np.cos(turns)) / 2
    weights = np.full(_ELSE, np.sqrt(_WEIGHT_ELSE * _PIXELS))
    weights[0] = np.sqrt(_WEIGHT_WHITE * _PIXELS)

    def rows(taken: Array, sent: Array, part: Part) -> Array:
        """Ways of light, then waves of direct and of indirect light of each lamp."""
        direct, indirect = ways.transport(albedos @ taken)
        whole = {"direct": direct, "indirect": indirect, "all": direct + indirect}[part]
        seen = np.einsum("lpc,lc->pc", whole, sent)
        each = (waves @ taken * weights[:, np.newaxis])[np.newaxis] * sent[:, np.newaxis]
        met = each.reshape(-1, taken.shape[1])
        none = np.zeros_like(met)
        return np.concatenate(
            (seen, none if part == "indirect" else met, none if part == "direct" else met)
        )

    told = np.concatenate([rows(one.taken, one.sent, one.part) for one in channels], axis=1)
    wanted = rows(np.eye(count), lights, "all") @ means
    square = told.T @ told
    mean = float(np.trace(square)) / len(square)
    found = np.linalg.solve(square + _DAMPING * mean * np.eye(len(square)), told.T @ wanted)
    if observer is None:
        return np.asarray(found)
    color = np.concatenate([one.to_observer for one in channels])
    # Where there is most light a correction is seen least.
    spread = (wanted**2).mean(axis=0)[:, np.newaxis] * observer
    return np.asarray(
        found + (color - found @ observer) @ np.linalg.solve(observer.T @ spread, spread.T)
    )
