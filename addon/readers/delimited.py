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
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..sample import Sample, check_spectrum
from . import _labels, _table
from ._delimiter import find_delimiter
from ._document import Document, quote
from ._table import EXPECTED, SPACES, Row

NAME = "table with wavelengths (CSV, TSV, semicolons or spaces)"
PRIORITY = 0

_PEEK = 20  # rows from which the layout follows
_NUMBER = re.compile(r"\d+(?:[.,]\d*)?")
_NAME_COLUMN = re.compile(r"(?:sample[ _-]?)?(?:name|label)|user color name|sample", re.IGNORECASE)
_ID_COLUMN = re.compile(r"(?:sample[ _-]?)?(?:id|index|no\.?|number)", re.IGNORECASE)
# A single column with such a name says what is in it, not which sample it is.
_QUANTITY = re.compile(
    r"%?\s*(?:reflectance|reflectance[ _]factor|reflectivity|albedo|reading|values?|r|y|spectrum)?"
    r"\s*[\[(]?(?:%|percent|fraction|-|1)?[\])]?",
    re.IGNORECASE,
)
# Names of columns in nanometers start here: samples are called 1, 2, 3 more often than 100.
_LEAST_BAND = 100.0


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
        or _labels.is_wavelength(line)
    )


def read(document: Document) -> list[Sample]:
    """Return one sample a column, or one a row where the wavelengths stand in the header.

    Raises
    ------
    InputError
        The delimiter or the wavelengths cannot be found, a field is not a number, or a spectrum is
        not one (`check_spectrum`).
    """
    said = _labels.comments(document)
    delimiter, skip = find_delimiter(document)
    table = _table.rows(document, delimiter, skip)
    top = list(itertools.islice(table, _PEEK))
    if not top:
        raise document.error("", "its rows are empty; export the table with its values")
    table = itertools.chain(top, table)
    comma = delimiter != ","
    header = [label.strip() for label in top[0].fields]
    while len(header) > 1 and not header[-1]:
        header.pop()  # a delimiter at the end of each line
    if _is_across(document, header, top, comma):
        next(table)
        return _read_across(document, said, header, table, top, comma)
    if _plain_number(header[0], comma) is None:
        next(table)
        if delimiter == SPACES and len(top) > 1 and len(top[1].fields) == 2 != len(header):
            header = [header[0], " ".join(header[1:])]  # spaces within the second name
    else:
        if delimiter == "," and len(header) > 2 and not any("." in c for c in top[0].fields):
            raise document.error(
                f"line {top[0].line}",
                "its commas may be decimal commas; separate the columns by semicolons, or give "
                "them names in a first line",
            )
        header = ["wavelength", *[""] * (len(header) - 1)]
    return _read_down(document, said, header, table, comma)


def _read_down(
    document: Document,
    said: _labels.Comments,
    header: list[str],
    table: Iterator[Row],
    comma: bool,
) -> list[Sample]:
    names = header[1:]
    if not names:
        raise document.error(
            "line 1", f"there is only one column; wavelengths need values beside them: {EXPECTED}"
        )
    labels = [label or f"column {i}" for i, label in enumerate(header, start=1)]
    block = _table.numbers(document, table, labels, range(len(header)), decimal_comma=comma)
    nm = _nanometers(document, said, block.values[:, 0], header[:1])
    values = np.ascontiguousarray(block.values[:, 1:].T)
    samples = []
    for i, label in enumerate(names):
        generic = len(names) == 1 and _QUANTITY.fullmatch(label)
        place = f"column {quote(labels[i + 1])}" if label else labels[i + 1]
        samples.append(
            _sample(
                document,
                said,
                name=document.path.stem if generic else label or f"{document.path.stem} {i + 1}",
                nm=nm,
                values=values[i] / _scale(document, said, place, [label]),
                position=place,
                place=lambda band: f"line {block.lines[band]}",
            )
        )
    return samples


def _read_across(
    document: Document,
    said: _labels.Comments,
    header: list[str],
    table: Iterator[Row],
    top: list[Row],
    comma: bool,
) -> list[Sample]:
    if len(top) > 1 and _labels.band(header[0]) and len(top[1].fields) == len(header) + 1:
        header = ["", *header]  # names without a name above them
    bands = [i for i, label in enumerate(header) if (_labels.band(label) or 0) >= _LEAST_BAND]
    others = [i for i in range(len(header)) if i not in set(bands)]
    name = next((i for i in others if _NAME_COLUMN.fullmatch(header[i])), None)
    if name is None:
        name = next((i for i in others if _ID_COLUMN.fullmatch(header[i])), None)
    if name is None and others:
        name = others[0]
    notes: tuple[str, ...] = ()
    unread = [header[i] for i in others if i != name and header[i]]
    if unread:
        more = f" and {len(unread) - 8} more" if len(unread) > 8 else ""
        notes = (f"Columns not read: {', '.join(unread[:8])}{more}.",)
    texts = [] if name is None else [name]
    block = _table.numbers(document, table, header, bands, texts, decimal_comma=comma)
    nm = np.array([_labels.band(header[i]) for i in bands], dtype=np.float64)
    nm = _nanometers(document, said, nm, [header[0], header[bands[0]]])
    # Of the other columns' names only the corner's is about the values below.
    about = [header[i] for i in sorted({0, *bands})]
    values = block.values / _scale(document, said, f"line {top[0].line}", about)
    samples = []
    for i, line in enumerate(block.lines):
        found = block.texts[i][0] if texts else ""
        alone = document.path.stem if len(block.lines) == 1 else f"{document.path.stem} {i + 1}"
        samples.append(
            _sample(
                document,
                said,
                name=found or alone,
                nm=nm,
                values=values[i],
                position=f"line {line}",
                place=lambda band: f"column {quote(header[bands[band]])}",
                notes=notes,
            )
        )
    return samples


def _sample(
    document: Document,
    said: _labels.Comments,
    *,
    name: str,
    nm: NDArray[np.float64],
    values: NDArray[np.float64],
    position: str,
    place: Callable[[int], str],
    notes: tuple[str, ...] = (),
) -> Sample:
    where = f"{document.path}, {position}"
    wavelengths, fractions = check_spectrum(nm, values, where, place)
    sample = Sample(
        name,
        wavelengths,
        fractions,
        said.kind,
        source=str(document.path),
        position=position,
        notes=notes,
    )
    return replace(sample, **said.texts) if said.texts else sample  # type: ignore[arg-type]


def _nanometers(
    document: Document, said: _labels.Comments, found: NDArray[np.float64], labels: list[str]
) -> NDArray[np.float64]:
    """Return the wavelengths in nm, by the unit that a column name or a comment states."""
    units = {unit for unit in map(_labels.unit_of_wavelengths, labels) if unit}
    units |= {said.wavelength_unit} if said.wavelength_unit else set()
    if len(units) > 1:
        raise document.error(
            "wavelength unit", "the comment and the column name disagree; make them agree"
        )
    factor = _labels.NM_PER_UNIT[units.pop()] if units else 1.0
    # Rounded to 1e-9 nm: 0.57 µm is 570 nm, while the product of the two floats is not.
    return found if factor == 1.0 else np.round(found * factor, 9)


def _scale(document: Document, said: _labels.Comments, place: str, labels: list[str]) -> float:
    """Return what to divide the values by: 100 where a name or a comment says percent."""
    percent = any(map(_labels.says_percent, labels))
    if percent and said.scale == 1.0:
        raise document.error(
            place, "the column says percent and a comment says fraction; make them agree"
        )
    return 100.0 if percent else said.scale or 1.0


def _plain_number(cell: str, comma: bool) -> float | None:
    try:
        return float(cell.replace(",", ".") if comma else cell)
    except ValueError:
        return None


def _is_across(document: Document, header: list[str], top: list[Row], comma: bool) -> bool:
    """Return whether the first row names the bands, or the first column does.

    Raises
    ------
    InputError
        Neither does, or both could.
    """
    down = [_labels.band(row.fields[0]) or 0.0 for row in top[1:]]
    column_fits = bool(down) and min(down) >= _LEAST_BAND
    bands = [(_labels.band(label) or 0.0) for label in header]
    place = f"line {top[0].line}"
    if _plain_number(header[0], comma) is not None:
        return min(bands) >= _LEAST_BAND and bool(down) and not column_fits
    rest = bands[1:]
    if _labels.is_wavelength(header[0]) and _labels.band(header[0]) is None:
        if not rest or min(rest) < _LEAST_BAND or not column_fits:
            return bool(rest) and min(rest) >= _LEAST_BAND
        if _increasing(rest) == _increasing(down):
            raise document.error(
                place,
                "wavelengths could stand in the first row or in the first column; call the first "
                "column 'name' if it has names, or begin the names in the first row with a letter",
            )
        return _increasing(rest)
    if max(bands) >= _LEAST_BAND:
        return True
    if down and _plain_number(top[1].fields[0], comma) is not None and len(header) > 1:
        return False
    raise document.error(
        place,
        f"no wavelengths found at {quote(header[0])}; call the first column 'wavelength', or the "
        "columns of the bands '400 nm' and so on, and begin lines that are not part of the table "
        "with '#'",
    )


def _increasing(numbers: list[float]) -> bool:
    return all(first < second for first, second in itertools.pairwise(numbers))
