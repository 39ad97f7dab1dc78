# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The text header that ENVI writes beside cubes and spectral libraries.

Source: "ENVI Header Files", https://www.nv5geospatialsoftware.com/docs/ENVIHeaderFiles.html.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from . import label_words

MAGIC = b"ENVI"
TYPES = {1: "u1", 2: "i2", 3: "i4", 4: "f4", 5: "f8", 12: "u2", 13: "u4"}
"""Numbers by the code of the header; complex ones and those of 64 bits are not read."""

_UNITS = {"nanometers": 1.0, "nanometer": 1.0, "nm": 1.0, "micrometers": 1e3, "micrometer": 1e3,
          "micron": 1e3, "microns": 1e3, "um": 1e3, "µm": 1e3, "angstroms": 0.1}  # fmt: skip
_KEYS = 100
"""Characters of a word of the header, at most."""
_NANOMETERS = (200.0, 20_000.0)
_MICROMETERS = (0.2, 20.0)


def entries(text: str) -> dict[str, str]:
    """Give what the header says, by its words in small letters; lists with their braces."""
    found: dict[str, str] = {}
    listed, parts = "", [""]
    for line in text.split("\n"):
        if listed:
            parts.append(line)
        else:
            key, equals, value = line.partition("=")
            key = key.strip().lower()
            if not equals or not key or len(key) > _KEYS:
                continue
            found[key] = value.strip()
            if not value.lstrip().startswith("{"):
                continue
            listed, parts = key, [value.strip()]
        if "}" in parts[-1]:  # of the line what belongs to the list: a key may hold one, too
            whole = "\n".join(parts)
            found[listed], listed = whole[: whole.index("}") + 1], ""
    return found


def words(listed: str) -> list[str]:
    """Give the numbers or words of a list."""
    return listed.strip("{} \n").replace(",", " ").split()


def names(listed: str) -> list[str]:
    """Give what stands between the commas of a list, which may hold spaces."""
    return [" ".join(name.split()) for name in listed.strip("{} \n").split(",")]


def whole(found: dict[str, str], name: str, default: int | None = None) -> int:
    """Give a whole number.

    Raises
    ------
    ValueError
        It is none, or missing without a default; the message is the rest of a sentence.
    """
    if name not in found and default is not None:
        return default
    text = found.get(name, "")
    if not re.fullmatch(r"\d{1,12}", text):
        raise ValueError(f"has no readable {name!r}; mend the header")
    return int(text)


def number(found: dict[str, str], name: str) -> float | None:
    """Give a number, or None where the header has none.

    Raises
    ------
    ValueError
        It is no number; the message is the rest of a sentence.
    """
    if name not in found:
        return None
    try:
        return float(found[name])
    except ValueError:
        raise ValueError(f"has a {name!r} that is no number; mend the header") from None


def form(found: dict[str, str]) -> np.dtype[np.generic]:
    """Give the type of the numbers.

    Raises
    ------
    ValueError
        It is not one that is read; the message is the rest of a sentence.
    """
    code = whole(found, "data type")
    if code not in TYPES:
        raise ValueError(f"has numbers of the type {code}; save them as floats, type 4")
    order = ">" if found.get("byte order", "0") == "1" else "<"
    return np.dtype(order + TYPES[code])


def wavelengths(found: dict[str, str], bands: int) -> tuple[NDArray[np.float64], tuple[str, ...]]:
    """Give the wavelengths of all bands in nm, and what to say of them.

    Raises
    ------
    ValueError
        They are missing, no numbers, of another count or no wavelengths; the message is the rest of
        a sentence.
    """
    if "wavelength" not in found:
        raise ValueError("has no 'wavelength' of its bands; add that line to the header")
    try:
        values = np.array([float(word) for word in words(found["wavelength"])])
    except ValueError:
        raise ValueError("has a 'wavelength' that is no number; mend the header") from None
    if values.size != bands:
        raise ValueError(f"lists {values.size} wavelengths of {bands} bands; mend the header")
    unit = found.get("wavelength units", "").strip().lower()
    notes: tuple[str, ...] = ()
    if unit in _UNITS:
        nm = values * _UNITS[unit]
    elif known := label_words.unit_of_wavelengths(unit):
        nm = label_words.to_nanometers(values, known)
    elif unit not in ("", "unknown"):
        raise ValueError(f"has wavelengths in {unit!r}; they may be nanometers or wavenumbers")
    elif _within(values, _NANOMETERS):
        nm, notes = values, ("The header names no unit of wavelengths; taken for nanometers.",)
    elif _within(values, _MICROMETERS):
        nm = values * 1e3
        notes = ("The header names no unit of wavelengths; taken for micrometers.",)
    else:
        raise ValueError("names no unit of its wavelengths; add 'wavelength units' to it")
    # Decimals of micrometers leave a last digit behind: 0.41 µm is no even grid with 0.4.
    return np.round(nm, 6), notes


def _within(values: NDArray[np.float64], ends: tuple[float, float]) -> bool:
    return bool(values.size and ends[0] <= values.min() and values.max() <= ends[1])
