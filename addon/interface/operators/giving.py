# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators share that give samples to materials: their options, and the giving."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import radians
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, FloatProperty

from ....core import limits, white_scale
from ....core.errors import InputError, MaterialError, RoughSpectraError
from ...material.properties import PLAQUE, SHADER_ITEMS, SIGMA, WHITE, WHITE_FACTOR, WHITE_ITEMS
from . import common, targets

if TYPE_CHECKING:
    from ....core.gloss import Gloss
    from ...matching.solution import Solution
    from ...matching.solve import Request
    from ...material.textures import Looked
    from ...samples.sample import Sample


class AssignOptions:
    """Properties of every operator that assigns a spectrum.

    None is taken over from the last time: of one that is set, somebody said so now.
    """

    sigma: FloatProperty(**SIGMA, options={"SKIP_SAVE"})
    began_sigma: FloatProperty(
        name="First σ",
        description="The roughness with which the dialog began, as the user had set it before",
        default=-1.0,
        options={"SKIP_SAVE", "HIDDEN"},
    )
    shader: EnumProperty(
        name="Shader", description="Node that is set", items=SHADER_ITEMS, options={"SKIP_SAVE"}
    )
    scope: EnumProperty(
        name="For",
        description="Materials that get it",
        items=targets.ASSIGN_SCOPE_ITEMS,
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
    from ...material import roughness_origin, snapshot, state, storage

    own = radians(sample.sigma_degrees or 0.0) if sigma is None else sigma
    if material is None or not snapshot.has_spectrum(material):
        return new_request(sample, own), "AUTO"
    group = material.rough_spectra
    shader, kept = group.shader, sigma is None and roughness_origin.is_sigma_set(material)
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
    from ...material import roughness_origin, snapshot

    material = targets.active_material(context)
    if (
        material is not None
        and snapshot.has_spectrum(material)
        and roughness_origin.is_sigma_set(material)
    ):
        operator.sigma = operator.began_sigma = snapshot.sigma(material.rough_spectra)
    begin_scope(operator, context)


def told_sigma(operator: Any) -> float | None:
    """Give the σ that an operator was told, in radians; None where it is each material's own.

    What a dialog merely began with is of the material that it began with: others in its scope keep
    what they have, or take the sample's, as they do where no dialog asks.
    """
    if not operator.properties.is_property_set("sigma") or operator.sigma == operator.began_sigma:
        return None
    return float(operator.sigma)


def begin_scope(operator: Any, context: Any) -> None:
    """Mean all selected objects where there are several, one of which is the active one."""
    chosen = targets.carriers(context)
    active: Any = targets.active_object(context)
    if (
        len(chosen) > 1
        and active in chosen
        and active.active_material == targets.active_material(context)
    ):
        operator.scope = "EACH"


def assign_sample(
    operator: Any,
    aimed: targets.Aim,
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
    if sigma is None:
        sigma = told_sigma(operator)

    def wanted(material: Any | None) -> tuple[Request, str]:
        request, shader = replacing_request(material, sample, sigma)
        return request, operator.shader if told("shader") else shader

    assigned = _assign(aimed, wanted, sample, looked)
    given = {material.rough_spectra.sigma for material, _ in assigned}
    if sigma is None and len(given) == 1:
        [operator.sigma] = given  # to be seen, and changed, afterwards
        operator.began_sigma = operator.sigma
    return assigned


def _assign(
    aimed: targets.Aim,
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


def told_of(operator: Any, assigned: Sequence[tuple[Any, Any]], sample: Sample) -> str:
    """Report every warning of the solutions; gives the sentence on which got the sample."""
    from ...samples import stated_white

    common.report_warnings(operator, assigned)
    if remark := stated_white.remark(sample):
        operator.report({"INFO"}, remark)
    names = ", ".join(material.name for material, _ in assigned[:3])
    sentence = rpt_("{materials}: {sample} assigned").format(materials=names, sample=sample.name)
    return sentence + told_roughness(operator, assigned)


def told_roughness(operator: Any, assigned: Sequence[tuple[Any, Any]]) -> str:
    """Say, for the end of a sentence, where the roughness is not the sample's, unless it was told.

    Else nobody would know that the one before stayed, or that a file says nothing of it.
    """
    from ...material import roughness_origin, snapshot

    if told_sigma(operator) is not None:
        return ""
    materials = [material for material, _ in assigned]
    kept = {
        f"{snapshot.sigma_degrees(material.rough_spectra):g}°"
        for material in materials
        if roughness_origin.is_sigma_set(material)
    }
    if kept:
        return rpt_("; roughness {degrees} stays, as you set it").format(
            degrees=", ".join(sorted(kept))
        )
    if any(map(roughness_origin.is_guess, materials)):
        return rpt_("; it says nothing of roughness: smooth is a guess")
    return ""
