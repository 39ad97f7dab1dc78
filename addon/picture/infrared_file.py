# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An infrared picture as an EXR, which every program shows: gray, or in false color."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..support import atomic_files
from . import exr_file
from .infrared import InfraredPicture


def write(picture: InfraredPicture, path: Path, *, false_color: bool = False) -> None:
    """Write it.

    Parameters
    ----------
    picture
        Of the open file.
    path
        Of an EXR, whose channels are `R`, `G`, `B` and `A`.
    false_color
        Whether red, green and blue are the thirds of the band, red the longest; else all three are
        the whole band.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    rgb = picture.false_color if false_color else np.stack([picture.gray] * 3, axis=-1)
    pixels = np.concatenate((rgb, picture.alpha[..., np.newaxis]), axis=-1)
    first, last = picture.ends
    with atomic_files.publication() as publication:
        band = {"roughSpectra:band": f"{first:g}-{last:g} nm"}
        exr_file.write(publication.stage(path), path, pixels, tuple("RGBA"), band)
