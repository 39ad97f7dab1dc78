# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors and sizes of the pictures, readable on a light or dark background."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...colorimetry import srgb

if TYPE_CHECKING:
    from .raster import Color


# Okabe and Ito, "Color Universal Design" (2008): told apart by color-blind readers too.
_BLUE = (0.0, 114 / 255, 178 / 255)


_VERMILION = (213 / 255, 94 / 255, 0.0)


_LETTERS = 4.5
"""Contrast that WCAG 2.1 asks of text (success criterion 1.4.3)."""


_SHAPES = 3.0
"""Contrast that it asks of what is not text (1.4.11)."""


_FONT = 10.0
"""Pixels an em at interface scale 1; Blender's own labels have 11."""


@dataclass(frozen=True)
class Look:
    """How to draw: colors, display-encoded, and the scale of lines and letters.

    Parameters
    ----------
    background, text
        Of the panel.
    faint
        Of letters that step back.
    grid
        Of lines that step back further.
    target, blender
        Of what was measured, and of what Blender shows; letters may have them. The text's color is
        the third that everybody tells from both, in a light and in a dark theme.
    scale
        Pixels of the screen for one of the interface at scale 1.
    """

    background: Color
    text: Color
    faint: Color
    grid: Color
    target: Color
    blender: Color
    scale: float

    @property
    def font(self) -> float:
        """Pixels an em."""
        return _FONT * self.scale


def look(background: Color, text: Color, scale: float = 1.0) -> Look:
    """Choose colors that are readable on a background, both display-encoded."""
    target, blender = (readable(color, background, _LETTERS) for color in (_BLUE, _VERMILION))
    return Look(
        background=background,
        text=readable(text, background, _LETTERS),
        faint=readable(_mix(background, text, 0.6), background, _LETTERS),
        grid=_mix(background, text, 0.18),
        target=target,
        blender=blender,
        scale=scale,
    )


def readable(color: Color, background: Color, ratio: float = _SHAPES) -> Color:
    """Darken or lighten a color until its contrast with the background is `ratio`.

    Away from the background, so that its hue stays.
    """
    end = (
        (0.0, 0.0, 0.0)
        if contrast((0, 0, 0), background) > contrast((1, 1, 1), background)
        else (
            1.0,
            1.0,
            1.0,
        )
    )
    for step in range(101):
        mixed = _mix(color, end, step / 100)
        if contrast(mixed, background) >= ratio:
            return mixed
    return end


def contrast(a: Color, b: Color) -> float:
    """Contrast of two display-encoded colors after WCAG 2.1: 1 to 21."""
    low, high = sorted((_luminance(a), _luminance(b)))
    return (high + 0.05) / (low + 0.05)


def _luminance(color: Color) -> float:
    return float(srgb.decode(color) @ srgb.LUMINANCE)


def _mix(a: Color, b: Color, share: float) -> Color:
    red, green, blue = (x + (y - x) * share for x, y in zip(a, b, strict=True))
    return red, green, blue
