# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the objects of a CxF3 document hold, and what its specifications say of them."""

from __future__ import annotations

import itertools
import math
import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import geometry_words
from .cxf_xml import tag
from .document import Document, quote

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

_NOT_REFLECTANCE = {
    "TransmittanceSpectrum": "transmittance",
    "EmissiveSpectrum": "emission",
    "RadianceSpectrum": "radiance",
    "IrradianceSpectrum": "irradiance",
}
_MOST_REMARKS, _LONGEST_REMARK = 100, 1000  # that are searched, and characters of each
_WORD = re.compile(r"\S+")
_TYPES = (("Transmittance", "transmittance"), ("Emissive", "emission"))


@dataclass
class Spectrum:
    """One spectrum; NaN and None where it leaves a thing to its specification."""

    values: NDArray[np.float64]
    specification: str
    label: str
    start: float = math.nan
    increment: float = math.nan
    wavelengths: NDArray[np.float64] | None = None


@dataclass
class Thing:
    """One ``Object``: its spectra of reflectance, its colors, and what else there is."""

    number: int
    name: str
    spectra: list[Spectrum] = field(default_factory=list)
    colors: dict[str, list[tuple[str, tuple[float, float, float]]]] = field(default_factory=dict)
    others: list[str] = field(default_factory=list)


@dataclass
class Specification:
    """One ``ColorSpecification``; empty what it does not say."""

    refused: str = ""
    reflectance: bool = False
    start: float = math.nan
    increment: float = math.nan
    geometry: str = ""
    angles: dict[str, str] = field(default_factory=dict)
    specular: str = ""
    aperture: str = ""
    device: str = ""
    condition: str = ""
    illuminant: str = ""
    observer: int | None = None
    notes: tuple[str, ...] = ()


def thing(document: Document, number: int, element: Element) -> Thing:
    """Read an ``Object``.

    Raises
    ------
    InputError
        A value is not a number.
    """
    place = f"object {number}"
    found = Thing(number, element.get("Name", "").strip() or element.get("Id", "").strip())
    for part in element.iter():
        kind = tag(part)
        specification = part.get("ColorSpecification", "")
        if kind == "ReflectanceSpectrum":
            found.spectra.append(
                Spectrum(
                    _numbers(document, place, part.text),
                    specification,
                    part.get("Name", "").strip(),
                    _attribute(document, place, part, "StartWL"),
                    _attribute(document, place, part, "Increment"),
                )
            )
        elif kind == "CustomSpectrum":
            found.spectra.append(_points(document, place, part, specification))
        elif kind in _NOT_REFLECTANCE:
            found.others.append(_NOT_REFLECTANCE[kind])
        elif kind in ("ColorCIELab", "ColorCIEXYZ"):
            letters = "LAB" if kind == "ColorCIELab" else "XYZ"
            texts = [_text(part, letter) or _text(part, letter.lower()) for letter in letters]
            values = _numbers(document, f"{place}, {kind}", " ".join(texts)).tolist()
            if len(values) == 3 and all(texts):
                color = (values[0], values[1], values[2])
                found.colors.setdefault(kind, []).append((specification, color))
    return found


def specification(document: Document, element: Element) -> tuple[str, Specification]:
    """Read a ``ColorSpecification``: its Id and what it says."""
    name = element.get("Id", "")
    place = f"ColorSpecification {quote(name)}"
    found = Specification()
    measured = _child(element, "MeasurementSpec")
    if measured is None:
        measured = element
    kind = _text(measured, "MeasurementType")
    found.refused = next((quantity for mark, quantity in _TYPES if mark in kind), "")
    found.reflectance = "Reflectance" in kind
    span = _child(measured, "WavelengthRange")
    if span is None:
        span = _child(element, "WavelengthRange")
    if span is not None:
        found.start = _attribute(document, place, span, "StartWL")
        found.increment = _attribute(document, place, span, "Increment")
    _choose_geometry(found, measured)
    found.aperture = _text(measured, "Aperture")
    device = _child(measured, "Device")
    if device is not None:
        made = (_text(device, "Manufacturer"), _text(device, "Model"))
        found.device = " ".join(part for part in made if part)
        light = _text(device, "DeviceIllumination")
        found.condition = light[:2] if light[:2] in ("M0", "M1", "M2", "M3") else ""
    standard = _text(measured, "CalibrationStandard")
    if standard:
        found.notes = (f"The calibration standard is {quote(standard)}.",)
    tristimulus = _child(element, "TristimulusSpec")
    if tristimulus is not None:
        found.illuminant = _text(tristimulus, "Illuminant")
        observer = _text(tristimulus, "Observer").partition("_")[0]
        found.observer = int(observer) if observer in ("2", "10") else None
    return name, found


def _choose_geometry(found: Specification, measured: Element) -> None:
    choice = _child(measured, "GeometryChoice")
    for part in choice if choice is not None else ():
        kind = tag(part)
        if kind == "SingleAngle":
            light, view = _text(part, "IlluminationAngle"), _text(part, "MeasurementAngle")
            if not light or not view:
                found.geometry = _half_said(light, view)
                continue
            letter = "x" if _text(part, "SingleAngleConfiguration") == "Uniplanar" else "a"
            at_light, at_view = (letter, "") if light[:1] != "0" else ("", letter)
            found.geometry = f"{_plain(light)}°{at_light}:{_plain(view)}°{at_view}"
        elif kind == "SphereGeometry":
            words = " ".join((part.text or "").replace("_", " ").split())
            found.geometry = f"sphere, {words}"
            found.specular = geometry_words.specular_of(words)
        elif kind == "MultiAngle":
            for angle in part:
                light, aspecular = _text(angle, "IlluminationAngle"), _text(angle, "Aspecular")
                words = f"{_plain(light)}as{_plain(aspecular)}" if aspecular else ""
                words = words or _half_said(light, "")
                azimuth = _text(angle, "Azimuth")
                if _plain(azimuth) not in ("", "0"):
                    words += f", azimuth {_plain(azimuth)}°"
                found.angles[angle.get("Notation", "")] = words
        elif kind == "EmissiveMode":
            found.refused = found.refused or "emission"
        elif kind == "UnknownGeometry":
            found.geometry = " ".join((part.text or "").split())


def _half_said(light: str, view: str) -> str:
    """Return words for a geometry that lacks an angle, or nothing where it lacks both."""
    if not light and not view:
        return ""
    unsaid = "an angle that is not said"
    of_light, of_view = (f"{_plain(angle)}°" if angle else unsaid for angle in (light, view))
    return f"light at {of_light}, view at {of_view}"


def remarks(element: Element) -> list[tuple[str, str]]:
    """Read ``FileInformation``: what it says of all objects, as keys and texts."""
    said = (part for part in element.iter() if tag(part) in ("Description", "Comment", "Tag"))
    found = []
    for part in itertools.islice(said, _MOST_REMARKS):
        text = (part.get("Value", "") or part.text or "")[:_LONGEST_REMARK]
        key = part.get("Name", "") if tag(part) == "Tag" else ""
        found.append((key[:_LONGEST_REMARK], " ".join(text.split())))
    return found


def _points(document: Document, place: str, element: Element, specification: str) -> Spectrum:
    points = [part for part in element if tag(part) == "SpectralPoint"]
    nm = np.array([_attribute(document, place, point, "WL") for point in points])
    values = _numbers(document, place, " ".join(point.text or "nothing" for point in points))
    # Each point names its wavelength, so that their order carries nothing.
    order = np.argsort(nm, kind="stable")
    nm = nm[order]
    nm.flags.writeable = False
    found = Spectrum(values[order], specification, element.get("Name", "").strip())
    found.wavelengths = nm
    return found


def _child(element: Element, name: str) -> Element | None:
    return next((part for part in element if tag(part) == name), None)


def _text(element: Element, name: str) -> str:
    part = _child(element, name)
    return "" if part is None else " ".join((part.text or "").split())


def _plain(text: str) -> str:
    """Return 45 for 45.0."""
    try:
        return f"{float(text):g}"
    except ValueError:
        return text


def _attribute(document: Document, place: str, element: Element, name: str) -> float:
    text = element.get(name)
    if text is None:
        return math.nan
    try:
        return float(_numbers(document, f"{place}, {name}", text)[0])
    except IndexError:
        return math.nan


def _numbers(document: Document, place: str, text: str | None) -> NDArray[np.float64]:
    try:
        # Not a list of words, which takes twenty times their text.
        found = np.array(array("d", map(float, _words(text))), dtype=np.float64)
    except ValueError:
        wrong = next(word for word in _words(text) if not _is_number(word))
        raise document.error(
            place, f"{quote(wrong)} is not a number; numbers stand between spaces, with points"
        ) from None
    found.flags.writeable = False
    return found


def _words(text: str | None) -> Iterator[str]:
    return (match[0] for match in _WORD.finditer(text or ""))


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
