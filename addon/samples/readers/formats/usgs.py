# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of the USGS Spectral Library, versions 6 and 7.

Version 7 (``splib07a``, ``splib07b``, and ``s07_ASD`` and others at the bands of one sensor): a
line such as ``splib07a Record=5932: Kaolinite CM5  BECKb AREF`` and one value a line. The
wavelengths stand in another file, one for each spectrometer. Version 6: a page of text, then
wavelength, reflectance and standard deviation. Deleted channels are -1.23e34 in both.

Source: R. F. Kokaly et al., "USGS Spectral Library Version 7" (USGS Data Series 1035, 2017);
R. N. Clark et al., "USGS digital spectral library splib06a" (USGS Data Series 231, 2007).
"""

from __future__ import annotations

import contextlib
import re
from array import array
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample, check_spectrum
from ..parts import band_order, geometry_words, tables
from ..parts.document import Document, quote

NAME = "USGS Spectral Library file"
ENDINGS = ("txt",)
PRIORITY = 100

LICENSE = "public domain (U.S. Geological Survey)"

_RECORD = re.compile(r"\s*([A-Za-z][\w.-]{0,30})\s+Record=(\d{1,9}):\s*(.*?)\s*")
_VERSION_6 = "USGS Digital Spectral Library"
_VALUE = re.compile(r"\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?\s*")
_CODE = re.compile(r"([A-Z][A-Z0-9]*?)([a-z?]{0,2})")
_NO_SPECTRUM = re.compile(
    r"wavelengths?\b|waves\b|wavenumber|bandpass|srf\b|error ?bars?", re.IGNORECASE
)
_NANOMETERS = re.compile(r"\bnm\b|nanomet", re.IGNORECASE)  # else micrometers
_DELETED = -1e30  # anything below: the library writes -1.23e34, some copies of it are rounded

_QUANTITIES = {
    "AREF": "absolute reflectance",
    "RREF": "relative reflectance",
    "RTGC": "reflectance by radiative transfer and ground calibration",
}
_DEVICES = {
    "ASDFR": "ASD FieldSpec, standard resolution",
    "ASDHR": "ASD FieldSpec, high resolution",
    "ASDNG": "ASD FieldSpec NG, high resolution",
    "AVIRIS": "AVIRIS, 1996",
    "BECK": "Beckman 5270",
    "NIC4": "Nicolet FTIR",
}
_FAMILIES = ("ASD", "AVIRIS", "BECK", "NIC4")
# What to ask for, by library and family. Others are found by how their names begin.
_WAVELENGTH_FILES = {
    ("splib07a", "ASD"): "splib07a_Wavelengths_ASD_0.35-2.5_microns_2151_ch.txt",
    ("splib07a", "AVIRIS"): "splib07a_Wavelengths_AVIRIS_1996_0.37-2.5_microns.txt",
    ("splib07a", "BECK"): "splib07a_Wavelengths_BECK_Beckman_0.2-3.0_microns.txt",
    ("splib07a", "NIC4"): "splib07a_Wavelengths_NIC4_Nicolet_1.12-216microns.txt",
    ("splib07b", "ASD"): "splib07b_Wavelengths_ASDFR_0.35-2.5microns_2151ch.txt",
    ("splib07b", "AVIRIS"): "splib07b_Wavelengths_AVIRIS_1996_interp_to_2203ch.txt",
    ("splib07b", "BECK"): "splib07b_Wavelengths_BECK_Beckman_interp._3961_ch.txt",
    ("splib07b", "NIC4"): "splib07b_Wavelengths_NIC4_Nicolet_1.12-216microns.txt",
    ("s07_ASD", ""): "s07_ASD_Wavelengths_ASD_0.35-2.5_microns_2151_ch.txt",
}


@dataclass(frozen=True)
class _Title:
    """The parts of a title: library, sample, spectrometer, purity and quantity."""

    library: str
    sample: str
    spectrometer: str = ""
    purity: str = ""
    quantity: str = ""

    @property
    def family(self) -> str:
        """The spectrometers that share one wavelength file; nothing in libraries of one sensor."""
        if not self.library.lower().startswith("splib"):
            return ""
        return next((name for name in _FAMILIES if self.spectrometer.startswith(name)), "")


def sniff(document: Document) -> bool:
    """Return whether the file begins with a record's title, or as version 6 does."""
    head = document.head_text
    if head.lstrip().startswith(_VERSION_6):
        return True
    first, _, rest = head.partition("\n")
    return bool(_RECORD.fullmatch(first)) and bool(_VALUE.fullmatch(rest.partition("\n")[0]))


def read(document: Document) -> list[Sample]:
    """Return the one sample of the file.

    Raises
    ------
    InputError
        The file is one of wavelengths or bandpasses, the values are no reflectance, the file with
        the wavelengths is not beside it or has another number of channels, or the spectrum is not
        one (`check_spectrum`).
    """
    if document.head_text.lstrip().startswith(_VERSION_6):
        title, place, nm, values, notes = _version_6(document)
    else:
        title, place, nm, values, notes = _version_7(document)
    kept = np.flatnonzero(~(values < _DELETED))  # NaN stays, and is refused below
    altered: tuple[str, ...] = ()
    if kept.size < values.size:
        altered = (
            f"{values.size - kept.size} of {values.size} channels are marked as deleted (-1.23e34) "
            "and were left out.",
        )
    order, moved = band_order.in_order(nm[kept])
    kept = kept[order]
    wavelengths, fractions = check_spectrum(
        nm[kept],
        values[kept],
        str(document.path),
        lambda band: f"line {place + int(kept[band])}",
    )
    geometry = "integrating sphere" if title.spectrometer.startswith("BECK") else ""
    instrument, note = geometry_words.instrument_of(geometry)
    return [
        Sample(
            name=title.sample or document.path.stem,
            wavelengths=wavelengths,
            values=fractions,
            kind="reading",
            quantity=_QUANTITIES[title.quantity],
            instrument=instrument,
            geometry=geometry,
            source=str(document.path),
            license=LICENSE,
            position=f"lines {place} to {place + values.size - 1}",
            device=_DEVICES.get(title.spectrometer, title.spectrometer),
            notes=(*notes, *_notes(title), *filter(None, [note])),
            altered=altered + moved,
        )
    ]


def _notes(title: _Title) -> tuple[str, ...]:
    notes = []
    if title.quantity == "RREF":
        notes.append("The values are relative to a standard whose own reflectance is not in them.")
    if title.purity:
        notes.append(
            f"The library's code for the purity of the sample is {title.purity!r} (a: pure, to d: "
            "contaminated, u: not known)."
        )
    if title.library.lower() == "splib07b":
        notes.append("Of splib07b the library has interpolated the bands from those of splib07a.")
    elif title.library.lower().startswith("s07_"):
        notes.append(f"The library has computed {title.library} from spectra of finer resolution.")
    return tuple(notes)


def _title(document: Document, line: int, library: str, text: str) -> _Title:
    """Take a title apart: the last word is the quantity, the one before it the spectrometer."""
    words = text.split()
    quantity = words[-1].upper() if words else ""
    if quantity == "TRAN":
        raise document.not_reflectance(f"line {line}", "transmittance")
    if quantity not in _QUANTITIES:
        found = quote(words[-1]) if words else "nothing"
        raise document.error(
            f"line {line}",
            f"the title ends with {found}, not with one of {', '.join(_QUANTITIES)}; it is not "
            "known to be reflectance",
        )
    code = _CODE.fullmatch(words[-2]) if len(words) > 1 else None
    if not code:
        return _Title(library, " ".join(words[:-1]), quantity=quantity)
    return _Title(library, " ".join(words[:-2]), code[1], code[2], quantity)


def _version_7(
    document: Document,
) -> tuple[_Title, int, NDArray[np.float64], NDArray[np.float64], tuple[str, ...]]:
    library, text, values = _column(document)
    if _NO_SPECTRUM.match(text):
        raise document.error(
            "line 1",
            f"this holds {quote(text)} and no spectrum; leave it where it is and open a spectrum "
            "beside it",
        )
    title = _title(document, 1, library, text)
    nm, name = _wavelengths(document, title, values.size)
    return title, 2, nm, values, (f"The wavelengths are those of {name}.",)


def _wavelengths(
    document: Document, title: _Title, channels: int
) -> tuple[NDArray[np.float64], str]:
    """Return the wavelengths in nm from the file of all spectra alike, and that file's name."""
    prefix = f"{title.library}_Wavelengths_{title.family}"
    known = _WAVELENGTH_FILES.get((title.library, title.family), "")
    others = []
    for name in dict.fromkeys(filter(None, [known, *_beginning_with(document, prefix)])):
        companion = document.companion(name)
        if companion is None:
            continue
        _, text, numbers = _column(companion)
        if numbers.size == channels:
            # Rounded to 1e-9 nm: 0.57 µm is 570 nm, while the product of the two floats is not.
            return np.round(numbers * (1.0 if _NANOMETERS.search(text) else 1000.0), 9), name
        others.append(f"'{name}' has {numbers.size}")
    if others:
        raise document.error(
            "",
            f"it has {channels} channels, but {others[0]}; put the wavelengths of the same "
            "library there",
        )
    wanted = f"'{known}'" if known else f"the file whose name begins with '{prefix}'"
    raise document.error(
        "",
        f"its wavelengths are in another file; copy {wanted} from the library into the folder of "
        "this file or the one above",
    )


def _beginning_with(document: Document, prefix: str) -> list[str]:
    found: list[str] = []
    for folder in document.folders():
        with contextlib.suppress(OSError):
            found += sorted(p.name for p in folder.iterdir() if p.name.startswith(prefix))
    return found


def _column(document: Document) -> tuple[str, str, NDArray[np.float64]]:
    """Return library, title and values of a file with a title and one number a line."""
    table = tables.lines(document)
    first = next(table)
    match = _RECORD.fullmatch(first)
    if not match:
        raise document.error("line 1", f"{quote(first.strip())} is no title of a USGS record")
    numbers = array("d")
    for number, line in enumerate(table, start=2):
        try:
            numbers.append(float(line.replace("_", "x")))  # Python reads 1_0 as ten
        except ValueError:
            if line.strip():
                raise document.error(
                    f"line {number}", f"{quote(line.strip())} is not a number; download it again"
                ) from None
    return match[1], match[3], np.array(numbers, dtype=np.float64)


def _version_6(
    document: Document,
) -> tuple[_Title, int, NDArray[np.float64], NDArray[np.float64], tuple[str, ...]]:
    top: list[str] = []
    number = 0  # of lines above the title
    for line in tables.lines(document):
        top.append(line)
        if number == 0 and line.startswith("-----"):
            number = len(top)
        if number and len(top) == number + 2:
            break
    else:
        raise document.error(f"line {len(top)}", "the spectrum is missing; download the file again")
    title = _title(document, number + 1, "splib06", top[number])
    table = tables.rows(document, tables.SPACES, skip=number + 2)
    columns = ("wavelength", "reflectance", "standard deviation")
    block = tables.numbers(document, table, columns, (0, 1))
    if not block.lines:
        raise document.error(f"line {number + 2}", "no rows follow; download the file again")
    nm = np.round(block.values[:, 0] * 1000.0, 9)
    notes = ("The standard deviations in the third column were not read.",)
    return title, block.lines[0], nm, block.values[:, 1], notes
