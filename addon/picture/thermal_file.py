# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A thermal picture as an EXR: radiance and apparent temperature, a channel each."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..support import atomic_files
from . import exr_file
from .thermal import ThermalPicture

CHANNELS = "radiance", "kelvin"


def write(picture: ThermalPicture, path: Path) -> None:
    """Write it.

    Parameters
    ----------
    picture
        Of the open file.
    path
        Of an EXR, whose channels are `radiance`, W m⁻² sr⁻¹, and `kelvin`.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    pixels = np.stack((picture.radiance, picture.kelvin), axis=-1)
    first, last = picture.band
    with atomic_files.publication() as publication:
        band = {"roughSpectra:band": f"{first:g}-{last:g} nm"}
        exr_file.write(publication.stage(path), path, pixels, CHANNELS, band)
