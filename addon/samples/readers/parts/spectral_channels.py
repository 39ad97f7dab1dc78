# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of an OpenEXR image's spectral channels, and the wavelengths in them.

Channels ``T.400,000000nm`` hold reflectance. Channels ``S0.400,000000nm`` hold emitted radiance,
``S1`` to ``S3`` its polarization, and ``T.380,000000nm.420,000000nm`` what light of one wavelength
becomes at another.

Source: A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout for Spectral Images" (JCGT 10,
2021).
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

_SPEED_OF_LIGHT = 299_792_458.0  # m/s
_NUMBER = r"(\d{1,12}(?:,\d{0,12})?(?:[eE][+-]?\d{1,2})?)"
_UNIT = r"([YZEPTGMkhdcmunp]|da)?(m|Hz)"
_CHANNEL = re.compile(rf"(?:(.*)\.)?(S[0-3]|T)\.{_NUMBER}{_UNIT}(?:\.({_NUMBER}{_UNIT}))?")
_PREFIXES = dict(zip("YZEPTGMkhdcmunp", (24, 21, 18, 15, 12, 9, 6, 3, 2, -1, -2, -3, -6, -9, -12),
                     strict=True)) | {"da": 1, "": 0}  # fmt: skip
_PLAIN = re.compile(r"(\d{3,4}(?:\.\d{1,6})?)(?:\s*-\s*(\d{3,4}(?:\.\d{1,6})?))?\s*nm", re.I)


class SpectralChannel(NamedTuple):
    """What a channel's name says.

    Parameters
    ----------
    layer
        Name of its layer, or None.
    nm
        Wavelength in nanometers.
    emits
        Whether it holds emitted light.
    bispectral
        Whether it is of two wavelengths.
    """

    layer: str | None
    nm: float
    emits: bool
    bispectral: bool


def parse(name: str) -> SpectralChannel | None:
    """Return what a name of that layout says; None of any other.

    Examples
    --------
    >>> parse("T.550,0nm").nm, parse("S0.0,55um").emits, parse("R")
    (550.0, True, None)
    """
    match = _CHANNEL.fullmatch(name)
    if not match:
        return None
    nm = _nanometers(match[3], match[4], match[5])
    return SpectralChannel(match[1], nm, match[2] != "T", bool(match[6]))


def plain(name: str) -> float | None:
    """Return the wavelength in nanometers of a name that just has one; None of any other.

    Such as ``550nm`` and ``reflectance_550.5 nm`` of spectral cameras' software, and the middle of
    ``540.00-560.00nm``, as Mitsuba 0.6 names the bands of its films.

    Examples
    --------
    >>> plain("R_550nm"), plain("540.00-560.00nm"), plain("S0.550,0nm"), plain("B05")
    (550.0, 550.0, None, None)
    """
    match = _PLAIN.search(name)
    if not match or parse(name) or name[match.end() :].strip(" )]"):
        return None
    ends = [float(text) for text in match.groups() if text]
    return sum(ends) / len(ends)


def _nanometers(number: str, prefix: str | None, unit: str) -> float:
    value = float(number.replace(",", ".")) * 10.0 ** _PREFIXES[prefix or ""]
    if unit == "Hz":
        value = _SPEED_OF_LIGHT / value if value else np.inf
    return round(value * 1e9, 9)
