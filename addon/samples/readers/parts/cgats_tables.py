# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""CGATS text as tables: keywords, names of the fields, records.

CGATS.17 separates by white space of any kind and knows no lines, so a record may run over several.
Measurement software separates by tabs and leaves cells empty. Both are read: tabs count where the
names of the fields are separated by them and the number of cells fits.
"""

from __future__ import annotations

import csv
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from . import tables as _table
from .document import Document, quote
from .tables import Row

SIGNATURE = re.compile(
    r"CGATS(?:\.\w+)?|IT8\.7/\d\w*|CTI[1-4]|SPECT|CCSS|CCMX|CMF|CAL|ECI2002\w*|ISO\s?\d{5}(?:-\d)?"
)
"""First lines of a table that say what it is; many dialects leave them out."""

# What a table without a signature line of its own shares with the one above it. Not the measurement
# condition: one table is M0 and the next one M1.
_SHARED = ("INSTRUMENTATION", "TARGET_INSTRUMENT", "MEASUREMENT_GEOMETRY", "DEVICE_CLASS")

_KEYWORD = re.compile(r"([A-Za-z_][\w./-]*):?(?:\s+(.*))?")
_COMMENT = re.compile(r"\s#")
_QUOTED = re.compile(r'"(?:[^"]|"")*"')
_TOKEN = re.compile(r'"((?:[^"]|"")*)"|(\S+)')


REMARKS = "#"
"""The key of what stands in lines of comments."""


@dataclass
class Table:
    """One table.

    Parameters
    ----------
    line
        Where its data begin.
    signature
        Its own first line, or an empty string.
    keys
        Upper-case keywords, and all values that each has.
    lines
        The line of each keyword's first value.
    fields
        Names of the columns.
    tabs
        Whether tabs separate the names.
    rows
        The records, each as many cells as there are fields. To be used before the next table.
    """

    line: int = 0
    signature: str = ""
    keys: dict[str, list[str]] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)
    fields: list[str] = field(default_factory=list)
    tabs: bool = False
    rows: Iterable[Row] = ()

    def last(self, *names: str) -> str:
        """Return the last value of the first of these keywords that has one."""
        for name in names:
            for value in reversed(self.keys.get(name, [])):
                if value:
                    return value
        return ""


def tables(document: Document) -> Iterator[Table]:
    """Return the tables one by one.

    Raises
    ------
    InputError
        Data without names of fields, a block that does not end, or a record that does not fit.
    """
    numbered = enumerate(_table.lines(document), start=1)
    table = Table()
    for number, line in numbered:
        text = line.strip()
        if text.startswith("#"):
            table.keys.setdefault(REMARKS, []).append(text.lstrip("# "))
        if not text or text.startswith("#"):
            continue
        word = text[:20].split(None, 1)[0].upper()
        if word == "BEGIN_DATA_FORMAT":
            table.fields, table.tabs = _format(document, numbered, number, text[len(word) :])
        elif word == "BEGIN_DATA":
            if not table.fields:
                raise document.error(
                    f"line {number}", "there is no BEGIN_DATA_FORMAT with the names of the columns"
                )
            table.line = number
            rows = _rows(document, numbered, table, text[len(word) :])
            table.rows = rows
            yield table
            for _ in rows:
                pass  # whoever had no use for the records left them
            table = _below(table)
        else:
            _keyword(table, number, text)


def _below(table: Table) -> Table:
    """Return the beginning of the next table; the names of the fields stay until others come."""
    keys = {key: table.keys[key] for key in _SHARED if key in table.keys}
    lines = {key: table.lines[key] for key in keys}
    return Table(keys=keys, lines=lines, fields=table.fields, tabs=table.tabs)


def _keyword(table: Table, number: int, text: str) -> None:
    if SIGNATURE.fullmatch(text):
        table.signature, table.keys, table.lines = text, {}, {}
        return
    match = _KEYWORD.fullmatch(text)
    if not match:
        return  # some software writes plain remarks
    key, value = match[1].upper(), (match[2] or "").strip()
    if value.startswith('"'):
        quoted = _QUOTED.match(value)
        value = quoted[0][1:-1].replace('""', '"') if quoted else value[1:]
    else:
        value = value.split("#", 1)[0].strip()
    table.lines.setdefault(key, number)
    table.keys.setdefault(key, []).append(value.strip())


def _format(
    document: Document, numbered: Iterator[tuple[int, str]], start: int, rest: str
) -> tuple[list[str], bool]:
    """Return the names of the fields, and whether tabs separate them."""
    lines = []
    for _, line in itertools.chain([(start, rest)], numbered):
        before, end, _ = line.partition("END_DATA_FORMAT")
        if not before.lstrip().startswith("#"):
            lines.append(before.strip())
        if end:
            break
    else:
        raise document.error(
            f"line {start}", "BEGIN_DATA_FORMAT has no END_DATA_FORMAT; export the file again"
        )
    text = "\n".join(lines)
    fields = [name.strip('"') for name in text.split()]
    if not fields:
        raise document.error(f"line {start}", "the table has no columns; export it again")
    return fields, "\t" in text and " " not in text


def _rows(
    document: Document, numbered: Iterator[tuple[int, str]], table: Table, rest: str
) -> Iterator[Row]:
    size = len(table.fields)
    pending: list[str] = []  # the beginning of a record that goes on in the next line
    start = taken = 0
    for number, line in itertools.chain([(table.line, rest)], numbered):
        text = line.lstrip()
        if not text or text[0] == "#":
            continue
        if text[:8].upper() == "END_DATA":
            if pending:
                raise _short(document, table, start, taken)
            return
        cells = _cells(line, size - len(pending), table.tabs)
        if not pending:
            start, taken = number, len(cells)
        pending += cells
        if len(pending) == size:
            yield Row(start, pending)
            pending = []
        elif taken > size:
            raise document.error(
                f"line {number}",
                f"the line has {taken} cells where BEGIN_DATA_FORMAT names {size} columns; "
                "make them agree, and put names with spaces into quotation marks",
            )
        elif len(pending) > size:
            raise _short(document, table, start, taken)
    raise document.error(
        f"line {table.line}", "BEGIN_DATA has no END_DATA, the file breaks off; export it again"
    )


def _short(document: Document, table: Table, line: int, taken: int) -> Exception:
    return document.error(
        f"line {line}",
        f"the line ends before column {quote(table.fields[taken])}, with {taken} of "
        f"{len(table.fields)} columns; complete it or leave it out",
    )


def _cells(line: str, size: int, tabs: bool) -> list[str]:
    """Return the cells of a line: those of them that fit `size` if some do."""
    if tabs and "\t" in line:
        cells = _by_tabs(line)
        while len(cells) > size and not cells[-1].strip():
            cells.pop()
        if len(cells) == size:
            return cells
        spaced = _by_spaces(line)
        if len(spaced) == size:
            return spaced
        while cells and not cells[-1].strip():
            cells.pop()
        while cells and not cells[0].strip():
            cells.pop(0)
    else:
        cells = _by_spaces(line)
    comment = _COMMENT.search(line) if len(cells) > size else None
    return _by_spaces(line[: comment.start()]) if comment else cells


def _by_tabs(line: str) -> list[str]:
    if '"' not in line:
        return line.split("\t")
    try:
        return next(csv.reader([line], delimiter="\t", skipinitialspace=True), [])
    except csv.Error:
        return line.split("\t")


def _by_spaces(line: str) -> list[str]:
    if '"' not in line:
        return line.split()
    # One after the other: a list of all matches takes four times the memory of the cells.
    return [found[2] or (found[1] or "").replace('""', '"') for found in _TOKEN.finditer(line)]
