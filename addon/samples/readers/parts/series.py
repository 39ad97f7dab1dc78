# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spectrum as a file lists it, brought to what a `Sample` holds."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .....core.errors import InputError
from ...sample import check_spectrum
from .document import Document, quote

_NAMED = 8  # how many of the bands left out a sentence names

_LOG = r"log[\s_]*(?:10)?\s*\(?\s*1\s*/|-\s*(?:log|lg)(?:_?10)?(?![a-z])"
_KUBELKA = r"kubelka|\bk\s*/\s*s\b|f\(r\)|remission function"
# What is computed from a reflectance, and named by it.
_DERIVED = (
    (re.compile(_LOG, re.IGNORECASE), "absorbance"),
    (re.compile(_KUBELKA, re.IGNORECASE), "Kubelka-Munk values (K/S)"),
    (
        re.compile(
            r"derivative|ableitung|d[ée]riv[ée]e|derivad|derivata|производн|微分|导数|"
            r"\bd\^?[r2]?r\s*/|[ΔδΔ∆]r\b",
            re.IGNORECASE,
        ),
        "a derivative or a difference of reflectance",
    ),
    (
        re.compile(r"continuum[\s_-]*remov", re.IGNORECASE),
        "reflectance divided by its continuum",
    ),
    (
        re.compile(r"^\W*1\s*[-−–]\s*(?:r|refl\w*)\W*$", re.IGNORECASE),
        "one less the reflectance",
    ),
)
# Whole words, the longest first: "transmission" says more than its "T". "Scope" is what both Ocean
# Optics and Avantes call raw counts.
_OTHERS = (
    (
        re.compile(r"\bb[rs]df\b", re.IGNORECASE),
        "a BRDF, the reflectance factor over π, without the angles of light and view",
    ),
    (re.compile(r"/\s*sr\b", re.IGNORECASE), "radiance"),
    (
        re.compile(
            r"irradian[cz]|µ?w(?:att)?/c?m|j/cm|bestrahlungsst|放射照度|辐照度", re.IGNORECASE
        ),
        "irradiance",
    ),
    (
        re.compile(r"radiance\b(?! factor)|\brad\. \(|strahldichte|放射輝度|辐亮度", re.IGNORECASE),
        "radiance",
    ),
    (
        re.compile(
            r"transmi|trasmit|durchlass|%\s*t\b|^t\s*[\[(]?%|透過|透过|透射|пропуск",
            re.IGNORECASE,
        ),
        "transmittance",
    ),
    (
        re.compile(
            rf"absorb[âa]n|assorban|absorpt|extin[ck]tion(?! coef)|\babs\b|\ba\.u\.|{_LOG}|"
            r"\bdensity\b|optische dichte|吸光|吸収|吸收|поглощ|оптическ\w+ плотн",
            re.IGNORECASE,
        ),
        "absorbance",
    ),
    (re.compile(_KUBELKA, re.IGNORECASE), "Kubelka-Munk values (K/S)"),
    (re.compile(r"[\[(]\s*(?:1/|/)\s*[mc]m\s*[\])]"), "coefficients of absorption or scattering"),
    (re.compile(r"emissivit|emittance", re.IGNORECASE), "emissivity"),
    (
        re.compile(r"emissi|emitted|fluorescence|luminescence|\bpl\W+intens", re.IGNORECASE),
        "emission",
    ),
    (
        re.compile(r"\bcounts?\b|\bscope\b|digital number|\bdn\b|single[\s_-]*beam", re.IGNORECASE),
        "counts",
    ),
    (
        re.compile(r"sensitivit|responsivit|quantum efficiency", re.IGNORECASE),
        "sensitivities of a camera, a detector or the eye",
    ),
    (
        re.compile(r"colou?r[ _-]?matching|\bcmfs?\b|\b[xyz][ _]?bar\b", re.IGNORECASE),
        "color matching functions",
    ),
    (
        # At the beginning: a unit or a mode may well name the illuminant that it is for.
        re.compile(
            r"^(?:cie |std |standard )*illuminant|power distribution|\bspd\b", re.IGNORECASE
        ),
        "emission",
    ),
    (
        re.compile(r"refractive|optical constants|extinction coef", re.IGNORECASE),
        "refractive indices of a material",
    ),
)
# Shorter words are names of samples as well, such as ABS.
_LEAST_IN_NAMES = 6
_REFLECTANCE = re.compile(
    r"r[ée]fle[ckx]|reflet|riflet|remission|albedo|radiance factor|反射|отраж",
    re.IGNORECASE,
)

# Software of remote sensing fills with -1.23e34 and the largest floats where it has no value.
_FILLED = 1e30
# U+FFFD is what Java's number format makes of NaN.
_NO_VALUE = {"∞", "-∞", "\ufffd", "Infinity", "-Infinity", "-"}


class Bands(NamedTuple):
    """Increasing wavelengths in nm, their values as fractions, and what was left out."""

    wavelengths: NDArray[np.float64]
    values: NDArray[np.float64]
    altered: tuple[str, ...]


def bands(
    nm: NDArray[np.float64],
    values: NDArray[np.float64],
    where: str,
    place: Callable[[int], str],
) -> Bands:
    """Return a spectrum in the order of its wavelengths, without bands that have no value.

    Instruments that scan from long to short wavelengths list them so; which row comes first is no
    change of a value, and nothing is said of it.

    Parameters
    ----------
    nm, values
        Shape ``(bands,)``; NaN where nothing was measured.
    where, place
        As of `check_spectrum`; `place` counts the bands as they are given.

    Raises
    ------
    InputError
        What stays is no spectrum.
    """
    missing = np.isnan(values) | ((np.abs(values) > _FILLED) & np.isfinite(values))
    altered: tuple[str, ...] = ()
    if missing.any():
        altered = (_left_out(nm[missing]),)
        kept = np.flatnonzero(~missing)
        if kept.size < 2:
            gap = int(np.flatnonzero(missing)[0])
            raise InputError(
                f"{where}: {place(gap)} has no value, and fewer than two bands have one; "
                "measure again or leave the sample out."
            )
        nm, values = nm[kept], values[kept]
        first = place
        place = lambda band: first(int(kept[band]))  # noqa: E731
    if nm.size > 1 and (nm[1:] < nm[:-1]).all():
        last = nm.size - 1
        nm, values = nm[::-1], values[::-1]
        second = place
        place = lambda band: second(last - band)  # noqa: E731
    wavelengths, fractions = check_spectrum(nm, values, where, place)
    return Bands(wavelengths, fractions, altered)


def other_quantity(text: str) -> str:
    """Return which other quantity than reflectance a name or a unit states, or an empty string.

    The result is fit for `Document.not_reflectance`.
    """
    derived = next((name for pattern, name in _DERIVED if pattern.search(text)), "")
    if derived or _REFLECTANCE.search(text):
        return derived
    return next((name for pattern, name in _OTHERS if pattern.search(text.strip())), "")


def other_quantity_of_name(name: str) -> str:
    """Return what `other_quantity` finds in the name of a file, where nothing else says it."""
    words = re.sub(r"[_.-]+", " ", name)
    if _REFLECTANCE.search(words):
        return ""
    matches = ((pattern.search(words), other) for pattern, other in _OTHERS)
    return next((other for m, other in matches if m and len(m[0]) >= _LEAST_IN_NAMES), "")


def says_reflectance(text: str) -> bool:
    """Return whether a text names reflectance."""
    return bool(_REFLECTANCE.search(text))


def number(document: Document, place: str, text: str) -> float:
    """Return a number with a decimal point or a decimal comma.

    What programs print where they divided by nothing is NaN.

    Raises
    ------
    InputError
        It is none.
    """
    if text in _NO_VALUE:
        return math.nan
    try:
        if "_" not in text:  # Python reads 1_0 as ten
            return float(text.replace(",", "."))
    except ValueError:
        pass
    raise document.error(place, f"{quote(text)} is not a number; export the file again")


def fields(text: str, mark: str) -> Iterator[str]:
    """Yield what stands between the marks of a long text, stripped, without a list of it all."""
    start = 0
    while (end := text.find(mark, start)) >= 0:
        yield text[start:end].strip()
        start = end + 1
    yield text[start:].strip()


def two_columns(
    document: Document, numbered: Iterable[tuple[int, str]]
) -> tuple[NDArray[np.float64], NDArray[np.float64], Sequence[int]]:
    """Return wavelengths, values and line numbers of lines with two numbers each.

    Columns are apart by tabs, semicolons or spaces; commas are decimal commas.

    Raises
    ------
    InputError
        A line has another number of columns, or a field is not a number.
    """
    found = array("d")
    at = array("L")
    for line, text in numbered:
        cells = text.replace(";", " ").replace(",", ".").split()
        if not cells:
            continue
        if len(cells) != 2:
            raise document.error(
                f"line {line}",
                f"two columns were expected, found {len(cells)}; export one spectrum a file",
            )
        found.extend([number(document, f"line {line}", cell) for cell in cells])
        at.append(line)
    table = np.array(found).reshape(-1, 2)
    return table[:, 0], table[:, 1], at


def _left_out(nm: NDArray[np.float64]) -> str:
    count = f"{nm.size} bands" if nm.size > 1 else "1 band"
    verb = "were" if nm.size > 1 else "was"
    names = ", ".join(f"{value:.12g}" for value in nm[:_NAMED])
    more = f" and {nm.size - _NAMED} more" if nm.size > _NAMED else ""
    return f"{count} without a value {verb} left out: {names} nm{more}."
