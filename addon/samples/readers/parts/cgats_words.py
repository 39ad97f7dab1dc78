# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the keywords of a CGATS table say about the measurement."""

from __future__ import annotations

import re
from dataclasses import dataclass

from . import geometry_words, series, statements
from .cgats_tables import Table
from .document import Document, quote

_PAIR = re.compile(r"([A-Za-z]\w*(?: \w+)?)\s*=\s*([^\t,;=\"]*)")
_CONDITION = re.compile(r"\bM[0-3]\b", re.IGNORECASE)
_EMISSION = re.compile(r"emissi|display|ambient|radian|luminan|flash|\blight source", re.IGNORECASE)
_TRANSMISSION = re.compile(r"transmi|\btransparen", re.IGNORECASE)
_REFLECTION = re.compile(r"reflect|remission", re.IGNORECASE)
_ILLUMINANT = re.compile(r"(?:ILLUMINANT|ILLUMINATION)[,:=\s]+(\S+)", re.IGNORECASE)
_OBSERVER = re.compile(r"OBSERVER\D*?(10|2)(?!\d)", re.IGNORECASE)
_NOTHING = ("", "-", "no", "none", "unknown", "n/a", "undefined")

_MODE_KEYS = ("MEAS_TYPE", "MEASUREMENT_TYPE", "MEASUREMENT_MODE", "MEASURE_MODE", "DEVICE_CLASS")
_MODE_PAIRS = ("MODE", "MEASUREMENTMODE", "MEASUREMENTOPTICS")
_SOURCES = re.compile(r"MEASUREMENT_SOURCE|BARBIERI_INFO_\d+|FILTER_STATUS|MEASUREMENT_CONDITIONS?")
_OF_SAMPLES = {"KEYWORD", "TARGET_TYPE", "CREATED", "PROD_DATE", "SERIAL", "NUMBER_OF_FIELDS"}
"""Keywords whose values say nothing of the measurement."""
_SIGNATURES = {
    "CCSS": "emission",
    "CCMX": "corrections of a display's colorimeter",
    "CMF": "color matching functions",
    "IT8.7/1": "transmittance",
}


@dataclass(frozen=True)
class Words:
    """What a table says, empty where it says nothing; the names are those of `Sample`."""

    instrument: str
    geometry: str
    aperture: str
    specular: str
    device: str
    condition: str
    illuminant: str
    observer: int | None
    notes: tuple[str, ...]


def fault(document: Document, table: Table) -> Exception | None:
    """Return the refusal of a table that is not reflectance, by the name of what it is."""
    if table.signature in _SIGNATURES:
        return document.not_reflectance(
            f"signature {table.signature}", _SIGNATURES[table.signature]
        )
    said = _said(table)
    for key, text in said:
        if _TRANSMISSION.search(text):
            return document.not_reflectance(_place(table, key), "transmittance")
        if _EMISSION.search(text):
            return document.not_reflectance(_place(table, key), "emission")
        if other := series.other_quantity(text):
            return document.not_reflectance(_place(table, key), other)
    if "LUMINANCE_XYZ_CDM2" in table.keys:
        return document.not_reflectance(_place(table, "LUMINANCE_XYZ_CDM2"), "emission")
    if table.signature == "SPECT" and not any(_REFLECTION.search(text) for _, text in said):
        return document.error(
            "signature SPECT",
            'the file does not say what the spectrum is; add a line MEAS_TYPE "REFLECTIVE" below '
            "if it is reflectance",
        )
    return None


def is_light(table: Table) -> bool:
    """Return whether a table says that it is of light."""
    by_signature = _SIGNATURES.get(table.signature) == "emission"
    said = any(_EMISSION.search(text) for _, text in _said(table))
    return by_signature or said or "LUMINANCE_XYZ_CDM2" in table.keys


def _said(table: Table) -> list[tuple[str, str]]:
    """Return keywords, and what they say of how it was measured."""
    pairs = _pairs(table)
    said = [(key, table.last(key)) for key in _MODE_KEYS]
    said += [("MEASUREMENT_GEOMETRY", table.last("MEASUREMENT_GEOMETRY"))]
    said += [("MEASUREMENT_SOURCE", pairs[key]) for key in _MODE_PAIRS if key in pairs]
    source = table.last("MEASUREMENT_SOURCE").lstrip()
    return [*said, ("MEASUREMENT_SOURCE", source[:12])]  # "Emission …" before any pair


def read(table: Table) -> Words:
    """Return what the table says."""
    pairs = _pairs(table)
    device = table.last("INSTRUMENTATION", "TARGET_INSTRUMENT", "INSTRUMENT")
    geometry = table.last("MEASUREMENT_GEOMETRY", "GEOMETRY")
    aperture = table.last("MEASUREMENT_APERTURE", "APERTURE") or pairs.get("APERTURE", "")
    specular = geometry_words.specular_of(
        " ".join([geometry, table.last("SPECULAR", "SPECULAR_COMPONENT"), pairs.get("MODE", "")])
    )
    # What other keywords, remarks and the device's name say counts where these say nothing.
    found = statements.measured_by(
        (key, value)
        for key, values in table.keys.items()
        if key not in _OF_SAMPLES
        for value in reversed(values)
    )
    if not geometry and not specular:
        geometry, specular = found.get("geometry", ""), found.get("specular", "")
        device = device or found.get("device", "")
    known = geometry or geometry_words.geometry_of_device(device) or ("d/8" if specular else "")
    instrument, note = geometry_words.instrument_of(known, specular)
    notes = [note] if note else []
    if follows := statements.of_mention(found.get("mentioned", ""), geometry, specular):
        notes.insert(0, follows)
    if known and not geometry and known == geometry_words.geometry_of_device(device):
        notes.insert(0, f"The geometry {known} is that of the device {quote(device)}.")
    weighting = " ".join(table.keys.get("WEIGHTING_FUNCTION", []))
    illuminant = (
        _word(_ILLUMINANT, weighting)
        or table.last("ILLUMINATION_NAME", "ILLUMINANT_NAME", "ILLUMINANT")
        or pairs.get("ILLUMINATION", "")
    )
    observer = (
        _word(_OBSERVER, weighting)
        or _word(_OBSERVER, "OBSERVER " + table.last("OBSERVER_ANGLE"))
        or _word(_OBSERVER, "OBSERVER " + table.last("OBSERVER").rpartition("_")[2])
        or _word(_OBSERVER, "OBSERVER " + pairs.get("OBSERVERANGLE", ""))
    )
    condition = _CONDITION.search(
        " ".join(
            [
                *table.keys.get("MEASUREMENT_CONDITION", []),
                *table.keys.get("MEASUREMENT_CONDITIONS", []),
                pairs.get("MEASUREMENTCONDITION", ""),
            ]
        )
    )
    return Words(
        instrument=instrument,
        geometry=geometry,
        aperture=aperture,
        specular=specular,
        device=device,
        condition=condition[0].upper() if condition else found.get("condition", ""),
        illuminant="" if illuminant.lower() in _NOTHING else illuminant,
        observer=int(observer) if observer else None,
        notes=tuple(notes),
    )


def _pairs(table: Table) -> dict[str, str]:
    """Return what MEASUREMENT_SOURCE and its like say: ``Illumination=D50 ObserverAngle=2°``."""
    found: dict[str, str] = {}
    for key, values in table.keys.items():
        if not _SOURCES.fullmatch(key):
            continue
        for value in values:
            # Files of hand-made exports have a space where the software writes a tab.
            spread = value if re.search("[\t,]", value) else re.sub(r" +(?=\w+=)", "\t", value)
            for name, text in _PAIR.findall(spread):
                found.setdefault(name.replace(" ", "").upper(), text.strip())
    return found


def _word(pattern: re.Pattern[str], text: str) -> str:
    match = pattern.search(text)
    return match[1].strip('",;') if match else ""


def _place(table: Table, key: str) -> str:
    return f"line {table.lines[key]}, keyword {key}" if key in table.lines else f"keyword {key}"
