# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A thermal picture as an EXR: radiance and apparent temperature, a channel each."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.errors import OutputError
from ..support import atomic_files
from ..support.openimageio import openimageio
from ..support.version import version
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
    oiio = openimageio()
    pixels = np.stack((picture.radiance, picture.kelvin), axis=-1)[::-1]
    rows, columns = pixels.shape[:2]
    spec = oiio.ImageSpec(columns, rows, len(CHANNELS), oiio.FLOAT)
    spec.channelnames = CHANNELS
    spec.attribute("compression", "zip")
    spec.attribute("Software", f"Rough Spectra {version()}")
    first, last = picture.band
    spec.attribute("roughSpectra:band", f"{first:g}-{last:g} nm")
    with atomic_files.publication() as publication:
        part = publication.stage(path)
        out = oiio.ImageOutput.create("openexr")
        opened = out is not None and out.open(str(part), spec)
        whole = np.ascontiguousarray(pixels, np.float32)
        # Closed in any case: a file that could not be written whole is still open.
        if not (opened and out.write_image(whole)) or not out.close():
            said = " ".join(out.geterror().split()) if out is not None else "no OpenEXR"
            msg = f"{path} cannot be written ({said}); free the disk or choose another place."
            raise OutputError(msg)
