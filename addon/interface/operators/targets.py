# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects and materials that an operator works on."""

from __future__ import annotations

from typing import Any, NamedTuple

import bpy

from ....core.errors import RoughSpectraError

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


def carriers(context: Any) -> list[Any]:
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
    things = carriers(context)
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
    things = carriers(context)
    if not things:
        msg = "No selected object can carry a material; select meshes first."
        raise RoughSpectraError(msg)
    return things


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
