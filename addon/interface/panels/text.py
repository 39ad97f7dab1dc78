# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sentences in a panel: wrapped to its width, once for each text and width."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import blf

from .icon_values import icon_value

_FONT = 0  # the interface's
_MARGINS = 36.0  # panel and scroll bar, pixels at UI scale 1
_ICON = 28.0
_TABS = 20.0  # beside the panels of a sidebar
_WITH_TABS = {"NODE_EDITOR", "VIEW_3D", "IMAGE_EDITOR"}
_LEAST = 60.0
_LINE = 0.8
"""Height of a line, in heights of a button."""
_GLUE = "\N{NO-BREAK SPACE}"
_UNIT = re.compile(r"(?:nm|%|K)(?!\w)")

Sentence = tuple[tuple[str, int], ...]
"""Lines, each with the number of the icon before it."""


class Format(NamedTuple):
    """What the look of sentences in a region depends on.

    Parameters
    ----------
    pixels
        Width of the region.
    sidebar
        Whether it has tabs beside the panels.
    scale
        Of the interface.
    points
        Size of the letters at UI scale 1.
    """

    pixels: int
    sidebar: bool
    scale: float
    points: float

    def width(self, inset: float = 0.0) -> float:
        """Width of a line in pixels at UI scale 1; `inset` is taken by what is around it."""
        return max(int(self.room(inset) - _ICON), _LEAST)

    def room(self, inset: float = 0.0) -> float:
        """Width that buttons share in pixels at UI scale 1; parameters as with `width`."""
        tabs = _TABS if self.sidebar else 0.0
        return self.pixels / self.scale - _MARGINS - tabs - inset

    def sentence(self, text: str, icon: str = "BLANK1", inset: float = 0.0) -> Sentence:
        """Break a sentence into as many lines as it needs.

        Parameters
        ----------
        text
            Translated already.
        icon
            Before the first line; with "NONE" there is no place for one.
        inset
            Pixels at UI scale 1 that are taken beside the sentence, such as by a box around it.
        """
        lines = _lines(text, self.width(inset), self.points, self.scale)
        others = icon_value("NONE" if icon == "NONE" else "BLANK1")
        return tuple((line, others if at else icon_value(icon)) for at, line in enumerate(lines))

    def fitting(self, texts: Sequence[str], inset: float = 0.0) -> str:
        """Give the first of several wordings that fits into a line, or the last of them.

        Other parameters as in `sentence`.
        """
        return next((text for text in texts if self.fits(text, inset)), texts[-1])

    def fits(self, text: str, inset: float = 0.0) -> bool:
        """Whether a text fits into a line."""
        size = self.points * self.scale
        return _width(text, size) <= self.width(inset) * self.scale

    def shortened(self, text: str, inset: float = 0.0) -> str:
        """Leave out the last words of a name that does not fit, or all: Blender cuts in between."""
        words = text.split()
        shorter = [f"{' '.join(words[:count])}…" for count in range(len(words) - 1, 0, -1)]
        return self.fitting((text, *shorter, ""), inset)


def format_of(preferences: Any, scale: float, pixels: int, area: str) -> Format:
    """Give the format of a region of an editor of the type `area`."""
    points = float(preferences.ui_styles[0].widget.points)
    return Format(pixels, area in _WITH_TABS, scale, points)


def draw(layout: Any, sentences: Iterable[Sentence]) -> None:
    """Draw sentences below each other, the lines of each set close."""
    for sentence in sentences:
        column = layout.column(align=True)
        column.scale_y = _LINE
        for line, icon in sentence:
            column.label(text=line, icon_value=icon, translate=False)


def _lines(text: str, width: float, points: float, scale: float) -> tuple[str, ...]:
    """Wrap to a width in pixels at UI scale 1, as the font is drawn: Blender cuts what is longer.

    A word that is too long by itself, such as a path, is broken.
    """
    size, most = points * scale, width * scale
    space = _width("x x", size) - 2 * _width("x", size)
    lines: list[list[str]] = [[]]
    used = 0.0
    for word in _words(text):
        whole = _width(word, size)
        pieces = [(word, whole)] if whole <= most else _pieces(word, most, size)
        for piece, needed in pieces:
            if lines[-1] and used + space + needed > most:
                lines.append([])
            used = used + space + needed if lines[-1] else needed
            lines[-1].append(piece)
    return tuple(" ".join(line).replace(_GLUE, " ") for line in lines)


def _words(text: str) -> list[str]:
    """Split a text at the spaces where a line may end: a number stays with what it is of."""
    words: list[str] = []
    for word in text.split():
        if words and _belongs(words[-1], word):
            words[-1] += _GLUE + word
        else:
            words.append(word)
    return words


def _belongs(before: str, word: str) -> bool:
    if word[0].isdecimal():
        return before.endswith(("ΔE00", "="))
    if word[0] == "=":
        return before.endswith("σ")
    return before[-1].isdecimal() and _UNIT.match(word) is not None


def _pieces(word: str, most: float, size: float) -> list[tuple[str, float]]:
    """Break a word into pieces that fit, all but the last as long as they can be; with widths."""
    pieces = [""]
    for letter in word:
        if pieces[-1] and _width(pieces[-1] + letter, size) > most:
            pieces.append("")
        pieces[-1] += letter
    return [(piece, _width(piece, size)) for piece in pieces]


def _width(word: str, size: float) -> float:
    """Pixels that a word takes; sentences have few that are new."""
    blf.size(_FONT, size)
    return float(blf.dimensions(_FONT, word)[0])
