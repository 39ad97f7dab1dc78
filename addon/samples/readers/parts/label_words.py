# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What column names and comments of a plain table say: wavelengths, units, quantities."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from .....core.instruments import REGISTRY
from ....support.shown_text import ESCAPED
from ...sample import Kind
from ...stated_white import fields as white_fields
from . import name_marks
from .document import Document, quote
from .geometry_words import device_in_text, in_text
from .tables import lines

T = TypeVar("T")

NM_PER_UNIT = {"nm": 1.0, "µm": 1000.0, "Å": 0.1, "m": 1e9, "mm": 1e6, "pm": 1e-3}
NM_TIMES_UNIT = {
    "cm⁻¹": 1e7,
    "m⁻¹": 1e9,
    "THz": 299_792.458,
    "PHz": 299.792458,
    "GHz": 299_792_458.0,
    "Hz": 2.99792458e17,
    "eV": 1239.8419843320026,
    "meV": 1239841.9843320026,
}
"""What an abscissa other than a wavelength is divided into to give nm: c, and h c / e of CODATA."""

_BAND = re.compile(
    # What stands before: R400, %R400, nm400, SPECTRAL_NM_400, X400 (as R names columns), R[400].
    r"%?\s*(?:r|refl(?:ectance)?|spec(?:tral)?(?:[ _]?nm)?|nm|wl|w|wavelength|λ|x)?\s*%?"
    r"[ _.\[(-]{0,2}(\d{1,5}(?:[.,]\d{1,17})?)"
    r"[\])]?\s*[\[(]?(nm|[µμu]m|å|cm\s?\^?[-−–]1|cm⁻¹|1\s?/\s?cm|thz|ev)?[\])]?"
    r"\s*[\[(]?%?[\])]?",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"\d{1,2}(?:[.,]\d{1,17})?")
_LONGEST = 100  # characters of a value that are looked at for a unit
_LEAST_BARE = 3  # columns of bands called by numbers alone, where more than a name stands before
# ArgyllCMS' family of names is percent, as CGATS readers know.
_SPEC = re.compile(r"spec_\d", re.IGNORECASE)
_UNIT = re.compile(
    r"[\[(]?(?:nm|[µμupm]?m|nanomet\w+|micromet\w+|å|angstroms?|1/c?m|c?m\^?-1|c?m⁻¹|[tpg]?hz|m?ev|1|%|percent|fraction|counts|a\.?u\.?|-|none|units?)?"
    r"(?: ?(?:r|refl\w*|t|transm\w*|abs\w*))?[\])]?",
    re.IGNORECASE,
)
_WAVELENGTH = re.compile(
    r"(?:wave[ _-]?(?:lengths?|numbers?)|wvl|wl|lambda|λ|nm|1/cm|cm\^?-1|cm⁻¹|thz|ev|"
    r"wellenl(?:ä|ae)ngen?|wellenzahl(?:en)?|longueurs? d.onde|nombres? d.onde|longitud de onda|"
    r"n[úu]mero de onda|lunghezz[ae] d.onda|comprimento de onda|golflengte|våglängd|"
    r"длин[аы] волн\w*|波[長长数])(?![a-z])|"
    r"(?:photon )?(?:frequency|energy)\s*[\[(/,]",
    re.IGNORECASE,
)
_FREQUENCY = re.compile(
    r"\benerg(?:y|ie|ía|ia)\b|\bfrequen[cz]|\bfr[ée]quence|"
    r"\bfrecuencia|周波数|振動数|\bphoton energ|"
    r"^\s*(?:nu|ν|f|freq\.?|energ(?:y|ie|ía|ia)|[ée]nergie)\s*$",
    re.IGNORECASE,
)
_RAMAN = re.compile(r"\braman\b|\bshift\b", re.IGNORECASE)
_OTHER_UNITS = {
    "Å": re.compile(r"\bangstr|ångstr|å\b|[\[(]\s*aa?\s*[\])]", re.IGNORECASE),
    "m⁻¹": re.compile(
        r"(?<![a-zµμ])m\s*\^?\s*[-−–]\s*1\b|(?<![a-zµμ])m⁻¹|\b1\s*/\s*m\b", re.IGNORECASE
    ),
    "cm⁻¹": re.compile(
        r"cm\s*\^?\s*\{?\s*[-−–]\s*1\b|cm⁻¹|\b1\s*/\s*cm\b|\b(?:per|inverse) cm\b|"
        r"wave[ _-]?number|wellenzahl|nombre d.onde|numero d.onda|(?<!周)波数|\bkaysers?\b",
        re.IGNORECASE,
    ),
    "THz": re.compile(r"\bthz\b|терагерц|тгц|terahertz", re.IGNORECASE),
    "PHz": re.compile(r"\bphz\b|petahertz", re.IGNORECASE),
    "GHz": re.compile(r"\bghz\b|gigahertz", re.IGNORECASE),
    "Hz": re.compile(r"\bhz\b|\bhertz\b|\bs\^?-1\b", re.IGNORECASE),
    "meV": re.compile(r"\bmev\b|milli-?ele[ck]tronen?[ -]?volts?", re.IGNORECASE),
    "eV": re.compile(r"\bev\b|\bele[ck]tronen?[ -]?volts?|эв\b", re.IGNORECASE),
    "pm": re.compile(r"(?:^|[\[(/,])\s*(?-i:pm)\s*[\])]?\s*$|picomet", re.IGNORECASE),
    "mm": re.compile(r"(?:^|[\[(/,])\s*(?-i:mm)\s*[\])]?\s*$|millimet", re.IGNORECASE),
    "m": re.compile(
        r"(?:^|[\[(/,])\s*(?-i:m)\s*[\])]?\s*$|(?<![a-z])met(?:er|re)s?\b", re.IGNORECASE
    ),
}
_UNKNOWN_UNIT = re.compile(
    r"\b[a-z]?(?:ev|hz)\b|\bjoule|\bkcal|\bcal\b|[\[(]\s*[kmµ]?j\b", re.IGNORECASE
)
_MICROMETERS = re.compile(
    r"[µμ]m\b|\bum\b|\bmi[ck]rons?\b|\bmi[ck]rom[eè]t(?:er|re)s?\b", re.IGNORECASE
)
# Keys of comments and of lines above a table that say what its abscissa is.
_OF_ABSCISSA = re.compile(
    r"x[ _-]?(?:axis|units?|label)?|abscissa|(?:wave[ _-]?length|spectral|frequency)[ _-]?units?|"
    r"(?:wave[ _-]?lengths?|wave[ _-]?numbers?|frequenc(?:y|ies)|energ(?:y|ies))(?: in)?",
    re.IGNORECASE,
)
# "50 % gray" is a name; "R [%]", "% reflectance" and "percent" state a scale.
_PERCENT = re.compile(
    r"(?<!\d)(?<!\d[ _-])"
    r"(?:[%％]|\(0\s*(?:-|–|to|\.\.)\s*100\)|[x×*]\s*100(?!\d)|(?<![a-z])(?:percent(?:age)?|pct|prozent|pourcent(?:age)?|procent|パーセント)(?![a-z]))",
    re.IGNORECASE,
)
_ABOUT_VALUES = re.compile(
    r"reflectance|reflexion|réflectance|values?\b|units?\b|scale\b|spectr|einheit|unité|単位|反射",
    re.IGNORECASE,
)
_JUST_PERCENT = re.compile(
    r"(?:(?:is|are|all|data|given)\W+)*(?:in )?(?:%|percent)\W*", re.IGNORECASE
)
_TO_A_HUNDRED = re.compile(r"\bscale\b.*?\b0\s*(?:-|–|to|\.\.+)\s*100\b", re.IGNORECASE)
_OPTICAL = re.compile(r"optical constants|refractive ind", re.IGNORECASE)
_KEY = re.compile(r"\s*([A-Za-z][\w .-]*?)\s*[:=]\s*(.*?)\s*")
# A key with its mark, which texts that quote it keep, and a value.
_LISTED = re.compile(r"\s*([^\t;,:=]{1,40}[\t;,])\s*([^\t;,]{1,60})[\t;,\s]*")

_UNITS = {
    **dict.fromkeys(("fraction", "fractions", "1", "factor"), 1.0),
    **dict.fromkeys(("percent", "%", "pct", "prozent", "pourcent"), 100.0),
}
_KINDS: dict[str, Kind] = {
    "reading": "reading",
    "albedo": "albedo",
    "emissivity": "emissivity",
}
_WAVELENGTH_UNITS = {
    **dict.fromkeys(("nm", "nanometer", "nanometers", "nanometre", "nanometres"), "nm"),
    **dict.fromkeys(("um", "µm", "μm", "micron", "microns", "micrometer", "micrometers"), "µm"),
    **dict.fromkeys(("Å", "å", "angstrom", "angstroms"), "Å"),
    **dict.fromkeys(("cm-1", "cm^-1", "cm⁻¹", "1/cm", "wavenumber", "wavenumbers"), "cm⁻¹"),
    **dict.fromkeys(("thz", "THz"), "THz"),
    **dict.fromkeys(("ev", "eV"), "eV"),
    "m": "m",
    "mm": "mm",
    "pm": "pm",
    "m-1": "m⁻¹",
    "1/m": "m⁻¹",
    "mev": "meV",
    "hz": "Hz",
    "ghz": "GHz",
    "phz": "PHz",
}


@dataclass
class Comments:
    """What the comment lines state; `scale` is None where they say nothing of percent.

    `escaped` tells whether names are as `shown_text.to_cell` writes them. `others` are all further
    keys and values, which `statements` knows, as those of lines above a table; free text has no
    key. `measured` keeps what it found in them, for all samples. `reflects` tells whether one of
    the lines above the table says reflectance.
    """

    kind: Kind = "reading"
    scale: float | None = None
    wavelength_unit: str = ""
    texts: dict[str, Any] = field(default_factory=dict)
    escaped: bool = False
    others: list[tuple[str, str]] = field(default_factory=list)
    measured: dict[str, Any] | None = None
    reflects: bool = False


def band(label: str) -> float | None:
    """Return the wavelength that a column name such as ``R400 nm``, ``nm400``, ``400`` states.

    As it stands, or in nanometers where the name itself says another unit, such as ``428 THz``. A
    mark such as ``(SCI)`` counts for nothing.
    """
    text = label.strip()[:40]
    if text.isalpha():  # most of a text's words; the patterns take longer
        return None
    match = _BAND.fullmatch(text) or _BAND.fullmatch(name_marks.of_band(text)[0])
    if not match:
        return None
    found = float(match[1].replace(",", "."))
    unit = (unit_of_wavelengths(match[2]) if match[2] else "") or "nm"
    return found if unit == "nm" else float(to_nanometers(np.array([found]), unit)[0])


def bands_of(cells: list[str], least: float) -> list[float]:
    """Return the wavelengths that a row of column names states, none unless it can be one.

    Bare numbers also stand in rows of data: two of them, or some here and there, name no bands.

    Parameters
    ----------
    cells
        The row.
    least
        The smallest wavelength in nanometers that counts.
    """
    at = [i for i, cell in enumerate(cells) if (band(cell) or 0.0) >= least]
    bare = at and all(cells[i].strip()[:1].isdigit() and cells[i][-1:].isdigit() for i in at)
    if bare and at != list(range(len(cells))):
        together = at[-1] - at[0] + 1 == len(at)
        if not together or (len(at) < _LEAST_BARE and at[0] > 1):
            return []
    return [band(cells[i]) or 0.0 for i in at]


def small_bands(said: Comments, header: list[str]) -> list[int]:
    """Return which columns are bands in µm or eV, of which the corner or a comment states the unit.

    Their numbers are as small as those that samples are called by, so that all of them have to be
    numbers.
    """
    corner = header[0] if band(header[0]) is None else ""
    unit = said.wavelength_unit or unit_of_wavelengths(corner)
    found = [i for i, label in enumerate(header) if i or not corner]
    small = unit in ("µm", "eV") and len(found) > 1
    return found if small and all(_NUMBER.fullmatch(header[i]) for i in found) else []


def are_in_order(cells: list[str], least: float) -> bool:
    """Return whether the wavelengths of column names rise or fall, those of SCI and SCE apart."""
    found: dict[str, list[float]] = {}
    for cell in cells:
        nm = band(cell) or 0.0
        if nm >= least:
            found.setdefault(name_marks.of_band(cell)[1], []).append(nm)
    return all(nm in (sorted(set(nm)), sorted(set(nm), reverse=True)) for nm in found.values())


def is_unit_row(cells: list[str]) -> bool:
    """Return whether a row under the names of columns holds their units."""
    stated = [cell for cell in cells if cell.strip()]
    return bool(stated) and all(_UNIT.fullmatch(cell.strip()[:40]) for cell in stated)


def percent_of_values(text: str) -> bool:
    """Return whether a line about a table says that its values are percent.

    A name or a citation may well hold a percent sign, so only talk about the values counts.
    """
    pair = _KEY.fullmatch(text)
    if _JUST_PERCENT.fullmatch(text.strip()) or _TO_A_HUNDRED.search(text):
        return True
    return says_percent(text) and bool(_ABOUT_VALUES.search(pair[1] if pair else text))


def is_wavelength(label: str) -> bool:
    """Return whether a column is named as the one with the wavelengths."""
    return bool(_WAVELENGTH.match(label.strip()))


def unit_of_wavelengths(label: str) -> str:
    """Return the unit that the wavelength column's name states, or an empty string."""
    label = label.replace("_", " ")
    if _MICROMETERS.search(label):
        return "µm"
    if re.search(r"\bnm\b|nanomet", label, re.IGNORECASE):
        return "nm"
    return next((unit for unit, pattern in _OTHER_UNITS.items() if pattern.search(label)), "")


def unit_of_abscissa(key: str, value: str) -> str:
    """Return the unit that a key and its value state for the abscissa, or an empty string.

    Such as ``X units: THz`` and ``Wavenumber: cm-1``, or ``wavelengths in µm``, all of it the key.
    """
    words = key.strip()
    if not value and " in " in words:
        words, _, value = words.partition(" in ")
    return unit_of_wavelengths(value[:_LONGEST]) if _OF_ABSCISSA.fullmatch(words) else ""


def no_wavelength(label: str, stated: bool = False) -> str:
    """Return what the column named as the one with the wavelengths holds instead, or nothing.

    `stated` tells whether its unit stands elsewhere, such as below its name.
    """
    if _RAMAN.search(label):
        return "a Raman shift, which is no wavelength"
    if unit_of_wavelengths(label):
        return ""
    if _UNKNOWN_UNIT.search(label.replace("_", " ")):
        return "a frequency or an energy in a unit that is not known"
    if _FREQUENCY.search(label) and not stated:
        return "a frequency or an energy without its unit"
    return ""


def to_nanometers(values: NDArray[np.float64], unit: str) -> NDArray[np.float64]:
    """Return wavelengths in nm of numbers in one of the units that `unit_of_wavelengths` knows.

    Examples
    --------
    >>> to_nanometers(np.array([20000.0, 25000.0]), "cm⁻¹").tolist()
    [500.0, 400.0]
    """
    if unit in NM_TIMES_UNIT:
        with np.errstate(divide="ignore", over="ignore"):
            return np.round(NM_TIMES_UNIT[unit] / values, 6)
    factor = NM_PER_UNIT[unit]
    # Rounded to 1e-9 nm: 0.57 µm is 570 nm, while the product of the two floats is not.
    return values if factor == 1.0 else np.round(values * factor, 9)


def says_percent(label: str) -> bool:
    """Return whether a column name states that its values are percent."""
    if band(label) is not None:
        return "%" in label or bool(_SPEC.match(label))
    return bool(_PERCENT.search(label))


def comments(document: Document) -> Comments:
    """Return what the lines that begin with ``#`` state.

    Raises
    ------
    InputError
        A key that is honored has a value that is not known.
    """
    found = Comments()
    if "#" not in document.text:
        return found
    stated = False
    white: dict[str, str] = {}
    white_line = 0
    for number, line in enumerate(lines(document), start=1):
        text = line.strip()
        if not text.startswith("#"):
            continue
        text = text.lstrip("#")
        pair = _KEY.fullmatch(text)
        key = pair[1].lower().replace(" ", "_") if pair else ""
        value = pair[2] if pair else ""
        if key == "units":
            found.scale = _one_of(document, number, key, value, _UNITS)
            stated = True
        elif unit := unit_of_abscissa(*((pair[1], value) if pair else (text, ""))):
            found.wavelength_unit = unit
        elif key == "wavelength_unit":
            found.wavelength_unit = _one_of(document, number, key, value, _WAVELENGTH_UNITS)
        elif key == "kind":
            found.kind = _one_of(document, number, key, value, _KINDS)
        elif key == "cells":
            found.escaped = value.startswith(ESCAPED)
        elif key in ("white", "white_factor"):
            white[key], white_line = value, number
        elif key == "instrument" and value:
            # Our own tables of several readings list them; each row has its own.
            if value in REGISTRY:
                found.others.append(("geometry", value))
            elif not {name.strip() for name in value.split(",")} <= REGISTRY.keys():
                found.texts["device"] = value
        elif key in ("source", "license", "device", "condition"):
            if value:
                found.texts[key] = value
        elif not stated and percent_of_values(text):
            found.scale = 100.0
        elif _OPTICAL.search(text):
            raise document.not_reflectance(f"line {number}", "refractive indices of a material")
        elif pair and value:
            found.others.append((pair[1], value))
        elif listed := _LISTED.fullmatch(text[:_LONGEST]):  # of a spreadsheet: "# Geometry,d/8,,"
            found.others.append((listed[1], listed[2]))
        elif text.strip() and (any(in_text(text)) or device_in_text(text)):
            found.others.append(("", text))
    said, fault = white_fields(white.get("white"), white.get("white_factor"))
    if fault:
        raise document.error(f"line {white_line}", fault)
    found.texts.update(said)
    return found


def _one_of(document: Document, line: int, key: str, value: str, known: dict[str, T]) -> T:
    # What follows the first word explains it: "fraction (1 = perfect white diffuser)".
    word = re.split(r"[\s(;,]", value.lower(), maxsplit=1)[0]
    try:
        return known[word]
    except KeyError:
        raise document.error(
            f"line {line}",
            f"{key} is {quote(value)}; make it one of: {', '.join(known)}",
        ) from None
