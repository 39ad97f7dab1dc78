# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What everybody sees of a material: sample, roughness, gloss, and one verdict with its remedy.

The same in the Material tab, right below the material slots, and in the sidebars of 3D view and
shader editor. All else is in the panel Details.
"""

from __future__ import annotations

import math
from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from ....core.limits import MATCHED_SIGMA_DEGREES
from ...material import roughness_origin, roughness_words, verdict
from ...preview import balls
from ..operators import targets
from . import obstacle, redraw, renewal, sentences, text
from .icon_values import icon_value

_PICTURE_UNITS = 4.4
"""Height of the picture: as high as what stands beside it."""
_PICTURE = 96.0
"""Pixels at UI scale 1 that it takes of the width."""
_BESIDE = 150.0
"""Pixels that sliders need beside it; else they go below."""
_NARROW_UNITS = 3.4
_BALLS_HIGH = 1.3
_BUTTON = 20.0
"""Pixels of a button with an icon alone."""
_BUTTONS = 42.0
"""Pixels of the two buttons beside the sample's name."""
_NAME = 80.0
"""Pixels that the name needs beside them; else they go below."""
_VALUE = 34.0
"""Pixels that a slider keeps free for its number."""
_PADDING = 60.0
"""Pixels of a button that its text cannot have, less the margins that a line has anyway."""
_SHARES = (0.5, 0.6, 0.7)
"""Of a line, for the words beside a button: Blender cuts what has less than it needs."""
_GAP = 8.0
"""Pixels between these two, and some to spare."""
_FOLD = 6.0
"""Pixels of the arrow that folds a panel, and of its distances, less an icon's."""
_BELOW = 0.05
"""Degrees that a roughness is set below the largest: what is shown rounds."""

_MARKS: dict[verdict.Mark, str] = {
    "right": "STRIP_COLOR_04",
    "near": "STRIP_COLOR_03",
    "off": "STRIP_COLOR_01",
    "open": "STRIP_COLOR_09",
}
"""Colored squares: green, yellow, red and gray; what they mean stands beside them."""

_REMEDIES: dict[verdict.Remedy, tuple[str, tuple[str, ...]]] = {
    "cycles": ("rough_spectra.switch_to_cycles", ("Switch to Cycles", "Cycles")),
    "rendered": ("rough_spectra.show_rendered", ("Show Rendered", "Rendered")),
    "local": ("rough_spectra.make_local", ("Make Local",)),
    "renew": ("rough_spectra.renew", ("Renew",)),
    "wide": ("rough_spectra.use_wide_gamut", ("Use ACEScg", "ACEScg")),
    "matte": ("rough_spectra.remove_gloss", ("Remove Gloss", "Matte")),
    "smoother": ("rough_spectra.set_roughness", ("Make Smoother", "Smoother")),
    "measure": ("rough_spectra.measure", ("Measure",)),
    "unmute": ("rough_spectra.unmute", ("Unmute",)),
}


def draw_details_header(layout: Any, context: Any) -> None:
    """Name the panel Details."""
    form = redraw.current(context).format
    layout.label(text=form.fitting((iface_("Details"),), _FOLD), translate=False)


def draw(layout: Any, context: Any) -> None:
    """Draw what there is to see, and to do, without a second thought."""
    here = redraw.begin(context)
    if not here.format.sidebar:
        # Blender lets only panels without a header come right below the slots; in sidebars the tab
        # and the header say whose it is.
        layout.label(text=iface_("Rough Spectra"), translate=False)
    if here.shown is None:
        _draw_sample(layout, here, None, 0.0)
        told = "Choose a sample, or open a file that an instrument wrote"
        text.draw(layout, sentences.of(told, "INFO", here.style))
        return
    material: Any = targets.active_material(context)
    group, shown = material.rough_spectra, here.shown
    column, inset = _beside_picture(layout, here, shown)
    row_of_balls = balls.icon_ids(shown.uid, shown.facts, here.scale)
    chosen = column.column()
    chosen.enabled = shown.state.kind != "linked"  # Make Local stands below
    _draw_sample(chosen, here, group.sample_name, inset)
    _draw_balls(column, row_of_balls, shown, here.format.room(inset))
    _draw_sliders(column, group, here, shown, inset)
    _draw_verdict(layout, here, shown)


def _beside_picture(
    layout: Any, here: redraw.Redraw, shown: redraw.PanelMaterial
) -> tuple[Any, float]:
    """Draw the picture, and give the layout beside or below it, with what it takes of the width."""
    if shown.obstacle is not None:
        return layout.column(), 0.0
    if here.format.width(_PICTURE) < _BESIDE:
        layout.template_icon(shown.picture("ball", _NARROW_UNITS), scale=_NARROW_UNITS)
        return layout.column(), 0.0
    share = _PICTURE * here.scale / max(here.width - _PICTURE * here.scale / 4, 1)
    split = layout.split(factor=min(share, 0.5))
    split.template_icon(shown.picture("ball", _PICTURE_UNITS), scale=_PICTURE_UNITS)
    return split.column(), _PICTURE


def _draw_sample(layout: Any, here: redraw.Redraw, name: str | None, inset: float) -> None:
    """Name the sample on the button that chooses another, beside other ways to find one."""
    form, label = here.format, iface_("Choose Sample") if name is None else name
    beside, icon = form.width(inset + _BUTTONS) >= _NAME, icon_value("COLOR")
    row = layout.row(align=True) if beside else layout.column(align=True)
    if not beside and not form.fits(label, inset):
        icon, inset = 0, inset - _BUTTON  # a name tells more than an icon
    told = form.shortened(label, inset + _BUTTONS * beside)
    row.operator("rough_spectra.choose_sample", text=told, icon_value=icon, translate=False)
    if not beside:
        row = row.row(align=True)
        row.scale_x = max(form.room(inset) / (2 * _BUTTON), 1.0)
    row.operator("rough_spectra.assign_file", text="", icon_value=icon_value("FILE_FOLDER"))
    row.operator("rough_spectra.find_nearest", text="", icon_value=icon_value("EYEDROPPER"))


def _draw_balls(
    layout: Any, icons: tuple[int, ...], shown: redraw.PanelMaterial, room: float
) -> None:
    """Draw how rough it may be; each sets that."""
    row = layout.row(align=True)
    # An icon's button is as wide as high, unless it is scaled.
    row.scale_x = max(room / (len(roughness_words.STEPS) * _BUTTON), 1.0)
    row.scale_y = _BALLS_HIGH
    now = shown.facts.inputs.sigma_degrees
    for number, step in enumerate(roughness_words.STEPS):
        icon = icons[number] if icons else icon_value("MATSPHERE")
        chosen = math.isclose(now, step, abs_tol=_BELOW)
        button = row.operator(
            "rough_spectra.set_roughness", text="", icon_value=icon, depress=chosen
        )
        button.sigma = math.radians(step)


def _draw_sliders(
    layout: Any, group: Any, here: redraw.Redraw, shown: redraw.PanelMaterial, inset: float
) -> None:
    column = layout.column(align=True)
    column.enabled = group.id_data.is_editable
    label = iface_("Roughness")
    word = iface_(roughness_words.word(shown.facts.inputs.sigma_degrees))
    told = here.format.fitting((f"{label}: {word}", label, iface_("Rough")), inset + _VALUE)
    several = len(here.together.materials) > 1
    names = ("sigma_of_all", "gloss_of_all") if several else ("sigma", "gloss")
    column.prop(group, names[0], text=told, slider=True, translate=False)
    shine = column.row(align=True)
    surface = shown.facts.surface
    shine.enabled = surface is not None and not surface.muted and not surface.gloss_linked
    shine.prop(group, names[1], slider=True)
    if roughness_origin.is_guess(group.id_data):
        text.draw(layout, sentences.of(roughness_origin.GUESS, "QUESTION", here.style))
    if here.together.objects > 1:
        count, is_exact = here.together.objects, here.together.is_exact
        text.draw(layout, sentences.together(count, is_exact, here.style))


def _draw_verdict(layout: Any, here: redraw.Redraw, shown: redraw.PanelMaterial) -> None:
    """Say whether it looks right, and offer what helps."""
    found = verdict.of(shown.facts, shown.apart(), here.previewed, here.measured)
    words = sentences.of(found.words, _MARKS[found.mark], here.style)
    if not found.remedy:
        text.draw(layout, words)
        return
    name, labels = _REMEDIES[found.remedy]
    labels = tuple(map(iface_, labels))
    against: str | None = ""
    if found.remedy in {"renew", "measure"}:
        against = renewal.reason_against(shown.uid, shown.facts)
    in_the_way = obstacle.texts(shown) if against else []
    share = _share(here, iface_(found.words), [*in_the_way, *labels][0])
    row = layout.split(factor=share) if share else layout.column()
    text.draw(row.column(), words)
    row = row.row()
    if in_the_way and obstacle.draw(row, here, shown):
        return
    row.enabled = found.remedy == "measure" or against == ""
    told = here.format.fitting(labels)
    button = row.operator(name, text=told, translate=False)
    if found.remedy in {"renew", "matte", "measure"}:
        button.scope = "ACTIVE"
    elif found.remedy == "smoother":
        button.sigma = math.radians(_largest(shown))


def _share(here: redraw.Redraw, words: str, button: str) -> float:
    """Give the words' share of a line with a button; 0 where they are not to stand in one."""
    room = here.format.room()
    for share in _SHARES:
        if here.format.fits(words, room * (1 - share) + _GAP) and here.format.fits(
            button, room * share + _PADDING
        ):
            return share
    return 0.0


def _largest(shown: redraw.PanelMaterial) -> float:
    """Degrees that the sample may have at most."""
    last = shown.state.stamp
    if last is None or last.sigma_max is None:
        return MATCHED_SIGMA_DEGREES
    return max(min(last.sigma_max, MATCHED_SIGMA_DEGREES) - _BELOW, 0.0)
