# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""ProcSpec files of Ocean Optics' SpectraSuite: one spectrum as XML in a ZIP archive.

The XML is the program's own objects, and of every step of processing one: the last one says in what
unit the result is. Reflection is in percent. The text may hold bytes of no encoding, which no
parser takes; the numbers are looked for by their elements' names.

Source: checked against files of three versions, and against 100 (S - D) / (R - D) of their spectra.
"""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from array import array

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample
from ..parts import series
from ..parts.document import Document, plain
from ..parts.geometry_words import instrument_of

NAME = "Ocean Optics ProcSpec file"
ENDINGS = ("procspec",)
PRIORITY = 100

_MAGIC = b"PK\x03\x04"
_NAME = re.compile(r"ps_\d+\.xml")
_UNPACKED = 12
"""Bytes of XML, a byte of the file; those of the program have up to nine."""
_LEAST = 2**20
_UNIT = re.compile(rb'<yUnits class="[\w.]*\.(\w+)Descriptor"')
_NUMBER = re.compile(rb"<double>([^<]{1,40})</double>")
_DEVICE = re.compile(rb"<spectrometerClass>[^<]{0,200}?(\w+)</spectrometerClass>")
_SERIAL = re.compile(rb"<spectrometerSerialNumber>([^<]{1,60})<")
_PERCENT = 100.0
_KNOWN = {
    "CountsIntensity": "counts",
    "TransmissionIntensity": "transmittance",
    "AbsorbanceIntensity": "absorbance",
}


def sniff(document: Document) -> bool:
    """Return whether the archive begins with such a spectrum."""
    head = document.head
    if not head.startswith(_MAGIC):
        return False
    return bool(re.search(rb"ps_\d+\.xml", head[:512])) or b"OOIVersion.txt" in document.data[-512:]


def read(document: Document) -> list[Sample]:
    """Return the spectrum of the file.

    Raises
    ------
    InputError
        The archive is damaged, it holds no reflection, or the spectrum is none.
    """
    text = _xml(document)
    units = _UNIT.findall(text)
    unit = units[-1].decode("ascii") if units else ""
    if not unit.startswith("Reflection"):
        other = _KNOWN.get(unit) or f"of the kind {unit or 'that it does not say'}"
        raise document.not_reflectance("the last step of its processing", other)
    nm = _numbers(document, text, b"channelWavelengths")
    percent = _numbers(document, text, b"processedPixels")
    if nm.size != percent.size:
        raise document.error(
            "", f"{nm.size} wavelengths stand against {percent.size} values; save it again"
        )
    where = str(document.path)
    found = series.bands(nm, percent / _PERCENT, where, lambda band: f"pixel {band + 1}")
    instrument, assumed = instrument_of("")
    said = [match[1].decode("latin-1") for p in (_DEVICE, _SERIAL) if (match := p.search(text))]
    return [
        Sample(
            name=document.path.stem,
            wavelengths=found.wavelengths,
            values=found.values,
            kind="reading",
            instrument=instrument,
            source=where,
            device=plain(" ".join(said)),
            notes=(assumed,),
            altered=found.altered,
        )
    ]


def _xml(document: Document) -> bytes:
    """Return the XML, of which no more is unpacked than a spectrum can need."""
    most = max(_LEAST, _UNPACKED * len(document.data))
    try:
        with zipfile.ZipFile(io.BytesIO(document.data)) as archive:
            name = next((name for name in archive.namelist() if _NAME.fullmatch(name)), None)
            if name is None:
                raise document.error("", "there is no spectrum in it; save it again")
            with archive.open(name) as file:
                text = file.read(most + 1)
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, OSError,
            ValueError) as error:  # fmt: skip
        raise document.error(
            "", f"the archive is damaged ({plain(str(error))}); copy it from the instrument again"
        ) from None
    if len(text) > most:
        raise document.error(
            name, f"it unpacks to more than {most:,} bytes, as no spectrum does; export it as text"
        )
    return text


def _numbers(document: Document, text: bytes, element: bytes) -> NDArray[np.float64]:
    """Return the numbers of the first such element that has any; the others refer to it."""
    start = re.search(rb"<" + element + rb">\s*(?:<\w+>\s*){0,2}<double>", text)
    end = text.find(b"</" + element + b">", start.start()) if start else -1
    if start is None or end < 0:
        raise document.error("", f"its {element.decode()} are missing; save it again")
    found = array("d")
    for match in _NUMBER.finditer(text, start.start(), end):
        found.append(series.number(document, element.decode(), match[1].decode("latin-1").strip()))
    return np.array(found)
