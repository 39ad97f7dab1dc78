# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a radiometer lets through, from a table with two columns: wavelength and response."""

from __future__ import annotations

import itertools
import os

import numpy as np

from ...core.emissivity import Filter
from ...core.errors import DomainError, InputError
from ...core.numerics.arrays import Array
from .readers import open_document
from .readers.parts import band_order, label_words, scale, table_start, tables
from .readers.parts.delimiter import find_delimiter
from .sample import SHORTEST_NM

_COLUMNS = ("wavelength", "response")
_EMPTY = "no rows of numbers follow; export the table with its values"


def read(path: str | os.PathLike[str]) -> Filter:
    """Return the response that a file holds: CSV, tabs, semicolons or spaces.

    A first row may name the columns; wavelengths are nanometers unless their name, or a comment
    ``# wavelength_unit: um``, says micrometers. The response may be on any scale.

    Raises
    ------
    InputError
        The file cannot be opened, has other columns, or holds no response.
    """
    nm, response = table(path)
    try:
        return Filter(nm, response)
    except DomainError as error:
        raise InputError(f"{path}: {str(error).rstrip('.')}.") from None


def table(path: str | os.PathLike[str]) -> tuple[Array, Array]:
    """Return the two columns of such a file: nanometers, in order, and what stands beside them.

    Raises
    ------
    InputError
        The file cannot be opened, or has other columns.
    """
    document = open_document(path)
    said = label_words.comments(document)
    start = table_start.find_start(document)
    delimiter, skip = find_delimiter(document, start)
    rows = tables.rows(document, delimiter, skip)
    first = next(rows, None)
    if first is None:  # lines of nothing but delimiters
        raise document.error("", _EMPTY)
    label = first.fields[0]
    try:
        float(label.replace(",", "."))
    except ValueError:
        pass
    else:
        rows, label = itertools.chain([first], rows), ""
    block = tables.numbers(document, rows, _COLUMNS, (0, 1), decimal_comma=delimiter != ",")
    if not block.lines:
        raise document.error("", _EMPTY)
    nm = scale.nanometers(document, said, block.values[:, 0], [label], is_seen=False)
    order, _ = band_order.in_order(nm)
    nm = nm[order]
    if nm.max() < SHORTEST_NM:
        raise document.error(
            f"line {block.lines[0]}",
            "the wavelengths look like micrometers; call their column 'wavelength (µm)'",
        )
    return nm, np.asarray(block.values[order, 1])
