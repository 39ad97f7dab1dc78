# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the open .blend from the command line."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..core.errors import InputError, OutputError


def save(output: Path | None) -> Path:
    """Save the open file, in place or elsewhere; Blender itself writes beside it and renames.

    Raises
    ------
    InputError
        If the file has no name yet and none is given.
    OutputError
        If it cannot be written.
    """
    if output is None and not bpy.data.filepath:
        msg = "The open file has no name; say where to save it with --output FILE."
        raise InputError(msg)
    path = Path(bpy.data.filepath) if output is None else output.resolve()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        bpy.ops.wm.save_as_mainfile(filepath=str(path), check_existing=False)
    except (RuntimeError, OSError) as error:
        reason = " ".join(str(error).split())
        msg = f"{path} cannot be saved ({reason}); choose another place with --output."
        raise OutputError(msg) from error
    return path
