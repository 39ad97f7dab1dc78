# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Datacolor's exchange files (.qtx).

Sections ``[STANDARD_DATA 0]`` and ``[BATCH_DATA 0]`` of lines ``STD_NAME=…`` and ``BAT_NAME=…``.
Reflectance stands in ``STD_R``, always in percent, from ``STD_REFLLOW`` on in steps of
``STD_REFLINTERVAL`` nanometers, ``STD_REFLPOINTS`` of them. A batch repeats its standard's name.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample
from ..parts import series, tables
from ..parts.document import Document, quote
from ..parts.geometry_words import instrument_of, specular_of

NAME = "Datacolor QTX"
ENDINGS = ("qtx",)
PRIORITY = 95

_PERCENT = 100.0
_SECTION = re.compile(r"\[(STANDARD|BATCH)_DATA\s*\d*\]", re.IGNORECASE)
_PREFIXES = {"STANDARD": "STD_", "BATCH": "BAT_"}


@dataclass
class _Section:
    prefix: str
    line: int
    texts: dict[str, str] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)


def sniff(document: Document) -> bool:
    """Return whether a section of this format begins in the head."""
    return bool(re.search(_SECTION.pattern, document.head_text, re.IGNORECASE))


def read(document: Document) -> list[Sample]:
    """Return standards and batches in the order of the file.

    Raises
    ------
    InputError
        A section has colors but no spectrum, its keys contradict each other, a field is not a
        number, or a spectrum is not one.
    """
    sections = list(_sections(document))
    return [_sample(document, section, i) for i, section in enumerate(sections, start=1)]


def _sections(document: Document) -> Iterator[_Section]:
    current: _Section | None = None
    for number, line in enumerate(tables.lines(document), start=1):
        text = line.strip()
        header = _SECTION.fullmatch(text)
        if text.startswith("["):
            if current:
                yield current
            current = _Section(_PREFIXES[header[1].upper()], number) if header else None
        elif current and "=" in text:
            key, _, value = text.partition("=")
            key = key.strip().upper()
            current.texts[key] = value.strip()
            current.lines[key] = number
    if current:
        yield current


def _sample(document: Document, section: _Section, index: int) -> Sample:
    values = _values(document, section)
    low = _number(document, section, "REFLLOW")
    step = _number(document, section, "REFLINTERVAL")
    nm = low + step * np.arange(values.size, dtype=np.float64)
    line = section.lines[f"{section.prefix}R"]
    found = series.bands(
        nm,
        values / _PERCENT,
        f"{document.path}, line {line}",
        lambda band: f"value {band + 1}",
    )
    viewing = _text(section, "VIEWING") or _text(section, "SPECULAR")
    geometry = _text(section, "GEOMETRY")
    specular = specular_of(viewing)
    # Datacolor's file knows specular in or out for its spheres only.
    instrument, note = instrument_of(geometry or ("d/8" if specular else ""), specular)
    return Sample(
        name=_text(section, "NAME") or f"{document.path.stem} {index}",
        wavelengths=found.wavelengths,
        values=found.values,
        kind="reading",
        instrument=instrument,
        geometry=geometry,
        aperture=_text(section, "APERTURE"),
        specular=specular,
        source=str(document.path),
        position=f"line {section.line}",
        device=_text(section, "INSTRUMENT"),
        notes=(note,) if note else (),
        altered=found.altered,
    )


def _text(section: _Section, key: str) -> str:
    return section.texts.get(section.prefix + key, "").strip(" ,")


def _number(document: Document, section: _Section, key: str) -> float:
    name = section.prefix + key
    if name not in section.texts:
        raise document.error(
            f"line {section.line}",
            f"{name} is missing, so the bands have no wavelengths; export it again",
        )
    place = f"line {section.lines[name]}, key {name}"
    return series.number(document, place, _text(section, key))


def _values(document: Document, section: _Section) -> NDArray[np.float64]:
    """Return the percent of a section, shape (bands,)."""
    name = f"{section.prefix}R"
    if name not in section.texts:
        raise document.error(
            f"line {section.line}",
            f"{quote(_text(section, 'NAME'))} has no spectrum ({name}); export it with one",
        )
    place = f"line {section.lines[name]}, key {name}"
    text = section.texts[name].rstrip(", ")
    # A semicolon between values leaves the comma for decimals; the format itself uses commas.
    fields = series.fields(text, ";" if ";" in text else ",")
    values = np.array(array("d", (series.number(document, place, cell) for cell in fields)))
    if f"{section.prefix}REFLPOINTS" in section.texts:
        stated = _number(document, section, "REFLPOINTS")
        if stated != values.size:
            raise document.error(
                place, f"{values.size} values stand where {stated:g} are announced; export it again"
            )
    return values
