# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything Blender has to know of the extension. Imports no color science and reads no file."""

from __future__ import annotations

import bpy

from ...core.numerics import memoized
from ..commands import command_line
from ..material import follow, preferences, properties
from ..picture import lamp_sliders, settings
from ..scene import chosen_light
from ..support import events
from . import gltf_export, operators, shelf
from .panels import cameras, lamps, lights, menus, panels, pictures, shading

_OPERATORS = operators.modules()
_MODULES = (
    *(properties, chosen_light, settings, lamp_sliders, preferences),
    *_OPERATORS,
    *(panels, lights, pictures, lamps, cameras, shelf),
)
classes = tuple(cls for module in _MODULES for cls in module.classes)


def register() -> None:
    """Register classes, the property groups of materials and lights, and the command."""
    for cls in classes:
        bpy.utils.register_class(cls)
    properties.register_pointer()
    chosen_light.register_pointers()
    settings.register_pointers()
    lamp_sliders.register_pointers()
    for module in _OPERATORS:
        if hasattr(module, "register_menu"):
            module.register_menu()
    menus.register(classes)
    gltf_export.register()
    shading.register()
    follow.register()
    command_line.register()


def unregister() -> None:
    """Undo `register`, in reverse."""
    events.unregistering.announce()
    command_line.unregister()
    shelf.unregister_timer()
    follow.unregister()
    gltf_export.unregister()
    shading.unregister()
    menus.unregister()
    for module in reversed(_OPERATORS):
        if hasattr(module, "unregister_menu"):
            module.unregister_menu()
    lamp_sliders.unregister_pointers()
    settings.unregister_pointers()
    chosen_light.unregister_pointers()
    properties.unregister_pointer()
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
    memoized.clear_all()
