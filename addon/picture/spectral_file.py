# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectra of a picture as a spectral OpenEXR image.

A channel `S0.440,000000nm` a wavelength, of emitted light, and the picture in R, G, B and A. Never
load one as a Blender image: Blender crashes on 24 or more bands.

Source: A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout for Spectral Images" (JCGT 10,
2021).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.errors import OutputError
from ...core.numerics.arrays import Array
from ..blender import working_space
from ..support import atomic_files
from ..support.openimageio import openimageio
from ..support.version import version
from . import spectra
from .picture import SpectralPicture

ENDING = ".spectral.exr"
UNITS = "scene radiance per nm (times color matching functions, summed over nm: XYZ, white Y = 1)"
"""Blender's lights have no radiance in W.m^-2.sr^-1 that a color could be known by."""
_DATE = "1970:01:01 00:00:00"
"""A fixed date: equal pictures give equal bytes."""
_LINES = 16
"""Rows that are written at a time: unpacked, an image is many times its picture."""


def check(path: Path) -> None:
    """Refuse a path that `write` would.

    Raises
    ------
    OutputError
        If the ending is another, or no file can be there.
    """
    if not path.name.lower().endswith(ENDING):
        msg = f"{path} is no spectral image by its name; let it end in {ENDING}."
        raise OutputError(msg)
    atomic_files.check_target(path)


def write(picture: SpectralPicture, part: Path, target: Path, *, at_bands: bool = False) -> None:
    """Write radiance at `spectra.NM`, or at the wavelengths of the bands.

    Parameters
    ----------
    picture
        With `spectra`.
    part
        Where to.
    target
        What the file will be called, for errors.
    at_bands
        Whether at the bands alone: a radiance there instead of the mean over 10 nm.

    Raises
    ------
    OutputError
        If there are no spectra or no bands, or the file cannot be written.
    """
    if picture.spectra is None:
        raise OutputError(f"{target} was not written: the picture has no spectra; render it anew.")
    held = picture.spectra
    nm, matrix = (held.bands, held.to_bands) if at_bands else (spectra.NM, held.to_grid)
    if not nm.size:
        msg = f"{target} was not written: nothing was rendered in bands; write every 10 nm instead."
        raise OutputError(msg)
    rows, columns = held.channels.rows, held.channels.columns
    names = [f"S0.{value:.6f}nm".replace(".", ",").replace("S0,", "S0.", 1) for value in nm]
    oiio = openimageio()
    spec = oiio.ImageSpec(columns, rows, 4 + len(names), oiio.FLOAT)
    spec.channelnames = ("R", "G", "B", "A", *names)
    spec.attribute("compression", "zip")
    spec.attribute("DateTime", _DATE)
    spec.attribute("Software", f"Rough Spectra {version()}")
    spec.attribute("spectralLayoutVersion", "1.0")
    spec.attribute("emissiveUnits", UNITS)
    spec.attribute("chromaticities", "float[8]", chromaticities())
    spec.attribute("roughSpectra:bands", " ".join(f"{value:g}" for value in held.bands))
    spec.attribute("roughSpectra:observer", f"{picture.observer} degrees")
    out = oiio.ImageOutput.create("openexr")
    whole = out is not None and out.open(str(part), spec)
    for first in range(0, rows, _LINES):
        low, high = max(rows - first - _LINES, 0), rows - first  # from the bottom up
        values = held.channels.lines(low, high).astype(np.float64) @ matrix
        block = np.concatenate((picture.rgb[low:high], values), axis=-1)[::-1]
        pixels = np.ascontiguousarray(block, np.float32)
        whole = whole and out.write_scanlines(first, first + len(pixels), 0, pixels)
    # Closed in any case: a file that could not be written whole is still open.
    if out is None or not out.close() or not whole:
        said = " ".join(out.geterror().split()) if out is not None else "no OpenEXR"
        msg = f"{target} cannot be written ({said}); free the disk or choose another place."
        raise OutputError(msg)


def chromaticities() -> tuple[float, ...]:
    """Give x and y of red, green, blue and white of the working space, as EXR states them."""
    columns: Array = np.linalg.inv(working_space.current().from_xyz)
    xyz = np.vstack((columns.T, columns.sum(axis=1)))
    return tuple((xyz[:, :2] / xyz.sum(axis=1, keepdims=True)).ravel().tolist())
