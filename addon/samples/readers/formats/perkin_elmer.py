# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""ASCII files of PerkinElmer's UV WinLab (Lambda instruments, .asc).

The first line begins ``PE UV``. The ninth names the sample and the twelfth the instrument; below
``#GR`` stand the units of x and y, and below ``#DATA`` the pairs.
"""

from __future__ import annotations

import re

from ...sample import Sample
from ..parts import series, tables
from ..parts.document import Document, quote

NAME = "PerkinElmer Lambda ASCII"
ENDINGS = ("asc",)
PRIORITY = 90

_MARK = re.compile(r"PE UV\s+SUBTECH\s+SPECTRUM\s+ASCII")
_NAME_LINE, _DEVICE_LINE = 8, 11  # counted from 0
_REFLECTANCE = re.compile(r"%\s*r|r\s*%?|.*reflec.*", re.IGNORECASE)


def sniff(document: Document) -> bool:
    """Return whether the first line is that of the program."""
    return bool(_MARK.match(document.head_text))


def read(document: Document) -> list[Sample]:
    """Return the one spectrum of the file.

    Raises
    ------
    InputError
        The units are not nanometers and reflectance, or the spectrum is not one.
    """
    top: list[str] = []
    lines = enumerate(tables.lines(document), start=1)
    for _, line in lines:
        top.append(line.strip())
        if top[-1] == "#DATA":
            break
    if "#DATA" not in top[-1:] or "#GR" not in top[:-3]:
        raise document.error("", "the sections #GR and #DATA are not there; save the file again")
    units = top.index("#GR") + 1
    x, y = top[units], top[units + 1]
    if x.lower() != "nm":
        raise document.error(
            f"line {units + 1}", f"the unit of x is {quote(x)}; save it over nanometers (nm)"
        )
    if not _REFLECTANCE.fullmatch(y):
        other = series.other_quantity(y) or f"in units of {quote(y)}"
        raise document.not_reflectance(f"line {units + 2}", other)
    nm, values, at = series.two_columns(document, lines)
    found = series.bands(
        nm,
        values / 100.0 if "%" in y else values,
        str(document.path),
        lambda band: f"line {at[band]}",
    )
    return [
        Sample(
            name=top[_NAME_LINE]
            if len(top) > _NAME_LINE and top[_NAME_LINE]
            else document.path.stem,
            wavelengths=found.wavelengths,
            values=found.values,
            kind="reading",
            source=str(document.path),
            position=f"line {at[0]}",
            device=top[_DEVICE_LINE] if len(top) > _DEVICE_LINE else "",
            altered=found.altered,
        )
    ]
