# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Galactic SPC files (.spc), which many spectrometers' software writes: one spectrum or several.

A header of 512 bytes says what both axes are; then abscissas, unless they are even, and for each
spectrum a header of 32 bytes and its numbers: floats, or whole numbers with a common power of 2.
Reflectance over nm, µm, cm⁻¹ or eV is read, and all else refused by its name.

Source: Galactic Industries, "Universal Data Format Specification" (1997); checked against the text
exports of two programs.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...sample import BRIGHTEST, Sample
from ..parts import series, statements
from ..parts.document import Document, plain

NAME = "Galactic SPC file"
ENDINGS = ("spc",)
PRIORITY = 60

_LITTLE, _BIG, _OLD = 0x4B, 0x4C, 0x4D
_ZIP = b"PK"
"""What archives begin with, and the second byte of it is that of a version."""
_HEADER, _SUBHEADER = 512, 32
# Flags of the first byte.
_SHORT, _MANY, _LABELED, _OWN_ABSCISSAS, _ABSCISSAS = 0x01, 0x04, 0x20, 0x40, 0x80
_FLOATS = 0x80
"""The power of 2 that says that numbers are floats."""
_REFLECTANCE, _PERCENT = 129, 11
_QUANTITIES = {
    1: "an interferogram",
    2: "absorbance",
    3: "Kubelka-Munk values (K/S)",
    4: "counts",
    10: "absorbance",
    14: "of a detector's energy",
    128: "transmittance",
    131: "emission",
}
_PER_NM = {1: 1e7, 14: 1239.8419843320026}
"""What is divided by the abscissa to give nm: cm⁻¹, and eV by CODATA's h c / e."""
_NM = {2: 1e3, 3: 1.0}
_COMMENT, _LABELS = slice(88, 218), slice(218, 248)


class _Header(NamedTuple):
    flags: int
    version: int
    power: int
    points: int
    first: float
    last: float
    spectra: int
    along: int
    quantity: int


def sniff(document: Document) -> bool:
    """Return whether the header could be one: a version, and numbers that fit the file."""
    data = document.data
    if len(data) < 256 or data[1] not in (_LITTLE, _BIG, _OLD) or b"\0" not in data[:64]:
        return False
    if data.startswith(_ZIP):
        return False
    if data[1] == _OLD:
        return document.path.suffix.lower() == ".spc"
    header = _header(data)
    # With abscissas of their own the number of points is the place of a directory.
    fits = 2 * header.points <= len(data) or bool(header.flags & _OWN_ABSCISSAS)
    return header.spectra > 0 and header.along < 32 and fits


def read(document: Document) -> list[Sample]:
    """Return the spectra of the file.

    Raises
    ------
    InputError
        The file is of before 1996 or ends early, its axes are not reflectance over wavelength, or a
        spectrum is none.
    """
    if document.data[1] == _OLD:
        raise document.error(
            "byte 2", "this is an SPC file of before 1996; save it anew, or export it as text"
        )
    if len(document.data) < _HEADER:
        raise _truncated(document)
    header = _header(document.data)
    is_percent = _says_percent(document, header)
    comment = plain(document.data[_COMMENT].partition(b"\0")[0].decode("latin-1"))
    # The notes on the geometry come last, as they do of other formats.
    measured = statements.of_remarks([("", comment)])
    assumed = measured.pop("notes")
    samples = []
    for number, (along, values) in enumerate(_spectra(document, header), start=1):
        place = f"spectrum {number}" if header.spectra > 1 else ""
        where = f"{document.path}, {place}" if place else str(document.path)
        nm = _nanometers(document, header, along)
        scale, notes = _scale(values, is_percent)
        if comment:
            notes = (*notes, f"The file's comment: {comment!r}.")
        found = series.bands(nm, values / scale, where, lambda band: f"point {band + 1}")
        samples.append(
            Sample(
                name=document.path.stem + (f" {number}" if header.spectra > 1 else ""),
                wavelengths=found.wavelengths,
                values=found.values,
                kind="reading",
                **measured,
                source=str(document.path),
                position=place,
                notes=(*notes, *assumed),
                altered=found.altered,
            )
        )
    return samples


def _header(data: bytes) -> _Header:
    order = ">" if data[1] == _BIG else "<"
    flags, version, _, power, points, first, last, count, along, quantity = struct.unpack_from(
        f"{order}4Bi2diBB", data
    )
    return _Header(flags, version, power, max(points, 0), first, last, count, along, quantity)


def _says_percent(document: Document, header: _Header) -> bool:
    """Return whether the file says that its values are percent.

    Raises
    ------
    InputError
        It says that they are no reflectance, or doesn't say what they are.
    """
    label = ""
    if header.flags & _LABELED:
        label = plain(b" ".join(document.data[_LABELS].split(b"\0")[1:2]).decode("latin-1"))
    other = _QUANTITIES.get(header.quantity) or series.other_quantity(label)
    if other:
        raise document.not_reflectance("byte 30", other)
    named = series.says_reflectance(label) or label.strip(" %[]()").upper() == "R"
    if header.quantity != _REFLECTANCE and not named:
        raise document.error(
            "byte 30",
            f"it does not say that its values are reflectance, but {label or header.quantity!r}; "
            "export the reflectance as text",
        )
    return header.quantity == _PERCENT or "%" in label or "percent" in label.lower()


def _scale(values: NDArray[np.float64], is_percent: bool) -> tuple[float, tuple[str, ...]]:
    """Return what to divide values by, and what to say of it."""
    if is_percent:
        return 100.0, ()
    unit = "percent" if np.nanmax(values, initial=0.0) > BRIGHTEST else "fractions"
    return (100.0 if unit == "percent" else 1.0), (
        f"The file does not say whether its values are fractions or percent; {unit} are assumed.",
    )


def _nanometers(
    document: Document, header: _Header, along: NDArray[np.float64]
) -> NDArray[np.float64]:
    if header.along in _NM:
        factor = _NM[header.along]
        # Floats of 32 bits: 0.41 µm is 410 nm, while the product is not.
        return along if factor == 1 else np.round(along * factor, 4)
    if header.along in _PER_NM:
        with np.errstate(divide="ignore"):
            return np.round(_PER_NM[header.along] / along, 4)
    raise document.error(
        "byte 29",
        f"its abscissa is of the kind {header.along}, which is no wavelength; export it over nm",
    )


def _spectra(
    document: Document, header: _Header
) -> Iterator[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Yield abscissas and values of each spectrum."""
    order = ">" if header.version == _BIG else "<"
    place, common = _HEADER, None
    if not header.flags & _OWN_ABSCISSAS:
        if header.flags & _ABSCISSAS:
            common = _numbers(document, f"{order}f4", header.points, place)
            place += 4 * header.points
        else:
            common = np.linspace(header.first, header.last, header.points)
    for _ in range(header.spectra):
        if place + _SUBHEADER > len(document.data):
            raise _truncated(document)
        power, points = document.data[place + 1], header.points
        if header.flags & _OWN_ABSCISSAS:
            (points,) = struct.unpack_from(f"{order}i", document.data, place + 16)
        place += _SUBHEADER
        along = common
        if along is None:
            along = _numbers(document, f"{order}f4", points, place)
            place += 4 * points
        power = power if header.flags & _MANY else header.power
        if power == _FLOATS:
            yield along, _numbers(document, f"{order}f4", points, place)
            place += 4 * points
            continue
        bits = 16 if header.flags & _SHORT else 32
        whole = _numbers(document, f"{order}i{bits // 8}", points, place)
        yield along, np.ldexp(whole, (power - 256 if power > 127 else power) - bits)
        place += bits // 8 * points


def _numbers(document: Document, form: str, count: int, start: int) -> NDArray[np.float64]:
    size = np.dtype(form).itemsize * count
    if count < 0 or start + size > len(document.data):
        raise _truncated(document)
    with np.errstate(invalid="ignore"):
        return np.frombuffer(document.data, form, count, start).astype(np.float64)


def _truncated(document: Document) -> Exception:
    return document.error(
        f"byte {len(document.data)}", "the file ends early; save it again in its program"
    )
