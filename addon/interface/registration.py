# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything Blender has to know of the extension. Imports no color science and reads no file."""

from __future__ import annotations

import bpy

from ...core.numerics import memoized
from ..commands import command_line
from ..material import follow, preferences, properties
from ..support import events
from . import operators, shelf
from .panels import menus, panels, shading

_OPERATORS = operators.modules()
_MODULES = (properties, preferences, *_OPERATORS, panels, shelf)
classes = tuple(cls for module in _MODULES for cls in module.classes)


def register() -> None:
    """Register classes, the materials' property group and the command."""
    for cls in classes:
        bpy.utils.register_class(cls)
    properties.register_pointer()
    for module in _OPERATORS:
        if hasattr(module, "register_menu"):
            module.register_menu()
    menus.register(classes)
    shading.register()
    follow.register()
    command_line.register()


def unregister() -> None:
    """Undo `register`, in reverse."""
    events.unregistering.announce()
    command_line.unregister()
    shelf.unregister_timer()
    follow.unregister()
    shading.unregister()
    menus.unregister()
    for module in reversed(_OPERATORS):
        if hasattr(module, "unregister_menu"):
            module.unregister_menu()
    properties.unregister_pointer()
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
    memoized.clear_all()
