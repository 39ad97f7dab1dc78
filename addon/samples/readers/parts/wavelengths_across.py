# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables with one sample a row: the names of the columns are the bands."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from .....core.numerics.arrays import Array
from ....support.shown_text import from_cell
from ...sample import Sample
from . import (
    label_words,
    name_marks,
    series,
    statements,
    tables,
)
from .document import Document, plain, quote
from .scale import nanometers, of_row, scale, tells
from .table_start import LEAST_BAND, is_percent_reflectance
from .tables import Row

_NAME_COLUMN = re.compile(
    r"(?:(?:sample|data)[ _-]?)?(?:name|label)|user color name|sample", re.IGNORECASE
)
_ID_COLUMN = re.compile(r"(?:sample[ _-]?)?(?:id|index|no\.?|number)", re.IGNORECASE)
_Part = tuple[str, list[int], Array, Array]
"""What the bands' names say of the measurement, the places among the bands, wavelengths, values."""

_NAMED = 8  # how many of the columns not read a note names


def read(
    document: Document,
    said: label_words.Comments,
    fields: dict[str, Any],
    header: list[str],
    line: int,
    table: Iterator[Row],
) -> list[Sample]:
    """Return one sample a row.

    Parameters
    ----------
    document
        The file.
    said, fields
        What comments and the lines above the table say.
    header, line
        The names of the columns, and their line.
    table
        The rows below.
    """
    bands = [i for i, label in enumerate(header) if (label_words.band(label) or 0) >= LEAST_BAND]
    bands = bands or label_words.small_bands(said, header)
    inside = set(bands)
    others = [i for i in range(len(header)) if i not in inside]
    name = next((i for i in others if _NAME_COLUMN.fullmatch(header[i])), None)
    if name is None:
        name = next((i for i in others if statements.field_of(header[i]) == "name"), None)
    if name is None:
        name = next((i for i in others if _ID_COLUMN.fullmatch(header[i])), None)
    keyed = [i for i in others if i != name and statements.field_of(header[i])]
    color, light = statements.color_columns(header)
    if name is None:
        name = min(set(others) - {*keyed, *color}, default=None)
    first = "" if 0 in bands or statements.field_of(header[0]) else header[0]
    other = series.other_quantity(first)
    if other == "emissivity":
        said = replace(said, kind="emissivity")
    elif other:
        raise document.not_reflectance(f"line {line}, column {quote(header[0])}", other)
    telling = [i for i in others if i not in (name, *keyed, *color) and tells(header[i])]
    texts = [*([] if name is None else [name]), *keyed, *color, *telling]
    unread = [header[i] for i in sorted(set(others) - set(texts)) if header[i]]
    over = [label for label in unread if is_percent_reflectance(label)]  # a heading over the bands
    unread = [label for label in unread if label not in over]
    block = tables.numbers(document, table, header, bands, texts, decimal_comma=True, gaps=0)
    marked = {name_marks.of_band(header[i])[1] for i in bands}
    tables.check_count(document, len(block.lines) * len(marked))
    every = np.array([label_words.band(header[i]) for i in bands], dtype=np.float64)
    stated = [header[0]] if 0 not in bands else []
    if label_words.unit_of_wavelengths(header[bands[0]]) == "":
        every = nanometers(document, said, every, stated)
    # Of the other columns' names only the corner's, and a heading, are about the values below.
    values = block.values
    signs = ["%"] if block.percent else []
    if 0 < len(block.percent) < len(bands):
        raise document.error(
            f"line {line}",
            "some bands have percent signs and others have none; give all of them one",
        )
    labels = [*over, *signs, *(header[i] for i in sorted({0, *bands}))]
    one = scale(document, said, f"line {line}", labels)
    values /= one
    parts = _parts([header[i] for i in bands], every, values)
    of_columns = not_read(unread)
    samples: list[Sample] = []
    left: dict[str, str] = {}
    above = ""
    for i, row in enumerate(block.lines):
        cells = block.texts[i] if texts else []
        if name is not None and keyed:
            # Spreadsheets merge the name of several readings: its cell is empty in all but one.
            cells = [cells[0] or above, *cells[1:]]
            above = cells[0]
        telling_cells = cells[len(texts) - len(telling) :]
        if name is not None and is_percent_reflectance(cells[0]):
            telling_cells = [*telling_cells, "%"]
        divisor, other = of_row(telling_cells, one != 1.0)
        other = other or series.other_quantity_of_name(cells[0] if name is not None else "")
        if other and other != "emissivity":
            left.setdefault(other, f"line {row}")
            continue
        own = {**fields, **light} if color else dict(fields)
        named = 0 if name is None else 1
        for key, text in zip(keyed, cells[named:], strict=False):
            own.update(statements.stated(header[key], text))
        lab = _lab(document, row, header, color, cells[named + len(keyed) :][: len(color)])
        if lab:
            own["lab"] = lab
        alone = document.path.stem if len(block.lines) == 1 else f"{document.path.stem} {i + 1}"
        for mark, columns, nm, rows in parts:
            found = series.bands(
                nm,
                rows[i] if divisor == 1.0 else rows[i] / divisor,
                f"{document.path}, line {row}",
                lambda band: f"column {quote(header[bands[columns[band]]])}",  # noqa: B023
            )
            samples.append(
                statements.make(
                    document,
                    said,
                    own | _of_mark(mark),
                    found,
                    name=_name(cells[0], said.escaped) if name is not None and cells[0] else alone,
                    position=f"line {row}",
                    notes=of_columns,
                )
            )
    if left and not samples:
        other, place = next(iter(left.items()))
        raise document.not_reflectance(place, other)
    if not left:
        return samples
    note = f"Rows left out, as they are no reflectance: {_of_what(left)}."
    return [replace(sample, notes=(*sample.notes, note)) for sample in samples]


def _of_what(left: dict[str, str]) -> str:
    return ", ".join(f"from {place} on {other}" for other, place in left.items())


def _of_mark(mark: str) -> dict[str, Any]:
    """Return what the mark of the bands' names says, in the fields of `statements.stated`."""
    if not mark:
        return {}
    if mark in ("SCI", "SCE"):
        return dict(statements.stated("specular", mark))
    return {"aspecular" if name_marks.aspecular_of(mark) is not None else "angle": mark}


def _parts(labels: list[str], nm: Array, values: Array) -> list[_Part]:
    """Return the spectra of which each row has one: SCI and SCE, angles, or just one.

    So that no sample copies them, the arrays are read-only.
    """
    marks = [name_marks.of_band(label)[1] for label in labels]
    found: list[_Part] = []
    for mark in dict.fromkeys(marks):
        at = [i for i, own in enumerate(marks) if own == mark]
        whole = len(at) == len(marks)
        part = (mark, at, nm if whole else nm[at], values if whole else values[:, at])
        part[2].flags.writeable = part[3].flags.writeable = False
        found.append(part)
    return found


def not_read(labels: list[str]) -> tuple[str, ...]:
    """Return the note that names columns left out, if there are any."""
    if not labels:
        return ()
    more = f" and {len(labels) - _NAMED} more" if len(labels) > _NAMED else ""
    return (f"Columns not read: {plain(', '.join(labels[:_NAMED]))}{more}.",)


def _lab(
    document: Document, line: int, header: list[str], columns: list[int], cells: list[str]
) -> tuple[float, float, float] | None:
    """Return the file's own color, or None where the row has none."""
    if not columns or any(map(tables.is_missing, cells)):
        return None
    places = [f"line {line}, column {quote(header[column])}" for column in columns]
    lightness, a, b = (
        series.number(document, place, cell) for place, cell in zip(places, cells, strict=True)
    )
    return lightness, a, b


def _name(cell: str, escaped: bool) -> str:
    return from_cell(cell) if escaped else cell
