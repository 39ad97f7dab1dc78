# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scale the colors of a texture, channel by channel, until their mean reading is the target's.

What Cycles reads of a color is bent, so the mean of the readings is not the reading of the mean:
the scale solves the former. A scaled color above 1 counts, and is shown, as 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...core.color import color_difference
from ...core.cycles import instrument_lobe
from . import outside
from .scene_match import percentile

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from ..colorimetry.rgb_space import WorkingSpace

MOST_COLORS = 512
"""Colors of a palette, for the spread alone."""
MOST_VALUES = 512
"""Values of a channel: their mean reading is that of all to the sixth digit, clipped or not."""
_LARGEST = 1e4
"""Scale beyond which a channel of a texture counts as black."""
_STEPS = 60
"""Halvings of the scale's logarithm: to the last bit of single precision."""
_CLIPPED = 0.0005
"""Share of the surface above 1 that is worth a word."""
_APART = 0.01
"""ΔE00 of the mean from the target that is worth a word."""


@dataclass(frozen=True, eq=False)
class Scaled:
    """A texture's scale, and what comes of it.

    Parameters
    ----------
    factors
        Of the channels, shape (3,).
    delta_e
        ΔE00 of the mean reading from the target.
    spread_mean, spread_95
        Mean and 95th percentile over the surface of ΔE00 from the mean reading.
    clipped
        Share of the surface with a channel that would be above 1.
    notes
        Sentences.
    """

    factors: Array
    delta_e: float
    spread_mean: float
    spread_95: float
    clipped: float
    notes: tuple[str, ...]


def palette(colors: Array) -> tuple[Array, Array, Array]:
    """Let few values of each channel, and few colors, stand for many colors, shape (n, 3).

    Returns
    -------
    channels
        Means of as many values each, from small to large, shape (values, 3).
    colors, weights
        As of `boxes`.
    """
    ordered = np.sort(np.asarray(colors, np.float64), axis=0)
    count = min(MOST_VALUES, len(ordered))
    ends = np.linspace(0, len(ordered), count + 1)
    # A value at an end counts in part on either side, so that all have the same share.
    sums = np.concatenate((np.zeros((1, 3)), np.cumsum(ordered, axis=0)))
    at = np.stack([np.interp(ends, np.arange(len(sums)), sums[:, i]) for i in range(3)], axis=1)
    channels = np.diff(at, axis=0) / np.diff(ends)[:, np.newaxis]
    return channels, *boxes(colors)


def boxes(colors: Array) -> tuple[Array, Array]:
    """Let few colors stand for many, shape (n, 3): means of boxes of the color space, and weights.

    Median cut: a box is divided across its widest axis into halves of as many colors, until there
    are `MOST_COLORS`. The mean of all stays the same.
    """
    found = [np.asarray(colors, np.float64)]
    while len(found) < MOST_COLORS:
        halves = []
        for box in found:
            spans = np.ptp(box, axis=0)
            if len(box) < 2 or not spans.max():
                halves.append(box)
                continue
            middle = len(box) // 2
            order = np.argpartition(box[:, int(spans.argmax())], middle)
            halves += [box[order[:middle]], box[order[middle:]]]
        if len(halves) == len(found):
            break
        found = halves
    weights = np.array([len(box) for box in found], np.float64)
    return np.array([box.mean(axis=0) for box in found]), weights / weights.sum()


def solve(
    channels: Array,
    colors: Array,
    weights: Array,
    target: Array,
    roughness: float,
    space: WorkingSpace,
    illuminant: str,
    read_at: str,
) -> Scaled:
    """Find the scale.

    Parameters
    ----------
    channels, colors, weights
        Of a palette, shapes (values, 3), (colors, 3) and (colors,).
    target
        RGB of the reading that the mean is to be, shape (3,).
    roughness
        Cycles' diffuse roughness.
    space, illuminant
        In which ΔE00 is told.
    read_at
        The virtual instrument.
    """
    channels, colors = np.maximum(channels, 0), np.maximum(colors, 0)  # as Cycles takes them

    def mean_of(factors: Array) -> Array:
        return np.asarray(_read(channels * factors, roughness, read_at).mean(axis=0))

    low, high = np.full(3, -np.log(_LARGEST)), np.full(3, np.log(_LARGEST))
    for _ in range(_STEPS):
        middle = (low + high) / 2
        short = mean_of(np.exp(middle)) < target
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    factors = np.where(target > 0, np.exp(high), 0.0)
    # What no scale reaches, as where the texture is black, is left as it is.
    reached = mean_of(np.full(3, _LARGEST)) >= target * (1 - 1e-6)
    factors = np.where(reached, factors, 1.0)
    shown, mean = _read(colors * factors, roughness, read_at), mean_of(factors)
    apart = color_difference.delta_e(
        space.to_lab(shown, illuminant), space.to_lab(mean, illuminant)[np.newaxis]
    )
    delta_e = float(
        color_difference.delta_e(space.to_lab(mean, illuminant), space.to_lab(target, illuminant))
    )
    clipped = float(weights @ (colors * factors > 1 + 1e-6).any(axis=1))
    found = Scaled(
        factors, delta_e, float(weights @ apart), percentile(apart, weights, 0.95), clipped, ()
    )
    return Scaled(**(vars(found) | {"notes": tuple(_notes(found, reached))}))


def _read(colors: Array, roughness: float, read_at: str) -> Array:
    return instrument_lobe.reflectance(np.minimum(colors, 1), roughness, read_at)


def _notes(found: Scaled, reached: Array) -> list[str]:
    notes = [
        f"The texture is scaled so that its mean reads as the sample; its points are ΔE00 "
        f"{found.spread_mean:.1f} from the mean, 95 % of them within {found.spread_95:.1f}."
    ]
    if found.clipped > _CLIPPED:
        notes.append(
            f"{found.clipped:.1%} of the texture would be above 1 when scaled, and is clipped; the "
            "mean is right all the same."
        )
    if not reached.all():
        names = ", ".join(np.array(["red", "green", "blue"])[~reached])
        notes.append(
            f"The texture is {outside.TOO_DARK} in {names} for any scale to reach the sample: the "
            f"mean is ΔE00 {found.delta_e:.2f} off."
        )
    elif found.delta_e > _APART:
        notes.append(f"The mean reading of the texture is ΔE00 {found.delta_e:.2f} off.")
    return notes
