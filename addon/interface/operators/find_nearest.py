# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find the samples of library and presets whose color is nearest to a picked one."""

from __future__ import annotations

import math
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import (
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    StringProperty,
)

from ....core.errors import InputError, RoughSpectraError
from ...material.properties import ILLUMINANT_ITEMS
from . import ahead, common, giving, looking, targets
from .import_options import waiting

if TYPE_CHECKING:
    from ...samples.palette import Row
    from ...samples.sample import Sample

_ROWS = 8
_PICTURE = 7.0
"""Height and width of the highlighted match's picture, in heights of a button."""
_CHARACTERS, _CHARACTERS_BESIDE = 75, 52
"""Of a sentence in a line of the dialog, and beside the names of properties."""
_CHARACTERS_OF_NAME = 40
"""Of a match in the list, beside its ΔE00."""
_LABELS = 0.4
"""Share of the width that these have."""


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
        split.label(text=_told(item), translate=False)
        split.label(text=f"ΔE00 {item.difference:.1f}", translate=False)


def _told(item: Any) -> str:
    """Name a match with its collection, or leave out last words: Blender cuts within one."""
    whole = f"{item.name} ({item.sample.partition('/')[0]})"
    if len(whole) <= _CHARACTERS_OF_NAME:
        return whole
    return textwrap.shorten(item.name, _CHARACTERS_OF_NAME, placeholder="…")


def _find(operator: Any, context: Any) -> None:
    """Search again, also when what is looked for or the count change."""
    from ...material import preferences
    from ...samples import library

    operator.matches.clear()
    operator.fault = ""
    try:
        row = _wanted(operator)
        light = row.illuminant, row.observer
        found = library.nearest(row.lab, operator.count, preferences.user_folder(), *light)
    except RoughSpectraError as error:
        operator.fault = str(error)
        return
    for entry, difference in found:
        item = operator.matches.add()
        item.name, item.sample, item.difference = entry.title, entry.id, difference
        item.swatch = entry.swatch
    operator.index = min(operator.index, max(len(operator.matches) - 1, 0))
    _highlight(operator, context)


def _wanted(operator: Any) -> Row:
    """Give the color that is looked for.

    Raises
    ------
    InputError
        If a palette cannot be read, or has no such row.
    """
    from ...samples import palette, swatches

    if operator.by == "LAB":
        lightness, a, b = operator.lab
        return palette.Row("", (lightness, a, b), operator.illuminant, int(operator.observer))
    if operator.by == "COLOR":
        lightness, a, b = swatches.to_lab(tuple(operator.color)).tolist()
        return palette.Row("", (lightness, a, b))
    if not operator.palette:
        raise InputError("Give the file of your palette: a name and a color in each row.")
    rows = palette.read(Path(bpy.path.abspath(operator.palette)))
    return palette.find(rows, operator.row) if operator.row else rows[0]


def palette_rows(operator: Any, _context: Any, text: str) -> list[str]:
    """Give the names in a palette that hold a text."""
    from ...samples import palette

    try:
        rows = palette.read(Path(bpy.path.abspath(operator.palette)))
    except RoughSpectraError:
        return []  # what is wrong with it stands in the dialog
    return [row.name for row in rows if text.casefold() in row.name.casefold()]


def _highlight(operator: Any, context: Any) -> None:
    """Picture the highlighted match, and say how far it is from what is looked for elsewhere."""
    from ...material import preferences
    from ...preview import sample_ball
    from ...samples import library

    operator.apart, operator.picture = "", 0
    if operator.index >= len(operator.matches):
        return
    material = targets.active_material(context)
    try:
        match = library.load(operator.matches[operator.index].sample, preferences.user_folder())
        if not bpy.app.background:
            # Of an operator its properties are asked; an update is handed just these.
            told = getattr(operator, "properties", operator).is_property_set("sigma")
            sigma = operator.sigma if told else _own_sigma(match)
            operator.picture = sample_ball.icon_id(match, sigma, _PICTURE)
        operator.apart = _apart(operator, material, match)
    except RoughSpectraError:
        return  # it has no color, and is refused when it is assigned


def _apart(operator: Any, material: Any, match: Sample) -> str:
    """Give the metamerism index for each light in words; empty where there is no spectrum."""
    from ...matching import metamerism

    sample = _spectrum(operator, material)
    if sample is None:
        return ""
    one, other = (giving.new_request(each, _own_sigma(each)) for each in (sample, match))
    reference, *others = _lights(material)
    found = metamerism.compare(one, other, others[:_MOST_LIGHTS], reference)
    told = ", ".join(f"{each.light} {each.index:.1f}" for each in found[1:])
    return rpt_("{told}, if alike in {light}").format(told=told, light=found[0].light)


def _own_sigma(sample: Sample) -> float:
    return math.radians(sample.sigma_degrees or 0.0)


def _spectrum(operator: Any, material: Any) -> Sample | None:
    """Give the spectrum of what is looked for: a palette's, or that of the material's own color."""
    from ...material import snapshot, storage

    if operator.by == "PALETTE":
        return _wanted(operator).sample
    began = operator.by == "COLOR" and tuple(operator.color) == tuple(operator.began)
    if not began or material is None or not snapshot.has_spectrum(material):
        return None
    return storage.load(material).sample


def _lights(material: Any) -> list[Any]:
    """Give the lights of the scene, as far as it was analyzed, its main one first; else lamps."""
    from ...matching import metamerism
    from ...material import snapshot, storage

    if material is not None and snapshot.has_spectrum(material):
        view = storage.load(material).scene
        if view is not None and len(view.lights) > 1:
            return list(view.lights)
    return ["D65", *metamerism.LIGHTS]


def color_of(material: Any) -> tuple[float, float, float] | None:
    """Give the color of a material as encoded sRGB; None where it has not one."""
    import numpy as np

    from ...blender import shader_nodes, working_space
    from ...colorimetry import srgb, tristimulus
    from ...material import snapshot, storage
    from ...samples import swatches

    if snapshot.has_spectrum(material):
        try:
            [rgb], [lab] = swatches.of_samples([storage.load(material).sample])
        except RoughSpectraError:
            return None
        red, green, blue = rgb.tolist()
        return None if math.isnan(lab[0]) else (red, green, blue)
    node = shader_nodes.shader_node(material)
    if node is None or shader_nodes.color_socket(node).is_linked:
        return None
    linear = np.array(shader_nodes.color_socket(node).default_value)[:3]
    xyz = working_space.current().to_xyz(linear, "D65")
    encoded = srgb.encode(srgb.from_xyz(tristimulus.white("D65", 2)) @ xyz)
    red, green, blue = (min(max(value, 0.0), 1.0) for value in encoded.tolist())
    return red, green, blue


_BY_ITEMS = (
    ("COLOR", "Color", "A color that you pick, at first the material's"),
    ("LAB", "L*a*b*", "Three numbers, as an instrument or a catalog prints them"),
    ("PALETTE", "Palette", "A color of your own table: names with L*a*b*, codes or spectra"),
)
_OBSERVER_ITEMS = (("2", "2°", "CIE 1931"), ("10", "10°", "CIE 1964, as catalogs often print"))
_MOST_LIGHTS = 3
"""Beside the main one; a line holds no more."""


class ROUGHSPECTRA_OT_find_nearest(looking.LooksFirst, giving.AssignOptions, bpy.types.Operator):
    """Find the samples nearest to a color, this material's or one that you pick, and take one"""

    bl_idname = "rough_spectra.find_nearest"
    bl_label = "Find Sample by Color"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 1, 2

    by: EnumProperty(name="By", description="How the color is given", items=_BY_ITEMS, update=_find)
    color: FloatVectorProperty(
        name="Color",
        description="Color of the reading to look for, under D65",
        subtype="COLOR_GAMMA",
        min=0.0,
        max=1.0,
        default=(0.5, 0.5, 0.5),
        update=_find,
    )
    lab: FloatVectorProperty(
        name="L*a*b*",
        description="CIE 1976 L*, a* and b* of the reading to look for",
        default=(50.0, 0.0, 0.0),
        min=-200.0,
        max=200.0,
        precision=2,
        update=_find,
    )
    illuminant: EnumProperty(
        name="Illuminant", description="Light of L*a*b*", items=ILLUMINANT_ITEMS, update=_find
    )
    observer: EnumProperty(
        name="Observer", description="Observer of L*a*b*", items=_OBSERVER_ITEMS, update=_find
    )
    palette: StringProperty(
        name="Palette",
        description="Table of your own colors: a name and L*, a*, b* or #rrggbb in each row, or "
        "any file of spectra",
        subtype="FILE_PATH",
        update=_find,
    )
    row: StringProperty(
        name="Row",
        description="Color of the palette; empty takes the first",
        search=palette_rows,
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
        update=_highlight,
    )
    began: FloatVectorProperty(
        name="First Color",
        description="The material's, with which the dialog began",
        default=(-1.0, -1.0, -1.0),
        options={"SKIP_SAVE", "HIDDEN"},
    )
    fault: StringProperty(
        name="Fault", description="Why nothing is found", options={"SKIP_SAVE", "HIDDEN"}
    )
    picture: IntProperty(
        name="Picture",
        description="Icon of the highlighted match",
        options={"SKIP_SAVE", "HIDDEN"},
    )
    apart: StringProperty(
        name="Metamerism Index",
        description="How far match and color are apart in other lights",
        options={"SKIP_SAVE", "HIDDEN"},
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return targets.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Show the matches while a color is picked; begin with the material's."""
        if not ahead.is_done():
            ahead.begin(context, "find_nearest")
            return {"CANCELLED"}
        giving.begin(self, context)
        material = targets.active_material(context)
        color = None if material is None else color_of(material)
        if color is not None:
            self.color = color
            self.began = self.color
        with waiting(context):
            _find(self, context)
        return context.window_manager.invoke_props_dialog(self, width=560, confirm_text="Assign")

    def draw(self, _context: Any) -> None:
        """Draw color, matches and how to assign."""
        layout = self.layout
        layout.prop(self, "by", expand=True)
        layout.use_property_split = True
        layout.use_property_decorate = False
        if self.by == "COLOR":
            layout.prop(self, "color")
        elif self.by == "LAB":
            layout.prop(self, "lab")
            layout.prop(self, "illuminant")
            layout.prop(self, "observer")
        else:
            layout.prop(self, "palette")
            layout.prop(self, "row")
        if self.fault:
            column = layout.column(align=True)
            column.alert = True
            for line in textwrap.wrap(self.fault, _CHARACTERS):
                column.label(text=line, translate=False)
        row = layout.row()
        row.template_list(
            *("ROUGHSPECTRA_UL_matches", "", self, "matches", self, "index"),
            rows=_ROWS,
            maxrows=_ROWS,
        )
        if self.picture:
            row.template_icon(self.picture, scale=_PICTURE)
        for number, line in enumerate(textwrap.wrap(self.apart, _CHARACTERS_BESIDE)):
            split = layout.split(factor=_LABELS)
            label = split.row()
            label.alignment = "RIGHT"
            label.label(text="" if number else "Metamerism Index (ΔE00)")
            split.label(text=line, translate=False)
        layout.prop(self, "sigma")
        if giving.told_sigma(self) is None:
            split = layout.split(factor=_LABELS)
            split.label(text="")
            if self.properties.is_property_set("sigma"):
                words = "As you set it for the material before"
            else:
                words = "The sample's own, unless you set it"
            split.label(text=words, icon="INFO")
        layout.prop(self, "shader")
        layout.prop(self, "scope")

    def work(self, context: Any) -> looking.Work:
        """Assign the match to all materials in scope, or to none."""
        if not self.matches:
            _find(self, context)
        if self.fault:
            raise RoughSpectraError(self.fault)
        if self.index >= len(self.matches):
            msg = f"There are only {len(self.matches)} matches; choose one of them."
            raise RoughSpectraError(msg)
        match = self.matches[self.index]
        sample, difference = giving.of_library(match.sample), match.difference

        def tell(assigned: Any) -> str:
            common.report_warnings(self, assigned)
            sentence = rpt_("{materials}: {sample} assigned, ΔE00 {difference:.2f} from the color")
            names = ", ".join(material.name for material, _ in assigned[:3])
            told = sentence.format(materials=names, sample=sample.name, difference=difference)
            return told + giving.told_roughness(self, assigned)

        return looking.assignment(self, context, sample, tell)


classes = (RoughSpectraMatch, ROUGHSPECTRA_UL_matches, ROUGHSPECTRA_OT_find_nearest)
