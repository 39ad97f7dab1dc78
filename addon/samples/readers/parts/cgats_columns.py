# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the columns of a CGATS table hold: spectra with their scale, names, colors.

The scale follows from the family of the names and from what the file states, never from the size
of the values. ArgyllCMS writes percent in SPEC_380 (its file formats say so), the standard's
SPECTRAL_PCT is percent and its SPECTRAL_DEC decimal; X-Rite, Barbieri and the others write
fractions under all other names.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from . import statements
from .cgats_tables import Table
from .document import Document, quote
from .geometry_words import specular_of
from .label_words import says_percent

_PERCENT = ("SPEC", "SPECTRAL_PCT", "PCT", "REFL_PCT", "R_PCT")
_FAMILY = (
    r"SPECTRAL_NM|SPECTRAL_PCT|SPECTRAL_DEC|SPECTRAL|SPECTRUM|SPEC|REFLECTANCE|REFL_PCT|REFL|R_PCT|"
    r"PCT|NM|WL|LAMBDA|R"
)
_MARK = r"M[0-3]|SCI|SCE|SPIN|SPEX"
_BAND = re.compile(
    rf"(?:({_MARK})[_:])?({_FAMILY})_?(\d{{3,4}}(?:\.\d+)?)(?:_?NM)?(?:[_:]({_MARK}))?",
    re.IGNORECASE,
)
_BARE = re.compile(
    rf"(?:({_MARK})[_:])?(\d{{3,4}}(?:\.\d+)?)(?:_?NM)?(?:[_:]({_MARK}))?", re.IGNORECASE
)

# In the order in which they make a name: people's words before places before numbers.
_NAMES = ("SAMPLENAME", "NAME", "COLORNAME", "PATCHNAME", "SAMPLELOC", "STRING", "SAMPLEID", "ID")
_SAID_OF_RECORDS = ("geometry", "specular", "aspecular", "angle", "surface", "gloss")
_LAB = ("LAB_L", "LAB_A", "LAB_B")
_XYZ = ("XYZ_X", "XYZ_Y", "XYZ_Z")


@dataclass(frozen=True)
class Spectrum:
    """The columns of one spectrum.

    Parameters
    ----------
    columns
        Of the values, by increasing wavelength.
    wavelengths
        Nanometers, shape ``(bands,)``; None where `places` are the columns that hold them.
    places
        Columns of the wavelengths, or empty.
    scale
        What to divide the values by.
    condition
        ``"M0"`` to ``"M3"`` where the names of the columns say so.
    specular
        ``"SCI"`` or ``"SCE"`` where they say so.
    """

    columns: list[int]
    wavelengths: NDArray[np.float64] | None
    places: list[int]
    scale: float
    condition: str
    specular: str = ""


@dataclass
class Columns:
    """Where things stand; empty or None what the table does not have.

    `keyed` are the columns that say how each record was measured, as `statements` knows them.
    """

    spectra: list[Spectrum] = field(default_factory=list)
    name: int | None = None
    condition: int | None = None
    lab: list[int] = field(default_factory=list)
    xyz: list[int] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    keyed: list[int] = field(default_factory=list)


def find(document: Document, table: Table) -> Columns:
    """Return what the table's columns hold.

    Raises
    ------
    InputError
        Two families of spectral columns, or a stated scale that is not a number above 0.
    """
    upper = [name.upper() for name in table.fields]
    found = Columns()
    plain = [re.sub(r"[_ -]", "", name) for name in upper]
    for known in _NAMES:
        if known in plain:
            found.name = plain.index(known)
            break
    for label in ("MEASUREMENT_CONDITION", "MEASUREMENTCONDITION", "M_CONDITION", "MCONDITION"):
        if label in upper:
            found.condition = upper.index(label)
    found.keyed = [
        i
        for i, label in enumerate(table.fields)
        if statements.field_of(label).partition(" ")[0] in _SAID_OF_RECORDS
    ]
    found.lab = _triple(upper, _LAB)
    found.xyz = _triple(upper, _XYZ)
    groups: dict[tuple[str, str], list[tuple[float, int]]] = {}
    for column, label in enumerate(upper):
        match, bare = _BAND.fullmatch(label), _BARE.fullmatch(label)
        if match:
            key = (match[2], match[1] or match[4] or "")
            groups.setdefault(key, []).append((float(match[3]), column))
        elif bare:
            key = ("NM", bare[1] or bare[3] or "")
            groups.setdefault(key, []).append((float(bare[2]), column))
    stated = _stated_scale(document, table)
    found.spectra = [
        _spectrum(table, found, bands, stated or _scale(family), condition)
        for (family, condition), bands in groups.items()
        if len(bands) > 1
    ] or _pairs(upper, stated)
    conditions = [(spectrum.condition, spectrum.specular) for spectrum in found.spectra]
    if len(set(conditions)) < len(conditions):
        families = sorted({family for family, _ in groups})
        raise document.error(
            f"line {table.line}",
            f"the table has more than one kind of spectral columns ({', '.join(families)}); "
            "export one of them",
        )
    return found


def _scale(family: str) -> float:
    return 100.0 if family in _PERCENT else 1.0


def _triple(upper: list[str], labels: tuple[str, ...]) -> list[int]:
    return [upper.index(label) for label in labels] if set(labels) <= set(upper) else []


def _stated_scale(document: Document, table: Table) -> float | None:
    """Return the value of white that the file states: ArgyllCMS's SPECTRAL_NORM, or percent."""
    for key in ("SPECTRAL_NORM", "SPEC_SCALE"):
        text = table.last(key)
        if text:
            scale = number(text)
            if not (0.0 < scale < math.inf):
                raise document.error(
                    f"line {table.lines[key]}",
                    f"{key} is {quote(text)}; make it the value of a perfect white, 1 or 100",
                )
            return scale
    units = (table.last(key) for key in ("UNITS", "SPECTRAL_UNITS", "DATA_UNITS"))
    return 100.0 if any(map(says_percent, units)) else None


def _spectrum(
    table: Table, found: Columns, bands: list[tuple[float, int]], scale: float, condition: str
) -> Spectrum:
    bands = sorted(bands)  # each column names its wavelength, so their order carries nothing
    nm = np.array([band for band, _ in bands])
    exact = _stated_wavelengths(table, nm)
    if isinstance(exact, str):
        found.notes.append(exact)
    else:
        nm = exact
    nm.flags.writeable = False
    specular = specular_of(condition)
    condition = "" if specular else condition
    return Spectrum([column for _, column in bands], nm, [], scale, condition, specular)


def _stated_wavelengths(table: Table, named: NDArray[np.float64]) -> NDArray[np.float64] | str:
    """Return the wavelengths by the keywords where they fit the columns' names, or a note.

    ArgyllCMS names a column after the nearest nanometer: SPEC_383 is 383.333.
    """
    count, start, end = (
        number(table.last(key))
        for key in ("SPECTRAL_BANDS", "SPECTRAL_START_NM", "SPECTRAL_END_NM")
    )
    if not (math.isfinite(start) and math.isfinite(end)):
        return named
    if count == named.size or math.isnan(count):
        exact = np.linspace(start, end, named.size)
        if np.abs(exact - named).max() <= 0.5 + 1e-6:
            # 383.333333: the file's own digits end there, and 380.0 stays 380.0.
            return np.round(exact, 6)
    return (
        "SPECTRAL_BANDS, SPECTRAL_START_NM and SPECTRAL_END_NM contradict the names of the "
        "columns, which were used."
    )


def _pairs(upper: list[str], stated: float | None) -> list[Spectrum]:
    """Return the spectrum of columns that give each value's wavelength in the column before."""
    for family in ("SPECTRAL_PCT", "SPECTRAL_DEC"):
        values = [i for i in range(1, len(upper)) if upper[i] == family]
        if len(values) > 1 and all(upper[i - 1] == "SPECTRAL_NM" for i in values):
            places = [i - 1 for i in values]
            return [Spectrum(values, None, places, stated or _scale(family), "")]
    return []


def number(text: str) -> float:
    """Return a number with a point or a comma, NaN for anything else."""
    try:
        return float(text.replace(",", ".")) if "_" not in text else math.nan
    except ValueError:
        return math.nan
