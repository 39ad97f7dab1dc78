# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral libraries of ENVI: a text header (.hdr), and a file of numbers beside it (.sli).

Either of the two may be named. Spectra are the lines of a picture with one band, wavelengths its
samples. Cubes are images: see `addon/textures`.

Source: "ENVI Header Files", https://www.nv5geospatialsoftware.com/docs/ENVIHeaderFiles.html.
"""

from __future__ import annotations

import os

import numpy as np

from ...sample import Sample
from ..parts import envi_header, series, statements
from ..parts.document import Document, open_document, plain
from ..parts.label_words import says_percent

NAME = "ENVI spectral library"
ENDINGS = ("sli", "hdr", "slb")
PRIORITY = 100

_NUMBERS = (".sli", ".SLI", ".slb", ".SLB", ".dat", ".img", "")
_MANY = 100_000
_OF_NUMBERS = {"wavelength", "wavelength units", "spectra names", "fwhm", "bbl", "z plot titles"}
"""Words of the header that say nothing of how its spectra were measured."""
_LONGEST = 1000  # characters of the description that are searched for a geometry


def sniff(document: Document) -> bool:
    """Return whether it is a header, or numbers with a header beside them."""
    return _header_of(document) is not None


def read(document: Document) -> list[Sample]:
    """Return the spectra in the order of the file.

    Raises
    ------
    InputError
        The header is of an image, contradicts itself or the file of numbers, or a spectrum is none.
    """
    header = _header_of(document)
    assert header is not None
    found = envi_header.entries(header.data.decode("utf-8", "replace"))
    if "library" not in found.get("file type", "").lower():
        raise header.error(
            "key 'file type'",
            "this is an image and no spectral library; make a material of it with Material from "
            "Image, or export the mean of a region as CSV",
        )
    numbers = _numbers_of(document, header)
    try:
        bands, count = envi_header.whole(found, "samples"), envi_header.whole(found, "lines")
        form = envi_header.form(found)
        start = envi_header.whole(found, "header offset", 0)
        stated = envi_header.number(found, "reflectance scale factor")
        ignored = envi_header.number(found, "data ignore value")
        nm, notes = envi_header.wavelengths(found, bands)
    except ValueError as error:
        raise header.error("", f"it {error}") from None
    size = start + bands * count * form.itemsize
    if not 0 < count <= _MANY or size > len(numbers.data):
        raise numbers.error(
            "",
            f"the header promises {count} spectra of {bands} bands, {size} bytes, and the file has "
            f"{len(numbers.data)}; copy both again",
        )
    scale = 1.0 if stated is None else stated
    ordinate = found.get("z plot titles", "").strip("{} ").rpartition(",")[2]
    if other := series.other_quantity(ordinate):
        raise header.not_reflectance("key 'z plot titles'", other)
    if stated is None and says_percent(ordinate):
        scale = stated = 100.0
    if form.kind != "f" and stated is None:
        raise header.error(
            "", "it has whole numbers and no 'reflectance scale factor'; add it, such as 10000"
        )
    if not (np.isfinite(scale) and scale > 0):
        raise header.error("key 'reflectance scale factor'", "it has to be above 0; mend it")
    table = np.frombuffer(numbers.data, form, bands * count, start).reshape(count, bands)
    names = envi_header.names(found.get("spectra names", ""))
    described = plain(found.get("description", "")[:_LONGEST]).strip("{} ")
    texts = ((key, plain(text[:_LONGEST]).strip("{} ")) for key, text in found.items())
    own = [(k, text) for k, text in texts if k not in _OF_NUMBERS and text.lower() != "unknown"]
    measured = statements.of_remarks([*own, ("", described)])
    samples = []
    for i, row in enumerate(table):
        with np.errstate(invalid="ignore", over="ignore"):
            values = row.astype(np.float64)
            values[values == ignored] = np.nan
        place = f"spectrum {i + 1}"
        taken = series.bands(nm, values / scale, f"{document.path}, {place}", _band)
        samples.append(
            Sample(
                name=(names[i] if len(names) == count else "")
                or f"{document.path.stem}{f' {i + 1}' if count > 1 else ''}",
                wavelengths=taken.wavelengths,
                values=taken.values,
                kind="reading",
                **measured | {"notes": (*notes, *measured["notes"])},
                source=str(document.path),
                position=place if count > 1 else "",
                altered=taken.altered,
            )
        )
    return samples


def _band(band: int) -> str:
    return f"band {band + 1}"


def _header_of(document: Document) -> Document | None:
    """Return the header, of whichever of the two files is named; None where it is neither."""
    if document.head.startswith(envi_header.MAGIC):
        return document
    if not document.fault:  # text is none of its numbers
        return None
    name = document.path.name
    for header in (f"{name}.hdr", f"{document.path.stem}.hdr"):
        path = document.path.with_name(header)
        try:
            with path.open("rb") as file:
                if file.read(4) == envi_header.MAGIC:
                    return open_document(path)
        except (OSError, ValueError):
            continue
    return None


def _numbers_of(document: Document, header: Document) -> Document:
    if document is not header:
        return document
    base = document.path.with_suffix("")
    for ending in _NUMBERS:
        path = base.with_name(base.name + ending)
        if path != document.path and os.path.isfile(path):
            return open_document(path)
    raise document.error("", "this is a header without its file of numbers; put the .sli beside it")
