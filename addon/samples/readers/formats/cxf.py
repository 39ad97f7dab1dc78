# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""CxF3, the Color Exchange Format (ISO 17972-1), an XML format.

Reflectance is a fraction by the standard's schema, which ends at 3. Where the wavelengths lie and
how was measured stands in a specification that the spectrum names.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample, check_spectrum
from ..parts import cxf_parts, cxf_xml, geometry_words, statements
from ..parts.cxf_parts import Specification, Spectrum, Thing
from ..parts.document import Document, quote

NAME = "CxF3"
ENDINGS = ("cxf", "mxf", "xml")
PRIORITY = 100

_ROOT = re.compile(r"<(?:[\w.-]+:)?CXF[\s>/]", re.IGNORECASE)
_OLD = re.compile(r"colorexchangeformat\.com/v[12]\b|CxF2", re.IGNORECASE)
_COLORS = ("ColorCIELab", "ColorCIEXYZ")


@dataclass
class _Chosen:
    """A specification as far as it concerns one sample."""

    instrument: str
    geometry: str
    notes: tuple[str, ...]


def sniff(document: Document) -> bool:
    """Return whether the head has the root element, with any prefix."""
    head = document.head_text.lstrip()
    return head.startswith("<") and bool(_ROOT.search(head))


def read(document: Document) -> list[Sample]:
    """Return one sample a spectrum of reflectance, in the order of the file.

    Raises
    ------
    InputError
        Another version of CxF, broken XML, no reflectance at all, wavelengths that nothing states,
        or a spectrum that is not one (`check_spectrum`).
    """
    things: list[Thing] = []
    specifications: dict[str, Specification] = {}
    remarks: list[tuple[str, str]] = []
    pieces = cxf_xml.parts(document)
    root = next(pieces)
    if cxf_xml.tag(root) != "CxF" or _OLD.search(str(root.tag)):
        raise document.error("", "this is an older CxF; export it as CxF3, which ISO 17972 fixes")
    for piece in pieces:
        if cxf_xml.tag(piece) == "Object":
            things.append(cxf_parts.thing(document, len(things) + 1, piece))
        elif cxf_xml.tag(piece) == "FileInformation":
            remarks += cxf_parts.remarks(piece)
        else:
            name, found = cxf_parts.specification(document, piece)
            specifications[name] = found
    wanted, left = _sort_out(things, specifications)
    if not wanted:
        raise _nothing(document, left)
    several = {_of(specifications, one).condition for _, one in wanted}
    notes = _note_of_left(left)
    of_file = statements.measured_by(remarks)
    names = Counter(id(thing) for thing, _ in wanted)
    grids: dict[tuple[float, float, int], NDArray[np.float64]] = {}
    samples = []
    for thing, spectrum in wanted:
        said = _of(specifications, spectrum)
        name = thing.name or f"{document.path.stem} {thing.number}"
        suffix = said.condition if len(several) > 1 else ""
        if not suffix and names[id(thing)] > 1:
            suffix = spectrum.label or spectrum.specification
        nm = _wavelengths(document, thing, spectrum, said, grids)
        samples.append(
            _sample(
                document,
                thing,
                spectrum,
                specifications,
                of_file,
                f"{name} ({suffix})" if suffix else name,
                nm,
                notes,
            )
        )
    return samples


def _of(specifications: dict[str, Specification], spectrum: Spectrum) -> Specification:
    return specifications.get(spectrum.specification) or Specification()


def _sort_out(
    things: list[Thing], specifications: dict[str, Specification]
) -> tuple[list[tuple[Thing, Spectrum]], Counter[str]]:
    """Return the spectra of reflectance, and how many objects there are without one, by content."""
    wanted: list[tuple[Thing, Spectrum]] = []
    left: Counter[str] = Counter()
    for thing in things:
        others = list(thing.others)
        before = len(wanted)
        for spectrum in thing.spectra:
            said = _of(specifications, spectrum)
            refused = said.refused
            if spectrum.wavelengths is not None and not said.reflectance:
                refused = refused or "a custom quantity"
            if refused:
                others.append(refused)
            else:
                wanted.append((thing, spectrum))
        if len(wanted) == before:
            left[others[0] if others else "color"] += 1
    return wanted, left


def _nothing(document: Document, left: Counter[str]) -> Exception:
    for quantity in left:
        if quantity != "color":
            return document.not_reflectance("", quantity)
    return document.error("", "it has no spectral data; export the spectra with the colors")


def _note_of_left(left: Counter[str]) -> tuple[str, ...]:
    if not left:
        return ()
    kinds = [f"{count} with {what} only" for what, count in left.items()]
    return (f"Objects without reflectance were left out: {', '.join(kinds)}.",)


def _wavelengths(
    document: Document,
    thing: Thing,
    spectrum: Spectrum,
    said: Specification,
    grids: dict[tuple[float, float, int], NDArray[np.float64]],
) -> NDArray[np.float64]:
    if spectrum.wavelengths is not None:
        return spectrum.wavelengths
    start = said.start if math.isnan(spectrum.start) else spectrum.start
    step = said.increment if math.isnan(spectrum.increment) else spectrum.increment
    missing = "StartWL" if math.isnan(start) else "Increment" if math.isnan(step) else ""
    if missing:
        raise document.error(
            f"object {thing.number}",
            f"the spectrum has no {missing}, and its ColorSpecification "
            f"{quote(spectrum.specification)} does not state it in a WavelengthRange; export the "
            "file with its specifications",
        )
    key = (start, step, spectrum.values.size)
    if key not in grids:
        grids[key] = start + step * np.arange(spectrum.values.size, dtype=np.float64)
        grids[key].flags.writeable = False
    return grids[key]


def _sample(
    document: Document,
    thing: Thing,
    spectrum: Spectrum,
    specifications: dict[str, Specification],
    of_file: dict[str, Any],
    name: str,
    nm: NDArray[np.float64],
    notes: tuple[str, ...],
) -> Sample:
    said = _of(specifications, spectrum)
    if not (said.geometry or said.angles or said.specular) and of_file:
        said = _with_remarks(said, of_file)
    chosen = _choose(said, spectrum)
    position = f"object {thing.number}"
    check_spectrum(nm, spectrum.values, f"{document.path}, {position}")
    lab_by, lab = _color(thing, spectrum, _COLORS[0], "")
    xyz_by, xyz = _color(thing, spectrum, _COLORS[1], lab_by)
    colorimetry = specifications.get(lab_by or xyz_by) or said
    if lab and xyz and lab_by != xyz_by:
        xyz = None  # one sample states one illuminant
    return Sample(
        name=name,
        wavelengths=nm,
        values=spectrum.values,
        kind="reading",
        instrument=chosen.instrument,
        geometry=chosen.geometry,
        aperture=said.aperture,
        specular=said.specular,
        source=str(document.path),
        position=position,
        device=said.device,
        condition=said.condition,
        illuminant=colorimetry.illuminant,
        observer=colorimetry.observer,
        lab=lab,
        xyz=xyz and (xyz[0] / 100, xyz[1] / 100, xyz[2] / 100),  # CxF: white has Y = 100
        notes=(*chosen.notes, *said.notes, *notes),
    )


def _with_remarks(said: Specification, of_file: dict[str, Any]) -> Specification:
    """Return a specification that says no geometry with what the file's description says of it."""
    known = statements.finish(of_file)
    geometry, specular = known.get("geometry", ""), known.get("specular", "")
    follows = statements.of_mention(of_file.get("mentioned", ""), geometry, specular)
    return replace(
        said,
        geometry=geometry,
        specular=specular,
        device=said.device or known.get("device", ""),
        notes=(follows, *said.notes) if follows else said.notes,
    )


def _choose(said: Specification, spectrum: Spectrum) -> _Chosen:
    """Return the instrument; of several angles the one that the spectrum's name says."""
    geometry = said.geometry
    notes = []
    if said.angles:
        geometry = said.angles.get(spectrum.label) or next(iter(said.angles.values()))
        if len(said.angles) > 1 and spectrum.label not in said.angles:
            notes.append(
                "Which of several angles this spectrum has is not said; the first was taken."
            )
        if "azimuth" in geometry:
            notes.append(f"The geometry {quote(geometry)} is computed in the plane of the light.")
    device = "" if geometry else geometry_words.geometry_of_device(said.device)
    if device:
        notes.append(f"The geometry {device} is that of the device {quote(said.device)}.")
    known = geometry or device or ("d/8" if said.specular else "")
    instrument, note = geometry_words.instrument_of(known, said.specular)
    return _Chosen(instrument, geometry, (note, *notes) if note else tuple(notes))


def _color(
    thing: Thing, spectrum: Spectrum, kind: str, like: str
) -> tuple[str, tuple[float, float, float] | None]:
    """Return the object's own color: that of the spectrum's specification, or its only one."""
    found = thing.colors.get(kind, [])
    for wanted in (like, spectrum.specification):
        for specification, color in found:
            if wanted and specification == wanted:
                return specification, color
    # With several spectra, a color of another specification may belong to another one of them.
    return found[0] if found and len(thing.spectra) == 1 else ("", None)
