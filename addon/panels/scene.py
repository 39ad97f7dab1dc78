# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scene shows of a material: its lights, and how right it is under each."""

from __future__ import annotations

from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from .. import stamp
from ..preview import words
from . import redraw


def draw_scene(layout: Any, context: Any, material: Any) -> None:
    """Draw the button, the choice, and the lights that were found."""
    group = material.rough_spectra
    row = layout.row(align=True)
    row.operator("rough_spectra.analyze_scene", icon="LIGHT").scope = "VIEW"
    shown = redraw.current(material, context)
    write, found = shown.write, shown.state.stamp
    if not group.scene_view:
        text = iface_("Finds the lights and directions that meet the materials in view")
        write.sentence(layout, text, "INFO")
        return
    if not group.use_scene or found is None:
        return
    for name, delta_e in found.delta_e_lights:
        text = f"{name}: ΔE00 {delta_e:.2f}, {iface_(words.words(delta_e))}"
        write.sentence(layout, text, "LIGHT")
    if found.scene_reason:
        write.sentence(layout, found.scene_reason, "INFO")
    analyzed = stamp.analyzed_scene(group.scene_view)
    if analyzed not in {"", context.scene.name}:
        text = iface_("Analyzed in scene {name}; analyze again if that is not this one")
        write.sentence(layout, text.format(name=repr(analyzed)), "INFO")
