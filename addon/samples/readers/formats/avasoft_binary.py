# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Binary files of Avantes' AvaSoft 8 (.RFL8, .Rfl8x), with one spectrum or several.

Little-endian: a version of five bytes, the number of spectra, and for each its length, a header,
wavelengths, the sample's counts, the dark ones and the white reference's. AvaSoft shows
100 (S - D) / (R - D), and so is it read here. Files of AvaSoft 6 and 7 don't say what was measured,
and are refused.

Source: checked against AvaSoft's own text exports of files that versions 8.2 and 8.4 wrote.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample
from ..parts import series
from ..parts.document import Document, plain
from ..parts.geometry_words import instrument_of

NAME = "AvaSoft binary file"
ENDINGS = ("rfl8", "rfl8x")
PRIORITY = 100

_VERSIONS = {b"AVS82": 0, b"AVS84": 3779}  # and how much follows the spectrum and its group
_OLDER = (b"\x00\x00\x8cB", b"\x00\x00pB")  # 70.0 and 60.0
_MODES = ("counts", "counts", "absorbance", "transmittance", "irradiance", "", "irradiance")
"""What is measured, by a byte of the header; nothing stands for reflectance."""
# Offsets from where a spectrum's length stands.
_MODE = 5
_DEVICE = slice(8, 18)
_PIXELS = 83
_COMMENT = slice(192, 322)
_HEADER = 322
_GROUP = 10
_DIVIDED = (
    "The counts were divided by those of the white reference in the file, without the dark ones, "
    "as AvaSoft does."
)


def sniff(document: Document) -> bool:
    """Return whether the file begins as AvaSoft's do."""
    return document.head.startswith((b"AVS8", *_OLDER))


def read(document: Document) -> list[Sample]:
    """Return the spectra of the file.

    Raises
    ------
    InputError
        The file is older than AvaSoft 8.2, ends early, holds no reflectance, or a spectrum is none.
    """
    version = document.data[:5]
    if version not in _VERSIONS:
        raise document.error(
            "", "this is a binary file of AvaSoft; export the reflectance as text in AvaSoft"
        )
    count = document.data[5] if len(document.data) > 5 else 0
    instrument, assumed = instrument_of("")
    samples = []
    for number, start in enumerate(_starts(document, version, count), start=1):
        place = f"spectrum {number}" if count > 1 else ""
        comment = plain(document.data[start:][_COMMENT].partition(b"\0")[0].decode("latin-1"))
        nm, values = _spectrum(document, start, place)
        where = f"{document.path}, {place}" if place else str(document.path)
        found = series.bands(nm, values, where, lambda band: f"channel {band + 1}")
        samples.append(
            Sample(
                name=(comment or document.path.stem) + (f" {number}" if count > 1 else ""),
                wavelengths=found.wavelengths,
                values=found.values,
                kind="reading",
                instrument=instrument,
                source=str(document.path),
                position=place,
                device=plain(document.data[start:][_DEVICE].partition(b"\0")[0].decode("latin-1")),
                notes=(assumed,),
                altered=(_DIVIDED, *found.altered),
            )
        )
    return samples


def _starts(document: Document, version: bytes, count: int) -> Iterator[int]:
    """Yield where each spectrum begins; how long one is follows from its own pixels."""
    start = 6
    for _ in range(count):
        yield start
        start += _HEADER + 16 * _pixels(document, start) + _GROUP + _VERSIONS[version]


def _pixels(document: Document, start: int) -> int:
    if start + _HEADER > len(document.data):
        raise _truncated(document)
    first, last = struct.unpack_from("<2H", document.data, start + _PIXELS)
    if last <= first:
        raise document.error(
            f"byte {start + _PIXELS + 1}",
            f"it states pixels {first} to {last}; a spectrum has at least two",
        )
    return int(last - first + 1)


def _spectrum(
    document: Document, start: int, place: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return wavelengths and reflectance; NaN where the white reference has no signal."""
    pixels = _pixels(document, start)
    mode = document.data[start + _MODE]
    other = _MODES[mode] if mode < len(_MODES) else f"of the unknown kind {mode}"
    if other:
        raise document.not_reflectance(place or f"byte {start + _MODE + 1}", other)
    if start + _HEADER + 16 * pixels > len(document.data):
        raise _truncated(document)
    table = np.frombuffer(document.data, "<f4", 4 * pixels, start + _HEADER).reshape(4, -1)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        nm, sample, dark, white = table.astype(np.float64)
        signal = white - dark
        return nm, np.where(signal > 0, (sample - dark) / signal, np.nan)


def _truncated(document: Document) -> Exception:
    return document.error(
        f"byte {len(document.data)}", "the file ends early; copy it from the instrument again"
    )
