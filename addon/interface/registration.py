# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything Blender has to know of the extension. Imports no color science and reads no file."""

from __future__ import annotations

import bpy

from ...core.numerics import memoized
from ..commands import command_line
from ..material import follow, preferences, properties
from ..support import events
from .operators import (
    analyze_scene,
    assign_file,
    assign_preset,
    bake,
    build_assets,
    choose_sample,
    find_nearest,
    import_review,
    import_samples,
    keep,
    library,
    measure,
    renew,
)
from .panels import panels

_MODULES = (
    *(
        properties,
        preferences,
        choose_sample,
        assign_preset,
        assign_file,
        renew,
        keep,
        bake,
        measure,
    ),
    *(import_samples, import_review, library, find_nearest, build_assets, analyze_scene, panels),
)
classes = tuple(cls for module in _MODULES for cls in module.classes)


def register() -> None:
    """Register classes, the materials' property group and the command."""
    for cls in classes:
        bpy.utils.register_class(cls)
    properties.register_pointer()
    import_samples.register_menu()
    build_assets.register_menu()
    panels.register_menus()
    follow.register()
    command_line.register()


def unregister() -> None:
    """Undo `register`, in reverse."""
    events.unregistering.announce()
    command_line.unregister()
    follow.unregister()
    panels.unregister_menus()
    build_assets.unregister_menu()
    import_samples.unregister_menu()
    properties.unregister_pointer()
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
    memoized.clear_all()
