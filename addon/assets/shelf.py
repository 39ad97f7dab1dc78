# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The asset library of all presets that comes with the extension, in the user's preferences.

It is added once, when a window first shows a 3D view (`interface/shelf.py`). Whoever takes it out
of the preferences does not get it again unasked: the folder that was added is remembered beside it,
in the same preferences, so that both are saved or lost together. Blender comes here right after its
start: nothing here may import numpy.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import bpy

from ..material import preferences
from . import catalogs

BLEND = "rough-spectra.blend"
IMPORT_METHOD = "APPEND"
"""What is dragged can be edited, and a second drag gives the sample as it is in the library."""


def folder() -> Path:
    """Return the folder of the library; `tools/tables/make_shelf.py` fills it."""
    return Path(__file__).resolve().parents[2] / "presets" / "shelf"


def offer(again: bool = False) -> str | None:
    """Put the library into the preferences, or mend its path after the extension has moved.

    Parameters
    ----------
    again
        Whether to add it though the user took it out, as somebody who asks for it wants.

    Returns
    -------
    The name that the preferences show, if it was added; None where nothing was to do, or the
    library is missing.
    """
    if not (folder() / BLEND).is_file():
        return None
    wanted = str(folder())
    libraries = bpy.context.preferences.filepaths.asset_libraries
    addon = bpy.context.preferences.addons.get(preferences.PACKAGE)
    if addon is None or addon.preferences is None:
        # Switched on for this session alone, as by `--addons`: so is the library.
        return None if _find(libraries, wanted) is not None else _new(libraries, wanted)
    chosen = addon.preferences
    before = chosen.shelf_folder
    chosen.shelf_folder = wanted
    if _find(libraries, wanted) is not None:
        return None
    moved = _find(libraries, before) if before else None
    if moved is not None:
        moved.path = wanted
        return None
    if before and not again:
        return None
    return add(libraries, wanted)


def is_offered() -> bool:
    """Return whether the library is in the preferences."""
    return _find(bpy.context.preferences.filepaths.asset_libraries, str(folder())) is not None


def add(libraries: Any, path: str) -> str:
    """Add an asset library whose materials are appended; returns its name."""
    name = _new(libraries, path)
    bpy.context.preferences.is_dirty = True
    return name


def _new(libraries: Any, path: str) -> str:
    library = libraries.new(name=catalogs.ROOT, directory=path)
    library.import_method = IMPORT_METHOD
    return str(library.name)


def _find(libraries: Any, path: str) -> Any | None:
    """Give the library of a folder; by its text, as asking a disk of the network may take long."""
    wanted = _plain(path)
    return next((known for known in libraries if known.path and _plain(known.path) == wanted), None)


def _plain(path: str) -> str:
    return os.path.normcase(os.path.normpath(path))
