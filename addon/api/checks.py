# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked of every call."""

from __future__ import annotations

from typing import Any

import bpy

from ...core.errors import MaterialError, RoughSpectraError


def checked(material: Any) -> Any:
    """Give a material back, or say what it is instead."""
    check_enabled()
    if not isinstance(material, bpy.types.Material):
        msg = f"{material!r} is no material; give one of bpy.data.materials."
        raise MaterialError(msg)
    return material


def check_enabled() -> None:
    """Refuse a Blender in which the extension is not enabled."""
    if "rough_spectra" not in bpy.types.Material.bl_rna.properties:
        msg = (
            "Rough Spectra is not enabled in this Blender; enable it in the preferences, and start "
            "without --factory-startup."
        )
        raise RoughSpectraError(msg)
