# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators share: the materials they work on, and how they report."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import radians
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, FloatProperty

from ....core import limits, white_scale
from ....core.errors import InputError, MaterialError, RoughSpectraError
from ...material.properties import (
    PLAQUE,
    SHADER_ITEMS,
    SIGMA,
    WHITE,
    WHITE_FACTOR,
    WHITE_ITEMS,
)

if TYPE_CHECKING:
    from ...matching.solution import Solution
    from ...matching.solve import Request
    from ...samples.sample import Sample

SCOPE_ITEMS = (
    ("ACTIVE", "Active Material", "Only the active object's active material"),
    ("SELECTED", "Selected Objects", "Every material on the selected objects"),
)
ALL_WITH_SPECTRUM = ("ALL", "All with a Spectrum", "Every material of the file with a spectrum")


_CHARACTERS_A_LINE = 100
_SWATCH_WIDTH = 1.6
"""Of a color in a list, in heights of a button."""


class AssignOptions:
    """Properties of every operator that assigns a spectrum."""

    sigma: FloatProperty(**SIGMA)
    shader: EnumProperty(name="Shader", description="Node that is set", items=SHADER_ITEMS)
    scope: EnumProperty(name="For", description="Materials that get it", items=SCOPE_ITEMS)


AS_FILE = "FILE"
"""What a menu has for what the file says."""


class WhiteOptions:
    """Properties of every operator that reads measurement files: what their values are relative to.

    Called as a material's own, so that they are drawn alike.
    """

    white: EnumProperty(
        **WHITE,
        items=((AS_FILE, "As in the File", "Perfect diffuser if it says nothing", 9), *WHITE_ITEMS),
        default=AS_FILE,
    )
    plaque: EnumProperty(**PLAQUE)
    white_factor: FloatProperty(**WHITE_FACTOR)


def stated_white(operator: Any) -> tuple[str | None, Any]:
    """Give white and factor of an operator's `WhiteOptions`, for `samples.stated_white`."""
    if operator.white == AS_FILE:
        return None, None
    factors = {white_scale.STATED: round(operator.white_factor, 6), white_scale.UNKNOWN: None}
    if operator.white == white_scale.PERFECT:
        return operator.white, None
    return operator.white, factors.get(operator.plaque, operator.plaque)


def draw_white(layout: Any, owner: Any) -> None:
    """Ask which white values are relative to; `owner` has the properties of `WhiteOptions`."""
    layout.prop(owner, "white")
    if owner.white in ("", AS_FILE, white_scale.PERFECT):
        return
    layout.prop(owner, "plaque")
    if owner.plaque == white_scale.STATED:
        layout.prop(owner, "white_factor")


def draw_in_browser(operator: Any, names: Sequence[str]) -> None:
    """Draw options beside the files: those of these names, and the white."""
    layout = operator.layout
    layout.use_property_split = True
    layout.use_property_decorate = False
    for name in names:
        layout.prop(operator, name)
    draw_white(layout, operator)


def active_object(context: Any) -> Any | None:
    """Give the object whose material is being edited, which may be pinned."""
    pinned = getattr(context, "object", None)
    return pinned if pinned is not None else context.view_layer.objects.active


def active_material(context: Any) -> Any | None:
    """Give the material that the Material tab shows."""
    shown = getattr(context, "material", None)
    if shown is not None:
        return shown
    thing = active_object(context)
    return None if thing is None else thing.active_material


def materials_in_scope(context: Any, scope: str) -> list[Any]:
    """Give the materials that an operator is to work on.

    Raises
    ------
    RoughSpectraError
        If there is none.
    """
    if scope == "SELECTED":
        from ...material import selection

        found = selection.of_objects(context.selected_objects)
        if not found:
            msg = "No selected object has a material; select objects with materials."
            raise RoughSpectraError(msg)
        return found
    if scope == "ALL":
        from ...material import selection

        return [material for _, material in selection.surfaces((), ())]
    material = active_material(context)
    if material is None:
        msg = "The active object has no material; give it one first."
        raise RoughSpectraError(msg)
    return [material]


def new_request(sample: Sample, sigma: float) -> Request:
    """Give the request of a new material, with the user's preferences.

    Raises
    ------
    InputError
        If no material has this σ, as a file of an earlier version may state it.
    """
    from ...matching.request import Request
    from ...material import preferences, snapshot

    degrees = snapshot.entered_degrees(sigma)
    if fault := limits.sigma_fault(degrees):
        msg = f"{sample.source or 'Sample'}, {sample.name!r}: {fault}"
        raise InputError(msg)
    chosen = preferences.defaults()
    return Request(
        sample,
        radians(degrees),
        illuminant=chosen.illuminant,
        observer=chosen.observer,
        tolerance=chosen.tolerance,
        read_at=chosen.read_at,
    )


def replacing_request(material: Any | None, sample: Sample) -> tuple[Request, str]:
    """Give the request of a material with another sample, and its shader; the settings stay.

    Parameters
    ----------
    material
        A `bpy.types.Material`, or None where it has yet to be made.

    Raises
    ------
    MaterialError
        If the material keeps a σ of an earlier version, which is the user's to change.
    """
    from ...material import snapshot, state, storage

    own = radians(sample.sigma_degrees or 0.0)
    if material is None or not snapshot.has_spectrum(material):
        return new_request(sample, own), "AUTO"
    shader = material.rough_spectra.shader
    beyond = state.beyond(snapshot.sigma_degrees(material.rough_spectra))
    if beyond:
        msg = f"Material {material.name!r}: {beyond}."
        raise MaterialError(msg)
    try:
        return replace(storage.load(material), sample=sample), shader
    except MaterialError:
        # What is stored is damaged: assigning anew is what mends it.
        return new_request(sample, own), shader


def request_in_scope(material: Any | None, scope: str, sample: Sample, sigma: float) -> Request:
    """Give the request for the materials in scope.

    The active material keeps its light, model and tolerance, as with `replacing_request`; several
    materials, which may differ, get the user's preferences.
    """
    from ...material import snapshot

    fresh = new_request(sample, sigma)
    if scope != "ACTIVE" or material is None or not snapshot.has_spectrum(material):
        return fresh
    request, _ = replacing_request(material, sample)
    return replace(request, sigma=fresh.sigma)


def begin_with_sigma(operator: Any, context: Any) -> None:
    """Let a dialog begin with the roughness that the material has: another sample keeps it."""
    from ...material import snapshot

    material = active_material(context)
    if material is not None and snapshot.has_spectrum(material):
        operator.sigma = snapshot.sigma(material.rough_spectra)


def is_material_tree(context: Any) -> bool:
    """Whether the node editor shows the nodes of a material."""
    space = context.space_data
    tree = getattr(space, "edit_tree", None)
    return (
        tree is not None
        and tree.bl_idname == "ShaderNodeTree"
        and isinstance(getattr(space, "id", None), bpy.types.Material)
    )


def assign_in_scope(
    context: Any, scope: str, request: Request, shader: str
) -> list[tuple[Any, Solution]]:
    """Assign to all materials in scope, or to none; an active object without one gets one.

    Returns
    -------
    Each material and what was matched.

    Raises
    ------
    RoughSpectraError
        If it cannot be done; nothing was changed then.
    """
    from ...blender import shader_nodes
    from ...material import derive

    if scope == "SELECTED" or active_material(context) is not None:
        materials = materials_in_scope(context, scope)
        solutions = derive.assign([(material, request) for material in materials], shader)
        return list(zip(materials, solutions, strict=True))
    thing = active_object(context)
    if thing is None or not hasattr(thing.data, "materials"):
        msg = "There is no object that can carry a material; select a mesh first."
        raise RoughSpectraError(msg)
    if not (thing.is_editable and thing.data.is_editable):
        msg = f"Object {thing.name!r} is linked; make it local first, to give it a material."
        raise RoughSpectraError(msg)
    material = shader_nodes.new_material(thing.name)
    try:
        solutions = derive.assign([(material, request)], shader)
    except RoughSpectraError:
        bpy.data.materials.remove(material)
        raise
    thing.active_material = material
    return [(material, solutions[0])]


def of_library(operator: Any, name: str) -> tuple[Sample, float]:
    """Give a sample of library or presets and its σ for an operator with `AssignOptions`.

    σ is the sample's unless the caller of the operator gave one.

    Raises
    ------
    RoughSpectraError
        If there is no such sample.
    """
    from ...material import preferences
    from ...samples import library

    sample = library.load(name, preferences.user_folder())
    sigma = operator.sigma
    if not operator.properties.is_property_set("sigma"):
        sigma = radians(sample.sigma_degrees or 0.0)
        operator.sigma = sigma  # Blender holds it within the slider: what counts is the sample's
    return sample, sigma


def can_have_material(operator: Any, context: Any) -> bool:
    """Poll for operators that assign to the active material."""
    thing = active_object(context)
    if active_material(context) is not None or hasattr(getattr(thing, "data", None), "materials"):
        return True
    operator.poll_message_set("Select an object that can carry a material")
    return False


def has_materials(operator: Any) -> bool:
    """Poll for operators that measure any material."""
    if len(bpy.data.materials) > 0:
        return True
    operator.poll_message_set("There is no material to measure")
    return False


def is_local(operator: Any, material: Any) -> bool:
    """Poll for operators that write to a material."""
    if material.is_editable:
        return True
    operator.poll_message_set("The material is linked; make it local first")
    return False


def has_spectra(operator: Any) -> bool:
    """Poll for operators that need a material with a spectrum."""
    if any(material.rough_spectra.spectrum for material in bpy.data.materials):
        return True
    operator.poll_message_set("No material has a measured spectrum; assign one first")
    return False


def told_of(operator: Any, assigned: Sequence[tuple[Any, Any]], sample: Sample) -> str:
    """Report every warning of the solutions; gives the sentence on which got the sample."""
    from ...samples import stated_white

    report_warnings(operator, assigned)
    if remark := stated_white.remark(sample):
        operator.report({"INFO"}, remark)
    names = ", ".join(material.name for material, _ in assigned[:3])
    return rpt_("{materials}: {sample} assigned").format(materials=names, sample=sample.name)


def draw_swatch(row: Any, item: Any, has_color: bool = True) -> None:
    """Draw the color of a list's item, as wide in every list, or leave its place empty."""
    swatch = row.row()
    swatch.ui_units_x = _SWATCH_WIDTH
    if has_color:
        swatch.prop(item, "swatch", text="")
    else:
        swatch.label(text="", icon="BLANK1")
    row.separator(factor=0.5)


def report_error(operator: Any, error: Exception | str) -> None:
    """Report what went wrong, in lines: Blender's popup lets a long one run out of the window."""
    sentence = str(error)
    if not bpy.app.background:
        # The space is for the status bar, which leaves out the end of a line.
        lines = textwrap.wrap(
            sentence, _CHARACTERS_A_LINE, break_long_words=False, break_on_hyphens=False
        )
        sentence = " \n".join(lines)
    operator.report({"ERROR"}, sentence)


def report_warnings(operator: Any, pairs: Iterable[tuple[Any, Any]]) -> None:
    """Report every warning of the solutions, with the material's name."""
    for material, solution in pairs:
        for warning in solution.warnings:
            operator.report({"WARNING"}, f"{material.name}: {warning}")
