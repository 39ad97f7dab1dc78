# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables say of their samples beside the spectrum, by key and value, for fields of `Sample`.

The keys stand in lines above a table, in its first column, or name its columns.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from .....core.instruments import REGISTRY
from .....core.numerics.memoized import memoized
from ...sample import Sample
from .document import Document
from .geometry_words import EMITTED, EMITTING, instrument_of, specular_of
from .label_words import Comments
from .series import Bands

_KEYS = {
    **dict.fromkeys(("device", "instrument", "instrumentname", "instrumenttype"), "device"),
    **dict.fromkeys(("instrumentmodel", "spectrophotometer", "spectrometer"), "device"),
    **dict.fromkeys(("geometry", "measurementgeometry", "measuringgeometry"), "geometry"),
    **dict.fromkeys(("instrumentgeometry", "opticalgeometry", "optics"), "geometry"),
    **dict.fromkeys(("aperture", "aperturesize", "measuringaperture"), "aperture"),
    **dict.fromkeys(("measurementarea", "measuringarea", "areaofview", "spotsize"), "aperture"),
    **dict.fromkeys(("illuminant", "lightsource", "illuminant1"), "illuminant"),
    **dict.fromkeys(("observer", "standardobserver", "observer1", "observerangle"), "observer"),
    **dict.fromkeys(("illuminantobserver", "illobs", "colorcondition"), "light"),
    **dict.fromkeys(("condition", "measurementcondition", "measurementmode", "mode"), "condition"),
    **dict.fromkeys(("measuringmode", "measuremode", "filter", "uvfilter"), "condition"),
    **dict.fromkeys(("specular", "specularcomponent", "specularmode", "scisce"), "specular"),
    **dict.fromkeys(("spex", "sci", "sce", "gloss", "reflectancemode", "viewing"), "specular"),
    **dict.fromkeys(("sample", "samplename", "name", "sampleid", "dataname", "target"), "name"),
}
_CONDITION = re.compile(r"\bM[0-3]\b", re.IGNORECASE)
_OBSERVER = re.compile(r"(?<![\d.])(2|10)\s*(?:°|º|deg\w*|\b)", re.IGNORECASE)
# Names of CIE illuminants: A, C, D50, D65, D75, F2 … F12 (also FL2), LED-B1.
_ILLUMINANT = re.compile(r"(?<![A-Za-z0-9])(A|C|E|D\d{2}|FL?\d{1,2}|TL84|LED-\w+)(?![A-Za-z0-9])")
_COLOR = re.compile(r"(?:cie[ _-]*)?([lab])(?:\s*\*)?\s*(?:[\[(](.*)[\])])?", re.IGNORECASE)


def field_of(key: str) -> str:
    """Return the field that a key names, ``"light"`` for illuminant and observer, or nothing."""
    return _KEYS.get(re.sub(r"[^a-z0-9]", "", key.lower()), "")


@memoized(maxsize=1024)
def stated(key: str, value: str) -> Mapping[str, Any]:
    """Return the fields of `Sample` that one key and its value give, none if it is not known.

    `finish` turns all of a sample's fields into arguments.
    """
    value = value.strip().strip('"').strip()
    field = field_of(key)
    if not value or not field:
        return {}
    if field == "light":
        return light(value)
    if field == "observer":
        found = _OBSERVER.search(value)
        return {"observer": int(found[1])} if found else {}
    if field == "condition":
        condition = _CONDITION.search(value)
        specular = specular_of(value)
        return {"condition": condition[0].upper()} if condition else _specular(specular)
    if field == "specular":
        # A key such as "SCI" has a value such as "yes"; the words of both say it together.
        return _specular(specular_of(value) or specular_of(f"specular {value}"))
    if field == "device" and value in REGISTRY:
        return {"geometry": value}
    return {field: value}


def light(text: str) -> dict[str, Any]:
    """Return illuminant and observer of words such as ``"10°/D65"``."""
    found: dict[str, Any] = {}
    illuminant = _ILLUMINANT.search(text)
    observer = _OBSERVER.search(text.replace(illuminant[0], "") if illuminant else text)
    if illuminant:
        found["illuminant"] = illuminant[0]
    if observer:
        found["observer"] = int(observer[1])
    return found


def color_columns(header: list[str]) -> tuple[list[int], dict[str, Any]]:
    """Return the columns of L*, a*, b*, none unless all are there, and their illuminant.

    The first of each counts: L also begins LCh, and more of them belong to further illuminants.
    """
    columns: dict[str, int] = {}
    said: dict[str, Any] = {}
    for i, label in enumerate(header):
        match = _COLOR.fullmatch(label.strip())
        if match and match[1].lower() not in columns:
            columns[match[1].lower()] = i
            said.update(light(match[2] or ""))
    return ([columns[c] for c in "lab"], said) if len(columns) == 3 else ([], {})


def finish(fields: dict[str, Any]) -> dict[str, Any]:
    """Return arguments for `Sample`: the instrument and its note follow from the geometry."""
    found = dict(fields)
    geometry, specular = found.get("geometry", ""), found.get("specular", "")
    if not geometry and not specular:
        return found
    found["instrument"], note, found["specular"] = _instrument(geometry, specular)
    if note:
        found["notes"] = (note,)
    return found


@memoized(maxsize=256)
def _instrument(geometry: str, specular: str) -> tuple[str, str, str]:
    """Return instrument, note and specular component: tables repeat them in each row."""
    specular = specular or specular_of(geometry)
    # Only spheres can leave specular light out or let it in.
    return (*instrument_of(geometry or "d/8", specular), specular)


def make(
    document: Document,
    said: Comments,
    fields: dict[str, Any],
    found: Bands,
    *,
    name: str,
    position: str,
    notes: tuple[str, ...] = (),
) -> Sample:
    """Return a sample with what comments and keys say of it; comments come first."""
    known = finish(fields)
    known.pop("name", None)
    notes = notes + known.pop("notes", ())
    texts: dict[str, Any] = {"source": str(document.path), **known, **said.texts}
    if said.kind == "emissivity":
        texts |= {"quantity": "emissivity", "instrument": EMITTING}
        notes = (*notes, EMITTED)
    return Sample(
        name=name,
        wavelengths=found.wavelengths,
        values=found.values,
        kind=said.kind,
        position=position,
        notes=notes,
        altered=found.altered,
        **texts,
    )


def _specular(found: str) -> dict[str, Any]:
    return {"specular": found} if found else {}
