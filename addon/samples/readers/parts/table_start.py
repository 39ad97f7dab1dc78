# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a table begins below the lines that instruments and spreadsheets put above it."""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection
from typing import Any

from . import (
    label_words,
    series,
    statements,
    tables,
)
from .document import Document
from .tables import DELIMITERS, SPACES

_SEARCHED = 400  # lines; the longest preamble known has about 90
_ROWS_BETWEEN = 8  # between the names of columns and the first numbers
_ENOUGH = 64  # fields of a row
_WORDS_OF_A_TITLE = 2  # "Log(1/R)", "Transmittance [%]"; names of samples may be longer
_WORDS_OF_A_QUANTITY = 3  # "Reflectance in %"; a title goes on
_LONGEST = 4096  # characters of a line that decide what it is
LEAST_BAND = 100.0
"""Names of columns in nanometers start here: samples are called 1, 2, 3 more often than 100."""

_PAIR = re.compile(r"[^:=]{1,60}[:=]")
_VALUES_KEY = re.compile(
    r"units?\b|einheit|y[ -]?(?:axis|units?|label|data)?$|ordinate|measure\w* (?:type|quantity)",
    re.I,
)
_ORDINATE_KEY = re.compile(r"(?:ordinate|photometric|y[ _-])", re.I)
_KIND_KEY = re.compile(
    r"(?:(?:photometric|measure\w*|data|spectr\w*|scan|display)[ _-]?)?(?:mode|type)$|"
    r"quantity|values?$|title",
    re.I,
)
"""Keys whose values may say which quantity it is; they are no units."""
_PERCENT_ALONE = re.compile(
    r"[%％]\s*(?:r|refl\w*)?|(?:r|refl\w*)(?:\s*[/\[(]\s*|[\s_])?(?:[%％]|pct|percent)[\])]?", re.I
)
_OF_WHAT = re.compile(r"\s+(?:of|spectr\w*|values?|data|von|de)\b", re.I)
_VALUES_ARE = re.compile(r"(?:all )?(?:the )?(?:values|data|spectra|numbers) (?:are|is|in)\b", re.I)


def find_start(document: Document) -> int:
    """Return how many lines stand above the table.

    The table begins with a line that names bands or wavelengths, else with the line above the first
    rows of numbers, else with the first line.
    """
    content = [
        (i, line)
        for i, line in enumerate(itertools.islice(tables.lines(document), _SEARCHED))
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if content and content[0][0] == 0 and tables.announced(content[0][1]):
        del content[0]
    for k, (i, line) in enumerate(content):
        following = content[k + 1][1] if k + 1 < len(content) else ""
        if _names_bands(line, following, first=k == 0) or (
            _names_wavelengths(line, first=k == 0)
            and _numbers_follow(content[k + 1 : k + 1 + _ROWS_BETWEEN])
        ):
            return i
        mark = _numbers_by(line)
        if mark and (not following.strip() or _numbers_by(following)):
            return content[_header(content, k, mark)][0]
    return content[0][0] if content else 0


def above(
    document: Document, start: int, said: label_words.Comments, but: Collection[int] = ()
) -> dict[str, Any]:
    """Return what the lines above the table say of its samples; note units and kind in `said`.

    Lines in `but`, counted from 0, are about single columns.

    Raises
    ------
    InputError
        One of them says that the values are another quantity.
    """
    found: dict[str, Any] = {}
    free: dict[str, Any] = {}
    for number, line in enumerate(itertools.islice(tables.lines(document), start), start=1):
        text = line[:_LONGEST].strip().strip("\t;,").strip()
        if not text or number - 1 in but or (number == 1 and tables.announced(line)):
            continue
        is_comment = text.startswith("#")  # what comments say of samples, `label_words` found
        text = text.lstrip("# ")
        key, value = _key_and_value(text)
        said.reflects = said.reflects or series.says_reflectance(text)
        for field, content in statements.stated(key, value).items() if not is_comment else ():
            found.setdefault(field, content)
        if not statements.field_of(key) and not is_comment:
            free |= statements.mentioned(f"{key}: {value}")
        if unit := label_words.unit_of_abscissa(key, value) if not is_comment else "":
            said.wavelength_unit = unit
        if _KIND_KEY.match(key):
            _refuse_other(document, number, start, value)
            if said.scale is None and is_percent_reflectance(value):
                said.scale = 100.0
        if _ORDINATE_KEY.match(key) and value.strip().upper() in ("A", "ABS", "T"):
            other = "transmittance" if value.strip() in "tT" else "absorbance"
            raise document.not_reflectance(f"line {number}", other)
        if _VALUES_KEY.match(key):
            other = series.other_quantity(value)
            if other == "emissivity":
                said.kind = "emissivity"
            else:
                _refuse_other(document, number, start, value)
            if said.scale is None and "%" in value:
                said.scale = 100.0
        about = _OF_WHAT.split(text, maxsplit=1)[0]
        if _VALUES_ARE.match(text):
            _refuse_other(document, number, start, text)
        elif len(about.split()) <= _WORDS_OF_A_TITLE:
            _refuse_other(document, number, start, about)
        if said.scale is None and not is_comment and label_words.percent_of_values(text):
            said.scale = 100.0
    return found if found.keys() & statements.GEOMETRIES else found | free


def is_percent_reflectance(text: str) -> bool:
    """Return whether a text is a quantity in percent, such as ``%R`` and ``Reflexion [%]``."""
    text = text[:_LONGEST].strip()
    return bool(_PERCENT_ALONE.fullmatch(text)) or (
        len(text.split()) <= _WORDS_OF_A_QUANTITY
        and series.says_reflectance(text)
        and label_words.says_percent(text)
    )


def _refuse_other(document: Document, number: int, start: int, text: str) -> None:
    """Refuse a table whose lines above it name another quantity, if no column says reflectance."""
    other = series.other_quantity(text)
    if other and other != "emissivity" and not _header_says_reflectance(document, start):
        raise document.not_reflectance(f"line {number}", other)


def _header_says_reflectance(document: Document, start: int) -> bool:
    """Return whether a column is reflectance, whatever unit the raw columns beside it have."""
    header = next(itertools.islice(tables.lines(document), start, None), "")
    return series.says_reflectance(header[:_LONGEST])


def _key_and_value(text: str) -> tuple[str, str]:
    for mark in DELIMITERS:  # "Geometry,di:8°": the colon is the value's
        key, found, value = text.partition(mark)
        if found and mark != SPACES and statements.field_of(key):
            return key.strip(' "'), value.strip("\t;, ")
    pair = _PAIR.match(text)
    if pair:
        return pair[0][:-1].strip(' "'), text[pair.end() :].strip("\t;, ")
    for mark in DELIMITERS:
        key, found, value = text.partition(mark)
        if found and mark != SPACES:
            return key.strip(' "'), value.strip("\t;, ")
    return "", text


def _cells(line: str, mark: str, longest: int | None = _LONGEST) -> list[str]:
    line = line[:longest]
    cells = line.split() if mark == SPACES else line.split(mark)
    cells = [cell.strip().strip('"').strip() for cell in cells]
    while cells and not cells[-1]:
        cells.pop()
    return cells


def _names_wavelengths(line: str, *, first: bool) -> bool:
    return any(
        len(cells) > 1
        and not _is_number(cells[0])
        and any(map(label_words.is_wavelength, cells[:3]))
        and (first or not label_words.is_unit_row(cells))  # names stand above their units
        for cells in (_cells(line, mark) for mark in (*DELIMITERS, "|"))
    )


def _names_bands(line: str, following: str, *, first: bool) -> bool:
    for mark in DELIMITERS:
        cells = _cells(line, mark)
        found = label_words.bands_of(cells, LEAST_BAND)
        if len(found) < 2 or (not first and _is_number(cells[0])):
            continue
        plain = all(_is_number(cell) for cell in cells[1:])
        ordered = label_words.are_in_order(cells, LEAST_BAND)
        # Two numbers may be a date: the row below has to have as many fields.
        fits = first and len(_cells(following, mark)) in (len(cells), len(cells) + 1)
        if ordered and (len(found) > 2 or fits or not plain):
            return True
    return False


def _numbers_follow(content: list[tuple[int, str]]) -> bool:
    """Return whether a row of numbers comes next, or after units and what is said of samples."""
    for _, line in content:
        rows = [cells for mark in DELIMITERS if (cells := _cells(line, mark))]
        if any(_is_number(cells[0]) for cells in rows):
            return True
        if not any(label_words.is_unit_row(cells) or _is_keyed(cells) for cells in rows):
            return False
    return False


def _is_keyed(cells: list[str]) -> bool:
    return bool(cells) and statements.field_of(cells[0]) not in ("", "name")


def _numbers_by(line: str) -> str:
    """Return the delimiter by which a line is a row of numbers, or nothing."""
    for mark in DELIMITERS:
        cells = _cells(line, mark)
        if len(cells) > 1 and _is_number(cells[0]):
            del cells[_ENOUGH:]
            rest = [cell for cell in cells[1:] if not tables.is_missing(cell)]
            if rest and all(map(_is_number, rest)):
                return mark
    return ""


def _header(content: list[tuple[int, str]], k: int, mark: str) -> int:
    """Return which line begins the table whose first row of numbers is line `k`."""
    if k == 0:
        return 0
    above = k - 1
    while above and (
        label_words.is_unit_row(cells := _cells(content[above][1], mark)) or _is_keyed(cells)
    ):
        above -= 1
    line = content[above][1]
    if _PAIR.match(line):
        return k
    columns, names = len(_cells(content[k][1], mark, None)), len(_cells(line, mark, None))
    return above if names == columns or (mark == SPACES and names > 1) else k


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return "_" not in cell
