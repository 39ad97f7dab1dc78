# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Binary files of ASD spectroradiometers (FieldSpec, LabSpec, TerraSpec), versions 1 to 8.

Little-endian: a header of 484 bytes, the spectrum, and from version 2 the white reference: a flag
whether it was taken, two times, a text, and a spectrum of the same form. Even files that say
reflectance hold the detector's counts; ASD's software divides them by the reference when it shows
them, and so does this reader.

Source: ASD Inc., "ASD File Format, version 8, revision B"; checked against files of versions 6, 7
and 8.
"""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample, check_spectrum
from ..parts import statements
from ..parts.document import Document

NAME = "ASD binary file (.asd)"
ENDINGS = ("asd",)
PRIORITY = 100

_MAGIC = (b"ASD", b"as2", b"as3", b"as4", b"as5", b"as6", b"as7", b"as8")
_HEADER = 484  # bytes
_COMMENT = slice(3, 160)
# Offsets in the header and what stands there.
_DARK_SUBTRACTED = 181
_DATA_TYPE = 186
_FIRST_WAVELENGTH = 191  # two floats: the first wavelength and the step, nm
_DATA_FORMAT = 199
_CHANNELS = 204
_INSTRUMENT_NUMBER = 400
_SATURATION = 422
_INSTRUMENT = 431

_RAW, _REFLECTANCE = 0, 1
_REFUSED = {
    2: "radiance",
    3: "values without a unit",
    4: "irradiance",
    5: "a quality index",
    6: "transmittance",
    7: "of a kind that the file calls unknown",
    8: "absorbance",
}
_FORMATS: dict[int, np.dtype[np.generic]] = {
    0: np.dtype("<f4"),
    1: np.dtype("<i4"),
    2: np.dtype("<f8"),
}
_INSTRUMENTS = {
    1: "PS II",
    2: "LS VNIR",
    3: "FieldSpec VNIR",
    4: "FieldSpec FR",
    5: "FieldSpec NIR",
    6: "CHEM",
    7: "LabSpec Pro",
    10: "HandHeld",
}
_DETECTORS = {1: "VNIR", 2: "SWIR1", 4: "SWIR2"}
_DIVIDED = (
    "The counts were divided by those of the white reference in the file, as ASD's software does."
)
_PANEL = "The values are relative to the white reference; its own reflectance is not in them."


def sniff(document: Document) -> bool:
    """Return whether the file begins with a version and is binary."""
    # A text that begins "ASD" is no such file; the header has zeros even in a truncated one.
    return document.data[:3] in _MAGIC and b"\0" in document.head[3:]


def read(document: Document) -> list[Sample]:
    """Return the one sample of the file.

    Raises
    ------
    InputError
        The file ends early, the values are no reflectance and cannot become it, a number in the
        header is not possible, or the spectrum is not one (`check_spectrum`).
    """
    data = document.data
    if len(data) < _HEADER:
        raise _truncated(document, "header", _HEADER)
    data_type = data[_DATA_TYPE]
    if data_type not in (_RAW, _REFLECTANCE):
        quantity = _REFUSED.get(data_type, f"of the unknown kind {data_type}")
        raise document.not_reflectance(f"byte {_DATA_TYPE + 1}", quantity)
    nm = _wavelengths(document)
    stored, end = _spectrum(document, _HEADER, nm.size, "spectrum")
    reference = _reference(document, end, nm.size)
    notes = [_PANEL]
    altered: tuple[str, ...] = ()
    if reference is not None:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            stored = stored / reference  # not finite where the reference is 0: refused below
        altered = (_DIVIDED,)
        if not data[_DARK_SUBTRACTED]:
            notes.append("The file says that the dark signal was not subtracted from the counts.")
    elif data_type == _RAW:
        raise document.not_reflectance("", "counts")
    comment = _comment(document)
    notes += _stated(document, comment)
    measured = statements.of_remarks([("", comment)])
    wavelengths, values = check_spectrum(
        nm, stored, str(document.path), lambda band: f"channel {band + 1}"
    )
    return [
        Sample(
            name=document.path.stem,
            wavelengths=wavelengths,
            values=values,
            kind="reading",
            **measured | {"device": _device(document), "notes": (*notes, *measured["notes"])},
            source=str(document.path),
            altered=altered,
        )
    ]


def _wavelengths(document: Document) -> NDArray[np.float64]:
    """Return the wavelengths in nm by first wavelength, step and number of channels."""
    first, step = struct.unpack_from("<2f", document.data, _FIRST_WAVELENGTH)
    (channels,) = struct.unpack_from("<H", document.data, _CHANNELS)
    if channels < 2:
        raise document.error(
            f"byte {_CHANNELS + 1}", f"it states {channels} channels; a spectrum has at least two"
        )
    with np.errstate(invalid="ignore", over="ignore"):  # not finite: `check_spectrum` names it
        return first + step * np.arange(channels, dtype=np.float64)


def _spectrum(
    document: Document, start: int, channels: int, what: str
) -> tuple[NDArray[np.float64], int]:
    """Return the numbers of a spectrum, and where they end."""
    form = _FORMATS.get(document.data[_DATA_FORMAT])
    if form is None:
        raise document.error(
            f"byte {_DATA_FORMAT + 1}",
            f"the format {document.data[_DATA_FORMAT]} of the numbers is not known; save the file "
            "again with ASD's software",
        )
    end = start + channels * form.itemsize
    if end > len(document.data):
        raise _truncated(document, what, end)
    numbers = np.frombuffer(document.data, form, channels, start)
    with np.errstate(invalid="ignore"):  # a signaling NaN
        return numbers.astype(np.float64), end


def _reference(document: Document, start: int, channels: int) -> NDArray[np.float64] | None:
    """Return the white reference; None where the format has none or the file says so."""
    data = document.data
    if data[:3] == b"ASD":
        return None
    if len(data) < start + 20:
        raise _truncated(document, "white reference", start + 20)
    taken, described = struct.unpack_from("<h16xH", data, start)
    if not taken:
        return None
    return _spectrum(document, start + 20 + described, channels, "white reference")[0]


def _comment(document: Document) -> str:
    """Return what the user wrote into the header, or nothing where it is no text."""
    text = " ".join(document.data[_COMMENT].partition(b"\0")[0].decode("latin-1").split())
    return text if text.isprintable() else ""


def _stated(document: Document, comment: str) -> list[str]:
    """Return what the header says that the user should see."""
    notes = []
    if comment:
        notes.append(f"The file's comment: {comment!r}.")
    flags = document.data[_SATURATION]
    saturated = [name for bit, name in _DETECTORS.items() if flags & bit]
    if saturated:
        notes.append(f"Saturated when measured: {', '.join(saturated)}.")
    return notes


def _device(document: Document) -> str:
    kind = _INSTRUMENTS.get(document.data[_INSTRUMENT], "")
    (number,) = struct.unpack_from("<H", document.data, _INSTRUMENT_NUMBER)
    return " ".join(filter(None, ["ASD", kind, str(number or "")]))


def _truncated(document: Document, what: str, size: int) -> Exception:
    return document.error(
        f"byte {len(document.data)}",
        f"the file ends in the {what}, which needs {size} bytes; copy it from the instrument again",
    )
