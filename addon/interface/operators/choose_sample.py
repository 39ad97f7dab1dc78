# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Choose a sample by name, with a picture beside it, from the file, presets and library."""

from __future__ import annotations

from collections import Counter
from functools import partial
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.props import EnumProperty

from . import ahead, giving, looking, of_this_file, targets

if TYPE_CHECKING:
    from ...samples.entry import Entry

_items: list[tuple[str, str, str, int, int]] = []
"""Blender keeps no reference to dynamic enumeration texts; without this list they are freed."""

_before: list[tuple[str, str, str, int, int]] = []
"""What an open list was filled with: Blender may still show these texts."""
_is_partial = False
"""Whether only the presets are in the list."""

_BEHIND = "\u25b8"
"""What Blender's menus have between their names: search ranks what is before it lower, so that the
file's own come first whatever is typed, though their names are longer."""
_UNKNOWN = "NONE"
_CHART = "colorchecker"


def sample_items(_operator: Any, _context: Any) -> list[tuple[str, str, str, int, int]]:
    """List what was there when the list was opened; a script gets it at the first look.

    While the list is open, the user's own samples come along as soon as they are read.
    """
    if not _items or (_is_partial and ahead.is_done()):
        _fill()
    return _items


def _fill() -> None:
    global _is_partial
    from ...preview import list_icons
    from ...samples import preset_index

    found, _is_partial = _entries()
    # Things to make walls of before patches of a chart. Yours come last: they are added while the
    # list is open, and what is in it keeps its number.
    entries = sorted(found, key=lambda each: (not each.is_preset, each.collection == _CHART))
    own = of_this_file.entries()
    _before[:] = _items
    glosses = preset_index.glosses_of_presets()
    pictures = list_icons.icon_ids(
        [
            *(each.pictured for each in own),
            *(
                list_icons.Pictured(each.swatch, each.sigma_degrees or 0.0, glosses.get(each.id))
                for each in entries
            ),
        ]
    )
    count = Counter(entry.name for entry in entries)
    new = f" {_BEHIND} {iface_('new')}" if own else ""
    _items[:] = [
        (each.identifier, each.label, each.about, picture, each.number)
        for each, picture in zip(own, pictures, strict=False)
    ] + [
        (
            entry.id,
            (entry.name if count[entry.name] == 1 else f"{entry.name} ({entry.collection})") + new,
            _about(entry),
            picture,
            number,
        )
        for number, (entry, picture) in enumerate(zip(entries, pictures[len(own) :], strict=True))
    ]
    if not _items:
        _items.append((_UNKNOWN, "No Samples", "Install the extension again", 0, 0))


def _entries() -> tuple[tuple[Entry, ...], bool]:
    """Give the samples to list, and whether the user's own are missing: they are being read."""
    from ...samples import preset_index

    if not bpy.app.background and not ahead.is_done():
        presets = preset_index.entries()
        if presets is not None:
            return presets, True
    from ...material import preferences
    from ...samples import library

    return library.contents(preferences.user_folder()).entries, False


def _about(entry: Any) -> str:
    what = entry.kind.capitalize()
    sigma = "" if entry.sigma_degrees is None else f", σ {entry.sigma_degrees:g}°"
    return f"{entry.collection}: {what}{sigma}. {entry.source}"


class ROUGHSPECTRA_OT_choose_sample(looking.LooksFirst, giving.AssignOptions, bpy.types.Operator):
    """Choose what it looks like: brick, paper. For all selected objects; what you set stays"""

    bl_idname = "rough_spectra.choose_sample"
    bl_label = "Choose Sample"
    bl_options = {"REGISTER", "UNDO"}
    bl_property = "sample"
    menu_place = 1, 1

    sample: EnumProperty(name="Sample", description="Measured sample", items=sample_items)

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return targets.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user search the file's own materials, presets and library by name."""
        ahead.begin()
        _fill()
        giving.begin_scope(self, context)
        context.window_manager.invoke_search_popup(self)
        return {"FINISHED"}

    def work(self, context: Any) -> looking.Work:
        """Assign to all materials in scope, or to none; an object without one gets one.

        A material of the file is given to the objects itself.
        """
        if of_this_file.is_one(self.sample):
            given = partial(of_this_file.give, context, self.scope, self.sample)
            return looking.Work([], None, lambda _materials, _looked: given())
        return looking.assignment(self, context, giving.of_library(self.sample))


classes = (ROUGHSPECTRA_OT_choose_sample,)
