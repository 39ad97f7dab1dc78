# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Units of a plain table, by what its names and comments say: never by the size of the numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import label_words
from .document import Document


def nanometers(
    document: Document, said: label_words.Comments, found: NDArray[np.float64], labels: list[str]
) -> NDArray[np.float64]:
    """Return the wavelengths in nm, by the unit that a column name or a comment states.

    Raises
    ------
    InputError
        The two disagree.
    """
    units = {unit for unit in map(label_words.unit_of_wavelengths, labels) if unit}
    units |= {said.wavelength_unit} if said.wavelength_unit else set()
    if len(units) > 1:
        raise document.error(
            "wavelength unit", "the comment and the column name disagree; make them agree"
        )
    factor = label_words.NM_PER_UNIT[units.pop()] if units else 1.0
    # Rounded to 1e-9 nm: 0.57 µm is 570 nm, while the product of the two floats is not.
    return found if factor == 1.0 else np.round(found * factor, 9)


def scale(document: Document, said: label_words.Comments, place: str, labels: list[str]) -> float:
    """Return what to divide the values by: 100 where a name or a comment says percent.

    Raises
    ------
    InputError
        The two disagree.
    """
    percent = any(map(label_words.says_percent, labels))
    if percent and said.scale == 1.0:
        raise document.error(
            place, "the column says percent and a comment says fraction; make them agree"
        )
    return 100.0 if percent else said.scale or 1.0
