# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators share: the materials they work on, and how they report."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

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
    from ....core.gloss import Gloss
    from ...matching.solution import Solution
    from ...matching.solve import Request
    from ...material.textures import Looked
    from ...samples.sample import Sample

SCOPE_ITEMS = (
    ("ACTIVE", "Active Material", "Only the active object's active material"),
    ("SELECTED", "Selected Objects", "Every material on the selected objects"),
)
ASSIGN_SCOPE_ITEMS = (
    SCOPE_ITEMS[0],
    (
        "EACH",
        "Selected Objects",
        "The active material of each selected object; objects without a material get one",
    ),
    ("SELECTED", "Selected Objects, All Slots", "Every material on the selected objects"),
)
ALL_WITH_SPECTRUM = ("ALL", "All with a Spectrum", "Every material in use with a spectrum")


_WITHOUT_SURFACE = {"GREASEPENCIL", "GPENCIL", "VOLUME"}
"""Types of objects whose materials are not of surfaces."""
_CHARACTERS_A_LINE = 100
_SWATCH_WIDTH = 1.6
"""Of a color in a list, in heights of a button."""


def choose_files(operator: Any, context: Any, behind: str = "") -> set[str]:
    """Let the user choose where an operator writes; the .blend's name and `behind` come first."""
    if not operator.filepath:
        blend = Path(bpy.data.filepath or "untitled.blend")
        operator.filepath = str(blend.with_name(blend.stem + behind))
    context.window_manager.fileselect_add(operator)
    return {"RUNNING_MODAL"}


class AssignOptions:
    """Properties of every operator that assigns a spectrum.

    None is taken over from the last time: of one that is set, somebody said so now.
    """

    sigma: FloatProperty(**SIGMA, options={"SKIP_SAVE"})
    shader: EnumProperty(
        name="Shader", description="Node that is set", items=SHADER_ITEMS, options={"SKIP_SAVE"}
    )
    scope: EnumProperty(
        name="For",
        description="Materials that get it",
        items=ASSIGN_SCOPE_ITEMS,
        options={"SKIP_SAVE"},
    )


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


def white_settings(owner: Any) -> list[str]:
    """Name those of `WhiteOptions` that count for an owner of all of them."""
    if owner.white in ("", AS_FILE, white_scale.PERFECT):
        return ["white"]
    return ["white", "plaque"] + ["white_factor"] * (owner.plaque == white_scale.STATED)


def draw_white(layout: Any, owner: Any) -> None:
    """Ask which white values are relative to; `owner` has the properties of `WhiteOptions`."""
    for name in white_settings(owner):
        layout.prop(owner, name)


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


def can_carry(thing: Any | None) -> bool:
    """Whether an object may have surface materials: Grease Pencil has materials of its own."""
    if thing is None or thing.type in _WITHOUT_SURFACE:
        return False
    return hasattr(thing.data, "materials")


def active_material(context: Any) -> Any | None:
    """Give the material that the Material tab shows."""
    found = getattr(context, "material", None)
    if found is None:
        thing = active_object(context)
        found = None if thing is None else thing.active_material
    return None if found is None or found.is_grease_pencil else found


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

        found = selection.in_use(material for _, material in selection.surfaces((), ()))
        if not found:
            msg = "No material in use has a measured spectrum; assign one first."
            raise RoughSpectraError(msg)
        return found
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


def replacing_request(
    material: Any | None, sample: Sample, sigma: float | None = None
) -> tuple[Request, str]:
    """Give the request of a material with another sample, and its shader; the settings stay.

    Parameters
    ----------
    material
        A `bpy.types.Material`, or None where it has yet to be made.
    sigma
        Radians, where somebody said so. None keeps the roughness that the user set, and else takes
        the sample's own.

    Raises
    ------
    MaterialError
        If the material keeps a σ of an earlier version, which is the user's to change.
    """
    from ...material import snapshot, state, storage

    own = radians(sample.sigma_degrees or 0.0) if sigma is None else sigma
    if material is None or not snapshot.has_spectrum(material):
        return new_request(sample, own), "AUTO"
    group = material.rough_spectra
    shader, kept = group.shader, sigma is None and storage.is_sigma_set(material)
    beyond = state.beyond(snapshot.sigma_degrees(group))
    if kept and beyond:
        msg = f"Material {material.name!r}: {beyond}."
        raise MaterialError(msg)
    fresh = new_request(sample, snapshot.sigma(group) if kept else own)
    try:
        return replace(storage.load(material), sample=sample, sigma=fresh.sigma), shader
    except MaterialError:
        # What is stored is damaged: assigning anew is what mends it.
        return fresh, shader


def begin(operator: Any, context: Any) -> None:
    """Let a dialog begin with the roughness that the user gave the material, and the selection."""
    from ...material import snapshot, storage

    material = active_material(context)
    if material is not None and snapshot.has_spectrum(material) and storage.is_sigma_set(material):
        operator.sigma = snapshot.sigma(material.rough_spectra)
    begin_scope(operator, context)


def begin_scope(operator: Any, context: Any) -> None:
    """Mean all selected objects where there are several, one of which is the active one."""
    chosen = _carriers(context)
    active: Any = active_object(context)
    if len(chosen) > 1 and active in chosen and active.active_material == active_material(context):
        operator.scope = "EACH"


def _carriers(context: Any) -> list[Any]:
    """Give the selected objects that a surface can be assigned to, the active one first."""
    active = active_object(context)
    found = [thing for thing in context.selected_objects if can_carry(thing)]
    return sorted(found, key=lambda thing: (thing != active, thing.name))


def is_material_tree(context: Any) -> bool:
    """Whether the node editor shows the nodes of a material."""
    space = context.space_data
    tree = getattr(space, "edit_tree", None)
    return (
        tree is not None
        and tree.bl_idname == "ShaderNodeTree"
        and isinstance(getattr(space, "id", None), bpy.types.Material)
    )


class Aim(NamedTuple):
    """What an assignment means: all of it, or nothing.

    Parameters
    ----------
    materials
        The one that is shared first.
    bare
        Objects that nobody gave one, which share the first, or a new one.
    makes
        Whether a new one is made, called as the sample.
    """

    materials: list[Any]
    bare: list[Any]
    makes: bool


def aim(context: Any, scope: str) -> Aim:
    """Find what a scope of `AssignOptions` means.

    Raises
    ------
    RoughSpectraError
        If that is nothing, or an object without a material cannot be given one.
    """
    materials, bare = _in_scope(context, scope)
    for thing in bare:
        refuse_linked(thing)
    makes = bool(bare) and not (materials and active_object(context) not in bare)
    if scope != "EACH":
        return Aim(materials, bare, makes)
    # What Blender made, and nobody touched since, is no material of an object's own.
    from ...blender import untouched

    spare = untouched.among(materials)
    if makes and spare:
        materials = [spare[0], *(each for each in materials if each != spare[0])]
        makes = False
    replaced = set(spare) - {*materials[:1]}
    things = _carriers(context)
    idle = {each for each in things if each.active_material in replaced and is_local_object(each)}
    kept = {*materials[:1], *(each.active_material for each in things if each not in idle)}
    shared = [*bare, *(each for each in things if each in idle)]
    return Aim([each for each in materials if each in kept], shared, makes)


def is_local_object(thing: Any) -> bool:
    """Whether an object's materials may be exchanged."""
    return bool(thing.is_editable and thing.data.is_editable)


def refuse_linked(thing: Any) -> None:
    """Raise `RoughSpectraError` unless an object's materials may be exchanged."""
    if not is_local_object(thing):
        msg = f"Object {thing.name!r} is linked; make it local first, to give it one."
        raise RoughSpectraError(msg)


def assign_sample(
    operator: Any,
    aimed: Aim,
    sample: Sample,
    looked: Looked | None = None,
    sigma: float | None = None,
) -> list[tuple[Any, Solution]]:
    """Assign a sample by an operator's `AssignOptions`, to all that is meant or to nothing.

    Each material keeps its light, model, tolerance, shader and gloss, unless the operator was told
    otherwise, and its roughness if the user set it. Objects without a material, or with one that
    nobody touched since Blender made it, share one that is called as the sample. So is one
    afterwards whose name was ours; a name that the user typed stays. `looked` is as of
    `derive.assign`; `sigma`, radians, counts instead of the operator's.

    Returns
    -------
    Each material and what was matched.

    Raises
    ------
    RoughSpectraError
        If it cannot be done; nothing was changed then.
    """
    told = operator.properties.is_property_set
    if sigma is None and told("sigma"):
        sigma = operator.sigma

    def wanted(material: Any | None) -> tuple[Request, str]:
        request, shader = replacing_request(material, sample, sigma)
        return request, operator.shader if told("shader") else shader

    assigned = _assign(aimed, wanted, sample, looked)
    given = {material.rough_spectra.sigma for material, _ in assigned}
    if sigma is None and len(given) == 1:
        [operator.sigma] = given  # to be seen, and changed, afterwards
    return assigned


def _assign(
    aimed: Aim,
    wanted: Callable[[Any], tuple[Request, str]],
    sample: Sample,
    looked: Looked | None = None,
) -> list[tuple[Any, Solution]]:
    from ...blender import shader_nodes
    from ...matching import own_gloss
    from ...material import derive, naming, storage

    shines = own_gloss.of_sample(sample) is not None
    ours = naming.given_by_us(aimed.materials)
    made = shader_nodes.new_material(sample.name, shines) if aimed.makes else None
    materials = aimed.materials if made is None else [made, *aimed.materials]
    try:
        found = [wanted(None if material == made else material) for material in materials]
        pairs = [
            (material, request) for material, (request, _) in zip(materials, found, strict=True)
        ]
        glosses = _glosses(materials, sample)
        shaders = [shader for _, shader in found]
        solutions = derive.assign(pairs, shaders, glosses=glosses, looked=looked)
    except RoughSpectraError:
        if made is not None:
            bpy.data.materials.remove(made)
        raise
    for material, gloss in zip(materials, glosses, strict=True):
        if gloss is not None:
            storage.note_own_gloss(material, storage.shown_gloss(material))
    for thing in aimed.bare:
        if thing.active_material != materials[0]:  # one of the same mesh may have been given it
            thing.active_material = materials[0]
    naming.rename(ours, sample.name)
    return list(zip(materials, solutions, strict=True))


def _glosses(materials: Sequence[Any], sample: Sample) -> list[Gloss | None]:
    """Give the gloss that each material gets with a sample, or None: it stays as it is.

    That of the sample, unless the user set one. What a new node has goes where the sample says that
    it is matte, and what an earlier sample brought goes with that.
    """
    from ....core.gloss import Gloss
    from ...matching import own_gloss
    from ...material import storage

    own, is_stated = own_gloss.of_sample(sample), own_gloss.is_stated(sample)
    matte = Gloss(level=0.0)
    found: list[Gloss | None] = []
    for material in materials:
        if storage.is_gloss_set(material):
            found.append(None)
        elif own is None and (is_stated or storage.own_gloss(material) is not None):
            found.append(matte)
        else:
            found.append(own)
    return found


def _in_scope(context: Any, scope: str) -> tuple[list[Any], list[Any]]:
    """Give the materials that an assignment means, that of the active object first.

    And the objects without one.
    """
    if scope == "SELECTED" or (scope == "ACTIVE" and active_material(context) is not None):
        return materials_in_scope(context, scope), []
    things = carriers_in_scope(context, scope)
    found = dict.fromkeys(thing.active_material for thing in things)
    found.pop(None, None)
    return list(found), [thing for thing in things if thing.active_material is None]


def carriers_in_scope(context: Any, scope: str) -> list[Any]:
    """Give the objects that a scope of `AssignOptions` means, the active one first.

    Raises
    ------
    RoughSpectraError
        If there is none.
    """
    if scope == "ACTIVE":
        active = active_object(context)
        if can_carry(active):
            return [active]
        msg = "There is no object that can carry a material; select a mesh first."
        raise RoughSpectraError(msg)
    things = _carriers(context)
    if not things:
        msg = "No selected object can carry a material; select meshes first."
        raise RoughSpectraError(msg)
    return things


def of_library(name: str) -> Sample:
    """Give a sample of library or presets.

    Raises
    ------
    RoughSpectraError
        If there is no such sample.
    """
    from ...material import preferences
    from ...samples import library

    return library.load(name, preferences.user_folder())


def can_have_material(operator: Any, context: Any) -> bool:
    """Poll for operators that assign to the active material."""
    if active_material(context) is not None or can_carry(active_object(context)):
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
    """Poll for operators that write to a material: neither linked nor an override."""
    from ...material import snapshot

    if not snapshot.elsewhere(material):
        return True
    operator.poll_message_set("The material is linked; make it local first")
    return False


def has_own_spectrum(operator: Any, context: Any) -> bool:
    """Poll for operators that change the active material's settings."""
    from ...material import snapshot

    material = active_material(context)
    if material is None or not snapshot.has_spectrum(material):
        operator.poll_message_set("The material has no measured spectrum; assign one first")
        return False
    return is_local(operator, material)


def previews(context: Any) -> list[Any]:
    """Give the 3D views that show Material Preview, which is Eevee whatever the scene's engine is.

    In a 3D view that one alone; elsewhere those of the window, unless one of them is rendered.
    """
    screen = getattr(context, "screen", None)
    own: Any = getattr(context, "space_data", None)
    if getattr(own, "type", "") == "VIEW_3D":
        spaces = [own]
    else:
        areas = () if screen is None else screen.areas
        spaces = [area.spaces.active for area in areas if area.type == "VIEW_3D"]
    kinds = [space.shading.type for space in spaces]
    if "RENDERED" in kinds:
        return []
    return [space for space, kind in zip(spaces, kinds, strict=True) if kind == "MATERIAL"]


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
    """Report every warning of the solutions, with the material's name.

    What was altered when the file was read is told, too, but is no fault of the match. `pairs` are
    materials that store what was solved, and their solutions.
    """
    from ...material import storage

    for material, solution in pairs:
        altered = storage.load(material).sample.altered if solution.warnings else ()
        for warning in solution.warnings:
            level = "INFO" if warning in altered else "WARNING"
            operator.report({level}, f"{material.name}: {warning}")
