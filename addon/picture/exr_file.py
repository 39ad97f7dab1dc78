# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pixels as an EXR of named channels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...core.errors import OutputError
from ...core.numerics.arrays import Array
from ..support.openimageio import openimageio
from ..support.version import version


def write(
    part: Path,
    target: Path,
    pixels: Array,
    channels: Sequence[str],
    attributes: Mapping[str, Any],
) -> None:
    """Write a file.

    Parameters
    ----------
    part, target
        Where it is written to, and what it will be called.
    pixels
        From the bottom up, shape (rows, columns, channels).
    channels
        Their names.
    attributes
        Texts by name, and `chromaticities`, eight numbers.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    oiio = openimageio()
    rows, columns = pixels.shape[:2]
    spec = oiio.ImageSpec(columns, rows, len(channels), oiio.FLOAT)
    spec.channelnames = tuple(channels)
    spec.attribute("compression", "zip")
    spec.attribute("Software", f"Rough Spectra {version()}")
    for name, value in attributes.items():
        if name == "chromaticities":
            spec.attribute(name, "float[8]", value)
        else:
            spec.attribute(name, value)
    out = oiio.ImageOutput.create("openexr")
    opened = out is not None and out.open(str(part), spec)
    whole = np.ascontiguousarray(pixels[::-1], np.float32)
    # Closed in any case: a file that could not be written whole is still open.
    if not (opened and out.write_image(whole)) or not out.close():
        said = " ".join(out.geterror().split()) if out is not None else "no OpenEXR"
        msg = f"{target} cannot be written ({said}); free the disk or choose another place."
        raise OutputError(msg)
