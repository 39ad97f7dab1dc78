# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the end of a sample's name says of the measurement: specular light in or out, an angle.

Software of spheres and of multi-angle instruments writes ``Tile (SCI)`` and ``Tile SCE``,
``Tile 45as15``, ``Tile as-15`` and ``Tile 15°``; others ``Tile (d/8 SCI)`` and ``Tile 45a:0``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from .geometry_words import in_text, specular_of

_LONGEST = 24  # characters of a name that can be such a mark
_SPECULAR = r"[Rr]?(?:SCI|SCE|SPIN|SPEX|SIN(?<=RSIN)|SEX(?<=RSEX))"
_ANGLE = r"(r?45\s*°?\s*:?\s*)?as([-+\u2212]?\d{1,3})\s*°?"
_BARE = r"([-+\u2212]?\d{1,3})\s*(?:°|º|deg)"
_IN_BRACKETS = re.compile(rf"\s*[(\[]\s*(?:({_SPECULAR})|{_ANGLE}|{_BARE})\s*[)\]]$", re.IGNORECASE)
# Without brackets "sci" may be part of a word, unlike "SCI", and a hyphen before an angle its sign.
_BEHIND = re.compile(
    rf"(?:^|[\s_.,;:/-])({_SPECULAR})$|(?:^|[\s_.,;:/]){_ANGLE}$|(?:^|[\s_.,;:/]){_BARE}$"
)
# In brackets any angle beside 45° or a sphere; without, what can hardly be a ratio.
_RING, _TO = r"[acx]?", r"\s?[:/]\s?"
_SPHERE = rf"d[ie]?{_TO}[08]°?[ie]?|[08]°?{_TO}d[ie]?"
_ANGLES = rf"45°?{_RING}{_TO}\d{{1,2}}°?{_RING}|\d{{1,2}}°?{_RING}{_TO}45°?{_RING}"
_NORMAL = rf"45°?{_RING}{_TO}0°?{_RING}|0°?{_RING}{_TO}45°?{_RING}"
_SAID = rf"(?:-iso|,?\s{_SPECULAR})?"
_GEOMETRY = re.compile(
    rf"\s*[(\[]\s*((?:{_SPHERE}|{_ANGLES}){_SAID})\s*[)\]]$|"
    rf"(?:^|[\s_])((?:{_SPHERE}|{_NORMAL}){_SAID})$",
    re.IGNORECASE,
)
_LAST_BRACKETS = re.compile(r"[(\[][^()\[\]]*(?:\([^()]*\)[^()\[\]]*)?[)\]]$")
_OF_BAND = rf"({_SPECULAR}|{_ANGLE}|{_BARE})"
_BEFORE = re.compile(rf"\s*[(\[]?\s*{_OF_BAND}\s*[)\]]?[\s_.,;:-]+", re.IGNORECASE)
_AFTER = re.compile(rf"[\s_.,;:-]*[(\[]?\s*{_OF_BAND}\s*[)\]]?\s*$", re.IGNORECASE)
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
    bare
        Whether the name is a number and no more.
    geometry
        In its words, where they are more than a specular component or an angle.
    """

    base: str
    specular: str = ""
    aspecular: int | None = None
    angle: int | None = None
    sure: bool = False
    geometry: str = ""
    bare: bool = False


def of_name(name: str) -> Mark:
    """Return what the end of a name says; the whole name where that is nothing."""
    end = name[-_LONGEST:]
    inside = _IN_BRACKETS.search(end)
    match = _GEOMETRY.search(end) or inside or _BEHIND.search(end)
    if not match:
        number = angle_of(name)
        return _in_words(name) if number is None else Mark("", angle=number, bare=True)
    if match.re is _GEOMETRY:
        return _of_geometry(name, match)
    base = name[: len(name) - len(match[0])].rstrip()
    if match[1]:
        sure = match is inside or _stands_out(match[1], base)
        return Mark(base, specular=_component(match[1]), sure=sure)
    if match[3]:
        return Mark(base, aspecular=_degrees(match[3]), sure=bool(match[2]))
    return Mark(base, angle=_degrees(match[4]))


def _stands_out(word: str, base: str) -> bool:
    """Return whether a word behind a name is a mark: "TOP SPIN" may be what a color is called.

    Capitals alone, with no name before them, are one, too.
    """
    if not base:
        return word.isupper() and word != "SPIN"
    return word.upper() != "SPIN" or bool(re.search(r"[a-z\d]", base))


def _of_geometry(name: str, match: re.Match[str]) -> Mark:
    words = match[1] or match[2]
    return Mark(name[: len(name) - len(match[0])].rstrip(), geometry=words, sure=True)


def _in_words(name: str) -> Mark:
    """Return what a name says as a sentence would: ``Tile (specular excluded)``."""
    geometry, specular = in_text(name)
    if not geometry and not specular:
        return Mark(name)
    brackets = _LAST_BRACKETS.search(name)
    base = name[: brackets.start()].rstrip() if brackets and any(in_text(brackets[0])) else name
    if not geometry:
        return Mark(base, specular=specular, sure=True)
    return Mark(base, geometry=f"{geometry} {specular}".strip(), sure=True)


def of_band(label: str) -> tuple[str, str]:
    """Return the name of a column of a band without a mark, and that mark.

    Such as ``400 nm(SCI)``, ``SCE 400``, ``R400_SPEX``, ``400 nm (45as15)`` and ``400nm 15°``; the
    mark is ``"SCI"``, ``"SCE"``, or an angle in the words of the label.
    """
    for pattern in (_AFTER, _BEFORE):
        match = pattern.search(label) if pattern is _AFTER else pattern.match(label)
        if match:
            rest = label[: match.start()] + label[match.end() :]
            return rest.strip(), _component(match[1]) or match[1].strip()
    return label, ""


def _component(word: str) -> str:
    """Return ``"SCI"`` or ``"SCE"`` of a makers' word, which may begin with R, as RSPIN does."""
    return specular_of(word) or specular_of(re.sub("^r", "", word, flags=re.IGNORECASE))


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
