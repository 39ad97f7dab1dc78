# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of RELAB, the Reflectance Experiment Laboratory of Brown University.

Two kinds. ``.txt``: a title with "Relab Spectrum", a line of column names, micrometers and
fractions. ``.asc`` and, in the Planetary Data System, ``.tab``: the number of rows, then
nanometers, fractions and perhaps standard deviations; below them an ``.asc`` file may describe the
sample and the angles.

Source: C. M. Pieters and T. Hiroi, "RELAB (Reflectance Experiment Laboratory): A NASA Multiuser
Spectroscopy Facility" (LPSC XXXV, 2004); https://doi.org/10.17189/1519032.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator

import numpy as np

from ...sample import Sample, check_spectrum
from ..parts import (
    band_order,
    geometry_words,
    label_words,
    tables,
)
from ..parts.document import Document, plain, quote
from ..parts.tables import Row

NAME = "RELAB file"
ENDINGS = ("txt", "asc", "tab")
PRIORITY = 90

_TITLE = re.compile(r"relab\s+spectrum\s*(\S*)", re.IGNORECASE)
_COUNT = re.compile(r"\s*(\d{1,7})\s*")
_NUMBERS = re.compile(r"\s*\d+\.\d*(?:\s+[-+]?\d*\.\d*(?:[eE][-+]?\d+)?){1,2}\s*")
_ANGLES = re.compile(r"Source Ang:\s*([\d.]+)\s+Detect Ang:\s*([-\d.]+)", re.IGNORECASE)
_COLUMNS = ("wavelength", "reflectance", "standard deviation")
_DEVIATIONS = "The standard deviations in the third column were not read."
_USUAL = "The file does not say the geometry; RELAB lights at 30° and looks at 0° unless it does."
_UNITS = "Of RELAB files with the number of rows on top, the unit is nanometers, 1 is white."


def sniff(document: Document) -> bool:
    """Return whether the head has RELAB's title, or a count and then rows of numbers."""
    top = [line for line in document.head_text[:4096].split("\n")[:12] if line.strip()]
    if len(top) < 2:
        return False
    if _COUNT.fullmatch(top[0]):
        return bool(_NUMBERS.fullmatch(top[1]))
    # A title that is commented out is none: `tables.rows` would not show it.
    titled = bool(_TITLE.search(top[0])) and not top[0].lstrip().startswith("#")
    return titled and label_words.is_wavelength(top[1])


def read(document: Document) -> list[Sample]:
    """Return the one sample of the file.

    Raises
    ------
    InputError
        Rows are missing, a unit is not stated, a field is not a number, or the spectrum is not one
        (`check_spectrum`).
    """
    table = tables.rows(document, tables.SPACES)
    top = next(table)
    counted = _COUNT.fullmatch(" ".join(top.fields))
    factor = 1.0 if counted else _nanometers_per_unit(document, next(table))
    first = next(table, None)
    if first is None:
        raise document.error(f"line {top.line}", "no rows follow; download the file again")
    columns = min(max(len(first.fields), 2), len(_COLUMNS))
    body: Iterator[Row] = itertools.chain([first], table)
    if counted:
        body = itertools.islice(body, int(counted[1]))
    block = tables.numbers(document, body, _COLUMNS[:columns], range(columns))
    if counted and len(block.lines) != int(counted[1]):
        raise document.error(
            f"line {block.lines[-1]}",
            f"line {top.line} says {counted[1]} rows but {len(block.lines)} follow; download the "
            "file again",
        )
    order, altered = band_order.in_order(block.values[:, 0])
    x, y = block.values[order, :2].T
    wavelengths, values = check_spectrum(
        np.round(x * factor, 9),  # 0.57 µm is 570 nm, while the product of the two floats is not
        y,
        str(document.path),
        lambda band: f"line {block.lines[order[band]]}",
    )
    below = [" ".join(row.fields) for row in itertools.islice(table, 20)] if counted else []
    geometry, notes = _geometry_of(" ".join(below))
    instrument, note = geometry_words.instrument_of(geometry)
    if counted:
        notes = (_UNITS, *notes)
    described = [line for line in below if ":" not in line]
    if described:
        notes = (*notes, f"The file says of the sample: {plain('; '.join(described)[:300])}.")
    if columns > 2:
        notes = (*notes, _DEVIATIONS)
    title = _TITLE.search(" ".join(top.fields))
    return [
        Sample(
            name=(title[1] if title else "") or document.path.stem,
            wavelengths=wavelengths,
            values=values,
            kind="reading",
            quantity="bidirectional reflectance",
            instrument=instrument,
            geometry=geometry,
            source=str(document.path),
            position=f"lines {block.lines[0]} to {block.lines[-1]}",
            notes=(*notes, *filter(None, [note])),
            altered=altered,
        )
    ]


def _nanometers_per_unit(document: Document, header: Row) -> float:
    """Return the factor by the name of the first column, which also has to fit the second."""
    text = " ".join(header.fields)
    unit = label_words.unit_of_wavelengths(text)
    if unit not in label_words.NM_PER_UNIT:
        raise document.error(
            f"line {header.line}",
            f"{quote(text)} names neither micrometers nor nanometers; add the unit",
        )
    if not re.search("reflect", text, re.IGNORECASE) or "%" in text:
        raise document.error(
            f"line {header.line}",
            f"RELAB files hold reflectance as fractions, and this says {quote(text)}; export that",
        )
    return label_words.NM_PER_UNIT[unit]


def _geometry_of(below: str) -> tuple[str, tuple[str, ...]]:
    angles = _ANGLES.search(below)
    if not angles:
        return "30°/0°", (_USUAL,)
    return "/".join(f"{part.rstrip('0').rstrip('.') or '0'}°" for part in angles.groups()), ()
