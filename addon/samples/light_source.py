# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a lamp was measured to send: of TM-27 (``.spdx``), CGATS, a spectral image, or a table."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...core.errors import InputError
from . import filter_response
from .readers import open_document, readers

_NOISE = 0.02
"""Part of the largest power that a detector may read below 0; such noise is no light."""


@dataclass(frozen=True, eq=False)
class LightSource:
    """A spectrum of light.

    Parameters
    ----------
    name
        Of the file.
    wavelengths
        Nanometers, increasing, shape (n,), at least two.
    power
        On any scale, 0 or more, shape (n,).
    """

    name: str
    wavelengths: npt.NDArray[np.float64]
    power: npt.NDArray[np.float64]


def read(path: str | os.PathLike[str]) -> LightSource:
    """Return the light that a file holds, whatever its name ends with.

    Of a spectral image it is the mean of all pixels. A table has two columns, as
    `filter_response.table` takes them. A little noise below 0 counts as 0.

    Raises
    ------
    InputError
        The file cannot be opened, holds no light, or several, or what can be none.
    """
    document, name = open_document(path), Path(path).name
    for reader in readers():
        if hasattr(reader, "emission") and reader.sniff(document):
            return checked(name, *reader.emission(document))
    return checked(name, *filter_response.table(path))


def checked(name: str, wavelengths: npt.ArrayLike, power: npt.ArrayLike) -> LightSource:
    """Make a `LightSource`, or say what it cannot be one for.

    Raises
    ------
    InputError
        If wavelengths don't increase, or power is below 0, no number, or nowhere above 0.
    """
    nm, sent = (np.asarray(each, np.float64) for each in (wavelengths, power))
    if nm.ndim != 1 or nm.shape != sent.shape or nm.size < 2:
        raise InputError(f"{name}: a light needs powers at two wavelengths at least; export more.")
    if not (np.isfinite(nm).all() and nm[0] > 0 and (np.diff(nm) > 0).all()):
        raise InputError(f"{name}: the wavelengths of a light have to increase; sort its table.")
    if not (np.isfinite(sent).all() and sent.max() > 0):
        raise InputError(f"{name}: the power of a light has to be above 0 somewhere; export it.")
    lowest = int(np.argmin(sent))
    if sent[lowest] < -_NOISE * sent.max():
        msg = (
            f"{name}: the power at {nm[lowest]:g} nm is {sent[lowest]:g}, which is below 0 by more "
            "than noise; subtract the dark reading and export it again."
        )
        raise InputError(msg)
    return LightSource(name, nm, np.maximum(sent, 0))
