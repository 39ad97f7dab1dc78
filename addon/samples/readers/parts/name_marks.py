# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the end of a sample's name says of the measurement: specular light in or out, an angle.

Software of spheres and of multi-angle instruments writes ``Tile (SCI)`` and ``Tile SCE``,
``Tile 45as15``, ``Tile as-15`` and ``Tile 15°``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from .geometry_words import specular_of

_LONGEST = 24  # characters of a name that can be such a mark
_SPECULAR = r"r?(?:SCI|SCE|SPIN|SPEX)"
_ANGLE = r"(45\s*°?\s*:?\s*)?as([-+\u2212]?\d{1,3})\s*°?"
_BARE = r"([-+\u2212]?\d{1,3})\s*(?:°|º|deg)"
_IN_BRACKETS = re.compile(rf"\s*[(\[]\s*(?:({_SPECULAR})|{_ANGLE}|{_BARE})\s*[)\]]$", re.IGNORECASE)
# Without brackets "sci" may be part of a word, and a hyphen before an angle its sign.
_BEHIND = re.compile(
    rf"(?:^|[\s_.,;:/-])({_SPECULAR})$|(?:^|[\s_.,;:/]){_ANGLE}$|(?:^|[\s_.,;:/]){_BARE}$"
)
_BEFORE = re.compile(rf"\s*[(\[]?\s*({_SPECULAR})\s*[)\]]?[\s_.,;:-]+", re.IGNORECASE)
_AFTER = re.compile(rf"[\s_.,;:-]*[(\[]?\s*({_SPECULAR})\s*[)\]]?\s*$", re.IGNORECASE)
_AS = re.compile(rf"\s*{_ANGLE}\s*", re.IGNORECASE)
_ALONE = re.compile(r"\s*([-+\u2212]?\d{1,3})(?:[.,]0+)?\s*(?:°|º|deg\w*)?\s*", re.IGNORECASE)


@dataclass(frozen=True)
class Mark:
    """A name in parts.

    Parameters
    ----------
    base
        The name without the mark; empty if it is nothing else.
    specular
        ``"SCI"`` or ``"SCE"``, or empty.
    aspecular
        Degrees from the mirror direction, or None.
    angle
        Degrees of an angle that is not said to be one from the mirror direction, or None.
    sure
        Whether it stands in brackets, or could be nothing else.
    """

    base: str
    specular: str = ""
    aspecular: int | None = None
    angle: int | None = None
    sure: bool = False


def of_name(name: str) -> Mark:
    """Return what the end of a name says; the whole name where that is nothing."""
    end = name[-_LONGEST:]
    inside = _IN_BRACKETS.search(end)
    match = inside or _BEHIND.search(end)
    if not match:
        return Mark(name)
    base = name[: len(name) - len(match[0])].rstrip()
    if match[1]:
        return Mark(base, specular=specular_of(match[1]), sure=bool(inside and base))
    if match[3]:
        return Mark(base, aspecular=_degrees(match[3]), sure=bool(match[2]))
    return Mark(base, angle=_degrees(match[4]))


def of_band(label: str) -> tuple[str, str]:
    """Return the name of a column of a band without a mark, and ``"SCI"``, ``"SCE"`` or nothing.

    Such as ``400 nm(SCI)``, ``SCE 400`` and ``R400_SPEX``.
    """
    for pattern in (_AFTER, _BEFORE):
        match = pattern.search(label) if pattern is _AFTER else pattern.match(label)
        if match:
            rest = label[: match.start()] + label[match.end() :]
            return rest.strip(), specular_of(match[1])
    return label, ""


def aspecular_of(text: str) -> int | None:
    """Return the degrees of a whole text such as ``45as15`` or ``as-15``; else None."""
    match = _AS.fullmatch(text[:_LONGEST])
    return _degrees(match[2]) if match else None


def angle_of(text: str) -> int | None:
    """Return the degrees of a whole text such as ``15`` or ``15°``; else None."""
    match = _ALONE.fullmatch(text[:_LONGEST])
    return _degrees(match[1]) if match else None


def _degrees(text: str) -> int:
    return int(text.replace("\u2212", "-"))
