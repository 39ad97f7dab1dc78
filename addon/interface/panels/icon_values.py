# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of Blender's own icons: given a name, it compares with each of a thousand in a row."""

from __future__ import annotations

import bpy

from ....core.numerics.memoized import memoized


@memoized(maxsize=64)
def icon_value(name: str) -> int:
    """Give what `icon_value` has to be for the icon that `icon` calls so; KeyError for no icon."""
    parameters = bpy.types.UILayout.bl_rna.functions["label"].parameters
    return int(parameters["icon"].enum_items[name].value)
