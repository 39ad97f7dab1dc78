# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Text exports of Avantes' AvaSoft 7 and 8 (.ttt, .trt, .tit, .txt).

Lines of metadata, ``Wave ;Dark ;Ref ;Sample ;Reflectance``, a line of units ``[nm] ;[counts] …``,
and rows with semicolons, with decimal commas where the computer's language has them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample
from ..parts import series, tables
from ..parts.document import Document, quote
from ..parts.geometry_words import instrument_of

NAME = "AvaSoft text export"
ENDINGS = ("ttt", "trt", "tit", "txt")
PRIORITY = 90

_HEADER = re.compile(r"wave(?:length)?\s*;", re.IGNORECASE)
_TWO_LINES = re.compile(rb"^wave(?:length)? *;[^\n]*\n+ *\[nm\] *;", re.IGNORECASE | re.MULTILINE)
_DEVICE = re.compile(r"data measured with spectrometer[^:]*:\s*(\S+)", re.IGNORECASE)
_BESIDE = {"dark", "ref", "reference", "sample", "scope", "white"}


def sniff(document: Document) -> bool:
    """Return whether a line of units follows the column names."""
    return bool(_TWO_LINES.search(document.head.replace(b"\0", b"").replace(b"\r", b"\n")))


def read(document: Document) -> list[Sample]:
    """Return one sample a column of reflectance.

    Raises
    ------
    InputError
        The file holds no reflectance, a field is not a number, or a spectrum is not one.
    """
    # AvaSoft 7 leaves the zero bytes of its buffer behind the spectrometer's name.
    document = replace(document, data=document.data.replace(b"\0", b""))
    lines = enumerate(tables.lines(document), start=1)
    top, number, line = _top(document, lines)
    header = [label.strip() for label in line.rstrip("; \t").split(";")]
    units = [unit.strip() for unit in next(lines, (0, ""))[1].split(";")][: len(header)]
    units += [""] * (len(header) - len(units))
    columns = _reflectance(document, number, header, units)
    rows, at = _numbers(document, lines, header, columns)
    instrument, assumed = instrument_of("")
    device = next((m[1] for m in map(_DEVICE.match, top) if m), "")
    comment = re.sub(r"^\w+-", "", top[0]).strip() if top else ""
    samples = []
    for i, column in enumerate(columns, start=1):
        place = f"column {quote(header[column])}"
        scale = 100.0 if "%" in units[column] or "%" in header[column] else 1.0
        found = series.bands(
            rows[:, 0],
            rows[:, i] / scale,
            f"{document.path}, {place}",
            lambda band: f"line {at[band]}",
        )
        samples.append(
            Sample(
                name=(comment or document.path.stem) + (f" {i}" if len(columns) > 1 else ""),
                wavelengths=found.wavelengths,
                values=found.values,
                kind="reading",
                instrument=instrument,
                source=str(document.path),
                position=place,
                device=device,
                notes=(assumed,),
                altered=found.altered,
            )
        )
    return samples


def _top(document: Document, lines: Iterator[tuple[int, str]]) -> tuple[list[str], int, str]:
    """Return what stands above the column names, their line's number, and that line."""
    top: list[str] = []
    for number, line in lines:
        if _HEADER.match(line):
            return top, number, line
        top.append(line)
    raise document.error("", "the line with the names of the columns is broken; export it again")


def _reflectance(document: Document, line: int, header: list[str], units: list[str]) -> list[int]:
    """Return the columns with reflectance.

    Raises
    ------
    InputError
        There is none; the sentence names what there is.
    """
    found = [i for i, label in enumerate(header) if series.says_reflectance(label)]
    if found:
        return found
    for i, label in enumerate(header[1:], start=1):
        if label.lower() in _BESIDE:
            continue
        other = series.other_quantity(label) or series.other_quantity(units[i])
        place = f"line {line}, column {quote(label)}"
        if other:
            raise document.not_reflectance(place, other)
        raise document.error(place, "the column is not reflectance; export the reflectance")
    raise document.not_reflectance(f"line {line}", "counts")


def _numbers(
    document: Document,
    lines: Iterator[tuple[int, str]],
    header: list[str],
    columns: list[int],
) -> tuple[NDArray[np.float64], list[int]]:
    """Return wavelengths and the given columns, shape (rows, 1 + columns), and their lines."""
    flat: list[float] = []
    at: list[int] = []
    for number, line in lines:
        fields = line.strip().rstrip(";").split(";")
        if fields == [""]:
            continue
        if len(fields) != len(header):
            raise document.error(
                f"line {number}",
                f"{len(header)} columns were expected, found {len(fields)}; export it again",
            )
        for column in (0, *columns):
            place = f"line {number}, column {quote(header[column])}"
            flat.append(series.number(document, place, fields[column].strip()))
        at.append(number)
    return np.array(flat, dtype=np.float64).reshape(-1, 1 + len(columns)), at
