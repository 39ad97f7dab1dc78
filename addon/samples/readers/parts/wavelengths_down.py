# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables with one sample a column: the wavelengths run down."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....support.shown_text import from_cell
from ...sample import BRIGHTEST, Sample
from . import (
    beside,
    label_words,
    series,
    shapes,
    statements,
    tables,
)
from .document import OTHER_QUANTITIES, Document, quote
from .scale import nanometers, scale
from .tables import EXPECTED, Row
from .wavelengths_across import not_read

# A single column with such a name says what is in it, not which sample it is.
_QUANTITY = re.compile(
    r"%?\s*(?:reflectance|reflect\.?|refl\.?|reflectance[ _]factor|reflectivity|albedo|reading|"
    r"reflexion(?:sgrad)?|remission|r[ée]flectanc\w*|reflectancia|riflettanza|reflet[âa]ncia|反射率|"
    r"отражени[ея]|emissivity|values?|r|y|spectrum)?"
    r"[\s_]*[\[(]?(?:%|％|pct|percent|fraction|-|1)?[\])]?",
    re.IGNORECASE,
)
_NEUTRAL = re.compile(r"values?|y|spectrum|%", re.IGNORECASE)
# What stands beside a spectrum and is none.
_ASIDE = re.compile(r"index|no\.?|chan(?:nel)?s?\.?\s*#?|#|unnamed: 0", re.IGNORECASE)
# Names of columns that say what they are only together; their marks and brackets do not count.
_TOGETHER = {
    frozenset("xyz"): "color matching functions",
    frozenset("rgb"): "sensitivities of a camera",
    frozenset("lms"): "sensitivities of the eye",
    frozenset("nk"): "refractive indices of a material",
}
# Names of a single column that say what it holds; of several, they may be samples.
_ALONE = {
    "a": "absorbance (a logarithm)",
    "od": "optical density (a logarithm)",
    "t": "transmittance (light through the sample)",
    "intensity": "an intensity, and nothing says of what",
    "signal": "a signal, and nothing says of what",
    "ks": "Kubelka-Munk values (K/S)",
    "km": "Kubelka-Munk values (K/S)",
}
_PRIMARIES = {"red", "green", "blue"}  # three samples, or what a camera sees
_MARKS = re.compile(r"[^a-z]|bar|lambda|cie|_?\d+", re.IGNORECASE)
# Not A and C alone, nor F2: samples are called so.
_ILLUMINANT = re.compile(
    r"(?:cie|iso)?[ _-]*(?:D(?:50|55|60|65|75)|iso[ _-]?7589|std[ _-]?illum.*)", re.IGNORECASE
)
# What spectrometers' software saves beside a reflectance that it calls so.
_RAW = re.compile(r"dark|ref(?:erence)?|white(?: ref\w*)?|sample|raw|target", re.IGNORECASE)


def read(
    document: Document,
    said: label_words.Comments,
    fields: dict[str, Any],
    header: list[str],
    table: Iterator[Row],
    above: Mapping[int, dict[str, Any]],
) -> list[Sample]:
    """Return one sample a column.

    Parameters
    ----------
    document
        The file.
    said, fields
        What comments and the lines above the table say.
    header
        The names of the columns.
    table
        The rows below.
    above
        What rows above the names of the columns say of each.
    """
    if len(header) < 2:
        raise document.error(
            "line 1", f"there is only one column; wavelengths need values beside them: {EXPECTED}"
        )
    labels = [label or f"column {i}" for i, label in enumerate(header, start=1)]
    axis = next((i for i, label in enumerate(header) if label_words.is_wavelength(label)), 0)
    units, own, table = _rows_above_numbers(header, axis, table)
    columns, emitting, unread = _columns(document, header, labels, units, axis)
    _check_kind(document, said, [header[i] for i in columns], [header[i] for i in emitting])
    if said.kind != "emissivity":
        _refuse_others(document, [header[i] for i in columns], said.reflects)
    block = tables.numbers(document, table, labels, [axis, *columns], decimal_comma=True, gaps=1)
    seen = said.kind != "emissivity" and not emitting
    nm = nanometers(document, said, block.values[:, 0], [header[axis], units[axis]], seen)
    values = block.values[:, 1:].T
    columns_read = columns
    again = _axes_again(document, labels, columns, nm, values)
    if again:
        unread = [*unread, *(labels[columns[i]] for i in again)]
        values = np.delete(values, again, axis=0)
        columns = [column for i, column in enumerate(columns) if i not in again]
    if len(columns) == 3 and shapes.are_of_the_eye(nm, values):
        raise document.not_reflectance("", "color matching functions or sensitivities of the eye")
    if {header[i].lower() for i in columns} == _PRIMARIES and shapes.all_vanish(values):
        raise document.not_reflectance("", _TOGETHER[frozenset("rgb")])
    if len(columns) == 3 and not any(header[i] for i in columns) and shapes.all_vanish(values):
        raise document.error(
            "",
            "three columns without names that all come down to nothing are the sensitivities of a "
            "camera, not reflectance; if they are samples, give the columns names",
        )
    samples = []
    for i, column in enumerate(columns):
        label = header[column]
        if not label and np.isnan(values[i]).all():
            continue  # an empty column without a name
        place = f"column {quote(label)}" if label else labels[column]
        sign = "%" if columns_read.index(column) + 1 in block.percent else ""
        percent = scale(document, said, place, [label, units[column], sign])
        found = series.bands(
            nm,
            values[i] / percent,
            f"{document.path}, {place}",
            lambda band: f"line {block.lines[band]}",
        )
        known = {**fields, **above.get(column, {}), **own.get(column, {})}
        name = from_cell(label) if said.escaped else label
        generic = len(columns) == 1 and _QUANTITY.fullmatch(label)
        alone = known.get("name") or statements.name_in_comments(said) or document.path.stem
        samples.append(
            statements.make(
                document,
                replace(said, kind="emissivity") if column in emitting else said,
                known,
                found,
                name=alone if generic else name or f"{document.path.stem} {column}",
                position=place,
                notes=not_read(unread),
            )
        )
    return samples


def _axes_again(
    document: Document,
    labels: list[str],
    columns: list[int],
    nm: NDArray[np.float64],
    values: NDArray[np.float64],
) -> list[int]:
    """Return which columns give the wavelengths once more, in another unit.

    Raises
    ------
    InputError
        One has wavelengths of its own, as where each spectrum has.
    """
    found = []
    for i, column in enumerate(columns):
        unit = label_words.unit_of_wavelengths(labels[column])
        if not label_words.is_wavelength(labels[column]) or not nm.size:
            continue
        if unit and np.allclose(label_words.to_nanometers(values[i], unit), nm, rtol=2e-3):
            found.append(i)
        elif (values[i] > BRIGHTEST).any():
            raise document.error(
                f"column {quote(labels[column])}",
                "it has wavelengths once more; save each spectrum with its wavelengths as a file, "
                "or leave that column out",
            )
    return found if len(found) < len(columns) else []


def names_quantity(label: str) -> bool:
    """Return whether a column's name says what is in it, and not which sample it is."""
    return bool(label and _QUANTITY.fullmatch(label))


def _check_kind(
    document: Document, said: label_words.Comments, names: list[str], emitting: list[str]
) -> None:
    """Refuse a table whose comment states another kind than the names of its columns."""
    reflecting = [name for name in names if series.says_reflectance(name)]
    wrong = emitting if said.kind == "albedo" else reflecting if said.kind == "emissivity" else []
    if wrong:
        raise document.error(
            f"column {quote(wrong[0])}",
            f"a comment says that the kind is {said.kind}; make the two agree",
        )


def _refuse_others(document: Document, names: list[str], reflects: bool) -> None:
    """Refuse a table whose columns together, or whose file's name alone, name another quantity."""
    together = _TOGETHER.get(frozenset(_MARKS.sub("", name).lower() for name in names), "")
    if not together and names[0] and all(map(_ILLUMINANT.fullmatch, names)):
        together = "emission (the spectrum of a light source)"
    if not together and len(names) == 1 and not reflects:
        together = _ALONE.get(names[0].lower().strip(" .%"), "")
    if together:
        quoted = ", ".join(map(quote, names))
        raise document.error(
            f"columns {quoted}",
            f"columns of these names hold {together}, not reflectance; if they are samples, give "
            "them longer names",
        )
    if any(name and not _NEUTRAL.fullmatch(name) for name in names):
        return
    other = series.other_quantity_of_name(document.path.stem)
    if _ILLUMINANT.fullmatch(document.path.stem):
        other = "emission"
    if other:
        what = OTHER_QUANTITIES.get(other, other)
        raise document.error(
            "",
            f"only the file's name says what the values are, and by it they are {what}, not "
            "reflectance; if they are, call their column 'reflectance'",
        )


def _columns(
    document: Document, header: list[str], labels: list[str], units: list[str], axis: int
) -> tuple[list[int], list[int], list[str]]:
    """Return the columns to read, those of them with emissivity, and the names of the others.

    Raises
    ------
    InputError
        There is none of the former.
    """
    rest = [i for i in range(len(header)) if i != axis]
    letters = beside.letters([header[i] for i in rest])
    others = {i: series.other_quantity(header[i]) or series.other_quantity(units[i]) for i in rest}
    others = {i: others[i] or letters.get(header[i], "") for i in rest}
    emitting = [i for i in rest if others[i] == "emissivity"]
    others |= dict.fromkeys(emitting, "")
    named = any(series.says_reflectance(header[i]) for i in rest)
    spread = beside.uncertainties([header[i] for i in rest])
    aside = {
        i
        for i in rest
        if len(rest) > 1
        and (
            _ASIDE.fullmatch(header[i])
            or header[i] in spread
            or (named and _RAW.fullmatch(header[i]))
            or (i < axis and not header[i])  # pandas writes its index without a name
        )
    }
    found = [i for i in rest if not others[i] and i not in aside]
    if not found:
        column = next((i for i in rest if others[i]), rest[0])
        raise document.not_reflectance(
            f"column {quote(labels[column])}", others[column] or "of another kind"
        )
    left = sorted(set(rest) - set(found))
    return found, emitting, [labels[i] for i in left if header[i] or others[i]]


def _rows_above_numbers(
    header: list[str], axis: int, table: Iterator[Row]
) -> tuple[list[str], dict[int, dict[str, Any]], Iterator[Row]]:
    """Return the units of the columns, what rows say of each, and the rows of numbers."""
    units = [""] * len(header)
    own: dict[int, dict[str, Any]] = {}
    for row in table:
        cells = [cell.strip() for cell in row.fields[: len(header)]]
        key = cells[axis] if axis < len(cells) else ""
        if label_words.is_unit_row(cells):
            units[: len(cells)] = cells
        elif statements.field_of(key):
            for i, cell in enumerate(cells):
                own.setdefault(i, {}).update(statements.stated(key, cell) if i != axis else {})
        else:
            return units, own, itertools.chain([row], table)
    return units, own, iter(())
