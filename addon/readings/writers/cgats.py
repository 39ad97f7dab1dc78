# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as CGATS.17 text, as a real instrument's software writes them.

One table a file, whatever differs between its readings: measurement software such as ArgyllCMS
takes the first table and leaves the others. What all readings share is said above the table; light,
observer, model and geometry that they don't share are columns. Spectral columns are named
SPECTRAL_NM380 and hold fractions, as that name means to measurement software.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from ....core.numerics import wavelength_grid
from ...support.shown_text import (
    CELLS,
    ESCAPED,
    printable,
    to_cell,
)
from ...support.version import version
from ..document import Predicted, Readings
from .tables import nanometers

NAME = "cgats"
PLACE = 20
ENDINGS = r"(?:predicted|measured)\.cgats\.txt"
CREATOR = rb'ORIGINATOR\t"Rough Spectra '


def files(readings: Readings) -> list[tuple[str, Iterator[bytes]]]:
    """Give the endings and tables of what was predicted and of what was measured."""
    found = []
    if any(entry.predicted is not None for entry in readings.entries):
        found.append(("predicted.cgats.txt", predicted(readings)))
    if any(entry.measured is not None for entry in readings.entries):
        found.append(("measured.cgats.txt", measured(readings)))
    return found


def predicted(readings: Readings) -> Iterator[bytes]:
    """Give the predicted spectra with their XYZ and Lab.

    Spectra on several wavelength grids are brought to one of 10 nm, over what all of them cover.
    """
    known = [(number, e, e.predicted) for number, e in enumerate(readings.entries, 1)]
    rows = [(number, entry, part) for number, entry, part in known if part is not None]
    bands = _shared_bands([part.wavelengths for _, _, part in rows])
    said = [
        {
            _LIGHT: part.illuminant,
            _OBSERVER: str(part.observer),
            _MODEL: part.model,
            _GEOMETRY: entry.instrument,
        }
        for _, entry, part in rows
    ]
    cells = (
        [
            *(str(number), _quoted(entry.material)),
            *(f"{value:.4f}" for value in (*part.xyz, *part.lab)),
            *(f"{value:.6f}" for value in _at(bands, part)),
        ]
        for number, entry, part in rows
    )
    what = "predicted by the core from the stored spectrum"
    if any(part.wavelengths != bands for _, _, part in rows):
        what += f", brought to {BAND_NM:g} nm"
    fields = [*_COLOR_FIELDS, *(f"SPECTRAL_NM{nanometers(nm)}" for nm in bands)]
    return _file(what, said, fields, cells)


def measured(readings: Readings) -> Iterator[bytes]:
    """Give the measured XYZ and Lab: an RGB render has no spectrum."""
    known = [(number, e, e.measured) for number, e in enumerate(readings.entries, 1)]
    rows = [(number, entry, part) for number, entry, part in known if part is not None]
    said = [
        {_LIGHT: part.illuminant, _OBSERVER: "2", _GEOMETRY: entry.instrument}
        for _, entry, part in rows
    ]
    cells = (
        [
            *(str(number), _quoted(entry.material)),
            *(f"{value:.4f}" for value in (*part.xyz, *part.lab)),
        ]
        for number, entry, part in rows
    )
    what = f"measured in a Cycles render, Blender {readings.blender}"
    return _file(what, said, list(_COLOR_FIELDS), cells)


BAND_NM = 10.0
"""Interval of spectra that had several: what software for print computes with."""

_LIGHT, _OBSERVER = "ROUGH_SPECTRA_ILLUMINANT", "ROUGH_SPECTRA_OBSERVER"
_MODEL, _GEOMETRY = "ROUGH_SPECTRA_MODEL", "MEASUREMENT_GEOMETRY"


def _shared_bands(grids: list[tuple[float, ...]]) -> tuple[float, ...]:
    """Give the wavelengths of all spectra; where they differ, steps of 10 nm that all cover."""
    if len(set(grids)) == 1:
        return grids[0]
    first = math.ceil(max(grid[0] for grid in grids) / BAND_NM)
    last = math.floor(min(grid[-1] for grid in grids) / BAND_NM)
    return tuple(BAND_NM * number for number in range(first, last + 1))


def _at(bands: tuple[float, ...], part: Predicted) -> tuple[float, ...]:
    if part.wavelengths == bands:
        return part.values
    values = wavelength_grid.resample(part.values, part.wavelengths, bands, "cubic")
    return tuple(values.tolist())


_COLOR_FIELDS = ("XYZ_X", "XYZ_Y", "XYZ_Z", "LAB_L", "LAB_A", "LAB_B")


def _file(
    quantity: str, said: list[dict[str, str]], fields: list[str], rows: Iterable[list[str]]
) -> Iterator[bytes]:
    """Put a table together, a line after the other.

    Parameters
    ----------
    quantity
        What it holds.
    said
        What each row is of, by the names of columns; every row has the same names.
    fields, rows
        Columns besides number and name, and the cells of all.
    """
    shared = {key: said[0][key] for key in said[0] if len({of[key] for of in said}) == 1}
    own = [key for key in said[0] if key not in shared]
    names = ["SAMPLE_ID", "SAMPLE_NAME", *own, *fields]
    if _MODEL in shared:
        quantity += f", {shared[_MODEL]} model"
    source = [f"Illumination={shared[_LIGHT]}"] if _LIGHT in shared else []
    source += [f"ObserverAngle={shared[_OBSERVER]}°"] if _OBSERVER in shared else []
    source += ["WhiteBase=Abs", "Filter=No"]
    head = [
        "CGATS.17",
        f'ORIGINATOR\t"Rough Spectra {version()}"',
        f'DESCRIPTOR\t"Virtual spectrophotometer, {printable(quantity)}"',
        'INSTRUMENTATION\t"Rough Spectra virtual spectrophotometer"',
        'MEASUREMENT_SOURCE\t"{}"'.format("\t".join(source)),
        'KEYWORD\t"MEASUREMENT_GEOMETRY"',
        *([f'MEASUREMENT_GEOMETRY\t"{shared[_GEOMETRY]}"'] if _GEOMETRY in shared else ()),
        'KEYWORD\t"ROUGH_SPECTRA_WHITE"',
        'ROUGH_SPECTRA_WHITE\t"perfect diffuser"',
        f'KEYWORD\t"{CELLS}"',
        f'{CELLS}\t"{ESCAPED}"',
        *(f'KEYWORD\t"{key}"' for key in own if key != _GEOMETRY),
        f"NUMBER_OF_FIELDS\t{len(names)}",
        "BEGIN_DATA_FORMAT",
        "\t".join(names),
        "END_DATA_FORMAT",
        f"NUMBER_OF_SETS\t{len(said)}",
        "BEGIN_DATA",
    ]
    yield ("\n".join(head) + "\n").encode()
    for of, cells in zip(said, rows, strict=True):
        row = [*cells[:2], *(_quoted(of[key]) for key in own), *cells[2:]]
        yield ("\t".join(row) + "\n").encode()
    yield b"END_DATA\n"


def _quoted(name: str) -> str:
    """Quote a name as a cell; a quote inside is doubled."""
    text = to_cell(name).replace('"', '""')
    return f'"{text}"'
