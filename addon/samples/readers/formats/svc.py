# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Text files (.sig) of Spectra Vista's field spectrometers, such as the HR-1024i.

Lines ``key= value``, a line ``data=``, rows of wavelength in nm, light from the reference, light
from the target, and their quotient in percent. Where its three detectors overlap the wavelengths
step back or repeat, unless the software removed the overlap.
"""

from __future__ import annotations

import re

import numpy as np

from ...sample import Sample, check_spectrum
from ..parts import band_order, statements, tables
from ..parts.document import Document

NAME = "Spectra Vista file (.sig)"
ENDINGS = ("sig",)
PRIORITY = 100

_MARK = "/*** Spectra Vista SIG Data"
_KEY = re.compile(r"\s*(name|instrument|comm)=\s*(.*?)\s*", re.IGNORECASE)
_DATA = re.compile(r"\s*data=\s*", re.IGNORECASE)
_COLUMNS = ("wavelength", "reference", "target", "reflectance")
_PERCENT = 100.0
_LONGEST = 1000  # characters of a line that matter
_RELATIVE = "The values are relative to the white reference; its own reflectance is not in them."


def sniff(document: Document) -> bool:
    """Return whether the file begins with the software's mark."""
    return document.head_text.lstrip().startswith(_MARK)


def read(document: Document) -> list[Sample]:
    """Return the one spectrum of the file.

    Raises
    ------
    InputError
        No data follow, a row has not four numbers, or the spectrum is not one (`check_spectrum`).
    """
    keys: dict[str, str] = {}
    top = 0
    for line in tables.lines(document):
        top += 1
        pair = _KEY.fullmatch(line[:_LONGEST])
        if pair:
            keys.setdefault(pair[1].lower(), pair[2])
        if _DATA.fullmatch(line[:_LONGEST]):
            break
    table = tables.rows(document, tables.SPACES, skip=top)
    block = tables.numbers(document, table, _COLUMNS, (0, 3))
    if not block.lines:
        raise document.error(f"line {top}", "no rows of data follow; save the file again")
    order, altered = band_order.in_order(block.values[:, 0])
    nm, first, count = np.unique(block.values[order, 0], return_index=True, return_counts=True)
    # Sums over equal wavelengths, which stand together now.
    percent = np.add.reduceat(block.values[order, 1], first) / count
    if nm.size < order.size:
        altered += (
            f"Bands that two detectors share were averaged: {np.sum(count > 1)} of {nm.size}.",
        )
    wavelengths, values = check_spectrum(
        nm,
        percent / _PERCENT,
        str(document.path),
        lambda band: f"line {block.lines[order[first[band]]]}",
    )
    device = re.sub(r"^HI: ", "", keys.get("instrument", ""))
    measured = statements.of_remarks(keys.items())
    return [
        Sample(
            name=re.sub(r"\.sig$", "", keys.get("name", "")) or document.path.stem,
            wavelengths=wavelengths,
            values=values,
            kind="reading",
            **measured | {"device": device, "notes": (_RELATIVE, *measured["notes"])},
            source=str(document.path),
            position=f"lines {block.lines[0]} to {block.lines[-1]}",
            altered=altered,
        )
    ]
