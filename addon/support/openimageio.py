# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenImageIO as it comes with Blender and with the bpy module."""

from __future__ import annotations

from types import ModuleType


def openimageio() -> ModuleType:
    """Give the module OpenImageIO; the bpy module has to be asked to show it."""
    import bpy

    if hasattr(bpy.utils, "expose_bundled_modules"):
        bpy.utils.expose_bundled_modules()
    import OpenImageIO

    return OpenImageIO
