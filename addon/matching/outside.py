# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors that no socket holds, in words: out of gamut, or of a reading beyond white.

A channel above 1 is a matter of gamut only while no band reads more than a white material does: in
some directions a rough surface, or one with gloss, sends back more than a perfect diffuser would,
and a white one in Cycles less than that. No working space helps there.
"""

from __future__ import annotations

BEYOND_WHITE = "more than the"
_OF_GAMUT = "lies outside the gamut of"
_BEYOND_DIFFUSER = "more than a perfect diffuser"
MISSES = "misses its target by"
"""What each of the sentences says, for who asks whether a target can be met."""
TOO_DARK = "too dark"
"""What is said of a texture that no scale brings to its sample."""


def of_gamut(name: str, space: str, channel: str, value: float, missed: float) -> str:
    """Say that a color lies outside the gamut of a working space."""
    side, beyond = ("below 0", -value) if value < 0 else ("above 1", value - 1)
    return (
        f"{name!r} {_OF_GAMUT} {space}: {channel} would be {value:.4f}, "
        f"{beyond:.4f} {side}; with the nearest value the reading {MISSES} ΔE00 {missed:.2f}."
    )


def beyond_white(
    name: str, peak: tuple[float, float], where: str, white: float, missed: float
) -> str:
    """Say that a reading is more than white gives; `peak` is its highest value and nanometers."""
    value, nm = peak
    return (
        f"{name!r} reads {value:.4f} at {nm:g} nm at {where}, {BEYOND_WHITE} {white:.4f} of a "
        f"white material there; the nearest color {MISSES} ΔE00 {missed:.2f}."
    )


def in_scene(name: str, space: str, channel: str, value: float, read: float, beyond: bool) -> str:
    """Say that a color is held by no socket under a scene's light.

    `read` is the highest value of the reading; `beyond` is whether it is that which is too high,
    so that no working space helps.
    """
    needs = f"its reading needs {channel} = {value:.4f}; the nearest color was taken."
    if beyond:
        return f"{name!r} reads up to {read:.4f}, {_BEYOND_DIFFUSER}: {needs}"
    return f"{name!r} {_OF_GAMUT} {space} under the scene's light: {needs}"


def is_of_gamut(sentence: str) -> bool:
    """Return whether a sentence says that the working space cannot hold a color."""
    return _OF_GAMUT in sentence


def is_beyond_white(sentence: str) -> bool:
    """Return whether a sentence says that no working space helps."""
    return (BEYOND_WHITE in sentence and MISSES in sentence) or _BEYOND_DIFFUSER in sentence
