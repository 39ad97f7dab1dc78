# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which delimiter a table has: the one that gives the first rows equally many columns."""

from __future__ import annotations

import csv
import itertools
from collections import Counter

from . import tables
from .document import Document
from .tables import DELIMITERS, EXPECTED, SPACES

_PEEK = 20  # rows that decide


def find_delimiter(document: Document, start: int = 0) -> tuple[str, int]:
    """Return the delimiter, and how many lines stand above the table.

    Parameters
    ----------
    document
        The file.
    start
        How many lines are known to stand above it.

    Raises
    ------
    InputError
        None of the known ones separates the lines, or the header has another than the rows.
    """
    announced = tables.announced(next(tables.lines(document)))
    skip = max(start, int(bool(announced)))
    content = (
        (number, line)
        for number, line in enumerate(tables.lines(document), start=1)
        if number > skip and line.strip() and not line.lstrip().startswith("#")
    )
    top = list(itertools.islice(content, _PEEK))
    if not top:
        raise document.error("", "there are only comments; export the table with its values")
    counts = {mark: [_count(line, mark) for _, line in top] for mark in DELIMITERS}
    for mark, found in counts.items():
        if announced in ("", mark) and min(found) == max(found) >= 2 and "|" not in top[0][1]:
            return mark, skip
    body = [mark for mark in counts for n in counts[mark][1:] or counts[mark] if n >= 2]
    # Most rows decide; at a tie, the earlier of DELIMITERS, which `Counter` keeps in order.
    usual = Counter(body).most_common(1)[0][0] if body else ""
    number, line = top[0]
    if not usual or "|" in line or announced not in ("", usual):
        expected = DELIMITERS.get(announced, EXPECTED)
        other = next(
            (name for name, n in _marks(line.strip()) if n and name not in expected),
            "one column" if not announced else "none of them",
        )
        raise document.error(
            f"line {number}",
            f"expected {expected}, found {other}; export a table with wavelengths and values",
        )
    heads = [mark for mark in counts if mark != SPACES and counts[mark][0] >= 2]
    if heads and usual not in heads:
        raise document.error(
            f"line {top[1][0]}",
            f"the columns are separated by {DELIMITERS[usual]} but in the header by "
            f"{DELIMITERS[heads[0]]}; use the same delimiter throughout",
        )
    return usual, skip


def _count(line: str, mark: str) -> int:
    if mark == SPACES:
        return len(line.split())
    try:
        return len(next(csv.reader([line], delimiter=mark, skipinitialspace=True), []))
    except csv.Error:
        return 0


def _marks(line: str) -> list[tuple[str, int]]:
    names = {"|": "vertical bars", ":": "colons", "/": "slashes", "&": "ampersands", **DELIMITERS}
    return [(name, line.count(mark)) for mark, name in names.items()]
