# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of spectral pictures in the Render tab, and in it what got which spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_

from . import text

if TYPE_CHECKING:
    from ...picture.images import Shown
    from ...picture.verdict import Verdict
    from .text import Format, Sentence

_BOX = 24.0
"""Pixels at UI scale 1 that a box takes of a sentence's width."""
_MOST = 40
"""Materials and lamps that are listed; the verb `spectral` tells all."""


class RenderTab:
    """What panels of the Render tab share."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}


class ROUGHSPECTRA_PT_picture(RenderTab, bpy.types.Panel):
    """Spectral pictures of the scene, by ordinary renders of three bands each"""

    bl_label = "Rough Spectra"

    def draw(self, context: Any) -> None:
        """Draw the verdict, the settings, the button, and what the last picture showed."""
        layout: Any = self.layout
        form = format_of(context)
        if context.engine != "CYCLES":
            words = iface_("Spectral pictures are rendered with Cycles")
            text.draw(layout, [form.sentence(words, "INFO")])
            layout.operator("rough_spectra.switch_to_cycles", icon="SHADING_RENDERED")
            return
        layout.use_property_split = True
        layout.use_property_decorate = False
        _draw_verdict(layout, context, form)
        group = context.scene.rough_spectra
        column = layout.column()
        column.enabled = context.scene.is_editable
        column.prop(group, "by")
        column.prop(group, "tolerance" if group.by == "TOLERANCE" else "renders")
        column.prop(group, "direct")
        column.prop(group, "observer")
        column.prop(group, "percentage")
        column.prop(group, "compare")
        layout.operator("rough_spectra.render_spectral", icon="RENDER_STILL")
        last = _last()
        if last is not None:
            _draw_shown(layout, last)
            text.draw(layout.column(align=True), _found(last, form))


def _draw_verdict(layout: Any, context: Any, form: Format) -> None:
    """Ask whether RGB is enough; where that is known, say it, and offer the one thing to do."""
    layout.operator("rough_spectra.judge_picture", icon="QUESTION")
    found = _verdict(context.scene)
    if found is None:
        return
    box = layout.box()
    told = [form.sentence(found.sentence, "CHECKMARK" if found.enough else "ERROR", _BOX)]
    if found.untranslated:
        words = iface_("{share:.0%} of the picture stays RGB in part, and is not judged")
        told.append(form.sentence(words.format(share=found.touched), "INFO", _BOX))
    text.draw(box.column(align=True), told)
    if found.enough:
        return
    kind, renders = found.advised.kind, found.advised.renders
    if "space" in kind:
        box.operator("rough_spectra.use_rec2020")
    if "lights" in kind:
        box.operator("rough_spectra.analyze_scene", text=iface_("Match to the Lights"))
    if kind == "passes":
        words = iface_("Render {count} Passes") if renders > 1 else iface_("Render {count} Pass")
        button = box.operator("rough_spectra.render_spectral", text=words.format(count=renders))
        button.renders = renders


def _draw_shown(layout: Any, last: Shown) -> None:
    """Offer to show the picture, and the map beside it."""
    from ...picture import images

    row = layout.row(align=True)
    row.operator("rough_spectra.show_picture", text=iface_("Picture")).which = images.PICTURE
    if last.top is not None:
        row.operator("rough_spectra.show_picture", text=iface_("ΔE00 Map")).which = images.MAP


class ROUGHSPECTRA_PT_picture_rules(RenderTab, bpy.types.Panel):
    """Which spectrum each material, lamp and world had in the last spectral picture"""

    bl_label = "Which Got What"
    bl_parent_id = "ROUGHSPECTRA_PT_picture"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show once there is a picture."""
        return context.engine == "CYCLES" and _last() is not None

    def draw(self, context: Any) -> None:
        """List them; first what stays RGB."""
        last = _last()
        if last is not None:
            layout: Any = self.layout
            text.draw(layout.column(align=True), _rules(last, format_of(context)))


class ROUGHSPECTRA_PT_pixel(bpy.types.Panel):
    """Spectrum and color of a pixel of the spectral picture, and how far RGB is off there"""

    bl_label = "Rough Spectra"
    bl_space_type = "IMAGE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Rough Spectra"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show where the spectral picture or its map is shown."""
        from ...picture import images

        return images.of(context.space_data.image) is not None

    def draw(self, context: Any) -> None:
        """Draw the button, and what was clicked."""
        from ...picture import images
        from ...preview import pixel_plot

        layout: Any = self.layout
        layout.operator("rough_spectra.pick_pixel", icon="EYEDROPPER")
        found, form = images.picked(), format_of(context)
        if found is None:
            return
        layout.template_icon(pixel_plot.icon_id(), scale=pixel_plot.UNITS)
        words = iface_("Pixel {column}, {row}").format(column=found.column, row=found.row)
        lab = "L* {:.1f}, a* {:.1f}, b* {:.1f}".format(*found.lab)
        xyz = "X {:.4g}, Y {:.4g}, Z {:.4g}".format(*found.xyz)
        told = [words, lab, xyz]
        if found.delta_e is not None:
            told.append(iface_("RGB is off by ΔE00 {:.2f}").format(found.delta_e))
        text.draw(layout.column(align=True), [form.sentence(each, "NONE") for each in told])


def _verdict(scene: Any) -> Verdict | None:
    from ...picture import last_verdict

    return last_verdict.of(scene)


def _last() -> Shown | None:
    from ...picture import images  # most sessions of Blender never render one

    return images.last()


def format_of(context: Any) -> Format:
    """Give the format of sentences in the region that is drawn."""
    from ...preview import theme

    scale = theme.scale(context.preferences)
    return text.format_of(context.preferences, scale, context.region.width, context.area.type)


def _found(last: Shown, form: Format) -> list[Sentence]:
    """Say what the last picture showed."""
    told = [form.sentence(f"{each[0].upper()}{each[1:]}", "INFO") for each in last.told]
    if last.top is not None:
        words = iface_("In the map, black is ΔE00 0, and white {top:g} and more")
        told.append(form.sentence(words.format(top=last.top), "IMAGE_DATA"))
    return told


def _rules(last: Shown, form: Format) -> list[Sentence]:
    left = [
        (iface_("{name}: {what} stays RGB").format(name=name, what=", ".join(what)), "ERROR")
        for name, what in last.picture.untranslated.items()
    ]
    rows = [(f"{name}: {'; '.join(rules)}", "DOT") for name, rules in last.picture.rules.items()]
    both = [*left, *rows]
    told = [form.sentence(words, icon) for words, icon in both[:_MOST]]
    if len(both) > _MOST:
        more = iface_("and {count} more").format(count=len(both) - _MOST)
        told.append(form.sentence(more, "BLANK1"))
    return told


classes = (ROUGHSPECTRA_PT_picture, ROUGHSPECTRA_PT_picture_rules, ROUGHSPECTRA_PT_pixel)
