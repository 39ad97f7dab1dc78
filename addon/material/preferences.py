# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Edit ▸ Preferences ▸ Add-ons ▸ Rough Spectra: what new materials begin with.

Only the interface asks for these; the command line says everything on the command line, so that a
batch does the same on every machine.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ...core.instruments import DEFAULT
from ...core.limits import TOLERANCE, TOLERANCES
from .properties import ILLUMINANT_ITEMS, INSTRUMENT_ITEMS, OBSERVER_ITEMS

PACKAGE = (__package__ or "").rpartition(".addon.")[0]
"""What Blender calls the extension."""


class Defaults(NamedTuple):
    """What a new material begins with.

    Parameters
    ----------
    illuminant, observer
        Of `addon.colorimetry.tristimulus`.
    tolerance
        Largest ΔE00 from the reference that a model may have to be chosen.
    library_folder
        Where the user's samples are, or an empty string for the extension's own folder.
    read_at
        Virtual instrument that it is to read right at.
    """

    illuminant: str = "D65"
    observer: int = 2
    tolerance: float = TOLERANCE
    library_folder: str = ""
    read_at: str = DEFAULT


class RoughSpectraPreferences(bpy.types.AddonPreferences):
    """What new materials begin with, and where the library is."""

    bl_idname = PACKAGE

    illuminant: EnumProperty(
        name="Illuminant",
        description="Light of newly assigned materials",
        items=ILLUMINANT_ITEMS,
    )
    observer: EnumProperty(
        name="Observer", description="Observer of newly assigned materials", items=OBSERVER_ITEMS
    )
    read_at: EnumProperty(
        name="Read At",
        description="Virtual instrument that newly assigned materials read right at",
        items=INSTRUMENT_ITEMS,
        default=DEFAULT,
    )
    tolerance: FloatProperty(
        name="Tolerance (ΔE00)",
        description=(
            "Largest color difference from the reference that Auto accepts for the sake of a "
            "simpler model, in newly assigned materials"
        ),
        default=TOLERANCE,
        min=TOLERANCES[0],
        soft_max=5.0,
        max=TOLERANCES[1],
        precision=2,
    )
    library_folder: StringProperty(
        name="Library Folder",
        description="Folder of your own samples; empty keeps them with Blender's extensions",
        subtype="DIR_PATH",
    )

    flamenco_manager: StringProperty(
        name="Flamenco Manager",
        description="Address of a Flamenco manager to submit to, such as http://farm:8080; "
        "nothing is sent to it before you submit",
    )

    show_shelf: BoolProperty(
        name="Asset Shelf",
        description="Show measured materials below the 3D view, to drag onto objects",
        default=True,
    )
    shelf_folder: StringProperty(
        name="Shelf Folder",
        description="Folder of the asset library that was added to the preferences",
        options={"HIDDEN"},
    )

    def draw(self, _context: Any) -> None:
        """Draw all of them, in the order of use, and where to read on."""
        from ..support import version  # reads the manifest, which no start has to

        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column()
        column.label(text="New Materials")
        column.prop(self, "illuminant")
        column.prop(self, "observer")
        column.prop(self, "read_at")
        column.prop(self, "tolerance")
        layout.prop(self, "library_folder", placeholder="With Blender's Extensions")
        layout.prop(self, "flamenco_manager", placeholder="http://farm:8080")
        layout.prop(self, "show_shelf")
        layout.operator("rough_spectra.show_presets", icon="ASSET_MANAGER")
        address = version.website()
        if address:
            layout.operator("wm.url_open", text="Manual", icon="HELP").url = address
        else:
            entry = layout.operator("wm.path_open", text="Read Me", icon="HELP")
            entry.filepath = str(version.read_me())


def defaults() -> Defaults:
    """Give the user's preferences; where the extension is not enabled, those of a new user."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    if addon is None or addon.preferences is None:
        return Defaults()
    chosen = addon.preferences
    folder = bpy.path.abspath(chosen.library_folder) if chosen.library_folder else ""
    return Defaults(
        chosen.illuminant,
        int(chosen.observer),
        round(chosen.tolerance, 5),
        folder,
        chosen.read_at or DEFAULT,  # empty where another version knew other instruments
    )


def flamenco_manager() -> str:
    """Return the address of the manager to submit to; empty without one."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    if addon is None or addon.preferences is None:
        return ""
    return str(addon.preferences.flamenco_manager).strip()


def shows_shelf() -> bool:
    """Return whether the 3D view is to have an asset shelf of measured materials."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    return addon is None or addon.preferences is None or bool(addon.preferences.show_shelf)


def user_folder() -> Path:
    """Return the folder of the user's library; it need not be there yet.

    The one of the preferences, or else Blender's folder for what an extension's user makes: an
    upgrade leaves it alone.
    """
    chosen = defaults().library_folder
    if chosen:
        return Path(chosen)
    try:
        return Path(bpy.utils.extension_path_user(PACKAGE, path="library"))
    except ValueError:  # run from a clone, not installed as an extension
        return Path(bpy.utils.user_resource("DATAFILES", path="rough_spectra/library"))


classes = (RoughSpectraPreferences,)
