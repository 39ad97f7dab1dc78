# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines around a table that are comments without our mark.

Above it those with the mark of another program:
MATLAB's and LaTeX's ``%``, Fortran's ``!``, ``//`` of C and ``;`` of configuration files. Taken for
names of columns, "% Wavelength Reflectance" would say that the values are percent. Below it what
instruments and spreadsheets add: ``Instrument: CM-700d``, or anything in words behind a blank line.
"""

from __future__ import annotations

import itertools
import re
from dataclasses import replace

from . import label_words, statements, tables
from .document import Document

_MARKS = ("%", "!", "//", ";")
_SEARCHED = 400  # lines, as for the start of a table
_TAIL = 2**15  # characters of the end that are searched
_PAIR = re.compile(r"[^\W\d_][^:=,;\t]{0,60}[:=]")
_NUMBER = re.compile(r"[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?%?")
_CELLS = re.compile(r"[\t;, ]+")
_LONGEST = 200  # characters of a line that are looked at


def as_ours(document: Document) -> Document:
    """Return the document with ``#`` before the comments around its table.

    All lines keep their numbers.
    """
    return _below(_above(document))


def _below(document: Document) -> Document:
    """Return the document with the lines in words at its end as comments.

    They begin with one that has a key, or behind a blank line: names of samples, whose numbers are
    missing, do neither.
    """
    text = document.text
    tail = text[-_TAIL:].split("\n")
    if len(text) > _TAIL:
        del tail[0]  # it begins somewhere
    first = len(tail)
    while first and (_is_blank(tail[first - 1]) or _is_words(tail[first - 1])):
        first -= 1
    found = tail[first:]
    starts = (i for i, line in enumerate(found) if _has_key(line))
    blank = (i for i, line in enumerate(found) if _is_blank(line))
    start = min(next(starts, len(found)), next(blank, len(found)))
    if first == 0 or not any(map(str.strip, found[start:])):
        return document
    ours = [line if _is_blank(line) else f"# {line}" for line in found[start:]]
    kept = len(text) - len("\n".join(found[start:]))
    return replace(document, data=(text[:kept] + "\n".join(ours)).encode())


def _is_blank(line: str) -> bool:
    return not line.strip(' \t;,"')


def _is_words(line: str) -> bool:
    """Return whether a line begins with a letter and has one number at most."""
    if not line.lstrip('"[(# \t')[:1].isalpha():
        return False
    cells = _CELLS.split(line[:_LONGEST])
    return sum(bool(_NUMBER.fullmatch(cell.strip('"'))) for cell in cells) <= 1


def _has_key(line: str) -> bool:
    text = line[:_LONGEST].lstrip(' "')
    key = re.split("[:=;,\t]", text, maxsplit=1)[0]
    return bool(statements.field_of(key.strip(' "')) or _PAIR.match(text))


def _above(document: Document) -> Document:
    """Return the document with ``#`` in the place of another mark, line by line.

    Only the lines at the top that begin so are comments.
    """
    if not document.head_text.lstrip().startswith(_MARKS):
        return document
    top = list(itertools.islice(tables.lines(document), _SEARCHED))
    others = (line for line in top if line.strip() and not line.lstrip().startswith(_MARKS))
    below = next(others, "")
    found: list[str] = []
    for line in top:
        text = line.lstrip()
        mark = next((mark for mark in _MARKS if text.startswith(mark)), "")
        if text and not text.startswith("#") and not _is_comment(text[:_LONGEST], mark, below):
            break
        found.append("#" + text[len(mark) :].lstrip(mark or None) if mark else line)
    if not any(found):
        return document
    rest = document.text.split("\n", len(found))[len(found) :]
    return replace(document, data="\n".join([*found, *rest]).encode())


def _is_comment(text: str, mark: str, below: str) -> bool:
    """Return whether a line is one, and not the names of columns: ``%R400;%R410``, ``;A;B``."""
    if mark == "%":
        rest = text[1:]
        return rest[:1] in ("", "%", " ", "\t") or label_words.is_wavelength(rest)
    if mark == ";":
        return ";" not in below[:_LONGEST]
    return bool(mark)
