# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure materials and keep the result with them, beside the prediction."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty

from ....core import instruments
from ....core.errors import MaterialError
from . import background, targets

if TYPE_CHECKING:
    from ....core.numerics.arrays import Array
    from ...instrument.bake import Plan


class ROUGHSPECTRA_OT_measure(background.Measuring, bpy.types.Operator):
    """Render the material with a virtual spectrophotometer and compare with its spectrum"""

    bl_idname = "rough_spectra.measure"
    bl_label = "Measure with Virtual Spectrophotometer"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 3, 1

    scope: EnumProperty(
        name="For",
        description="Materials to measure",
        items=(*targets.SCOPE_ITEMS, targets.ALL_WITH_SPECTRUM),
    )

    @classmethod
    def description(cls, _context: Any, properties: Any) -> str:
        """Say what the button at hand measures."""
        what = {
            "ACTIVE": "the material looks",
            "SELECTED": "the materials of the selected objects look",
            "ALL": "every material that stores a spectrum looks",
        }[properties.scope]
        return (
            f"Check whether {what} as measured. Renders with a virtual spectrophotometer, in a "
            "second Blender in the background, and compares with the spectrum; ESC stops"
        )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need at least one material."""
        return targets.has_materials(cls)

    def to_measure(self, context: Any) -> Plan:
        """Take down the predictions, and what each material is like now."""
        from ...instrument import bake, unseen
        from ...material import last_measurement

        materials = targets.materials_in_scope(context, self.scope)
        self._unlike = [unseen.on_flat_samples(material) for material in materials]
        for material, sentences in zip(materials, self._unlike, strict=True):
            for sentence in sentences:
                self.report({"WARNING"}, f"{material.name}: {sentence}")
        surfaces = [("", material) for material in materials]
        self._prepared = bake.prepare(surfaces)
        # A pointer to a material does not survive an undo while the measurement runs.
        self._ids = [material.session_uid for material in materials]
        self._states = [last_measurement.fingerprint(material) for material in materials]
        self._predicted = [_predicted(material) for material in materials]
        return bake.plan(surfaces, self._prepared)

    def take(self, values: Array) -> str:
        """Keep each reading with its material; linked ones are only reported."""
        from ...instrument import bake
        from ...material import last_measurement

        # As the panel predicts it, so from the spectrum even where a scene asks for something else.
        entries = [
            replace(entry, delta_e_00=bake.from_spectrum(item, entry))
            for item, entry in zip(
                self._prepared, bake.compare(self._prepared, values).entries, strict=True
            )
        ]
        present = {material.session_uid: material for material in bpy.data.materials}
        kept = (self._ids, self._states, self._predicted, self._unlike)
        for entry, uid, state, predicted, unlike in zip(entries, *kept, strict=True):
            material = present.get(uid)
            if material is not None and material.is_editable and entry.measured is not None:
                last_measurement.note(
                    *(material, state, entry.measured.rgb, entry.delta_e_00, predicted),
                    entry.instrument,
                    unlike=unlike,
                )
        for entry in entries:
            if entry.fault:
                self.report({"WARNING"}, entry.fault)
        return _sentence(entries)


def _predicted(material: Any) -> float | None:
    """ΔE00 at the instrument that Cycles is to show now; None where that cannot be said."""
    from ...blender import working_space
    from ...material import settled, snapshot

    if not snapshot.has_spectrum(material):
        return None
    try:
        return settled.differences(material, working_space.current())[0]
    except MaterialError:
        return None


def _sentence(entries: Any) -> str:
    if len(entries) == 1:
        entry = entries[0]
        if entry.delta_e_00 is not None:
            sentence = rpt_("{material}: measured ΔE00 {difference:.2f} from its spectrum")
            return sentence.format(material=entry.material, difference=entry.delta_e_00)
        if entry.measured is None:
            return rpt_("{material}: not measured").format(material=entry.material)
        if entry.fault:
            return rpt_("{material}: measured, but not compared").format(material=entry.material)
        rgb = ", ".join(f"{value:.3f}" for value in entry.measured.rgb)
        where = rpt_(instruments.spoken(entry.instrument))
        sentence = rpt_(
            "{material}: reads RGB {rgb} at {where}; it has no spectrum to compare with"
        )
        return sentence.format(material=entry.material, rgb=rgb, where=where)
    worst = max(entries, key=lambda entry: entry.delta_e_00 or 0.0)
    if worst.delta_e_00 is None:
        return rpt_("{count} materials measured").format(count=len(entries))
    sentence = rpt_("{count} materials measured; largest ΔE00 {difference:.2f} in {material}")
    return sentence.format(count=len(entries), difference=worst.delta_e_00, material=worst.material)


classes = (ROUGHSPECTRA_OT_measure,)
