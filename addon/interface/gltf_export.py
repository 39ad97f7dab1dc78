# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Warn when Blender's glTF exporter loses a color or a roughness.

The exporter asks the module of each add-on for a function of this name, and calls it first. Its
own log shows warnings, which end in a popup. Blender's USD exporter has no such place: its hooks
report nothing.
"""

from __future__ import annotations

import sys
from typing import Any

import bpy

_HOOK = "glTF2_pre_export_callback"


def warn(settings: dict[str, Any]) -> None:
    """Say what the materials of the scene will lose.

    Parameters
    ----------
    settings
        Of the export; its log is that of the exporter.
    """
    from ..export import kept
    from ..material import selection

    materials = selection.of_objects(bpy.context.scene.objects)
    for loss in kept.losses(materials, ("glTF",)):
        settings["log"].warning(loss.sentence, popup=True)


def register() -> None:
    """Let the exporter find the function."""
    setattr(_package(), _HOOK, warn)


def unregister() -> None:
    """Take it away again."""
    delattr(_package(), _HOOK)


def _package() -> Any:
    return sys.modules[__name__.partition(".addon.")[0]]
