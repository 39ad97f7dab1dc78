# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports of the Nix Toolkit app (Nix Spectro instruments).

A ``sep=;`` line for Excel, metadata lines, a header, one sample a row. The header has ``L`` twice,
first of Lab and then of LCh, so columns are found by their first occurrence. Reflectance stands in
``R400 nm`` and so on, as fractions.
"""

from __future__ import annotations

import math
import re

import numpy as np

from ...sample import Sample, check_spectrum
from ..parts import tables
from ..parts.document import Document, quote

NAME = "Nix export"
ENDINGS = ("csv",)
PRIORITY = 100

# Nix states 45°/0° for all its instruments.
INSTRUMENT = "45a:0"

_MARKS = ("User Color Name", "Nix Device")
_BAND = re.compile(r"R\s*(\d+(?:\.\d+)?)\s*nm", re.IGNORECASE)
_NOTHING = {"", "-", "undefined"}
_LAB = ("L", "a", "b")
_XYZ = ("X", "Y", "Z")
_TEXTS = (
    *("User Color Name", "Original Color Name", "Nix Device", "Illuminant", "Observer"),
    *("Measurement Mode", *_LAB, *_XYZ),
)


def sniff(document: Document) -> bool:
    """Return whether the head has the column names that only Nix writes."""
    return _header_line(document.head_text) >= 0


def read(document: Document) -> list[Sample]:
    """Return one sample a row.

    Raises
    ------
    InputError
        The delimiter is not the announced one, there are no bands, a band has no value, or the
        spectrum is not one (`check_spectrum`).
    """
    skip = _header_line(document.text)
    table = tables.rows(document, _delimiter(document, skip), skip)
    header_row = next(table)
    header = [label.strip() for label in header_row.fields]
    bands = [i for i, label in enumerate(header) if _BAND.fullmatch(label)]
    if not bands:
        raise document.error(
            f"line {header_row.line}",
            "there are no columns such as 'R400 nm'; export the spectral data with the colors",
        )
    nm = np.array([float(_BAND.fullmatch(header[i])[1]) for i in bands])  # type: ignore[index]
    known = [label for label in _TEXTS if label in header]
    block = tables.numbers(
        document,
        table,
        header,
        bands,
        [header.index(label) for label in known],
        decimal_comma=True,
    )
    samples: list[Sample] = []
    described = block.texts or [[]] * len(block.lines)
    for values, line, texts in zip(block.values, block.lines, described, strict=True):
        where = f"line {line}"
        wavelengths, fractions = check_spectrum(
            nm, values, f"{document.path}, {where}", lambda band: f"column {header[bands[band]]!r}"
        )
        stated = {
            label: "" if text in _NOTHING else text
            for label, text in zip(known, texts, strict=True)
        }
        name = stated.get("User Color Name") or stated.get("Original Color Name")
        samples.append(
            Sample(
                name=name or f"{document.path.stem} {len(samples) + 1}",
                wavelengths=wavelengths,
                values=fractions,
                kind="reading",
                instrument=INSTRUMENT,
                source=str(document.path),
                position=where,
                device=stated.get("Nix Device", ""),
                condition=stated.get("Measurement Mode", ""),
                illuminant=stated.get("Illuminant", ""),
                observer=_observer(stated.get("Observer", "")),
                lab=_triple(document, line, stated, _LAB),
                xyz=_triple(document, line, stated, _XYZ),  # the app writes Y = 1 for white
            )
        )
    return samples


def _header_line(text: str) -> int:
    """Return the index of the header's line, -1 if there is none."""
    start = text.find(_MARKS[0])
    if start < 0:
        return -1
    first = text.rfind("\n", 0, start) + 1
    end = text.find("\n", start)
    line = text[first : end if end >= 0 else len(text)]
    if _MARKS[1] not in line or line.lstrip().startswith("#"):
        return -1
    return text.count("\n", 0, first)


def _delimiter(document: Document, skip: int) -> str:
    """Return the delimiter of the header, which a ``sep=`` line has to confirm if there is one."""
    top = list(zip(range(skip + 1), tables.lines(document), strict=False))
    header = top[-1][1]
    found = next(
        (mark for mark in tables.DELIMITERS if mark != tables.SPACES and mark in header), ""
    )
    announced = tables.announced(top[0][1]) or found
    if not found or found != announced:
        expected = tables.DELIMITERS.get(announced, quote(announced)) if announced else "semicolons"
        other = tables.DELIMITERS.get(found, "something else")
        raise document.error(
            f"line {skip + 1}",
            f"the columns should be separated by {expected} but are by {other}; "
            "export the file again, without a detour over a spreadsheet",
        )
    return found


def _observer(text: str) -> int | None:
    degrees = text.strip(" °")
    return int(degrees) if degrees in ("2", "10") else None


def _triple(
    document: Document, line: int, stated: dict[str, str], labels: tuple[str, str, str]
) -> tuple[float, float, float] | None:
    """Return the device's own color, or None where the file has none."""
    texts = [stated.get(label, "") for label in labels]
    if not all(texts):
        return None
    found = []
    for label, text in zip(labels, texts, strict=True):
        try:
            value = float(text.replace(",", "."))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise document.error(
                f"line {line}, column {label!r}", f"{quote(text)} is not a number; export it again"
            )
        found.append(value)
    return found[0], found[1], found[2]
