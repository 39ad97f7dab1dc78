# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""CGATS.17 (ISO 28178) text and its dialects.

ArgyllCMS's .ti3 and .sp, exports of i1Profiler, ColorPort, MeasureTool and ProfileMaker, Barbieri
Gateway, Spectrolino, and this package's own readings. See `cgats_columns` on scales.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....support.shown_text import CELLS, ESCAPED, from_cell
from ...sample import Sample, check_spectrum
from ..parts import (
    cgats_columns,
    cgats_tables,
    cgats_words,
    statements,
)
from ..parts import (
    tables as _table,
)
from ..parts.cgats_columns import Columns, Spectrum
from ..parts.cgats_tables import Table
from ..parts.cgats_words import Words
from ..parts.document import Document, quote

NAME = "CGATS file"
ENDINGS = ("cgats", "ti3", "sp", "it8", "txt")
PRIORITY = 80

_FORMAT = re.compile(r"^[ \t]*BEGIN_DATA(?:_FORMAT)?\b", re.MULTILINE | re.IGNORECASE)
_CONDITION = re.compile(r"M[0-3]", re.IGNORECASE)


@dataclass
class _Read:
    """A table with its numbers."""

    fields: list[str]
    columns: Columns
    words: Words
    block: _table.Block
    notes: tuple[str, ...]
    escaped: bool


def sniff(document: Document) -> bool:
    """Return whether the head has the marks of the format, or a signature line."""
    head = document.head_text
    first = head[:200].lstrip().partition("\n")[0].strip()
    return bool(cgats_tables.SIGNATURE.fullmatch(first) or _FORMAT.search(head))


def read(document: Document) -> list[Sample]:
    """Return one sample a record, in the order of the file.

    Raises
    ------
    InputError
        No table holds reflectance spectra, the tables are damaged, or a spectrum is not one
        (`check_spectrum`).
    """
    found: list[_Read] = []
    refused: list[Exception] = []
    others: list[str] = []  # what tables without spectra have
    for table in cgats_tables.tables(document):
        fault = cgats_words.fault(document, table)
        if fault:
            refused.append(fault)
            continue
        columns = cgats_columns.find(document, table)
        if columns.spectra:
            found.append(_numbers(document, table, columns))
        else:
            others.append(f"at line {table.line}")
    if not found:
        raise refused[0] if refused else _no_spectra(document, bool(others))
    if refused:
        others.append(f"{len(refused)} with other quantities")
    left = (f"Tables without reflectance were not read: {', '.join(others)}.",) if others else ()
    conditions = {condition for one in found for condition in _conditions(one)}
    samples: list[Sample] = []
    for one in found:
        samples += _samples(document, one, left, several=len(conditions) > 1)
    return samples


def emission(document: Document) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what a lamp sends: nanometers, and power on the file's scale.

    Raises
    ------
    InputError
        The tables are damaged, or do not hold one spectrum that they call an emission.
    """
    found: list[tuple[NDArray[np.float64], NDArray[np.float64]]] = []
    for table in cgats_tables.tables(document):
        columns = cgats_columns.find(document, table)
        if not (columns.spectra and cgats_words.is_light(table)):
            continue
        for _, nm, values in _columns(_numbers(document, table, columns)):
            found += [(nm if nm.ndim == 1 else nm[row], each) for row, each in enumerate(values)]
    if len(found) != 1:
        held = "no spectrum" if not found else f"{len(found)} spectra"
        raise document.error("", f"it holds {held} of light; give a file with one")
    return found[0]


def _no_spectra(document: Document, tables: bool) -> Exception:
    what = "no spectral data" if tables else "no table with data"
    return document.error("", f"this CGATS file has {what}; export the spectra of the samples")


def _numbers(document: Document, table: Table, columns: Columns) -> _Read:
    """Read the records of a table."""
    wanted = [i for spectrum in columns.spectra for i in (*spectrum.places, *spectrum.columns)]
    texts = [i for i in (columns.name, columns.condition) if i is not None]
    block = _table.numbers(
        document,
        table.rows,
        table.fields,
        wanted,
        [*texts, *columns.keyed, *columns.lab, *columns.xyz],
        decimal_comma=True,
    )
    _table.check_count(document, len(block.lines) * len(columns.spectra))
    notes = list(columns.notes)
    for key, count in (
        ("NUMBER_OF_FIELDS", len(table.fields)),
        ("NUMBER_OF_SETS", len(block.lines)),
    ):
        stated = table.last(key)
        if stated and cgats_columns.number(stated) != count:
            notes.append(f"{key} says {quote(stated)}, the table has {count}.")
    return _Read(
        table.fields,
        columns,
        cgats_words.read(table),
        block,
        tuple(notes),
        table.last(CELLS) == ESCAPED,
    )


def _conditions(one: _Read) -> set[str]:
    if one.columns.condition is not None:
        at = int(one.columns.name is not None)
        return {texts[at] for texts in one.block.texts}
    return {spectrum.condition or one.words.condition for spectrum in one.columns.spectra}


def _samples(
    document: Document, one: _Read, left: tuple[str, ...], *, several: bool
) -> Iterator[Sample]:
    words, columns, block = one.words, one.columns, one.block
    about = (*one.notes, *left)
    notes = (*words.notes, *about)
    scaled = list(_scaled(document, one))
    alone = len(block.lines) == 1
    for row, line in enumerate(block.lines):
        texts = iter(block.texts[row] if block.texts else ())
        name = next(texts) if columns.name is not None else ""
        name = from_cell(name) if one.escaped else name
        name = name or (document.path.stem if alone else f"{document.path.stem} {row + 1}")
        own = next(texts) if columns.condition is not None else ""
        cells = [next(texts) for _ in columns.keyed]
        lab = _triple(document, line, texts, one.fields, columns.lab)
        xyz = _triple(document, line, texts, one.fields, columns.xyz)
        for spectrum, nm, values in scaled:
            stated = _stated(one, cells, spectrum.specular)
            condition = own if _CONDITION.fullmatch(own) else spectrum.condition or words.condition
            yield Sample(
                name=f"{name} ({condition})" if several and condition else name,
                wavelengths=nm if nm.ndim == 1 else nm[row],
                values=values[row],
                kind="reading",
                instrument=stated.get("instrument", words.instrument),
                geometry=stated.get("geometry", words.geometry),
                aperture=words.aperture,
                specular=stated.get("specular", words.specular),
                surface=stated.get("surface", ""),
                gloss=stated.get("gloss", ()),
                source=str(document.path),
                position=f"line {line}",
                device=words.device,
                condition=condition,
                illuminant=words.illuminant,
                observer=words.observer,
                lab=lab,
                xyz=xyz and (xyz[0] / 100, xyz[1] / 100, xyz[2] / 100),  # CGATS: white has Y = 100
                notes=(*stated["notes"], *about) if stated else notes,
            )


def _stated(one: _Read, cells: list[str], specular: str) -> dict[str, Any]:
    """Return fields of `Sample` from the columns of a record, with its notes on the geometry.

    `specular` is what the names of the bands say.
    """
    keys = [one.fields[i] for i in one.columns.keyed]
    own: dict[str, Any] = {}
    for key, cell in zip(keys, cells, strict=True):
        own.update(statements.stated(key, cell))
    if specular:
        own["specular"] = specular
    if not own:
        return {}
    words = one.words
    measured = own.keys() & {"geometry", "specular", "angle", "aspecular"}
    before = {"geometry": words.geometry, "specular": words.specular} if measured else {}
    found = statements.finish({k: v for k, v in before.items() if v} | own)
    notes = found.get("notes", ())
    return found | {"notes": notes if measured else (*words.notes, *notes)}


def _scaled(
    document: Document, one: _Read
) -> Iterator[tuple[Spectrum, NDArray[np.float64], NDArray[np.float64]]]:
    """Return each spectrum's wavelengths, shape (bands,) or (rows, bands), and fractions.

    Whatever is wrong with them is said here, where the columns have names.
    """
    for spectrum, nm, values in _columns(one):
        labels = [one.fields[i] for i in spectrum.columns]
        calm = (values.min(axis=1) >= 0.0) & (values.max(axis=1) <= 1.0) if values.size else []
        for row, line in enumerate(one.block.lines):
            # Samples check themselves; the first for its wavelengths, others for what stands out.
            if row == 0 or nm.ndim > 1 or not calm[row]:
                check_spectrum(
                    nm if nm.ndim == 1 else nm[row],
                    values[row],
                    f"{document.path}, line {line}",
                    lambda band: f"column {quote(labels[band])}",  # noqa: B023
                )
        yield spectrum, nm, values


def _columns(one: _Read) -> Iterator[tuple[Spectrum, NDArray[np.float64], NDArray[np.float64]]]:
    """Return the same, unchecked."""
    start = 0
    for spectrum in one.columns.spectra:
        size = len(spectrum.columns)
        nm = spectrum.wavelengths
        if nm is None:
            nm = one.block.values[:, start : start + size].copy()
            start += size
        values = one.block.values[:, start : start + size] / spectrum.scale
        start += size
        nm.flags.writeable = values.flags.writeable = False
        yield spectrum, nm, values


def _triple(
    document: Document, line: int, texts: Iterator[str], fields: list[str], columns: list[int]
) -> tuple[float, float, float] | None:
    """Return the file's own color, or None where it has none."""
    if not columns:
        return None
    found = []
    for column in columns:
        text = next(texts)
        value = cgats_columns.number(text)
        if not math.isfinite(value) and any(character.isdigit() for character in text):
            raise document.error(
                f"line {line}, column {quote(fields[column])}",
                f"{quote(text)} is not a number; correct it or leave it empty",
            )
        found.append(value)
    return (found[0], found[1], found[2]) if all(map(math.isfinite, found)) else None
