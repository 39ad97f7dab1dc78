# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find the color of a material by measuring, whatever nodes it is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import StringProperty

from . import background, giving, targets
from .library import matching_samples

if TYPE_CHECKING:
    from ...instrument.adjustment import Adjustment

_WIDTH = 420


def _places(_operator: Any, context: Any, typed: str) -> list[str]:
    """Give the colors of the material that have what was typed in their names."""
    from ...blender import colors

    material = targets.active_material(context)
    names = [] if material is None else [place.name for place in colors.places(material)]
    return [name for name in names if typed.casefold() in name.casefold()]


class ROUGHSPECTRA_OT_match_by_measuring(background.InBackground, bpy.types.Operator):
    """Find one color of the material by measuring, for mixes, groups, sheen and bump; ESC stops"""

    bl_idname = "rough_spectra.match_by_measuring"
    bl_label = "Match by Measuring"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 3, 4

    sample: StringProperty(
        name="Sample",
        description="Collection and name, as in colorchecker/14-green; empty for the stored one",
        search=matching_samples,
    )
    color: StringProperty(
        name="Color",
        description="Socket, RGB node or group input that is set; empty for the most likely one",
        search=_places,
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material of this file."""
        material = targets.active_material(context)
        if material is None:
            cls.poll_message_set("The active object has no material; give it one first")
            return False
        return targets.is_local(cls, material)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Ask which sample, and which color may change."""
        from ...blender import colors

        if not self.color:
            known = colors.places(targets.active_material(context))
            self.color = known[0].name if known else ""
        return context.window_manager.invoke_props_dialog(
            self, width=_WIDTH, confirm_text="Measure"
        )

    def draw(self, _context: Any) -> None:
        """Draw both fields."""
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "sample")
        layout.prop(self, "color")

    def start(self, context: Any) -> Any:
        """Begin the search."""
        from ...blender import colors, shader_nodes
        from ...instrument.adjustment import Adjustment
        from ...material import preferences, storage
        from ...samples import library

        material: Any = targets.active_material(context)
        shader_nodes.refuse_read_only(material)
        if self.sample:
            sample = library.load(self.sample, preferences.user_folder())
            request, _ = giving.replacing_request(material, sample)
        else:
            request = storage.load(material)
        return Adjustment(material, request, colors.find(material, self.color))

    def state(self, done: int, total: int) -> str:
        """Say how many measurements are done."""
        return rpt_("Matching by measuring: {done} of at most {total} measurements").format(
            done=done, total=total
        )

    def finish(self, job: Adjustment) -> str:
        """Write the color that was found."""
        from ...instrument import adjustment

        done = adjustment.finish(job)
        if not done.is_met:
            self.report({"WARNING"}, done.sentence)
        return done.sentence


classes = (ROUGHSPECTRA_OT_match_by_measuring,)
