# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Estimate σ of the material from its reading and a second one, smooth or rough."""

from __future__ import annotations

import textwrap
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.props import EnumProperty, FloatProperty, StringProperty

from ....core.errors import DomainError, RoughSpectraError
from ....core.limits import REPEATABILITY
from . import common, targets
from .assign_file import choose
from .library import matching_samples

if TYPE_CHECKING:
    from ....core.estimate import Estimate
    from ...matching.request import Request
    from ...samples.sample import Sample

    Pairs = list[tuple[Sample | None, Sample]]

_SOURCE_ITEMS = (
    ("LIBRARY", "Presets and Library", "A sample of the presets or of your library"),
    ("FILE", "File", "A sample of a measurement file"),
    ("SET", "Its Own Set", "Nothing else: the angles, or smooth and rough, that the sample holds"),
)
_WIDTH = 480
_CHARACTERS_A_LINE = 70


def _show(fields: Any, context: Any) -> None:
    """Estimate again whenever a field changes, so that drawing only shows what was found.

    Blender hands over the operator's fields here, without its methods.
    """
    from ...matching import roughness

    if not _is_named(fields):
        fields.found = ""
        return
    try:
        _, _, found = _estimate(fields, context)
    except RoughSpectraError as error:
        fields.found = str(error)
        return
    fields.found = "\n".join((roughness.summary(found), *found.notes))


def _is_named(fields: Any) -> bool:
    """Whether the second reading is named yet, if one is asked for."""
    if fields.source == "SET":
        return True
    return bool(fields.sample if fields.source == "LIBRARY" else fields.filepath)


def _estimate(fields: Any, context: Any) -> tuple[Request, Pairs, Estimate]:
    """Give what the material stores, the two readings, and what they say of σ.

    Raises
    ------
    RoughSpectraError
        If one of them cannot be used.
    """
    from ...matching import roughness
    from ...material import storage

    request = storage.load(targets.active_material(context))
    stored = request.sample
    pairs: Pairs
    if fields.source == "SET":
        pairs = [(None, stored)]
    else:
        other = _second(fields)
        # An albedo is what a smooth surface reads.
        pairs = [(other, stored) if stored.kind == "reading" else (stored, other)]
    return request, pairs, roughness.of_samples(pairs, relative=fields.repeatability / 100)


def _has_set(context: Any) -> bool:
    """Whether the material's own readings may do; what is damaged is told by the estimate."""
    from ...matching import roughness
    from ...material import storage

    try:
        return roughness.tells(storage.load(targets.active_material(context)).sample)
    except RoughSpectraError:
        return False


def _second(fields: Any) -> Sample:
    from ...material import preferences
    from ...samples import library, readers

    if not _is_named(fields):
        raise DomainError("Name the second reading: a sample of the library, or a file.")
    if fields.source == "LIBRARY":
        return library.load(fields.sample, preferences.user_folder())
    path = bpy.path.abspath(fields.filepath)
    return choose(readers.read(path), fields.name_in_file, path)


class ROUGHSPECTRA_OT_estimate_sigma(bpy.types.Operator):
    """Estimate the material's σ from its reading and one of the same material when smooth"""

    bl_idname = "rough_spectra.estimate_sigma"
    bl_label = "Estimate σ from Readings"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 2, 4

    source: EnumProperty(
        name="From", description="Where the second reading is", items=_SOURCE_ITEMS, update=_show
    )
    sample: StringProperty(
        name="Sample",
        description="Collection and name of the second reading, as in colorchecker/14-green",
        search=matching_samples,
        update=_show,
    )
    filepath: StringProperty(
        name="File",
        description="Measurement file that has the second reading",
        subtype="FILE_PATH",
        update=_show,
    )
    name_in_file: StringProperty(
        name="Sample", description="Its name, if the file has several", update=_show
    )
    repeatability: FloatProperty(
        name="Repeatability",
        description="Standard deviation of repeated readings, percent of the reading",
        default=100 * REPEATABILITY,
        min=0.001,
        max=100.0,
        soft_max=2.0,
        precision=3,
        update=_show,
    )
    found: StringProperty(
        name="Found", description="What was estimated", options={"SKIP_SAVE", "HIDDEN"}
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a material of the file that stores a spectrum."""
        from ...material import snapshot

        material = targets.active_material(context)
        if material is None or not snapshot.has_spectrum(material):
            cls.poll_message_set("The material has no measured spectrum; assign one first")
            return False
        return targets.is_local(cls, material)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Ask for the second reading, or take the material's own set where it may do."""
        if not self.properties.is_property_set("source") and _has_set(context):
            self.source = "SET"
        _show(self, context)
        return context.window_manager.invoke_props_dialog(self, width=_WIDTH, confirm_text="Set σ")

    def draw(self, context: Any) -> None:
        """Draw which reading is asked for, and what was found."""
        layout = self.layout
        group = targets.active_material(context).rough_spectra  # type: ignore[union-attr]
        stored, other = ("rough", "smooth") if group.kind == "reading" else ("smooth", "rough")
        words = iface_("The material's own is the {stored} reading; give the {other} one").format(
            stored=iface_(stored), other=iface_(other)
        )
        if self.source == "SET":
            words = iface_("The material's own readings are used, and nothing else")
        layout.label(text=words, translate=False)
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "source")
        if self.source == "LIBRARY":
            layout.prop(self, "sample")
        elif self.source == "FILE":
            layout.prop(self, "filepath")
            layout.prop(self, "name_in_file")
        layout.prop(self, "repeatability")
        column = layout.column(align=True)
        for sentence in self.found.split("\n"):
            for line in textwrap.wrap(sentence, _CHARACTERS_A_LINE):
                column.label(text=line, translate=False)

    def execute(self, context: Any) -> set[str]:
        """Write σ and where it comes from into the material, and derive its color again."""
        from ...matching import roughness
        from ...material import derive

        material: Any = targets.active_material(context)
        try:
            request, pairs, found = _estimate(self, context)
            if not found.is_told:
                raise DomainError(found.reason)
            sample = replace(request.sample, sigma_source=roughness.source(found, pairs))
            wanted = replace(request, sample=sample, sigma=found.sigma)
            shader = material.rough_spectra.shader
            solutions = derive.assign([(material, wanted)], shader, look_again=False)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        for note in found.notes:
            self.report({"WARNING"}, f"{material.name}: {note}")
        common.report_warnings(self, [(material, solutions[0])])
        self.report({"INFO"}, f"{material.name}: {roughness.summary(found)}")
        return {"FINISHED"}


classes = (ROUGHSPECTRA_OT_estimate_sigma,)
