# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Units of a plain table, by what its names and comments say: never by the size of the numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from . import label_words, series
from .document import Document, quote

_TELLS = re.compile(
    r"(?:y[ _-]?|value[ _-]?)?units?|einheit|unité|単位|quantity|"
    r"(?:data|value|measurement)[ _-]?type",
    re.IGNORECASE,
)
"""Names of columns that say of each row what its values are, beside those of `statements`."""

_LONGEST_SEEN = 3000.0
"""Nanometers; a table that begins beyond has to say so."""


def nanometers(
    document: Document,
    said: label_words.Comments,
    found: NDArray[np.float64],
    labels: list[str],
    is_seen: bool = True,
) -> NDArray[np.float64]:
    """Return the wavelengths in nm, by the unit that a column name or a comment states.

    Wavenumbers, frequencies and photon energies become wavelengths. Where nothing states a unit
    they are nanometers, unless no number could be one of light that is seen and `is_seen` says that
    it should be.

    Raises
    ------
    InputError
        The two disagree, the column holds something else, or its unit is missing and not nm.
    """
    stated = any(map(label_words.unit_of_wavelengths, labels))
    other = next(filter(None, (label_words.no_wavelength(label, stated) for label in labels)), "")
    if other and not said.wavelength_unit:
        raise document.error(
            f"column {quote(labels[0])}", f"it holds {other}; export the spectrum over wavelength"
        )
    units = {unit for unit in map(label_words.unit_of_wavelengths, labels) if unit}
    units |= {said.wavelength_unit} if said.wavelength_unit else set()
    if len(units) > 1:
        raise document.error(
            "wavelength unit", "the comment and the column name disagree; make them agree"
        )
    if units:
        return label_words.to_nanometers(found, units.pop())
    if is_seen and found.size and (found > _LONGEST_SEEN).all() and (found < np.inf).all():
        raise document.error(
            "wavelength unit",
            f"the wavelengths, {found.min():g} to {found.max():g}, have no unit and are not "
            "nanometers of light that is seen; call their column 'wavelength (nm)', "
            "'wavenumber (cm-1)' or what they are",
        )
    return found


def scale(document: Document, said: label_words.Comments, place: str, labels: list[str]) -> float:
    """Return what to divide the values by: 100 where a name or a comment says percent.

    Raises
    ------
    InputError
        The two disagree.
    """
    if any("‰" in label for label in labels):
        raise document.error(place, "its values are per mille, which are not read; export percent")
    percent = any(map(label_words.says_percent, labels))
    if percent and said.scale == 1.0:
        raise document.error(
            place, "the column says percent and a comment says fraction; make them agree"
        )
    return 100.0 if percent else said.scale or 1.0


def tells(label: str) -> bool:
    """Return whether a column says of each row in which unit its values are, or what they are."""
    return bool(_TELLS.fullmatch(label.strip()))


def of_row(cells: Sequence[str], percent: bool) -> tuple[float, str]:
    """Return what to divide a row's values by, and which other quantity they are, if they are.

    Parameters
    ----------
    cells
        Of the columns that `tells` names.
    percent
        Whether the table says percent already.
    """
    other = next(filter(None, map(series.other_quantity, cells)), "")
    return (100.0 if not percent and any(map(label_words.says_percent, cells)) else 1.0), other
