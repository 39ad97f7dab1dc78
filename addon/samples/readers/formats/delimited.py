# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain tables with wavelengths, down the first column or across the header.

Commas, semicolons, tabs or spaces between columns; one or many samples. Values are fractions
unless a column name or a comment says percent: never is the scale guessed from their size.
Lines that begin with ``#`` are comments, and state what a table cannot (see `_labels.comments`).
"""

from __future__ import annotations

import itertools
import re

from ...sample import Sample
from ..parts import (
    column_levels,
    comment_lines,
    goniometer_tables,
    label_words,
    long_tables,
    table_start,
    tables,
    wavelengths_across,
    wavelengths_down,
)
from ..parts.delimiter import find_delimiter
from ..parts.document import Document, quote
from ..parts.table_start import LEAST_BAND
from ..parts.tables import SPACES, Row

NAME = "table with wavelengths (CSV, TSV, semicolons or spaces)"
ENDINGS = ("csv", "tsv", "txt", "dat", "sed")
PRIORITY = 0

_PEEK = 20  # rows from which the layout follows
_NUMBER = re.compile(r"\d+(?:[.,]\d*)?")


def sniff(document: Document) -> bool:
    """Return whether some line is a row of numbers or begins with a word for wavelength."""
    head = document.head_text
    if head.lstrip()[:1] in ("<", "{", "["):
        return False  # XML or JSON: full of numbers, but no table
    return any(map(_may_be_row, head.split("\n")))


def _may_be_row(line: str) -> bool:
    if line.lstrip().startswith("#"):
        return False
    found = len(list(itertools.islice(_NUMBER.finditer(line), 2)))
    return (
        found > 1
        or (found == 1 and any(mark in line for mark in "\t;,"))
        or label_words.is_wavelength(line)
    )


def read(document: Document) -> list[Sample]:
    """Return one sample a column, or one a row where the wavelengths stand in the header.

    Where a row is one number, with its wavelength, samples are what the other columns tell apart.

    Raises
    ------
    InputError
        The delimiter or the wavelengths cannot be found, a field is not a number, or a spectrum is
        not one (`check_spectrum`).
    """
    document = comment_lines.as_ours(document)
    said = label_words.comments(document)
    start = table_start.find_start(document)
    delimiter, skip = find_delimiter(document, start)
    table = tables.rows(document, delimiter, skip)
    top = list(itertools.islice(table, _PEEK))
    if not top:
        raise document.error("", "its rows are empty; export the table with its values")
    table = itertools.chain(top, table)
    comma = delimiter != ","
    header = [label.strip() for label in top[0].fields]
    while len(header) > 1 and not header[-1]:
        header.pop()  # a delimiter at the end of each line
    tables.check_columns(document, top[0].line, len(header))
    levels = column_levels.find(document, start, delimiter, len(top[0].fields))
    fields = table_start.above(document, start, said, levels.lines)
    if goniometer_tables.is_goniometer(header):
        next(table)
        return goniometer_tables.read(document, said, fields, header, top[0].line, table)
    if len(top) > 1 and long_tables.is_long(header, top[1].fields):
        next(table)
        return long_tables.read(document, said, fields, header, top[0].line, table)
    if _plain_number(header[0], comma) is None:  # programs that go on in a file repeat the names
        names = top[0].fields
        table = (row for i, row in enumerate(table) if not i or row.fields != names)
    if _is_across(document, said, header, top, comma):
        next(table)
        if len(top) > 1 and label_words.band(header[0]) and len(top[1].fields) == len(header) + 1:
            header = ["", *header]  # names without a name above them
        return wavelengths_across.read(document, said, fields, header, top[0].line, table)
    if _plain_number(header[0], comma) is None:
        next(table)
        if _has_row_names(header, top):
            header = ["", *header]
        elif delimiter == SPACES and len(top) > 1 and len(top[1].fields) == 2 != len(header):
            header = [header[0], " ".join(header[1:])]  # spaces within the second name
    else:
        if delimiter == "," and len(header) > 2 and not any("." in c for c in top[0].fields):
            raise document.error(
                f"line {top[0].line}",
                "its commas may be decimal commas; separate the columns by semicolons, or give "
                "them names in a first line",
            )
        header = ["wavelength", *[""] * (len(header) - 1)]
    header = levels.labels(header)
    return wavelengths_down.read(document, said, fields, header, table, levels.own)


def _has_row_names(header: list[str], top: list[Row]) -> bool:
    """Return whether rows begin with their numbers, 1, 2, 3, without a name above: R writes so."""
    firsts = [row.fields[0].strip() for row in top[1:] if len(row.fields) == len(header) + 1]
    counted = [str(i) for i in range(1, len(top))]
    return len(top) > 2 and firsts == counted and label_words.is_wavelength(header[0])


def _plain_number(cell: str, comma: bool) -> float | None:
    try:
        return float(cell.replace(",", ".") if comma else cell)
    except ValueError:
        return None


def _is_across(
    document: Document,
    said: label_words.Comments,
    header: list[str],
    top: list[Row],
    comma: bool,
) -> bool:
    """Return whether the first row names the bands, or the first column does.

    Raises
    ------
    InputError
        Neither does, or both could.
    """
    rows = [row for row in top[1:] if _plain_number(row.fields[0], comma) is not None]
    if top[1:] and not rows and label_words.small_bands(said, header):
        return True
    rows = rows or top[1:]  # units and what is said of samples may stand above the numbers
    down = [label_words.band(row.fields[0]) or 0.0 for row in rows]
    column_fits = bool(down) and min(down) >= LEAST_BAND
    bands = [(label_words.band(label) or 0.0) for label in header]
    place = f"line {top[0].line}"
    if _plain_number(header[0], comma) is not None:
        return min(bands) >= LEAST_BAND and bool(down) and not column_fits
    rest = bands[1:]
    if label_words.is_wavelength(header[0]) and label_words.band(header[0]) is None:
        if not rest or min(rest) < LEAST_BAND or not column_fits:
            return bool(rest) and min(rest) >= LEAST_BAND
        if _increasing(rest) == _increasing(down):
            raise document.error(
                place,
                "wavelengths could stand in the first row or in the first column; call the first "
                "column 'name' if it has names, or begin the names in the first row with a letter",
            )
        return _increasing(rest)
    if label_words.bands_of(header, LEAST_BAND):
        return True
    first = rows[0].fields[0] if rows else ""
    is_number = _plain_number(first, comma) is not None or first.strip().lower().endswith("nm")
    if column_fits and is_number and len(header) > 1:
        return False
    if down and _plain_number(first, comma) is not None and len(header) > 1:
        return False
    raise document.error(
        place,
        f"no wavelengths found at {quote(header[0])}; call the first column 'wavelength', or the "
        "columns of the bands '400 nm' and so on, and begin lines that are not part of the table "
        "with '#'",
    )


def _increasing(numbers: list[float]) -> bool:
    return all(first < second for first, second in itertools.pairwise(numbers))
