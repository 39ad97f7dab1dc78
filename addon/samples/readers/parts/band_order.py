# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bands that a file has in another order than increasing wavelength."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SORTED = "The bands were put in order of increasing wavelength; no value was changed."


def in_order(nm: NDArray[np.float64]) -> tuple[NDArray[np.intp], tuple[str, ...]]:
    """Return the order of increasing wavelength, and what to say of a file that has another.

    Parameters
    ----------
    nm
        Wavelengths in any unit, shape ``(bands,)``. Where they repeat, they keep their order:
        `check_spectrum` names them.
    """
    if (nm[1:] >= nm[:-1]).all():
        return np.arange(nm.size), ()
    return np.argsort(nm, kind="stable"), (SORTED,)
