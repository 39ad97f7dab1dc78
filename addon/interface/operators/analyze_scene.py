# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let materials be right in the light and the directions of their scene."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty

from ....core.errors import RoughSpectraError
from . import common, targets

_SCOPES = (
    ("VIEW", "All in View", "Every material in view that has a measured spectrum", 0),
    ("ACTIVE", "Active Material", "Only the active object's active material", 1),
)
_EYES = (
    ("CAMERA", "Camera", "What the scene's camera sees", 0),
    ("VIEWPORT", "Viewport", "What the 3D viewport shows", 1),
)


class ROUGHSPECTRA_OT_analyze_scene(bpy.types.Operator):
    """Find the lights and directions that meet each material in view, and match it to them"""

    bl_idname = "rough_spectra.analyze_scene"
    bl_label = "Analyze Scene"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 1

    scope: EnumProperty(name="For", description="Materials that follow the scene", items=_SCOPES)
    through: EnumProperty(name="Through", description="What looks at the scene", items=_EYES)
    overwrite_edits: BoolProperty(
        name="Overwrite Edits by Hand",
        description="Match materials, too, whose color or roughness was edited by hand",
        default=False,
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a scene to look at."""
        if context.scene.camera is not None or _viewport(context) is not None:
            return True
        cls.poll_message_set("Add a camera, or open a 3D viewport")
        return False

    def execute(self, context: Any) -> set[str]:
        """Analyze and match, or change nothing."""
        from ...scene import analysis, follow_scene

        try:
            materials = None
            if self.scope == "ACTIVE":
                materials = targets.materials_in_scope(context, "ACTIVE")
            depsgraph = context.evaluated_depsgraph_get()
            report = analysis.analyze(depsgraph, context.scene, self._view(context))
            chosen, left = follow_scene.choose(report, materials, self.overwrite_edits)
            changes = follow_scene.follow(report, chosen)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        unlit = follow_scene.unlit_sentence(report)
        for sentence in (self._instead(context), *report.warnings, unlit, *left):
            if sentence:
                self.report({"WARNING"}, sentence)
        common.report_warnings(self, [(c.material, c.solution) for c in changes])
        from ...picture import last_verdict

        last_verdict.forget()  # it was on materials that are others now
        after = sum(change.solution.delta_e_mean for change in changes) / len(changes)
        if len(changes) == 1:
            sentence = rpt_("1 material matched to the scene in {time:.1f} s, mean ΔE00 {mean:.2f}")
        else:
            sentence = rpt_(
                "{count} materials matched to the scene in {time:.1f} s, mean ΔE00 {mean:.2f}"
            )
        sentence = sentence.format(count=len(changes), time=report.seconds, mean=after)
        self.report({"INFO"}, sentence)
        return {"FINISHED"}

    def _instead(self, context: Any) -> str:
        """Say when something else than asked for looked at the scene."""
        if self.through == "CAMERA" and context.scene.camera is None:
            return str(rpt_("The scene has no camera; what the 3D viewport shows was analyzed"))
        return ""

    def _view(self, context: Any) -> Any | None:
        viewport = _viewport(context)
        if context.scene.camera is not None and self.through == "CAMERA":
            return None
        if viewport is None:
            msg = "There is no 3D viewport to look through; open one, or choose the camera."
            raise RoughSpectraError(msg)
        from ...scene.analysis import View

        return View(viewport.view_matrix.copy(), viewport.window_matrix.copy())


def _viewport(context: Any) -> Any | None:
    """Give the region data of the 3D viewport at hand."""
    if context.region_data is not None:
        return context.region_data
    if context.window is None:
        return None
    areas = context.window.screen.areas
    return next((area.spaces[0].region_3d for area in areas if area.type == "VIEW_3D"), None)


classes = (ROUGHSPECTRA_OT_analyze_scene,)
