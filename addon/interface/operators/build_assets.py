# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Build an asset library of measured materials."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ....core.errors import InputError
from . import background
from .import_options import waiting

_items: list[tuple[str, str, str]] = []
"""Blender keeps no reference to dynamic enumeration texts; without this list they are freed."""


_ALL = "*"
"""Identifier that no collection has."""


def collection_items(_operator: Any, _context: Any) -> list[tuple[str, str, str]]:
    """List the collections of presets, and of the user's library as far as it is in memory."""
    from ...assets import catalogs
    from ...material import preferences
    from ...samples import library, presets

    known = library.cached(preferences.user_folder())
    ids = presets.names() if known is None else [entry.id for entry in known.entries]
    bundled = set(presets.collections())
    _items[:] = [
        (_ALL, iface_("All"), tip_("Every sample that came with Rough Spectra, and yours"))
    ]
    for name in dict.fromkeys(name.rpartition("/")[0] for name in ids):
        title = catalogs.title(name)
        if name in bundled:
            label, about = iface_("{} (Bundled)"), tip_("Samples that came with Rough Spectra")
        else:
            label, about = iface_("{} (Yours)"), tip_("Samples of your library")
        _items.append((name, label.format(title), about))
    return _items


class ROUGHSPECTRA_OT_build_assets(background.InBackground, bpy.types.Operator):
    """Make a folder of measured materials with previews, to drag from the Asset Browser"""

    bl_idname = "rough_spectra.build_assets"
    bl_label = "Build Asset Library"
    bl_options = {"REGISTER"}  # no undo step: nothing in the .blend changes
    menu_place = 4, 1

    stopped = "Building was stopped; nothing was written"

    directory: StringProperty(
        name="Folder", description="Folder of the asset library", subtype="DIR_PATH"
    )
    filter_folder: BoolProperty(
        name="Folders", description="Show folders", default=True, options={"HIDDEN"}
    )
    collection: EnumProperty(
        name="Samples", description="Collection that is made", items=collection_items
    )
    sigmas: StringProperty(
        name="σ",
        description="Roughnesses in degrees, such as 10 20 30; empty for what the samples say",
        default="10 20 30",
    )
    add_to_preferences: BoolProperty(
        name="Add to Preferences",
        description="Show the folder in every Asset Browser",
        default=True,
    )

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose the folder, and what of presets and library."""
        from ...material import preferences
        from ...samples import library

        with waiting(context):
            library.contents(preferences.user_folder())
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def start(self, _context: Any) -> Any:
        """Start the second Blender."""
        from ...assets import build, plan
        from ...material import preferences

        if not self.directory:
            msg = "No folder was chosen for the asset library; choose one."
            raise InputError(msg)
        self._folder = Path(bpy.path.abspath(self.directory))
        folder = preferences.user_folder()
        if self.collection == _ALL:
            chosen = plan.of_all(folder)
        else:
            chosen = plan.of_collection(self.collection, folder)
        assets = plan.assets(chosen, _degrees(self.sigmas), build.LONGEST_NAME)
        return build.Build(assets, self._folder)

    def state(self, done: int, total: int) -> str:
        """Say how many previews are done."""
        sentence = rpt_("Building the asset library: {done} of {total} previews")
        return sentence.format(done=done, total=total)

    def finish(self, job: Any) -> str:
        """Put the library into its folder and tell Blender of it."""
        from ...assets import build

        built = job.publish()
        for name, sentences in built.warnings.items():
            for sentence in sentences:
                self.report({"WARNING"}, f"{name}: {sentence}")
        one = rpt_("1 material in {file}")
        said = one if built.count == 1 else rpt_("{count} materials in {file}")
        said = said.format(count=built.count, file=built.blend)
        if not self.add_to_preferences:
            return said
        name = build.add_to_preferences(self._folder)
        if name is None:
            return f"{said}; {rpt_('its folder is in the preferences already')}"
        return f"{said}; {rpt_('choose {!r} in the Asset Browser').format(name)}"


def _degrees(text: str) -> list[float]:
    words = text.replace(",", " ").replace("°", " ").split()
    try:
        return [float(word) for word in words]
    except ValueError as error:
        msg = f"σ is {text!r}; give degrees with blanks between them, such as 10 20 30."
        raise InputError(msg) from error


def register_menu() -> None:
    """Add the operator to the Asset Browser's menu."""
    _menu().append(_draw_entry)


def unregister_menu() -> None:
    """Take the entry away."""
    _menu().remove(_draw_entry)


def _menu() -> Any:
    # Blender 4.5 has no menu Library; what it calls Asset is of an add-on, which may be off.
    return getattr(bpy.types, "ASSETBROWSER_MT_library", None) or bpy.types.ASSETBROWSER_MT_catalog


def _draw_entry(menu: Any, _context: Any) -> None:
    menu.layout.separator()
    menu.layout.operator("rough_spectra.build_assets", icon="ASSET_MANAGER")


classes = (ROUGHSPECTRA_OT_build_assets,)
