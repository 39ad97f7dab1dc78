# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The texture's file: an EXR of half floats that says what made it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...core.errors import OutputError
from ..support.openimageio import openimageio
from ..support.version import version
from .image import Pixels


class Writer:
    """An EXR of half floats, written from its top down.

    Parameters
    ----------
    part, target
        The file that is written, and the one that it becomes.
    size
        Width and height.
    told
        What stands in the header, by names of ours.

    Raises
    ------
    OutputError
        If the disk is full; as all its methods.
    """

    def __init__(
        self, part: Path, target: Path, size: tuple[int, int], told: Mapping[str, str | float]
    ) -> None:
        self._target = target
        oiio = openimageio()
        spec = oiio.ImageSpec(*size, 3, oiio.HALF)
        spec.channelnames = ("R", "G", "B")
        spec.attribute("compression", "zip")
        spec.attribute("Software", f"Rough Spectra {version()}")
        for name, value in told.items():
            spec.attribute(f"roughSpectra:{name}", value)
        self._out = oiio.ImageOutput.create("openexr")
        if self._out is None or not self._out.open(str(part), spec):
            raise self._fault()

    def write(self, first: int, last: int, pixels: Pixels) -> None:
        """Write lines, shape (lines, width, 3)."""
        if not self._out.write_scanlines(first, last, 0, np.ascontiguousarray(pixels)):
            raise self._fault()

    def close(self) -> None:
        """Write what is left."""
        if not self._out.close():
            raise self._fault()

    def _fault(self) -> OutputError:
        said = " ".join(self._out.geterror().split()) if self._out is not None else "no OpenEXR"
        msg = f"{self._target} cannot be written ({said}); free the disk or choose another place."
        return OutputError(msg)
