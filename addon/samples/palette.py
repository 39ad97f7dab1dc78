# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's own list of colors: a name and L*a*b*, an sRGB code or a spectrum in each row.

Catalogs of colors may not be handed on, and none comes with the extension; who has one as a table
can look for samples that come near.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.errors import DomainError, InputError
from ..colorimetry import cie_tables, tristimulus
from . import readers, swatches
from .readers import open_document
from .readers.parts import label_words
from .readers.parts.document import Document, quote
from .readers.parts.table_start import LEAST_BAND
from .sample import Sample

_HEX = re.compile(r"#?([0-9a-f]{6})", re.IGNORECASE)
_SAYS = re.compile(r"#\s*(illuminant|observer)\s*[:=]\s*(\S+)", re.IGNORECASE)
_DELIMITERS = "\t;,"
_CODES = {"hex", "html", "srgb", "rgb", "code"}
_NAMES = ("name", "color", "colour", "number", "id", "ral", "ncs")
LIGHTNESS = (0.0, 100.0)
_LARGEST = 200.0
"""Of a* and b*, beyond any surface's color."""


@dataclass(frozen=True)
class Row:
    """One color of a palette.

    Parameters
    ----------
    name
        As in the file.
    lab
        CIE L*a*b*.
    illuminant, observer
        What it was computed for, of `cie_tables`.
    sample
        Its spectrum, or None where the file has none.
    """

    name: str
    lab: tuple[float, float, float]
    illuminant: str = "D65"
    observer: int = 2
    sample: Sample | None = None


def read(path: Path) -> tuple[Row, ...]:
    """Return the rows of a palette, in the file's order.

    Parameters
    ----------
    path
        A table with commas, semicolons or tabs, with a header or without: a name, and either three
        numbers L*, a* and b*, or a code such as ``#b0a090``. Its L*a*b* are for D65 and 2° unless
        lines such as ``# illuminant: D50`` and ``# observer: 10`` say otherwise. Or any file of
        spectra, in each format that samples are read from.

    Raises
    ------
    InputError
        The file cannot be opened or is neither; the message names the line.
    """
    document = open_document(path)
    says = {word.lower(): value for word, value in _SAYS.findall(document.head_text)}
    try:
        light = checked_light(says.get("illuminant", "D65"), says.get("observer", "2"))
    except DomainError as error:
        raise document.error("comments", str(error)) from None
    lines = [
        (number, line)
        for number, line in enumerate(document.text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("# ")
    ]
    delimiter = next((d for d in _DELIMITERS if lines and d in lines[0][1]), ",")
    table = [(number, _cells(document, number, line, delimiter)) for number, line in lines]
    columns = _columns([cells for _, cells in table[:2]], delimiter)
    if columns is None:
        return _of_spectra(document, readers.read(path))
    name, places, first = columns
    found = []
    for number, cells in table[first:]:
        given = [cells[place] if place < len(cells) else "" for place in places]
        lab = _lab(given, delimiter)
        if lab is None:
            msg = f"{quote(', '.join(given))} is no color; give L*, a* and b* or #rrggbb"
            raise document.error(f"line {number}", msg)
        label = cells[name] if name < len(cells) else ""
        of_code = len(places) == 1
        found.append(Row(label or f"line {number}", lab, *(("D65", 2) if of_code else light)))
    if not found:
        raise document.error("", "no color is in it; give a name and L*, a* and b* in each row")
    return tuple(found)


def find(rows: Sequence[Row], name: str) -> Row:
    """Return the row that is called so, in any case; else the only one with it in its name.

    Raises
    ------
    InputError
        There is none, or several.
    """
    wanted = name.strip().casefold()
    found = [row for row in rows if row.name.casefold() == wanted]
    found = found or [row for row in rows if wanted in row.name.casefold()]
    if len(found) == 1:
        return found[0]
    names = ", ".join(row.name for row in (found or rows)[:5])
    if found:
        msg = f"The palette has several rows with {name!r}: {names}; give the whole name."
    else:
        msg = f"The palette has no row {name!r}; it begins with {names}."
    raise InputError(msg)


def checked_light(illuminant: str, observer: str | int) -> tuple[str, int]:
    """Return illuminant and observer that a user wrote, such as ``"d50"`` and ``"10°"``.

    Raises
    ------
    DomainError
        They are not known.
    """
    named = {name.casefold(): name for name in cie_tables.ILLUMINANTS}
    light = named.get(illuminant.strip().casefold())
    degrees = str(observer).strip().rstrip("°")
    if light is None:
        names = ", ".join(named.values())
        msg = f"illuminant {quote(illuminant)} is not known; choose one of {names}"
        raise DomainError(msg)
    if degrees not in map(str, cie_tables.OBSERVERS):
        msg = f"observer {quote(str(observer))} is not known; choose 2 or 10"
        raise DomainError(msg)
    return light, int(degrees)


def of_text(text: str) -> tuple[float, float, float] | None:
    """Return L*a*b* that a user wrote, as ``L, a, b`` or ``#rrggbb``; None where it is neither."""
    cells = [text.strip()] if is_code(text) else re.split(r"[;\s]+|,\s*", text.strip())
    return _lab(cells, ";")


def is_code(text: str) -> bool:
    """Whether a user wrote a color as ``#rrggbb``, whose light is D65."""
    return _HEX.fullmatch(text.strip()) is not None


def of_sample(sample: Sample) -> Row:
    """Return a sample's color under D65 for the 2° observer as a row.

    Raises
    ------
    DomainError
        It has no color, or its bands leave out too much of it.
    """
    if not sample.has_color:
        raise DomainError(f"{sample.name!r} has no color; choose another sample.")
    tristimulus.weights(sample.wavelengths)
    _, [lab] = swatches.of_samples([sample])
    lightness, a, b = lab.tolist()
    return Row(sample.name, (lightness, a, b), sample=sample)


def _of_spectra(document: Document, samples: Sequence[Sample]) -> tuple[Row, ...]:
    found = []
    for sample in samples:
        try:
            found.append(of_sample(sample))
        except DomainError as error:
            msg = f"{document.path}, sample {quote(sample.name)}: {error}"
            raise InputError(msg) from error
    return tuple(found)


def _cells(document: Document, number: int, line: str, delimiter: str) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter))]
    except csv.Error:
        raise document.error(
            f"line {number}",
            "one of its fields is too long for a color; shorten it or leave it out",
        ) from None


def _columns(top: list[list[str]], delimiter: str) -> tuple[int, list[int], int] | None:
    """Find the columns of names and of colors, and the first row; None of a table of spectra."""
    if not top:
        return None
    header = [re.sub(r"\(.*\)|[*_\s]|cie", "", cell.casefold()) for cell in top[0]]
    name = next((header.index(word) for word in _NAMES if word in header), 0)
    if {"l", "a", "b"} <= set(header):
        return name, [header.index(each) for each in "lab"], 1
    code = next((header.index(word) for word in _CODES if word in header), None)
    if code is not None and len(top) > 1 and _HEX.fullmatch("".join(top[1][code : code + 1])):
        return name, [code], 1
    if len(label_words.bands_of(top[0], LEAST_BAND)) > 2:
        return None  # three values below three wavelengths are no L*a*b*
    for first, cells in enumerate(top):
        if len(cells) == 4 and _lab(cells[1:], delimiter) is not None:
            return 0, [1, 2, 3], first
        if len(cells) == 2 and _HEX.fullmatch(cells[1]):
            return 0, [1], first
    return None


def _lab(cells: Sequence[str], delimiter: str) -> tuple[float, float, float] | None:
    code = _HEX.fullmatch(cells[0]) if len(cells) == 1 else None
    if code:
        lightness, a, b = swatches.to_lab(np.array(list(bytes.fromhex(code[1]))) / 255).tolist()
        return lightness, a, b
    try:
        numbers = [
            float(cell if delimiter == "," else cell.replace(",", ".").replace("−", "-"))
            for cell in cells
        ]
    except ValueError:
        return None
    if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
        return None
    lightness, a, b = numbers
    if not LIGHTNESS[0] <= lightness <= LIGHTNESS[1] or max(abs(a), abs(b)) > _LARGEST:
        return None
    return lightness, a, b
