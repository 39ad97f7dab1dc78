# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables with one number a row, its wavelength, and columns that say whose and how measured it is.

Such as ``name, geometry, wavelength, reflectance``, as programs write that have no bands.
"""

from __future__ import annotations

import itertools
from array import array
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ....support.shown_text import from_cell
from ...sample import Sample
from . import label_words, series, statements, tables
from .document import Document
from .scale import nanometers, of_row, scale, tells
from .tables import Row
from .wavelengths_across import not_read
from .wavelengths_down import names_quantity

_IN_WORDS = {"name", "geometry", "specular", "device", "surface", "condition"}
_ANGLES = {"aspecular", "angle", "view", "lit"}


def is_long(header: list[str], first: list[str]) -> bool:
    """Return whether the names of columns, with the first row below, are those of such a table.

    There is one column of wavelengths and one of values, and one that says in words whose or how
    measured they are, or at which angle.
    """
    columns = _columns(header)
    if columns is None or len(first) < len(header) or not _is_number(first[columns[0]]):
        return False
    if _naming(header, first, columns) is not None:
        return True
    fields = {statements.field_of(header[i]): first[i].strip() for i in columns[2]}
    words = {field for field, cell in fields.items() if cell and not _is_number(cell)}
    return bool(words & _IN_WORDS or fields.keys() & _ANGLES)


def _naming(header: list[str], first: list[str], columns: tuple[int, int, list[int]]) -> int | None:
    """Return the column of names where no key says so: the only other one that is not numbers."""
    axis, value, keyed = columns
    if any(statements.field_of(header[i]) == "name" for i in keyed):
        return None
    rest = [i for i, label in enumerate(header) if label and i not in (axis, value, *keyed)]
    words = [
        i for i in rest if first[i].strip() and not _is_number(first[i]) and not tells(header[i])
    ]
    return words[0] if len(words) == 1 else None


def read(
    document: Document,
    said: label_words.Comments,
    fields: dict[str, Any],
    header: list[str],
    line: int,
    table: Iterator[Row],
) -> list[Sample]:
    """Return one sample for all rows that say the same in all other columns; as others read."""
    columns = _columns(header)
    assert columns is not None, "ask `is_long` first"
    axis, value, keyed = columns
    top = next(table, None)
    naming = None if top is None else _naming(header, top.fields, columns)
    table = table if top is None else itertools.chain([top], table)
    keyed = keyed if naming is None else [naming, *keyed]
    telling = [i for i, label in enumerate(header) if i not in (axis, value) and tells(label)]
    keyed = [*keyed, *telling]
    if series.other_quantity(header[value]) == "emissivity":
        said = replace(said, kind="emissivity")
    groups: dict[tuple[str, ...], array[int]] = {}
    counted = _grouped(table, keyed, groups)
    block = tables.numbers(document, counted, header, [axis, value], decimal_comma=True, gaps=1)
    tables.check_count(document, len(groups))
    nm = nanometers(document, said, block.values[:, 0], [header[axis]])
    sign = "%" if block.percent else ""
    one = scale(document, said, f"line {line}", [header[value], sign])
    values = block.values[:, 1] / one
    unread = [label for i, label in enumerate(header) if label and i not in (axis, value, *keyed)]
    samples = []
    for cells, at in groups.items():
        own = dict(fields)
        for i, cell in zip(keyed, cells, strict=True):
            own.update({"name": cell} if i == naming else statements.stated(header[i], cell))
        start = block.lines[at[0]]
        divisor, other = of_row(cells[len(keyed) - len(telling) :], one != 1.0)
        if other and other != "emissivity":
            raise document.not_reflectance(f"line {start}", other)
        found = series.bands(
            nm[at],
            values[at] / divisor,
            f"{document.path}, from line {start} on",
            lambda band: f"line {block.lines[at[band]]}",  # noqa: B023
        )
        name = own.get("name", "")
        samples.append(
            statements.make(
                document,
                said,
                own,
                found,
                name=(from_cell(name) if said.escaped else name) or document.path.stem,
                position=f"line {start}",
                notes=not_read(unread),
            )
        )
    return samples


def _columns(header: list[str]) -> tuple[int, int, list[int]] | None:
    """Return the columns of wavelengths and values, and those that say something, if there are."""
    axes = [i for i, label in enumerate(header) if label_words.is_wavelength(label)]
    keyed = [i for i, label in enumerate(header) if statements.field_of(label)]
    values = [i for i, label in enumerate(header) if i not in keyed and names_quantity(label)]
    if len(axes) != 1 or len(values) != 1 or label_words.band(header[axes[0]]) is not None:
        return None
    return axes[0], values[0], keyed


def _grouped(
    table: Iterator[Row], keyed: list[int], groups: dict[tuple[str, ...], array[int]]
) -> Iterator[Row]:
    """Pass rows on, and note which of them say the same: no text of a row is kept but once."""
    for number, row in enumerate(table):
        cells = tuple(row.fields[i].strip() for i in keyed if i < len(row.fields))
        groups.setdefault(cells, array("L")).append(number)
        yield row


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True
