# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the ECOSTRESS spectral library, and of the ASTER library before it.

Lines ``Key: value``, among them the units of both columns, a blank line, two columns. Many files
begin with the longest wavelength, and some hold emissivity or transmittance.

Source: S. K. Meerdink, S. J. Hook, D. A. Roberts and E. A. Abbott, "The ECOSTRESS spectral library
version 1.0" (Remote Sensing of Environment 230, 2019); https://speclib.jpl.nasa.gov.
"""

from __future__ import annotations

import itertools
import re

import numpy as np

from ...sample import Kind, Sample, check_spectrum
from ..parts import (
    band_order,
    geometry_words,
    label_words,
    tables,
)
from ..parts.document import Document, quote
from ..parts.tables import Block, Row

NAME = "ECOSTRESS or ASTER library file"
ENDINGS = ("txt",)
PRIORITY = 100

_MARKS = ("x units", "y units", "first x value")
_KEYS = {*_MARKS, "last x value", "number of x values", "name", "measurement"}
_KEY = re.compile(r"\s*([A-Za-z][A-Za-z .]*?)\s*:\s*(.*?)\s*")
_TOP = 200  # lines within which the rows begin; the header has about 20
_COLUMNS = ("wavelength", "value")

# In the words of `Y Units` and of `Measurement`; what matches first is meant.
_REFUSED = (
    (re.compile("transmi", re.IGNORECASE), "transmittance"),
    (re.compile("absor", re.IGNORECASE), "absorbance"),
    (re.compile("radiance", re.IGNORECASE), "radiance"),
)
_REFLECTANCE = re.compile("reflect", re.IGNORECASE)
_EMISSIVITY = re.compile("emissivit|emittance", re.IGNORECASE)
_RATIO = "The file does not say percent: an emissivity is a ratio, and is taken as such."
_PERCENT = re.compile("percent|%", re.IGNORECASE)
_FRACTION = re.compile(r"fraction|unitless|decimal|0\s*(?:-|to)\s*1", re.IGNORECASE)


def sniff(document: Document) -> bool:
    """Return whether the head has the keys that name both units."""
    head = document.head_text.lower()
    return all(f"\n{mark}:" in f"\n{head}" for mark in _MARKS)


def read(document: Document) -> list[Sample]:
    """Return the one sample of the file.

    Raises
    ------
    InputError
        The values are neither reflectance nor emissivity, a unit is missing or not known, rows are
        missing, or the spectrum is not one (`check_spectrum`).
    """
    keys, top = _header(document)
    kind, scale, said = _values(document, keys)
    factor = _nanometers_per_unit(document, keys)
    table = tables.rows(document, tables.SPACES, skip=top)
    block = tables.numbers(document, table, _COLUMNS, (0, 1))
    notes = _check_count(document, keys, block)
    order, altered = band_order.in_order(block.values[:, 0])
    x, y = block.values[order].T
    wavelengths, values = check_spectrum(
        # Rounded to 1e-9 nm: 0.57 µm is 570 nm, while the product of the two floats is not.
        np.round(x * factor, 9),
        y / scale,
        str(document.path),
        lambda band: f"line {block.lines[order[band]]}",
    )
    measurement = _text(keys, "measurement")
    instrument, note = geometry_words.instrument_of(measurement)
    if kind == "emissivity":
        instrument, note = geometry_words.EMITTING, geometry_words.EMITTED
    return [
        Sample(
            name=" ".join(_text(keys, "name").split()) or document.path.stem,
            wavelengths=wavelengths,
            values=values,
            kind=kind,
            quantity=_quantity(measurement, kind),
            instrument=instrument,
            geometry=measurement,
            source=str(document.path),
            position=f"lines {block.lines[0]} to {block.lines[-1]}",
            notes=(*notes, *filter(None, [said, note])),
            altered=altered,
        )
    ]


def _header(document: Document) -> tuple[dict[str, Row], int]:
    """Return line and value of each key that is used, and how many lines stand above the rows."""
    keys: dict[str, Row] = {}
    number = 0
    for number, line in enumerate(itertools.islice(tables.lines(document), _TOP), start=1):
        fields = line.split()
        if len(fields) > 1 and all(map(_is_number, fields)):
            break
        pair = _KEY.fullmatch(line)
        if pair and pair[1].lower() in _KEYS:
            keys.setdefault(pair[1].lower(), Row(number, [pair[2]]))
    else:
        raise document.error(f"line {number}", "no rows of numbers follow; download the file again")
    if not keys.keys() >= set(_MARKS):
        raise document.error(
            f"line {number}", "numbers begin above the units; download the file again"
        )
    return keys, number - 1


def _text(keys: dict[str, Row], key: str) -> str:
    return keys[key].fields[0] if key in keys else ""


def _values(document: Document, keys: dict[str, Row]) -> tuple[Kind, float, str]:
    """Return the kind, what to divide by, and a note; refuse other quantities by their names."""
    units = keys["y units"]
    for key in ("y units", "measurement"):
        for pattern, quantity in _REFUSED:
            if pattern.search(_text(keys, key)):
                raise document.not_reflectance(f"line {keys[key].line}", quantity)
    text = units.fields[0]
    emits, reflects = bool(_EMISSIVITY.search(text)), bool(_REFLECTANCE.search(text))
    measured = _text(keys, "measurement")
    if reflects and (emits or _EMISSIVITY.search(measured)):
        raise document.error(
            f"line {units.line}",
            f"{quote(text)} and the measurement {quote(measured)} name both reflectance and "
            "emissivity; make them agree",
        )
    if not emits and not reflects:
        raise document.error(
            f"line {units.line}",
            f"the values are {quote(text)}, which is neither reflectance nor emissivity",
        )
    percent, fraction = bool(_PERCENT.search(text)), bool(_FRACTION.search(text))
    if emits and not percent:
        return "emissivity", 1.0, "" if fraction else _RATIO
    if percent == fraction:
        raise document.error(
            f"line {units.line}",
            f"{quote(text)} says neither percent nor fraction; add the one that is meant",
        )
    return "emissivity" if emits else "reading", 100.0 if percent else 1.0, ""


def _nanometers_per_unit(document: Document, keys: dict[str, Row]) -> float:
    units = keys["x units"]
    unit = label_words.unit_of_wavelengths(units.fields[0])
    if unit not in label_words.NM_PER_UNIT:
        raise document.error(
            f"line {units.line}",
            f"{quote(units.fields[0])} names neither micrometers nor nanometers; add the unit",
        )
    return label_words.NM_PER_UNIT[unit]


def _check_count(document: Document, keys: dict[str, Row], block: Block) -> tuple[str, ...]:
    """Compare the rows with what the header says of them.

    Raises
    ------
    InputError
        There are fewer or more, and they don't end where the header says.
    """
    stated, found = _text(keys, "number of x values"), len(block.lines)
    if not stated.isdecimal() or int(stated[:9]) == found:
        return ()
    end = _text(keys, "last x value")
    first = _text(keys, "first x value")
    if _is_number(end) and _is_number(first):
        # Of descending files, some state the smaller wavelength first.
        ends = {float(first), float(end)}
        if {float(block.values[0, 0]), float(block.values[-1, 0])} == ends:
            return (f"The header says {stated} values, and {found} follow, to the stated end.",)
    raise document.error(
        f"line {block.lines[-1]}",
        f"the header says {quote(stated)} values but {found} follow; download the file again",
    )


def _quantity(measurement: str, kind: Kind) -> str:
    text = measurement.lower()
    if kind == "emissivity":
        return "directional emissivity" if "direction" in text else "emissivity"
    if "hemispher" in text:
        # Spectra joined of two instruments say "bidirectional and directional hemispherical".
        both = "bidirectional and " if "bidirectional" in text.replace("-", "") else ""
        return f"{both}directional-hemispherical reflectance"
    return "bidirectional reflectance" if "bidirectional" in text else "reflectance"


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
