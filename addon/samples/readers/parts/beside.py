# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns that stand beside a spectrum and are none, by what their names say of other columns."""

from __future__ import annotations

import re

# How sure a spectrum is; alone, or with the name of the column that it is about.
_SPREAD = (
    r"std\.?(?:[ _.-]?(?:dev|err)\w*\.?)?|stdd?ev|sd|s\.d\.|sem|se|stderr|standard[ _]?deviation|"
    r"standard[ _]error|err(?:or)?|unc\.?|uncertaint(?:y|ies)|u|u95|ci|rsd|cv|variance|"
    r"sigma|σ|±|\+/-|"
    r"standardabweichung|stabw\.?|streuung|messunsicherheit|unsicherheit|fehler|incertitude|"
    r"[ée]cart[- ]type|desviaci[óo]n(?: est[áa]ndar| t[íi]pica)?|incertidumbre|"
    r"deviazione standard|incertezza|desvio padr[ãa]o|標準偏差|标准偏差|不確かさ"
)
_SHORT = re.compile(r"u|se|ci|cv|sem|rsd|err|unc", re.IGNORECASE)  # samples are called so, too
_ABOUT = r"[\s_.,:/-]*[\[(]?\s*"
_SPREAD_ALONE = re.compile(rf"(?:{_SPREAD})\s*(?:[\[(][^\[\]()]*[\])])?", re.IGNORECASE)
_SPREAD_BEHIND = re.compile(rf"(.*?[^\s_.,:/(\[-]){_ABOUT}(?:{_SPREAD})\s*[\])]?", re.IGNORECASE)
_SPREAD_BEFORE = re.compile(rf"(?:{_SPREAD}){_ABOUT}(?:of )?([^\])]+)[\])]?", re.IGNORECASE)
# What statistics put beside a mean; samples may be called so where there is none.
_MEAN = re.compile(r"(?:mean|average|avg|mittel\w*|moyenne|media|median)\b.*", re.IGNORECASE)
_BESIDE_MEAN = re.compile(r"n|count|min(?:imum)?|max(?:imum)?|range|median", re.IGNORECASE)
_LETTERS = {"t": "transmittance", "a": "absorptance"}
_LONGEST = 60  # characters of a name that are looked at for what it says of another column
_MARKS_BEHIND = re.compile(r"\s*[\[(][^\[\]()]*[\])]\s*$|\s*%\s*$")


def letters(names: list[str]) -> dict[str, str]:
    """Return which other quantities than reflectance stand beside one that is called ``R``.

    ``R, T`` and ``R (%), T (%), A (%)`` are three quantities; ``A, B, R, T`` may be samples.
    """
    bare = {name: _MARKS_BEHIND.sub("", name).strip(" %").lower() for name in names}
    if not {"r"} < set(bare.values()) <= {"r", *_LETTERS}:
        return {}
    return {name: _LETTERS[letter] for name, letter in bare.items() if letter in _LETTERS}


def uncertainties(names: list[str]) -> set[str]:
    """Return the names of columns that say how sure the others are, none where that is all."""
    bare = {_MARKS_BEHIND.sub("", name).lower() for name in names}
    mean = any(map(_MEAN.fullmatch, names))
    found = set()
    for name in filter(None, names):
        label = name[:_LONGEST]
        about = _SPREAD_BEHIND.fullmatch(label) or _SPREAD_BEFORE.fullmatch(label)
        if (
            (_SPREAD_ALONE.fullmatch(label) and (len(names) == 2 or not _SHORT.fullmatch(label)))
            or (about and _MARKS_BEHIND.sub("", about[1]).lower() in bare)
            or (mean and _BESIDE_MEAN.fullmatch(label))
        ):
            found.add(name)
    return found if len(found) < len(names) else set()
