# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""IES TM-27-14 spectra (``.spdx``), an XML format.

Most such files hold the light of a lamp, which `emission` reads. As samples its quantities
``reflectance`` and ``R-Factor`` are read, as fractions; all others are refused by name.

Source: IES TM-27-14, "IES Standard Format for the Electronic Transfer of Spectral Data".
"""

from __future__ import annotations

import io
import math
import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample, check_spectrum
from ..parts import band_order, geometry_words
from ..parts.document import Document, quote
from ..parts.xml_faults import faults_named

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

NAME = "IES TM-27 spectrum (.spdx)"
ENDINGS = ("spdx", "xml")
PRIORITY = 100

_ROOT = "IESTM2714"
_DEEPEST = 20  # levels; the format has three
_MOST_UNKNOWN = 1000  # elements with other names than the format has: `CustomElement` and such
_LONG_TAG = re.compile(rb"<[^<>]{65536}")  # its attributes would take a lot of memory
_HEADER = ("Description", "CatalogNumber", "MeasurementEquipment")
_TEXTS = ("SpectralQuantity", "ReflectionGeometry", "BandwidthFWHM", "BandwidthCorrected")
_KNOWN = {"SpectralData", "SpectralDistribution", *_HEADER, *_TEXTS}
_QUANTITIES = {"reflectance": "reflectance", "r-factor": "reflectance factor"}
_REFUSED = {
    "flux": "radiant flux, an emission",
    "intensity": "radiant intensity, an emission",
    "exitance": "radiant exitance, an emission",
    "relative": "relative power, an emission",
    "t-factor": "transmittance",
    "absorptance": "absorptance",
}
_LIGHT = {"flux", "intensity", "irradiance", "radiance", "exitance", "relative"}
"""Quantities of light."""


@dataclass
class _Distribution:
    """One ``SpectralDistribution``: its texts by tag, and its two columns."""

    texts: dict[str, str] = field(default_factory=dict)
    nm: array[float] = field(default_factory=lambda: array("d"))
    values: array[float] = field(default_factory=lambda: array("d"))


def sniff(document: Document) -> bool:
    """Return whether the head has the root element's name, with or without a prefix."""
    head = document.head_text
    return head.lstrip().startswith("<") and (f"<{_ROOT}" in head or f":{_ROOT}" in head)


def read(document: Document) -> list[Sample]:
    """Return one sample a ``SpectralDistribution``.

    Raises
    ------
    InputError
        The XML is broken, declares entities or a document type, or is nested too deeply; the
        quantity is not reflectance; a number is none; or a spectrum is not one
        (`check_spectrum`).
    """
    header, distributions = _parse(document)
    samples = []
    for i, found in enumerate(distributions, start=1):
        place = f"SpectralDistribution {i}"
        stated = found.texts.get("SpectralQuantity", "")
        quantity = _QUANTITIES.get(stated.lower())
        if not stated:
            raise document.error(place, "SpectralQuantity is missing; state what was measured")
        if not quantity:
            words = _REFUSED.get(stated.lower(), stated.lower())
            raise document.not_reflectance(f"{place}, SpectralQuantity {quote(stated)}", words)
        order, altered = band_order.in_order(np.array(found.nm))
        wavelengths, values = check_spectrum(
            np.array(found.nm)[order],
            np.array(found.values)[order],
            f"{document.path}, {place}",
            # The loop's variable is bound by the call below, before it moves on.
            lambda band, order=order: f"SpectralData {order[band] + 1}",  # type: ignore[misc]
        )
        geometry = found.texts.get("ReflectionGeometry", "").replace("other", "")
        instrument, note = geometry_words.instrument_of(geometry)
        name = header.get("Description") or header.get("CatalogNumber") or document.path.stem
        samples.append(
            Sample(
                name=name if len(distributions) == 1 else f"{name} {i}",
                wavelengths=wavelengths,
                values=values,
                kind="reading",
                quantity=quantity,
                instrument=instrument,
                geometry=geometry,
                specular=geometry_words.specular_of(geometry),
                source=str(document.path),
                position=place,
                device=header.get("MeasurementEquipment", ""),
                notes=(*_bandwidth(found.texts), *filter(None, [note])),
                altered=altered,
            )
        )
    return samples


def emission(document: Document) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what a lamp sends: nanometers, and power on the file's scale.

    Raises
    ------
    InputError
        As `read`, but for quantities of light, of which there has to be one.
    """
    _, distributions = _parse(document)
    stated = [found.texts.get("SpectralQuantity", "").lower() for found in distributions]
    light = [number for number, quantity in enumerate(stated) if quantity in _LIGHT]
    if len(light) != 1:
        held = "no spectrum" if not light else f"{len(light)} spectra"
        raise document.error("", f"it holds {held} of light; give a file with one")
    found = distributions[light[0]]
    nm, power = np.array(found.nm), np.array(found.values)
    order, _ = band_order.in_order(nm)
    return nm[order], power[order]


def _bandwidth(texts: dict[str, str]) -> tuple[str, ...]:
    width = texts.get("BandwidthFWHM", "")
    if not width:
        return ()
    corrected = texts.get("BandwidthCorrected", "").lower() in ("true", "1")
    done = "corrected" if corrected else "not corrected"
    return (f"The bandwidth is {width[:20]} nm, and was {done} for.",)


def _parse(document: Document) -> tuple[dict[str, str], list[_Distribution]]:
    """Return the header's texts and the distributions, keeping no element longer than needed."""
    header: dict[str, str] = {}
    distributions: list[_Distribution] = []
    for parent, element in _elements(document):
        tag, text = _tag(element), (element.text or "").strip()
        if parent == "Header":
            if tag in _HEADER and text and text != "N/A":
                header[tag] = " ".join(text.split())
        elif parent == "SpectralDistribution" and distributions:
            current = distributions[-1]
            if tag == "SpectralData":
                place = f"SpectralDistribution {len(distributions)}"
                place += f", SpectralData {len(current.nm) + 1}"
                current.nm.append(_number(document, place, element.get("wavelength", "")))
                current.values.append(_number(document, place, text))
            elif tag in _TEXTS:
                current.texts[tag] = " ".join(text.split())
        elif tag == "SpectralDistribution":
            distributions.append(_Distribution())
    return header, distributions


def _elements(document: Document) -> Iterator[tuple[str, Element]]:
    """Yield each element and its parent's tag: a distribution as it begins, all others whole."""
    from defusedxml.ElementTree import iterparse

    if _LONG_TAG.search(document.data):
        raise document.error("", "one of its XML tags is longer than 64 kB; export it again")
    path: list[Element] = []
    unknown = 0
    with faults_named(document):
        for event, element in iterparse(
            io.BytesIO(document.data), events=("start", "end"), forbid_dtd=True
        ):
            parent = _tag(path[-1]) if path else ""
            if event == "start":
                path.append(element)
                if len(path) > _DEEPEST:
                    raise document.error("", f"its XML is nested more than {_DEEPEST} levels deep")
                if _tag(element) == "SpectralDistribution":
                    yield parent, element
                continue
            path.pop()
            unknown += _tag(element) not in _KNOWN
            if unknown > _MOST_UNKNOWN:
                raise document.error("", f"it has more than {_MOST_UNKNOWN} elements of no TM-27")
            if path:
                if _tag(element) != "SpectralDistribution":
                    yield _tag(path[-1]), element
                path[-1].clear()  # what is whole is not needed again


def _tag(element: Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rpartition("}")[2]


def _number(document: Document, place: str, text: str) -> float:
    try:
        value = float(text) if "_" not in text else math.nan
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise document.error(place, f"{quote(text)} is not a number; export it again")
    return value
