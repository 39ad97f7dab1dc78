# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors that no socket holds, in words: out of gamut, or of a reading beyond white.

A channel above 1 is a matter of gamut only while no band reads more than a white material does: in
some directions a rough surface, or one with gloss, sends back more than a perfect diffuser would,
and a white one in Cycles less than that. No working space helps there.
"""

from __future__ import annotations

BEYOND_WHITE = "more than the"
MISSES = "misses its target by"
"""What each of the sentences says, for who asks whether a target can be met."""
TOO_DARK = "too dark"
"""What is said of a texture that no scale brings to its sample."""


def of_gamut(name: str, space: str, channel: str, value: float, missed: float) -> str:
    """Say that a color lies outside the gamut of a working space."""
    side, beyond = ("below 0", -value) if value < 0 else ("above 1", value - 1)
    return (
        f"{name!r} lies outside the gamut of {space}: {channel} would be {value:.4f}, "
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


def is_beyond_white(sentence: str) -> bool:
    """Return whether `beyond_white` made a sentence."""
    return BEYOND_WHITE in sentence and MISSES in sentence
