# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A target under gloss: what is left for the color below, and what is wanted elsewhere.

The reading at the instrument is the sample's, gloss included. The gloss is the artist's, and σ that
of the matte body below it: in other directions the target is the same gloss over a body that keeps
the directions of the matte surface, channel by channel. So what ΔE00 tells of all angles is how
well Cycles' diffuse lobe shows the body, seen through the gloss.
"""

from __future__ import annotations

import numpy as np

from ...core.cycles import gloss_lobe, gloss_reading, instrument_lobe
from ...core.cycles.gloss_lobe import Layer
from ...core.gloss import IMPOSSIBLE, Gloss
from ...core.numerics.arrays import Array

_ENOUGH = 1e-6
"""Overshoot that is rounding."""
_CHANNELS = "RGB"


def body(there: Layer, readings: Array, targets: Array) -> tuple[Array, Array]:
    """Give what the diffuse lobe alone has to read, at the instrument and elsewhere.

    Parameters
    ----------
    there
        What lies over it at the instrument.
    readings
        Whole readings at the instrument in scene-linear RGB, shape (..., 3).
    targets
        Of the matte surface in other directions, shape (..., directions, 3).

    Returns
    -------
    Of the same shapes; negative at the instrument where the gloss alone reads more.
    """
    below, share = share_below(there, readings)
    return below, np.asarray(targets * share[..., np.newaxis, :])


def share_below(there: Layer, readings: Array) -> tuple[Array, Array]:
    """Give what the diffuse lobe has to read for readings (..., 3), and its share in a matte one.

    A channel that is not above 0 has the whole share.
    """
    below = there.below(readings)
    shown = readings > 0
    share = np.where(shown, np.maximum(below, 0) / np.where(shown, readings, 1), 1)
    return below, share


def target(
    gloss: Gloss | None, reading: Array, targets: Array, angles: tuple[Array, ...], instrument: str
) -> Array:
    """Give the whole target in other directions, (directions, 3), of one matte surface there.

    `reading` and `targets` as in `body`; `angles` are θi, θr and Δφ of the directions.
    """
    if gloss is None:
        return targets
    _, below = body(gloss_reading.at_instrument(gloss, instrument), reading, targets)
    return gloss_lobe.layer(gloss, *angles).over(below)


def over(gloss: Gloss | None, diffuse: Array, angles: tuple[Array, ...]) -> Array:
    """Put gloss over a diffuse lobe in some directions, (..., directions, 3)."""
    return diffuse if gloss is None else gloss_lobe.layer(gloss, *angles).over(diffuse)


def with_instrument(
    gloss: Gloss, angles: tuple[Array, ...], instrument: str
) -> tuple[Layer, Layer]:
    """Give what lies over some directions and, last, an instrument: (directions + 1, 3), and (3,).

    The second is that of the instrument alone.
    """
    elsewhere, there = (
        gloss_lobe.layer(gloss, *angles),
        gloss_reading.at_instrument(gloss, instrument),
    )
    return Layer(*(np.vstack(pair) for pair in zip(elsewhere, there, strict=True))), there


def warning(
    name: str, gloss: Gloss, reading: Array, color: Array, roughness: float, instrument: str
) -> str:
    """Say when no color below the gloss reads like the sample, and what gloss is possible.

    Parameters
    ----------
    name
        Of the sample.
    gloss
        What there is.
    reading
        Of the sample at the instrument, shape (3,).
    color, roughness
        What the diffuse lobe would need, shape (3,), unclipped.
    instrument
        One of `core.instruments.REGISTRY`.

    Returns
    -------
    One sentence; empty where a color does, or where none does without gloss either.
    """
    channel = int(np.argmax(np.maximum(-color, color - 1)))
    missing = max(-color[channel], color[channel] - 1)
    white = instrument_lobe.reflectance(np.ones(3), roughness, instrument)
    if missing <= _ENOUGH or not ((reading > 0) & (reading <= white * (1 + _ENOUGH))).all():
        return ""
    alone = gloss_reading.at_instrument(gloss, instrument)
    if color[channel] < 0:
        why = (
            f"reads {reading[channel]:.4f} in {_CHANNELS[channel]}, and its gloss alone "
            f"{alone.shine[channel]:.4f}"
        )
    else:
        why = (
            f"reads {reading[channel]:.4f} in {_CHANNELS[channel]}, and a white under its gloss "
            f"{alone.over(white)[channel]:.4f}"
        )
    possible = _possible(gloss, reading, white, instrument)
    return f"{name!r} {IMPOSSIBLE}: it {why}; {possible}."


def too_much(name: str, gloss: Gloss | None, reading: Array, instrument: str) -> str:
    """Say the same of a reading that is one aim among others, as in a scene."""
    if gloss is None:
        return ""
    below = gloss_reading.at_instrument(gloss, instrument).below(reading)
    return warning(name, gloss, reading, below, 0.0, instrument)


def _possible(gloss: Gloss, reading: Array, white: Array, instrument: str) -> str:
    found = gloss_reading.largest(gloss, reading, instrument, white)
    if found is None:
        return "remove the gloss"
    told = []
    if found.level != gloss.level:
        told.append(f"Specular IOR Level {_floor(found.level)} is the most that it can have")
    if found.coat != gloss.coat:
        told = [f"without a specular level, Coat Weight {_floor(found.coat)} is the most"]
    return told[0]


def _floor(value: float) -> str:
    return f"{np.floor(value * 1000) / 1000:.3f}"
