# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Use and tend the user's library: assign, rename and remove samples, open the folder."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import StringProperty

from ....core.errors import RoughSpectraError
from . import common, giving, looking, targets


def matching_samples(_operator: Any, _context: Any, text: str) -> Iterator[tuple[str, str]]:
    """List ids and names of presets and library for a text field."""
    from ...material import preferences
    from ...samples import library

    for entry in library.search(text, preferences.user_folder()):
        yield entry.id, entry.title


def own_samples(_operator: Any, _context: Any, text: str) -> Iterator[tuple[str, str]]:
    """List those of the library alone, which can be renamed and removed."""
    from ...material import preferences
    from ...samples import library

    for entry in library.search(text, preferences.user_folder()):
        if not entry.is_preset:
            yield entry.id, entry.title


class ROUGHSPECTRA_OT_assign_sample(looking.LooksFirst, giving.AssignOptions, bpy.types.Operator):
    """Make the material read like a sample of the library or a preset, and store its spectrum"""

    bl_idname = "rough_spectra.assign_sample"
    bl_label = "Assign Sample"
    bl_options = {"REGISTER", "UNDO"}

    sample: StringProperty(
        name="Sample",
        description="Collection and name of the sample, as in colorchecker/14-green",
        search=matching_samples,
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return targets.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Assign the sample of a button; otherwise ask which."""
        if self.properties.is_property_set("sample") and self.sample:
            return self.execute(context)
        return context.window_manager.invoke_props_dialog(self, width=400)

    def work(self, context: Any) -> looking.Work:
        """Assign to all materials in scope, or to none; σ is the sample's unless it is given."""
        return looking.assignment(self, context, giving.of_library(self.sample))


class ROUGHSPECTRA_OT_rename_sample(bpy.types.Operator):
    """Give a sample of your library another name"""

    bl_idname = "rough_spectra.rename_sample"
    bl_label = "Rename Sample"
    bl_options = {"REGISTER"}
    menu_place = 4, 2

    sample: StringProperty(
        name="Sample",
        description="Collection and name of the sample",
        search=own_samples,
        options={"SKIP_SAVE"},
    )
    new_name: StringProperty(
        name="Name", description="What it is to be called", options={"SKIP_SAVE"}
    )

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Ask for the name, beginning with the present one, and for the sample if none is given."""
        from ...material import preferences
        from ...samples import library

        try:
            if self.sample:
                self.new_name = library.load(self.sample, preferences.user_folder()).name
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, _context: Any) -> set[str]:
        """Rename it in its file."""
        from ...material import preferences
        from ...samples import library

        try:
            new = library.rename(self.sample, self.new_name, preferences.user_folder())
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{} is now {}").format(self.sample, new))
        return {"FINISHED"}


class ROUGHSPECTRA_OT_remove_sample(bpy.types.Operator):
    """Take a sample out of your library; materials that have it keep it"""

    bl_idname = "rough_spectra.remove_sample"
    bl_label = "Remove Sample"
    bl_options = {"REGISTER"}
    menu_place = 4, 3

    sample: StringProperty(
        name="Sample",
        description="Collection and name of the sample",
        search=own_samples,
        options={"SKIP_SAVE"},
    )

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Ask first, since there is no undo for files; ask which if none is given."""
        if not self.sample:
            return context.window_manager.invoke_props_dialog(
                self, title=rpt_("Remove from the library? This cannot be undone"), width=400
            )
        return context.window_manager.invoke_confirm(
            self,
            event,
            title="Remove Sample",
            message=rpt_("Remove {} from the library? This cannot be undone.").format(self.sample),
            confirm_text="Remove",
            icon="WARNING",
        )

    def execute(self, _context: Any) -> set[str]:
        """Remove it from its file."""
        from ...material import preferences
        from ...samples import library

        try:
            library.remove([self.sample], preferences.user_folder())
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{} removed from the library").format(self.sample))
        return {"FINISHED"}


class ROUGHSPECTRA_OT_open_library(bpy.types.Operator):
    """Show the folder of your library, whose files can be shared"""

    bl_idname = "rough_spectra.open_library"
    bl_label = "Open Library Folder"
    bl_options = {"REGISTER"}
    menu_place = 4, 4

    def execute(self, _context: Any) -> set[str]:
        """Make the folder if it is not there, and open it in the system's file manager."""
        from ...material import preferences

        folder = preferences.user_folder()
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            reason = error.strerror or error
            sentence = rpt_("{folder} cannot be made ({reason}); choose another folder")
            self.report({"ERROR"}, sentence.format(folder=folder, reason=reason))
            return {"CANCELLED"}
        return set(bpy.ops.wm.path_open(filepath=str(folder)))


classes = (
    ROUGHSPECTRA_OT_assign_sample,
    ROUGHSPECTRA_OT_rename_sample,
    ROUGHSPECTRA_OT_remove_sample,
    ROUGHSPECTRA_OT_open_library,
)
