# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubes of spectral cameras, as ENVI writes them: a header of text, and numbers in another file.

Either of the two may be named. Read are whole numbers and floats of every order of bytes and
bands; compressed ones and complex numbers are refused.

What the header says is read by `samples/readers/parts/envi_header`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ..samples.readers.parts import envi_header
from .image import BandImage, Pixels, fault

_ENDINGS = ("", ".img", ".dat", ".raw", ".cube", ".bsq", ".bil", ".bip", ".bin")
_LARGEST_HEADER = 4_000_000  # bytes; that of 1,000 bands with all lists has 60,000


def header_of(path: Path) -> Path | None:
    """Give the header of a cube, of whichever of its files is named; None where it is none."""
    tried = (
        [path] if path.suffix.lower() == ".hdr" else [Path(f"{path}.hdr"), path.with_suffix(".hdr")]
    )
    for header in tried:
        try:
            with header.open("rb") as file:
                if file.read(4) == envi_header.MAGIC:
                    return header
        except OSError:
            continue
    return None


class Cube(BandImage):
    """A cube that is open for reading.

    Parameters
    ----------
    header
        Path of the header.
    scale
        What stands for a reflectance of 1; None takes what the header says.

    Raises
    ------
    InputError
        If the header contradicts itself or the file of numbers, or leaves out what has to be known.
    """

    def __init__(self, header: Path, scale: float | None = None) -> None:
        entries = _entries(header)
        with _named(header):
            width, height, self._bands = (
                envi_header.whole(entries, name) for name in ("samples", "lines", "bands")
            )
        super().__init__(header, width, height)
        if "library" in entries.get("file type", "").lower():
            raise self.fault("is a spectral library and no image; import its samples instead")
        if entries.get("file compression", "0") not in ("0", ""):
            raise self.fault("says that its numbers are compressed; save the cube without that")
        self._layout = entries.get("interleave", "bsq").lower()
        with _named(header):
            self._form = envi_header.form(entries)
            self._start = envi_header.whole(entries, "header offset", 0)
            self._ignored = envi_header.number(entries, "data ignore value")
            stated = envi_header.number(entries, "reflectance scale factor")
            self.wavelengths, self.notes = envi_header.wavelengths(entries, self._bands)
        if self._layout not in ("bsq", "bil", "bip"):
            raise self.fault(f"has the interleave {self._layout!r}; it may be BSQ, BIL or BIP")
        self._scale = self._scale_of(stated, scale)
        self.names = tuple(f"{nm:g} nm" for nm in self.wavelengths)
        bad = envi_header.words(entries.get("bbl", ""))
        self.good = [band for band in range(self._bands)
                     if len(bad) != self._bands or bad[band] != "0"]  # fmt: skip
        self._open(header)
        self.take(range(self._bands))

    def take(self, bands: Sequence[int]) -> None:
        """Read these bands from now on."""
        self._taken = list(bands)

    def read(self, first: int, last: int) -> Pixels:
        """Read lines as reflectance; what the header says to ignore is NaN."""
        count, width, bands = last - first, self.width, self._bands
        out = np.empty((count, width, len(self._taken)), np.float32)
        if self._layout == "bsq":
            for place, band in enumerate(self._taken):
                block = self._numbers((band * self.height + first) * width, count * width)
                out[:, :, place] = block.reshape(count, width)
        else:
            block = self._numbers(first * width * bands, count * width * bands)
            if self._layout == "bil":
                out[:] = block.reshape(count, bands, width)[:, self._taken].transpose(0, 2, 1)
            else:
                out[:] = block.reshape(count, width, bands)[:, :, _slice(self._taken)]
        if self._ignored is not None:
            out[out == np.float32(self._ignored)] = np.nan
        if self._scale != 1:
            out *= np.float32(1 / self._scale)
        return out.reshape(count * width, -1)

    def close(self) -> None:
        """Let the file go."""
        self._file.close()

    def _numbers(self, start: int, count: int) -> np.ndarray[tuple[int, ...], np.dtype[np.generic]]:
        self._file.seek(self._start + start * self._form.itemsize)
        found = np.fromfile(self._file, self._form, count)
        if found.size != count:
            raise self.fault("goes with a file that ends early; copy the cube again")
        return found

    def _scale_of(self, stated: float | None, scale: float | None) -> float:
        if scale is None and stated is None and self._form.kind != "f":
            raise self.fault(
                "holds whole numbers and no 'reflectance scale factor'; say which number stands "
                "for a reflectance of 1, such as 10000"
            )
        found = scale if scale is not None else 1.0 if stated is None else stated
        if not (np.isfinite(found) and found > 0):
            raise self.fault(f"has {found:g} for a reflectance of 1; give a number above 0")
        return float(found)

    def _open(self, header: Path) -> None:
        size = self._start + self.width * self.height * self._bands * self._form.itemsize
        base = header.with_suffix("")
        bases = [base] if base.suffix else [base, Path(f"{base}{header.suffix}")]
        found = [
            path
            for each in bases
            for ending in _ENDINGS
            for path in {Path(f"{each}{ending}"), Path(f"{each}{ending.upper()}")}
            if path.is_file() and path != header
        ]
        if not found:
            raise self.fault(
                "is a header without its file of numbers; put it beside, with the same name"
            )
        if found[0].stat().st_size < size:
            raise self.fault(
                f"says that {found[0].name} has {size} bytes, and it has "
                f"{found[0].stat().st_size}; copy the cube again"
            )
        self._file = found[0].open("rb")


def _entries(header: Path) -> dict[str, str]:
    if header.stat().st_size > _LARGEST_HEADER:
        raise fault(header, "is too large for a header; name the cube's own")
    return envi_header.entries(header.read_bytes().decode("utf-8", "replace"))


@contextmanager
def _named(header: Path) -> Iterator[None]:
    """Let what is wrong with a header name it."""
    try:
        yield
    except ValueError as error:
        raise fault(header, str(error)) from None


def _slice(bands: list[int]) -> slice | list[int]:
    """Give a slice for what is one run of bands: no copy is made of it."""
    if bands == list(range(bands[0], bands[-1] + 1)):
        return slice(bands[0], bands[-1] + 1)
    return bands
