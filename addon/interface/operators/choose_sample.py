# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose a sample by name, with its color beside it, from presets and library."""

from __future__ import annotations

from collections import Counter
from typing import Any

import bpy
from bpy.props import EnumProperty

from . import common, looking

_items: list[tuple[str, str, str, int, int]] = []
"""Blender keeps no reference to dynamic enumeration texts; without this list they are freed."""

_UNKNOWN = "NONE"


def sample_items(_operator: Any, _context: Any) -> list[tuple[str, str, str, int, int]]:
    """List what was there when the list was opened; a script gets it at the first look."""
    if not _items:
        _fill()
    return _items


def _fill() -> None:
    from ...material import preferences
    from ...preview import icons
    from ...samples import library

    entries = library.contents(preferences.user_folder()).entries
    gray = (0.5, 0.5, 0.5)
    swatches = icons.swatch_icons([entry.swatch or gray for entry in entries])
    count = Counter(entry.name for entry in entries)
    _items[:] = [
        (
            entry.id,
            entry.name if count[entry.name] == 1 else f"{entry.name} ({entry.collection})",
            _about(entry),
            swatch,
            number,
        )
        for number, (entry, swatch) in enumerate(zip(entries, swatches, strict=True))
    ] or [(_UNKNOWN, "No Samples", "Install the extension again", 0, 0)]


def _about(entry: Any) -> str:
    what = entry.kind.capitalize()
    sigma = "" if entry.sigma_degrees is None else f", σ {entry.sigma_degrees:g}°"
    return f"{entry.collection}: {what}{sigma}. {entry.source}"


class ROUGHSPECTRA_OT_choose_sample(looking.LooksFirst, bpy.types.Operator):
    """Choose a measured sample for the material; σ and the other settings stay as they are"""

    bl_idname = "rough_spectra.choose_sample"
    bl_label = "Choose Sample"
    bl_options = {"REGISTER", "UNDO"}
    bl_property = "sample"
    menu_place = 1, 1

    sample: EnumProperty(name="Sample", description="Measured sample", items=sample_items)

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return common.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user search presets and library by name."""
        _fill()
        context.window_manager.invoke_search_popup(self)
        return {"FINISHED"}

    def work(self, context: Any) -> looking.Work:
        """Assign to the active material; an object without one gets one."""
        from ...material import preferences
        from ...samples import library

        sample = library.load(self.sample, preferences.user_folder())
        return looking.assignment(
            context,
            "ACTIVE",
            lambda material: common.replacing_request(material, sample),
            lambda assigned, _request: common.told_of(self, assigned, sample),
        )


classes = (ROUGHSPECTRA_OT_choose_sample,)
