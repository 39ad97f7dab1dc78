# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as OpenEXR images: a swatch a reading, six in a row.

Predicted spectra follow A. Fichet, R. Pacanowski and A. Wilkie, "An OpenEXR Layout for Spectral
Images" (JCGT 10, 2021): a channel `T.400,000000nm` a band, and an RGB preview. Measured colors
have no spectrum and go to a plain RGB image. Never load a spectral EXR as a Blender image: Blender
crashes on 24 or more bands.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ....core.errors import OutputError
from ....core.numerics.arrays import Array
from ...support.openimageio import openimageio
from ...support.version import version
from ..document import Reading, Readings

NAME = "exr"
PLACE = 30
ENDINGS = r"predicted(?:-[1-9]\d*)?\.spectral\.exr|measured\.exr"
CREATOR = rb"Software\0string\0.{4}Rough Spectra "

SWATCH = 16
"""Pixels a swatch is wide and high."""
COLUMNS = 6
"""Swatches in a row, as on a ColorChecker."""

_DATE = "1970:01:01 00:00:00"
"""A fixed date: equal readings give equal bytes."""


@dataclass(frozen=True, eq=False)
class Picture:
    """Colors of shape (swatches, channels), channel names, and who is where."""

    swatches: Array
    channels: tuple[str, ...]
    layout: str
    spectral: bool


def files(readings: Readings) -> list[tuple[str, Callable[[Path, Path], None]]]:
    """Give the endings of all images, and what writes each."""
    pictures = predicted(readings) + measured(readings)
    return [(ending, partial(write, picture)) for ending, picture in pictures]


def predicted(readings: Readings) -> list[tuple[str, Picture]]:
    """Give a spectral image for each wavelength grid among the readings, with its file ending."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for index, entry in enumerate(readings.entries):
        if entry.predicted is not None:
            groups.setdefault(entry.predicted.wavelengths, []).append(index)
    pictures = []
    for number, (wavelengths, members) in enumerate(groups.items(), 1):
        parts = [part for i in members if (part := readings.entries[i].predicted) is not None]
        rows = np.array([(*part.preview, *part.values) for part in parts])
        names = tuple(
            f"T.{nm:.6f}nm".replace(".", ",").replace("T,", "T.", 1) for nm in wavelengths
        )
        picture = _picture(readings, members, rows, ("R", "G", "B", *names), True)
        suffix = "" if len(groups) == 1 else f"-{number}"
        pictures.append((f"predicted{suffix}.spectral.exr", picture))
    return pictures


def measured(readings: Readings) -> list[tuple[str, Picture]]:
    """Give the image of measured colors, scene-linear RGB, with its file ending."""
    members = [i for i, entry in enumerate(readings.entries) if entry.measured is not None]
    if not members:
        return []
    parts = [part for i in members if (part := readings.entries[i].measured) is not None]
    rows = np.array([part.rgb for part in parts])
    return [("measured.exr", _picture(readings, members, rows, ("R", "G", "B"), False))]


def write(picture: Picture, path: Path, shown: Path) -> None:
    """Write half-float ZIP OpenEXR with OpenImageIO, a row of swatches after the other.

    Raises
    ------
    OutputError
        Naming `shown`, if it cannot be written.
    """
    oiio = openimageio()
    number, count = picture.swatches.shape
    columns = min(COLUMNS, number)
    rows = -(-number // columns)
    spec = oiio.ImageSpec(columns * SWATCH, rows * SWATCH, count, oiio.HALF)
    spec.channelnames = picture.channels
    spec.attribute("compression", "zip")
    spec.attribute("DateTime", _DATE)
    spec.attribute("Software", f"Rough Spectra {version()}")
    spec.attribute("comments", picture.layout)
    if picture.spectral:
        spec.attribute("spectralLayoutVersion", "1.0")
    out = oiio.ImageOutput.create("openexr")
    if not (
        out.open(str(path), spec)
        and all(_write_row(out, picture.swatches, row, columns) for row in range(rows))
        and out.close()
    ):
        msg = (
            f"{shown} cannot be written ({out.geterror()}); nothing was changed. Free the disk or "
            "choose another place."
        )
        raise OutputError(msg)


def _write_row(out: Any, swatches: Array, row: int, columns: int) -> bool:
    """Write a row of swatches, which is what ZIP packs together; unused places are black.

    All pixels at once are 256 times the swatches, twice: 130 kB a material.
    """
    part = swatches[row * columns : (row + 1) * columns]
    line = np.zeros((columns * SWATCH, swatches.shape[1]), np.float32)
    line[: len(part) * SWATCH] = part.repeat(SWATCH, axis=0)
    pixels = np.tile(line, (SWATCH, 1, 1))
    return bool(out.write_scanlines(row * SWATCH, (row + 1) * SWATCH, 0, pixels))


def _picture(
    readings: Readings, members: list[int], rows: Array, channels: tuple[str, ...], spectral: bool
) -> Picture:
    """Lay out swatches from the top left."""
    several = len(readings.instruments) > 1
    names = "; ".join(_caption(readings.entries[i], spectral, several) for i in members)
    at = ", ".join(readings.instruments)
    layout = f"read at {at}; swatches of {SWATCH} px, {COLUMNS} a row, from the top left: {names}"
    return Picture(rows.astype(np.float32), channels, layout, spectral)


def _caption(entry: Reading, spectral: bool, several: bool) -> str:
    """Name the material, in a spectral image the model too, and the instrument among several."""
    about = [entry.predicted.model] if spectral and entry.predicted is not None else []
    about += [entry.instrument] * several
    return f"{entry.material} ({', '.join(about)})" if about else entry.material
