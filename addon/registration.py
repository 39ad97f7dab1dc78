# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything Blender has to know of the extension. Imports no color science and reads no file."""

from __future__ import annotations

import bpy

from . import command_line, panels, preferences, properties
from .operators import assign_file, assign_preset, bake, measure, renew

_MODULES = (properties, preferences, assign_preset, assign_file, renew, bake, measure, panels)
classes = tuple(cls for module in _MODULES for cls in module.classes)


def register() -> None:
    """Register classes, the materials' property group and the command."""
    for cls in classes:
        bpy.utils.register_class(cls)
    properties.register_pointer()
    command_line.register()


def unregister() -> None:
    """Undo `register`, in reverse."""
    command_line.unregister()
    properties.unregister_pointer()
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
