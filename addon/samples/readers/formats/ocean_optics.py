# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Text files of Ocean Optics' software: OceanView, SpectraSuite, OOIBase32, Jaz.

Lines of metadata, a line such as ``>>>>>Begin Spectral Data<<<<<``, rows of wavelength and value.
The mode stands nowhere but in the name that OceanView gives to a saved graph ("Data from
chalk_Reflection_001.txt Node") and in titles such as "Jaz Absolute Irradiance File". Reflection and
transmission are saved in percent: a Jaz file holds sample, dark and white beside the result, which
is 100 (S - D) / (R - D).
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample
from ..parts import series, statements, tables
from ..parts.document import Document

NAME = "Ocean Optics text file"
ENDINGS = ("txt", "jaz")
PRIORITY = 90

_PERCENT = 100.0
_SEARCHED, _LONGEST = 100, 1000  # lines that are searched for a geometry, and characters of each
_BEGIN = re.compile(r">>>>>\s*(?:begin|comienza|d[ée]but|beginn)", re.IGNORECASE)
_TITLE = re.compile(
    r"(?:spectrasuite|ooibase32|oceanview|jaz\b.*file|data from .* node|.*de spectrasuite)",
    re.IGNORECASE,
)
_REFERENCE = re.compile(r"referenc(?:e|ia)\b.*:\s*(no|none|false)\s*$", re.IGNORECASE)
_DEVICE = re.compile(r"(?:spectrometers?|espectr\S*metros)\b[^:]*:\s*(\S.*)", re.IGNORECASE)
_NODE = re.compile(r"data from (.*?) node", re.IGNORECASE)
_DUAL_BEAM = re.compile(r"dual-beam", re.IGNORECASE)
_UNKNOWN = (
    "The file does not name what was measured; its values are taken as reflectance in percent, "
    "which is how the software saves its reflection mode."
)


def sniff(document: Document) -> bool:
    """Return whether there is a line that begins the data, as all these programs write it."""
    head = document.head_text
    return ">>>>>" in head and any(_BEGIN.match(line.strip()) for line in head.split("\n"))


def read(document: Document) -> list[Sample]:
    """Return the one spectrum of the file.

    Raises
    ------
    InputError
        The file says that it holds something else than reflectance, a field is not a number, or the
        spectrum is not one.
    """
    top: list[str] = []
    lines = enumerate(tables.lines(document), start=1)
    for _, line in lines:
        if _BEGIN.match(line.strip()):
            break
        if line.strip():
            top.append(line.strip())
    notes = _refuse_or_note(document, top)
    nm, percent, at = _values(document, _rows(lines))
    where = f"{document.path}, line {at[0]}" if at else str(document.path)
    found = series.bands(nm, percent / _PERCENT, where, lambda band: f"line {at[band]}")
    device = next((m[1].strip() for m in map(_DEVICE.match, top) if m), "")
    # Names of files and lines that users add say the geometry, if anything does.
    lines_above = [line[:_LONGEST].replace("_", " ").partition(":") for line in top[:_SEARCHED]]
    said = [(key, value) if colon else ("", key) for key, colon, value in lines_above]
    measured = statements.of_remarks([("spectrometer", device), *said])
    return [
        Sample(
            name=_name(document, top),
            wavelengths=found.wavelengths,
            values=found.values,
            kind="reading",
            **measured | {"notes": (*notes, *measured["notes"])},
            source=str(document.path),
            position=f"line {at[0]}",
            altered=found.altered,
        )
    ]


def _refuse_or_note(document: Document, top: list[str]) -> tuple[str, ...]:
    """Return what to tell of a file that does not name its quantity.

    Raises
    ------
    InputError
        It names another quantity, or no white reference was stored and these are counts.
    """
    named = False
    for number, line in enumerate(top, start=1):
        if number == 1 or _mode(line):
            # Names join words by underscores and dates: "chalk_Absorbance_15-33-02.txt".
            words = line.replace("_", " ")
            other = series.other_quantity(words)
            if other:
                raise document.not_reflectance(f"line {number}", other)
            named = named or series.says_reflectance(words) or "reflex" in words.lower()
        if _REFERENCE.search(line) and not _DUAL_BEAM.search(line):
            raise document.error(
                f"line {number}",
                "no white reference was stored, so the values are raw detector counts; store a "
                "reference and save in reflection mode",
            )
    return () if named else (_UNKNOWN,)


def _mode(line: str) -> bool:
    key = line.partition(":")[0].lower()
    return "mode" in key and "xaxis" not in key and "trigger" not in key


def _rows(lines: Iterator[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    """Return the rows of the spectrum, which ends with the file or with a line like its first."""
    for number, line in lines:
        text = line.strip()
        if text.startswith(">>>>>"):
            return
        if text:
            yield number, text


def _values(
    document: Document, rows: Iterator[tuple[int, str]]
) -> tuple[NDArray[np.float64], NDArray[np.float64], Sequence[int]]:
    """Return wavelengths, processed values and lines; a Jaz file names its columns by letters."""
    first = next(rows, None)
    if first is None:
        raise document.error("", "there is no spectrum in it; save it again")
    names = first[1].split()
    if names[0].upper() != "W":
        return series.two_columns(document, itertools.chain([first], rows))
    if "P" not in names or "R" not in names:
        raise document.not_reflectance(f"line {first[0]}", "counts")
    return series.two_columns(document, _processed(document, names, rows))


def _processed(
    document: Document, names: list[str], rows: Iterator[tuple[int, str]]
) -> Iterator[tuple[int, str]]:
    column = names.index("P")
    for line, text in rows:
        fields = text.split()
        if len(fields) != len(names):
            raise document.error(
                f"line {line}",
                f"{len(names)} columns were expected, found {len(fields)}; save the file again",
            )
        yield line, f"{fields[0]} {fields[column]}"


def _name(document: Document, top: list[str]) -> str:
    node = _NODE.match(top[0]) if top else None
    return re.sub(r"\.txt$", "", node[1]).strip() if node else document.path.stem
