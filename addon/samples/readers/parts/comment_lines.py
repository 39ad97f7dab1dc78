# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines above a table that begin with the comment mark of another program than ours.

MATLAB's and LaTeX's ``%``, Fortran's ``!``, ``//`` of C and ``;`` of configuration files. Taken for
names of columns, "% Wavelength Reflectance" would say that the values are percent.
"""

from __future__ import annotations

import itertools
from dataclasses import replace

from . import label_words, tables
from .document import Document

_MARKS = ("%", "!", "//", ";")
_SEARCHED = 400  # lines, as for the start of a table
_LONGEST = 200  # characters of a line that are looked at


def as_ours(document: Document) -> Document:
    """Return the document with ``#`` in the place of another mark, line by line.

    Only the lines at the top that begin so are comments; all lines keep their numbers.
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
