# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a texture, and save the open file with a material of it: both appear, or neither."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..blender import blend_file
from ..support import atomic_files
from . import material
from .convert import Conversion
from .wanted import Made

OPTION = "--save"
"""Names another place for the file on the command line."""


def make_and_save(
    conversion: Conversion,
    name: str,
    output: Path | None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Made, Path]:
    """Convert, make the material and save the open file with it.

    A failure leaves texture and file as they were, and so does a kill.

    Parameters
    ----------
    conversion
        To a texture of colors.
    name
        Of the material.
    output
        Where to save; None saves over the open file.
    progress
        Called with lines done and lines in all, and may raise.

    Returns
    -------
    The texture, and the file that was saved.

    Raises
    ------
    InputError, OutputError, CancelledError
        As in `Conversion.finish` and `blend_file.save`.
    MaterialError
        As in `material.make`.
    """
    with atomic_files.publication() as files:
        made = conversion.finish(progress, files)
        material.make(made, name, conversion.part)
        saved = blend_file.save_among(files, output, OPTION)
    return made, saved
