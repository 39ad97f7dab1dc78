# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubes of spectral cameras, as ENVI writes them: a header of text, and numbers in another file.

Either of the two may be named. Read are whole numbers and floats of every order of bytes and
bands; compressed ones and complex numbers are refused.

Source: "ENVI Header Files", https://www.nv5geospatialsoftware.com/docs/ENVIHeaderFiles.html.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from .image import BandImage, Pixels, fault

_TYPES = {1: "u1", 2: "i2", 3: "i4", 4: "f4", 5: "f8", 12: "u2", 13: "u4"}
_ENDINGS = ("", ".img", ".dat", ".raw", ".cube", ".bsq", ".bil", ".bip", ".bin")
_UNITS = {"nanometers": 1.0, "nanometer": 1.0, "nm": 1.0, "micrometers": 1e3, "micrometer": 1e3,
          "micron": 1e3, "microns": 1e3, "um": 1e3, "µm": 1e3, "angstroms": 0.1}  # fmt: skip
_LARGEST_HEADER = 4_000_000  # bytes; that of 1,000 bands with all lists has 60,000
_ENTRY = re.compile(r"^\s*([A-Za-z][^={}\n]*?)\s*=\s*(\{[^}]*\}|[^\n]*)", re.MULTILINE)
_NANOMETERS = (200.0, 20_000.0)
_MICROMETERS = (0.2, 20.0)


def header_of(path: Path) -> Path | None:
    """Give the header of a cube, of whichever of its files is named; None where it is none."""
    tried = (
        [path] if path.suffix.lower() == ".hdr" else [Path(f"{path}.hdr"), path.with_suffix(".hdr")]
    )
    for header in tried:
        try:
            with header.open("rb") as file:
                if file.read(4) == b"ENVI":
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
        width, height, self._bands = (_whole(header, entries, name) for name in
                                      ("samples", "lines", "bands"))  # fmt: skip
        super().__init__(header, width, height)
        if "library" in entries.get("file type", "").lower():
            raise self.fault("is a spectral library and no image; import its samples instead")
        if entries.get("file compression", "0") not in ("0", ""):
            raise self.fault("says that its numbers are compressed; save the cube without that")
        code = _whole(header, entries, "data type")
        if code not in _TYPES:
            raise self.fault(f"has numbers of the type {code}; save the cube as floats, type 4")
        order = ">" if entries.get("byte order", "0") == "1" else "<"
        self._form = np.dtype(order + _TYPES[code])
        self._layout = entries.get("interleave", "bsq").lower()
        if self._layout not in ("bsq", "bil", "bip"):
            raise self.fault(f"has the interleave {self._layout!r}; it may be BSQ, BIL or BIP")
        self._start = _whole(header, entries, "header offset", 0)
        self._ignored = _number(header, entries, "data ignore value")
        self._scale = self._scale_of(entries, scale)
        self._lists(entries)
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

    def _scale_of(self, entries: dict[str, str], scale: float | None) -> float:
        stated = _number(self.path, entries, "reflectance scale factor")
        if scale is None and stated is None and self._form.kind != "f":
            raise self.fault(
                "holds whole numbers and no 'reflectance scale factor'; say which number stands "
                "for a reflectance of 1, such as 10000"
            )
        found = scale if scale is not None else 1.0 if stated is None else stated
        if not (np.isfinite(found) and found > 0):
            raise self.fault(f"has {found:g} for a reflectance of 1; give a number above 0")
        return float(found)

    def _lists(self, entries: dict[str, str]) -> None:
        """Read what the header lists of each band."""
        if "wavelength" not in entries:
            raise self.fault("has no 'wavelength' of its bands; add that line to the header")
        try:
            values = np.array([float(word) for word in _words(entries["wavelength"])])
        except ValueError:
            raise self.fault("has a 'wavelength' that is no number; mend the header") from None
        if values.size != self._bands:
            raise self.fault(
                f"lists {values.size} wavelengths of {self._bands} bands; mend the header"
            )
        unit = entries.get("wavelength units", "").strip().lower()
        if unit in _UNITS:
            self.wavelengths = values * _UNITS[unit]
        elif unit not in ("", "unknown"):
            raise self.fault(f"has wavelengths in {unit!r}; they may be nanometers or micrometers")
        elif _within(values, _NANOMETERS):
            self.wavelengths = values
            self.notes = ("The header names no unit of wavelengths; taken for nanometers.",)
        elif _within(values, _MICROMETERS):
            self.wavelengths = values * 1e3
            self.notes = ("The header names no unit of wavelengths; taken for micrometers.",)
        else:
            raise self.fault("names no unit of its wavelengths; add 'wavelength units' to it")
        # Decimals of micrometers leave a last digit behind: 0.41 µm is no even grid with 0.4.
        self.wavelengths = np.round(self.wavelengths, 6)
        self.names = tuple(f"{nm:g} nm" for nm in self.wavelengths)
        bad = _words(entries.get("bbl", ""))
        self.good = [band for band in range(self._bands)
                     if len(bad) != self._bands or bad[band] != "0"]  # fmt: skip

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
    text = header.read_bytes().decode("utf-8", "replace")
    return {key.lower(): value.strip() for key, value in _ENTRY.findall(text)}


def _words(listed: str) -> list[str]:
    return listed.strip("{} \n").replace(",", " ").split()


def _whole(header: Path, entries: dict[str, str], name: str, default: int | None = None) -> int:
    if name not in entries and default is not None:
        return default
    text = entries.get(name, "")
    if not re.fullmatch(r"\d{1,12}", text):
        raise fault(header, f"has no readable {name!r}; mend the header")
    return int(text)


def _number(header: Path, entries: dict[str, str], name: str) -> float | None:
    if name not in entries:
        return None
    try:
        return float(entries[name])
    except ValueError:
        raise fault(header, f"has a {name!r} that is no number; mend the header") from None


def _within(
    values: np.ndarray[tuple[int, ...], np.dtype[np.float64]], ends: tuple[float, float]
) -> bool:
    return bool(values.size and ends[0] <= values.min() and values.max() <= ends[1])


def _slice(bands: list[int]) -> slice | list[int]:
    """Give a slice for what is one run of bands: no copy is made of it."""
    if bands == list(range(bands[0], bands[-1] + 1)):
        return slice(bands[0], bands[-1] + 1)
    return bands
