# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as CGATS.17 text, as a real instrument's software writes them.

One table a combination of wavelengths, illuminant, observer, model and instrument. Spectral columns
are named SPECTRAL_NM380 and hold fractions, as that name means to measurement software.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...support.shown_text import (
    CELLS,
    ESCAPED,
    printable,
    to_cell,
)
from ...support.version import version
from ..document import Readings
from .tables import nanometers

NAME = "cgats"
PLACE = 20
ENDINGS = r"(?:predicted|measured)\.cgats\.txt"
CREATOR = rb'ORIGINATOR\t"Rough Spectra '


def files(readings: Readings) -> list[tuple[str, bytes]]:
    """Give the endings and tables of what was predicted and of what was measured."""
    found = []
    if any(entry.predicted is not None for entry in readings.entries):
        found.append(("predicted.cgats.txt", predicted(readings)))
    if any(entry.measured is not None for entry in readings.entries):
        found.append(("measured.cgats.txt", measured(readings)))
    return found


def predicted(readings: Readings) -> bytes:
    """Give the predicted spectra with their XYZ and Lab."""
    groups: dict[tuple[tuple[float, ...], str, int, str, str], list[list[str]]] = {}
    for number, entry in enumerate(readings.entries, 1):
        part = entry.predicted
        if part is None:
            continue
        cells = [str(number), _quoted(entry.material)]
        cells += [f"{value:.4f}" for value in (*part.xyz, *part.lab)]
        cells += [f"{value:.6f}" for value in part.values]
        key = (part.wavelengths, part.illuminant, part.observer, part.model, entry.instrument)
        groups.setdefault(key, []).append(cells)
    tables = [
        _table(
            f"predicted by the core from the stored spectrum, {model} model",
            illuminant,
            observer,
            instrument,
            [*_COLOR_FIELDS, *(f"SPECTRAL_NM{nanometers(nm)}" for nm in wavelengths)],
            rows,
        )
        for (wavelengths, illuminant, observer, model, instrument), rows in groups.items()
    ]
    return _file(tables)


def measured(readings: Readings) -> bytes:
    """Give the measured XYZ and Lab: an RGB render has no spectrum."""
    groups: dict[tuple[str, str], list[list[str]]] = {}
    for number, entry in enumerate(readings.entries, 1):
        part = entry.measured
        if part is None:
            continue
        cells = [str(number), _quoted(entry.material)]
        cells += [f"{value:.4f}" for value in (*part.xyz, *part.lab)]
        groups.setdefault((part.illuminant, entry.instrument), []).append(cells)
    quantity = f"measured in a Cycles render, Blender {readings.blender}"
    return _file(
        [
            _table(quantity, light, 2, instrument, _COLOR_FIELDS, rows)
            for (light, instrument), rows in groups.items()
        ]
    )


_COLOR_FIELDS = ("XYZ_X", "XYZ_Y", "XYZ_Z", "LAB_L", "LAB_A", "LAB_B")


def _table(
    quantity: str,
    illuminant: str,
    observer: int,
    instrument: str,
    fields: Sequence[str],
    rows: list[list[str]],
) -> str:
    names = ["SAMPLE_ID", "SAMPLE_NAME", *fields]
    source = f"Illumination={illuminant}\tObserverAngle={observer}°\tWhiteBase=Abs\tFilter=No"
    lines = [
        f'ORIGINATOR\t"Rough Spectra {version()}"',
        f'DESCRIPTOR\t"Virtual spectrophotometer, {printable(quantity)}"',
        'INSTRUMENTATION\t"Rough Spectra virtual spectrophotometer"',
        f'MEASUREMENT_SOURCE\t"{source}"',
        'KEYWORD\t"MEASUREMENT_GEOMETRY"',
        f'MEASUREMENT_GEOMETRY\t"{instrument}"',
        'KEYWORD\t"ROUGH_SPECTRA_WHITE"',
        'ROUGH_SPECTRA_WHITE\t"perfect diffuser"',
        f'KEYWORD\t"{CELLS}"',
        f'{CELLS}\t"{ESCAPED}"',
        f"NUMBER_OF_FIELDS\t{len(names)}",
        "BEGIN_DATA_FORMAT",
        "\t".join(names),
        "END_DATA_FORMAT",
        f"NUMBER_OF_SETS\t{len(rows)}",
        "BEGIN_DATA",
        *("\t".join(row) for row in rows),
        "END_DATA",
    ]
    return "\n".join(lines)


def _file(tables: list[str]) -> bytes:
    return ("CGATS.17\n" + "\n\n".join(tables) + "\n").encode()


def _quoted(name: str) -> str:
    """Quote a name as a cell; a quote inside is doubled."""
    text = to_cell(name).replace('"', '""')
    return f'"{text}"'
