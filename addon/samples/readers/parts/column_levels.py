# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows above the names of columns that say more of each column, as spreadsheets and pandas write.

Such as ``,Tile A,,Tile B,`` above ``nm,SCI,SCE,SCI,SCE``: a cell that was merged stands in the
first of its columns and the others are empty. Or ``Glanz;ein;aus`` above ``Wellenlänge;;``.
"""

from __future__ import annotations

import csv
import itertools
from dataclasses import dataclass, field
from typing import Any

from . import label_words, statements, tables
from .document import Document
from .tables import SPACES
from .wavelengths_down import names_quantity

_MOST = 8  # rows that may stand so
_LEAST = 2  # cells beside the first: one alone is about the whole table


@dataclass
class Levels:
    """What the rows say: `lines` are theirs, counted from 0, `cells` those of rows without a key.

    `own` are fields of `statements.stated` by column; `axis` is what the first column is called in
    a row that has nothing else.
    """

    lines: set[int] = field(default_factory=set)
    cells: list[list[str]] = field(default_factory=list)
    own: dict[int, dict[str, Any]] = field(default_factory=dict)
    axis: str = ""

    def labels(self, header: list[str]) -> list[str]:
        """Return the names of columns with what stands above them before."""
        found = [self.axis or header[0], *header[1:]]
        for i, label in enumerate(header):
            above = [row[i] for row in self.cells if i < len(row) and row[i]]
            if above and not (i == 0 or label_words.is_wavelength(label)):
                plain = names_quantity(label) and not label_words.says_percent(label)
                found[i] = " ".join(above if plain else [*above, *filter(None, [label])])
        return found


def find(document: Document, start: int, delimiter: str, width: int) -> Levels:
    """Return what the rows right above line `start` say of a table's columns, if they do.

    Parameters
    ----------
    document
        The file.
    start
        How many lines stand above the names of the columns.
    delimiter, width
        Of the table.
    """
    levels = Levels()
    if delimiter == SPACES or width <= _LEAST:
        return levels
    first = max(0, start - _MOST)
    above = list(itertools.islice(tables.lines(document), first, start))
    for number, line in zip(itertools.count(start - 1, -1), reversed(above), strict=False):
        row = _cells(line, delimiter, width)
        if not row and number == start - 1 and line.count(delimiter) >= _LEAST:
            axis = line.strip().rstrip(delimiter).strip(' "')
            if delimiter not in axis and label_words.is_wavelength(axis):
                levels.axis = axis
                levels.lines.add(number)
                continue
        if not row:
            break
        key, cells = row[0], _filled(row)
        levels.lines.add(number)
        if not key or statements.field_of(key) == "name":
            levels.cells.insert(0, cells)
            continue
        for i, cell in enumerate(cells):
            if i and cell:
                levels.own.setdefault(i, {}).update(statements.stated(key, cell))
    return levels


def _cells(line: str, delimiter: str, width: int) -> list[str]:
    """Return the cells of a row that is about columns, none of any other line."""
    if line.lstrip().startswith("#") or line.count(delimiter) < _LEAST:
        return []
    try:
        cells = next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    except csv.Error:
        return []
    cells = [cell.strip() for cell in cells]
    rest = cells[1:]
    if len(cells) > width + 1 or sum(map(bool, rest)) < _LEAST or any(map(_is_number, rest)):
        return []
    return cells if not cells[0] or statements.field_of(cells[0]) else []


def _is_number(cell: str) -> bool:
    return label_words.band(cell) is not None


def _filled(row: list[str]) -> list[str]:
    """Return a row with what was merged in each of its columns."""
    found = row[:1]
    last = ""
    for cell in row[1:]:
        last = cell or last
        found.append(last)
    return found
