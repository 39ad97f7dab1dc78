# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Delimited text as rows of fields and blocks of numbers, each with its place in the file."""

from __future__ import annotations

import csv
import math
from array import array
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .document import Document, quote

SPACES = " "
# In the order in which they are preferred: a comma may be a decimal comma, a space part of a name.
DELIMITERS = {"\t": "tabs", ";": "semicolons", ",": "commas", SPACES: "spaces"}
_MOST_COLUMNS = 65536  # no spectrometer has so many bands, and no table so many samples
_NARROW, _MOST_NARROW = 24, 10_000  # bytes a column, and how many columns may have fewer
_SHORT, _MOST_SHORT = 50, 50_000  # bytes a sample, and how many samples may have fewer
_AT_ONCE = 2**13  # characters that are split into lines
EXPECTED = "commas, semicolons, tabs or spaces between the columns"

# What instruments' software writes where nothing was measured.
_MISSING = {"", "-", "--", "n/a", "na", "nan", "#n/a", "none", "null", "undefined"}


def is_missing(cell: str) -> bool:
    """Return whether a field says that nothing was measured."""
    return cell.strip().lower() in _MISSING


class Row(NamedTuple):
    """One record: the line it starts at, counted from 1, and its fields."""

    line: int
    fields: list[str]


@dataclass
class Block:
    """The numeric columns of a table.

    Parameters
    ----------
    values
        float64, shape ``(rows, columns)``.
    lines
        The line of each row.
    texts
        Of each row, the fields of the columns that were asked for as text.
    percent
        Which columns of `values` have a percent sign behind each number.
    """

    values: NDArray[np.float64]
    lines: array[int] = field(default_factory=lambda: array("L"))
    texts: list[list[str]] = field(default_factory=list)
    percent: set[int] = field(default_factory=set)


def lines(document: Document) -> Iterator[str]:
    """Return the lines of a text one by one, without holding a list of them all.

    Not `str.splitlines`: it also splits at form feeds and rare separators, and the line numbers
    in messages would no longer be those of an editor.
    """
    text = document.text
    if not text:
        return
    last = len(text) - text.endswith("\n")
    start = 0
    while start <= last:  # some at a time, which is several times faster than one by one
        end = text.find("\n", start + _AT_ONCE, last)
        end = last if end < 0 else end
        yield from text[start:end].split("\n")
        start = end + 1


def announced(line: str) -> str:
    """Return the delimiter that a first line such as ``sep=;`` announces to Excel, or nothing."""
    line = line.strip(' "')
    if not line.lower().startswith("sep="):
        return ""
    return "\t" if line[4:6] == "\\t" else line[4:5]


def rows(document: Document, delimiter: str, skip: int = 0) -> Iterator[Row]:
    """Return the records of a table without blank lines and without comments (``#``).

    Parameters
    ----------
    document
        The file.
    delimiter
        A key of `DELIMITERS`, or any single character.
    skip
        How many lines to leave out at the top.

    Raises
    ------
    InputError
        A field is longer than `csv` allows, which an unclosed quotation mark brings about.
    """
    # A line left out goes to the csv module as an empty one, so that its count stays right.
    kept = (
        "" if number < skip or ("#" in line and line.lstrip().startswith("#")) else line
        for number, line in enumerate(lines(document))
    )
    if delimiter == SPACES:
        for number, line in enumerate(kept, start=1):
            fields = line.split()
            if fields:
                yield Row(number, fields)
        return
    reader = csv.reader(kept, delimiter=delimiter, skipinitialspace=True)
    start = 1
    try:
        for fields in reader:
            if any(map(str.strip, fields)):
                yield Row(start, fields)
            start = reader.line_num + 1
    except csv.Error:
        raise document.error(
            f"line {start}", "a quotation mark is not closed; close it or remove it"
        ) from None


def numbers(
    document: Document,
    table: Iterable[Row],
    header: Sequence[str],
    columns: Sequence[int],
    texts: Sequence[int] = (),
    *,
    decimal_comma: bool = False,
    gaps: int | None = None,
) -> Block:
    """Return the given columns of a table as numbers.

    Parameters
    ----------
    document
        The file, for messages.
    table
        The records below the header.
    header
        One label a column, for messages.
    columns
        Which columns hold the numbers.
    texts
        Which columns to return as stripped text.
    decimal_comma
        Whether ``0,5`` is a number: only where commas do not separate columns, or in quotation
        marks.
    gaps
        From which of `columns` on a field may say that nothing was measured, which gives NaN.

    Raises
    ------
    InputError
        A record has more or fewer fields than the header, or a field is not a number.
    """
    signs: Counter[int] = Counter()
    flat = array("d")  # 8 bytes a number, where a list of floats takes 32
    block = Block(np.empty((0, len(columns))))
    width = len(header)
    plain = "_" not in document.text  # Python reads 1_0 as ten
    for row in table:
        fields = row.fields
        if len(fields) != width:
            fields = _fit(document, row, header)
        cells = [fields[column] for column in columns]
        if decimal_comma:
            # "1.234,5" becomes no number, and `_number` below says what is wrong with the original.
            cells = [cell.replace(",", ".") for cell in cells]
        try:
            found = list(map(float, cells))
            exact = plain or "_" not in "".join(cells)
        except ValueError:
            exact = False
        if not exact:
            found = [
                math.nan
                if gaps is not None and i >= gaps and is_missing(fields[column])
                else _number(
                    document,
                    row.line,
                    header[column],
                    _bare(fields[column], i, gaps),
                    decimal_comma,
                )
                for i, column in enumerate(columns)
            ]
            signs.update(i for i, c in enumerate(columns) if fields[c].rstrip().endswith("%"))
        flat.extend(found)
        block.lines.append(row.line)
        if texts:
            block.texts.append([fields[column].strip() for column in texts])
    if flat:
        # Copied out of the array, whose memory must not move while numpy looks at it.
        block.values = np.array(flat, dtype=np.float64).reshape(-1, len(columns))
    for i, count in signs.items():
        if count < np.count_nonzero(~np.isnan(block.values[:, i])):
            raise document.error(
                f"column {quote(header[columns[i]])}",
                "some of its values have a percent sign and others have none; give all of them one",
            )
    block.percent = set(signs)
    return block


def _bare(cell: str, place: int, gaps: int | None) -> str:
    """Return a number without the unit behind it: ``45.1 %``, and ``400 nm`` of wavelengths.

    Only of tables, whose values may be missing: there `gaps` is where those begin.
    """
    if gaps is None:
        return cell
    text = cell.strip()
    if place >= gaps and text.endswith("%"):
        return text[:-1]
    return text[:-2] if place < gaps and text[-2:].lower() == "nm" else cell


def check_columns(document: Document, line: int, columns: int) -> None:
    """Refuse a line of very many columns that hardly have rows: each takes 150 bytes of memory.

    Raises
    ------
    InputError
        There are more than 65,536, or more than 10,000 of fewer than 24 bytes each.
    """
    most = _MOST_COLUMNS if len(document.data) >= _NARROW * columns else _MOST_NARROW
    if columns > most:
        raise document.error(
            f"line {line}",
            f"it has {columns} columns, more than the {most} that are read; split it",
        )


def check_count(document: Document, samples: int) -> None:
    """Refuse a huge number of samples that hardly have a spectrum: each takes 1 kB of memory.

    Raises
    ------
    InputError
        There are more than 50,000, of fewer than 50 bytes each.
    """
    if samples > _MOST_SHORT and len(document.data) < _SHORT * samples:
        raise document.error(
            "",
            f"it has {samples} samples with a few numbers each; split it, or export whole spectra",
        )


def _fit(document: Document, row: Row, header: Sequence[str]) -> list[str]:
    """Return the fields without empty ones at the end, if that makes them as many as the header."""
    fields = list(row.fields)
    while len(fields) > len(header) and not fields[-1].strip():
        fields.pop()
    if len(fields) < len(header):
        label = header[len(fields)]
        raise document.error(
            f"line {row.line}",
            f"the line ends before column {quote(label)}, with {len(fields)} of {len(header)} "
            "columns; complete it or leave it out",
        )
    if len(fields) > len(header):
        comma = " (decimal commas need semicolons or tabs between columns)"
        if any("." in field for field in fields) or len(fields) > 2 * len(header):
            comma = ""
        raise document.error(
            f"line {row.line}",
            f"the line has {len(fields)} columns where the header has {len(header)}; "
            f"make them agree{comma}",
        )
    return fields


def _number(document: Document, line: int, label: str, cell: str, decimal_comma: bool) -> float:
    place = f"line {line}, column {quote(label)}"
    text = cell.strip()
    if is_missing(text):
        found = "the value is missing" if not text else f"{quote(text)} stands for a missing value"
        raise document.error(place, f"{found}; measure again or leave the sample out")
    if decimal_comma and text.count(",") == 1 and "." not in text:
        text = text.replace(",", ".")
    try:
        if "_" not in text:
            return float(text)
    except ValueError:
        pass
    foreign = [name for mark, name in DELIMITERS.items() if mark != "," and mark in text]
    foreign += ["vertical bars"] if "|" in text else []
    if foreign:
        raise document.error(
            place,
            f"{quote(text)} seems to be separated by {foreign[0]}, other than the header; "
            f"use the same delimiter throughout: {EXPECTED}",
        )
    raise document.error(place, f"{quote(text)} is not a number; correct it")
