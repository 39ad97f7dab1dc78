# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""CSV exports of Agilent's (Varian's) Cary WinUV.

A line of names over every second column, a line ``Wavelength (nm),%R,Wavelength (nm),%R,``, rows of
pairs that need not be equally many, and below a blank line the log of the measurement.
"""

from __future__ import annotations

import csv
import itertools
import re
from array import array
from collections.abc import Iterator

import numpy as np

from ...sample import Sample
from ..parts import label_words, series, tables
from ..parts.document import Document, plain, quote

NAME = "Cary WinUV CSV"
ENDINGS = ("csv",)
PRIORITY = 60

_MARKS = ",;\t"
_AXIS = re.compile(r"wavelength \(?nm\)?", re.IGNORECASE)
_REFLECTANCE = re.compile(r"%\s*r|r\s*%?|r\s*\(%\)|.*reflec.*", re.IGNORECASE)
_SEARCHED = 5  # lines
_HEAD = 20_000  # characters in which they stand


def sniff(document: Document) -> bool:
    """Return whether a second line repeats pairs of wavelength and value under a line of names."""
    return _header(document.head_text) is not None


def read(document: Document) -> list[Sample]:
    """Return one sample a pair of columns with reflectance.

    Raises
    ------
    InputError
        No pair is reflectance, a field is not a number, or a spectrum is not one.
    """
    line, mark = _header(document.text) or (1, ",")
    rows = _rows(document, line, mark)
    names, labels = next(rows), next(rows)
    pairs = [
        i for i in range(0, len(labels) - 1, 2) if _REFLECTANCE.fullmatch(labels[i + 1].strip())
    ]
    if not pairs:
        place = f"line {line + 1}, column {quote(labels[1])}"
        raise document.not_reflectance(
            place, series.other_quantity(labels[1]) or f"in units of {quote(labels[1])}"
        )
    left = [names[i] for i in range(0, min(len(names), len(labels) - 1), 2) if i not in pairs]
    notes = (f"Columns not read: {plain(', '.join(left[:8]))}.",) if left else ()
    table = _columns(document, rows, pairs, line + 2)
    return [_sample(document, names, labels, i, table[i], line + 2, notes) for i in pairs]


def _header(text: str) -> tuple[int, str] | None:
    """Return the line of the names, counted from 1, and the delimiter; None if there are none."""
    top = text[:_HEAD].split("\n")
    if len(text) > _HEAD:
        del top[-1]  # cut somewhere
    top = top[: _SEARCHED + 1]
    for i, (above, line) in enumerate(itertools.pairwise(top), start=1):
        for mark in _MARKS:
            cells = [cell.strip(' "') for cell in _fields(line, mark)]
            axes = cells[0::2][: len(cells) // 2]
            if axes and all(map(_AXIS.fullmatch, axes)) and len(_fields(above, mark)) > 1:
                return i, mark
    return None


def _rows(document: Document, first: int, mark: str) -> Iterator[list[str]]:
    """Yield the fields of each line from line `first` on; no field goes on in the next line."""
    lines = itertools.islice(tables.lines(document), first - 1, None)
    for number, line in enumerate(lines, start=first):
        try:
            yield _fields(line, mark)
        except csv.Error:
            raise document.error(
                f"line {number}", "a column is longer than any value; export it again"
            ) from None


def _fields(line: str, mark: str) -> list[str]:
    return next(csv.reader([line], delimiter=mark), [])


def _columns(
    document: Document, rows: Iterator[list[str]], pairs: list[int], first: int
) -> dict[int, tuple[array[float], array[float]]]:
    """Return wavelengths and values of each pair, down to the first blank line."""
    found = {i: (array("d"), array("d")) for i in pairs}
    for line, row in enumerate(rows, start=first):
        if not any(map(str.strip, row)):
            break
        for i in pairs:
            cells = [cell.strip() for cell in row[i : i + 2]]
            if not any(cells):
                continue
            if len(cells) < 2:
                raise document.error(
                    f"line {line}", "a wavelength stands without its value; export it again"
                )
            for column, cell in zip(found[i], cells, strict=True):
                column.append(series.number(document, f"line {line}", cell or "-"))
    return found


def _sample(
    document: Document,
    names: list[str],
    labels: list[str],
    column: int,
    table: tuple[array[float], array[float]],
    first: int,
    notes: tuple[str, ...],
) -> Sample:
    name = names[column].strip() if column < len(names) else ""
    place = f"column {column + 2}"
    values = np.array(table[1])
    found = series.bands(
        np.array(table[0]),
        values / 100.0 if label_words.says_percent(labels[column + 1]) else values,
        f"{document.path}, {place}",
        lambda band: f"line {first + band}",
    )
    return Sample(
        name=name or f"{document.path.stem} {column // 2 + 1}",
        wavelengths=found.wavelengths,
        values=found.values,
        kind="reading",
        source=str(document.path),
        position=place,
        device="Cary",
        notes=notes,
        altered=found.altered,
    )
