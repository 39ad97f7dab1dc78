# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find the samples of library and presets whose color is nearest to a picked one."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import (
    CollectionProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    StringProperty,
)

from ....core.errors import RoughSpectraError
from . import common, looking
from .import_options import waiting

_ROWS = 8


class RoughSpectraMatch(bpy.types.PropertyGroup):
    """A sample and how far its color is from the one that was picked."""

    sample: StringProperty(name="Sample", description="Collection and name of the sample")
    swatch: FloatVectorProperty(
        name="Color",
        description="Color of the reading under D65, for the 2° observer",
        subtype="COLOR_GAMMA",
        min=0.0,
        max=1.0,
    )
    difference: FloatProperty(name="ΔE00", description="CIEDE2000 from the color that was picked")


class ROUGHSPECTRA_UL_matches(bpy.types.UIList):
    """Samples by their distance from a color"""

    def draw_item(
        self,
        _context: Any,
        layout: Any,
        _data: Any,
        item: Any,
        _icon: Any,
        _active_data: Any,
        _active_property: str,
    ) -> None:
        """Draw color, name and difference."""
        row = layout.row(align=True)
        common.draw_swatch(row, item)
        split = row.split(factor=0.75)
        split.label(text=f"{item.name}  ({item.sample.partition('/')[0]})", translate=False)
        split.label(text=f"ΔE00 {item.difference:.1f}", translate=False)


def _find(operator: Any, _context: Any = None) -> None:
    """Search again, also when color or count change."""
    from ...material import preferences
    from ...samples import library, swatches

    lab = swatches.to_lab(tuple(operator.color))
    operator.matches.clear()
    for entry, difference in library.nearest(lab, operator.count, preferences.user_folder()):
        item = operator.matches.add()
        item.name, item.sample, item.difference = entry.title, entry.id, difference
        item.swatch = entry.swatch
    operator.index = min(operator.index, max(len(operator.matches) - 1, 0))


class ROUGHSPECTRA_OT_find_nearest(looking.LooksFirst, common.AssignOptions, bpy.types.Operator):
    """Find the measured samples nearest to a color, and assign one to the material"""

    bl_idname = "rough_spectra.find_nearest"
    bl_label = "Find Sample by Color"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 1, 2

    color: FloatVectorProperty(
        name="Color",
        description="Color of the reading to look for, under D65",
        subtype="COLOR_GAMMA",
        min=0.0,
        max=1.0,
        default=(0.5, 0.5, 0.5),
        update=_find,
    )
    count: IntProperty(
        name="Count",
        description="How many samples to show",
        default=10,
        min=1,
        max=100,
        update=_find,
    )
    matches: CollectionProperty(
        name="Matches",
        description="Samples, the nearest first",
        type=RoughSpectraMatch,
        options={"SKIP_SAVE", "HIDDEN"},
    )
    index: IntProperty(
        name="Match",
        description="Which of them to assign; 0 is the nearest",
        min=0,
        options={"SKIP_SAVE", "HIDDEN"},
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return common.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Show the matches while a color is picked."""
        common.begin_with_sigma(self, context)
        with waiting(context):
            _find(self)
        return context.window_manager.invoke_props_dialog(self, width=480, confirm_text="Assign")

    def draw(self, _context: Any) -> None:
        """Draw color, matches and how to assign."""
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "color")
        layout.template_list(
            *("ROUGHSPECTRA_UL_matches", "", self, "matches", self, "index"),
            rows=_ROWS,
            maxrows=_ROWS,
        )
        layout.prop(self, "sigma")
        layout.prop(self, "shader")
        layout.prop(self, "scope")

    def work(self, context: Any) -> looking.Work:
        """Assign the match to all materials in scope, or to none."""
        if not self.matches:
            _find(self)
        if self.index >= len(self.matches):
            msg = f"There are only {len(self.matches)} matches; choose one of them."
            raise RoughSpectraError(msg)
        match = self.matches[self.index]
        difference, scope, shader = match.difference, self.scope, self.shader
        sample, sigma = common.of_library(self, match.sample)

        def tell(assigned: Any, _request: Any) -> str:
            common.report_warnings(self, assigned)
            sentence = rpt_("{materials}: {sample} assigned, ΔE00 {difference:.2f} from the color")
            names = ", ".join(material.name for material, _ in assigned[:3])
            return sentence.format(materials=names, sample=sample.name, difference=difference)

        return looking.assignment(
            context,
            scope,
            lambda material: (common.request_in_scope(material, scope, sample, sigma), shader),
            tell,
        )


classes = (RoughSpectraMatch, ROUGHSPECTRA_UL_matches, ROUGHSPECTRA_OT_find_nearest)
