# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Set σ to one of the steps that the panel shows as balls."""

from __future__ import annotations

from math import degrees, radians
from typing import Any

import bpy
from bpy.app.translations import pgettext_tip as tip_

from ...material.properties import SIGMA
from . import targets


class ROUGHSPECTRA_OT_set_roughness(bpy.types.Operator):
    """Set how rough it is, for all selected objects of this sample"""

    bl_idname = "rough_spectra.set_roughness"
    bl_label = "Set Roughness"
    bl_options = {"REGISTER", "UNDO"}

    sigma: bpy.props.FloatProperty(**SIGMA)

    @classmethod
    def description(cls, _context: Any, properties: Any) -> str:
        """Say which value, and what such a surface is like."""
        from ...material import roughness_words

        found = round(degrees(properties.sigma), 1)
        word = tip_(roughness_words.word(found))
        return tip_("Make it {word}: roughness {degrees}°").format(degrees=f"{found:g}", word=word)

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material with a spectrum that may be changed."""
        return targets.has_own_spectrum(cls, context)

    def execute(self, context: Any) -> set[str]:
        """Set it for all that are meant; color and roughness follow."""
        from ...material import together

        material: Any = targets.active_material(context)
        sigma = radians(round(degrees(self.sigma), 3))
        together.set_sigma(material, context.selected_objects, sigma)
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_set_roughness,)
