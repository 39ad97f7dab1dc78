# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spots on surfaces of a scene: where an instrument is put down, by a click or by a name.

What is found here is a place on the surface as the viewport has it, and the side of it that the
instrument stands on. Where its spot then lies to a hair, with the displacement and the levels of a
render, the second Blender tells, which sees it (`spot_worker`).
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ...core.errors import DomainError, MaterialError
from ...core.limits import SPOT_DIAMETER
from ...core.numerics.arrays import Array
from .triangles import Triangles

SURFACES = frozenset({"MESH", "CURVE", "SURFACE", "FONT", "META"})
"""Types of objects that Blender makes a mesh of."""

Triple = tuple[float, float, float]
Key = tuple[str, str | None]
"""Name of a datablock, and the path of the library that it is linked from."""


@dataclass(frozen=True)
class Spot:
    """Where on an object a virtual instrument is put down, and how.

    Parameters
    ----------
    thing
        The object, by name and library.
    carrier
        What brings it into the scene: itself, or the object whose instance it is.
    material
        The `bpy.types.Material` there, whose spectrum the reading is compared with.
    point
        Place on the surface, in the scene.
    normal
        Unit vector to the side that the instrument stands on.
    toward
        Where azimuth 0 is; what of it is along the normal does not count.
    diameter
        Of the spot, millimeters.
    is_alone
        Whether other objects are hidden.
    """

    thing: Key
    carrier: Key
    material: Any
    point: Triple
    normal: Triple
    toward: Triple
    diameter: float = SPOT_DIAMETER
    is_alone: bool = True

    @property
    def surface(self) -> tuple[str, Any]:
        """Name of the object and the material, as `bake.prepare` takes them."""
        return self.thing[0], self.material

    @property
    def units(self) -> float:
        """Diameter in units of the scene."""
        return self.diameter / 1000 / float(bpy.context.scene.unit_settings.scale_length)

    def told(self) -> tuple[Any, ...]:
        """Tell it as plain values."""
        place = (*self.point, *self.normal, *self.toward)
        return (self.thing, self.carrier, self.material.name, place, self.diameter, self.is_alone)


def at_ray(
    context: Any, origin: Sequence[float], direction: Sequence[float], **how: Any
) -> Spot | None:
    """Put the instrument on what a ray of the viewport meets first, or give None.

    Parameters
    ----------
    context
        Its scene and view layer are looked at, with what the viewport shows.
    origin, direction
        Of the ray, in the scene.
    how
        `diameter` and `is_alone` of the spot.

    Raises
    ------
    MaterialError
        If what is met has no material there, or cannot be measured.
    """
    depsgraph = context.evaluated_depsgraph_get()
    is_met, where, _, _, thing, matrix = context.scene.ray_cast(depsgraph, origin, direction)
    if not is_met:
        return None
    thing = thing.original
    carrier = _carrier(depsgraph, thing, matrix)
    refuse(thing)
    triangles, materials = surface(thing, depsgraph, matrix)
    number, point = triangles.nearest(np.array(where, float))
    normal = triangles.normal(number)
    if normal @ np.array(direction, float) > 0:
        normal = -normal  # the side that is seen
    material = _material(thing, materials, int(triangles.slots[number]))
    return _spot(thing, carrier, material, point, normal, _own_axis(matrix, normal), **how)


def at_empty(thing: Any, empty: Any, **how: Any) -> Spot:
    """Put the instrument where an empty's z axis meets the object, nearest to the empty.

    It stands on the side that the axis points to, and its azimuth 0 is the empty's x axis.

    Raises
    ------
    MaterialError
        If the axis does not meet the object, or the object cannot be measured.
    """
    refuse(thing)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    triangles, materials = surface(thing, depsgraph)
    matrix = np.array(empty.evaluated_get(depsgraph).matrix_world)
    origin, up = matrix[:3, 3], matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])
    numbers, far = triangles.met(origin, up)
    if not len(numbers):
        msg = (
            f"The z axis of {empty.name!r} does not meet object {thing.name!r}; turn the empty so "
            "that its z axis points away from the surface."
        )
        raise MaterialError(msg)
    first = int(np.argmin(np.abs(far)))
    number, point = int(numbers[first]), origin + far[first] * up
    normal = triangles.normal(number)
    if normal @ up < 0:
        normal = -normal
    material = _material(thing, materials, int(triangles.slots[number]))
    return _spot(thing, thing, material, point, normal, tuple(matrix[:3, 0].tolist()), **how)


def at_group(thing: Any, group: str, **how: Any) -> Spot:
    """Put the instrument on the middle of a vertex group, by its weights.

    Raises
    ------
    MaterialError
        If there is no such group, it is empty, or the object cannot be measured.
    """
    refuse(thing)
    if group not in thing.vertex_groups:
        names = ", ".join(each.name for each in thing.vertex_groups) or "none"
        msg = f"Object {thing.name!r} has no vertex group {group!r}; it has {names}."
        raise MaterialError(msg)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    triangles, materials = surface(thing, depsgraph, group=group)
    weighted = triangles.only(triangles.weights.sum(axis=1) > 0)
    if not len(weighted):
        msg = f"Vertex group {group!r} of object {thing.name!r} holds no face; assign some to it."
        raise MaterialError(msg)
    return _in_middle(thing, weighted, materials, **how)


def on_materials(thing: Any, **how: Any) -> list[Spot]:
    """Put the instrument on the middle of each material's faces: one spot a material.

    Raises
    ------
    MaterialError
        If no face has a material, or the object cannot be measured.
    """
    refuse(thing)
    triangles, materials = surface(thing, bpy.context.evaluated_depsgraph_get())
    found, seen = [], set()
    for slot in np.unique(triangles.slots).tolist():
        material = materials[slot] if slot < len(materials) else None
        if material is not None and material not in seen:
            seen.add(material)
            alike = [i for i, each in enumerate(materials) if each == material]
            part = triangles.only(np.isin(triangles.slots, alike))
            found.append(_in_middle(thing, part, materials, **how))
    if not found:
        msg = f"Object {thing.name!r} has no material; give it one first."
        raise MaterialError(msg)
    return found


def refuse(thing: Any) -> None:
    """Refuse what has no surface that an instrument could stand on.

    Raises
    ------
    MaterialError
        Saying what it is.
    """
    if thing.type not in SURFACES:
        kind = thing.bl_rna.properties["type"].enum_items[thing.type].name.lower()
        msg = f"Object {thing.name!r} is a {kind}, and has no surface to measure; choose a mesh."
        raise MaterialError(msg)
    own = getattr(getattr(thing, "cycles", None), "use_adaptive_subdivision", False)
    experimental = getattr(bpy.context.scene.cycles, "feature_set", "") == "EXPERIMENTAL"
    by_modifier = any(
        getattr(modifier, "use_adaptive_subdivision", False) and modifier.show_render
        for modifier in thing.modifiers
    )
    if by_modifier or (own and experimental):
        msg = (
            f"Adaptive subdivision makes the surface of {thing.name!r} anew for every camera; use "
            "a fixed number of levels to measure it."
        )
        raise MaterialError(msg)


def surface(
    thing: Any, depsgraph: Any, matrix: Any = None, group: str = ""
) -> tuple[Triangles, list[Any]]:
    """Take the surface of an object as the viewport has it, and the materials of its slots.

    Parameters
    ----------
    thing
        Of one of the types in `SURFACES`.
    depsgraph
        Where it is evaluated.
    matrix
        Its place in the scene, if not the object's own.
    group
        Vertex group whose weights are taken.

    Raises
    ------
    MaterialError
        If it has no face.
    """
    if thing.mode == "EDIT":
        thing.update_from_editmode()
    evaluated = thing.evaluated_get(depsgraph)
    to_scene = np.array(evaluated.matrix_world if matrix is None else matrix, float)
    materials = [
        None if slot.material is None else slot.material.original
        for slot in evaluated.material_slots
    ]
    mesh = evaluated.to_mesh()
    try:
        mesh.calc_loop_triangles()
        count = len(mesh.loop_triangles)
        if not count:
            raise MaterialError(f"Object {thing.name!r} has no face to measure; choose another.")
        places = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", places)
        flat_corners = np.empty(3 * count, np.int32)
        mesh.loop_triangles.foreach_get("vertices", flat_corners)
        slots = np.empty(count, np.int32)
        mesh.loop_triangles.foreach_get("material_index", slots)
        weights = np.ones(len(mesh.vertices))
        if group:
            weights = _weights(mesh, thing.vertex_groups[group].index)
    finally:
        evaluated.to_mesh_clear()
    points = places.reshape(-1, 3) @ to_scene[:3, :3].T + to_scene[:3, 3]
    corners = flat_corners.reshape(-1, 3)
    is_mirrored = bool(np.linalg.det(to_scene[:3, :3]) < 0)
    return Triangles(points[corners], slots, weights[corners], is_mirrored), materials


def _weights(mesh: Any, index: int) -> Array:
    """Weights of a vertex group, shape (vertices,)."""
    found = np.zeros(len(mesh.vertices))
    for vertex in mesh.vertices:
        for each in vertex.groups:
            if each.group == index:
                found[vertex.index] = each.weight
    return found


def _in_middle(thing: Any, part: Triangles, materials: list[Any], **how: Any) -> Spot:
    number, point = part.nearest(part.middle())
    material = _material(thing, materials, int(part.slots[number]))
    matrix = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world
    normal = part.normal(number)
    return _spot(thing, thing, material, point, normal, _own_axis(matrix, normal), **how)


def _material(thing: Any, materials: list[Any], slot: int) -> Any:
    found = materials[min(slot, len(materials) - 1)] if materials else None
    if found is None:
        msg = f"Object {thing.name!r} has no material there; give it one first."
        raise MaterialError(msg)
    return found


def _own_axis(matrix: Any, normal: Array) -> Triple:
    """Give the object's x axis, or its y axis where that stands on the surface."""
    axes = np.array(matrix, float)[:3, :3]
    axes = axes / np.maximum(np.linalg.norm(axes, axis=0), 1e-300)
    x, y, z = axes[:, 1 if abs(axes[:, 0] @ normal) > math.cos(math.radians(30)) else 0].tolist()
    return x, y, z


def _carrier(depsgraph: Any, thing: Any, matrix: Any) -> Any:
    """Find the object whose instance stands at this matrix; the object itself if none does."""
    if np.allclose(thing.evaluated_get(depsgraph).matrix_world, matrix, atol=1e-6):
        return thing
    for instance in depsgraph.object_instances:
        if (
            instance.is_instance
            and instance.object.original == thing
            and np.allclose(instance.matrix_world, matrix, atol=1e-6)
        ):
            return instance.parent.original
    return thing


def _spot(
    thing: Any,
    carrier: Any,
    material: Any,
    point: Array,
    normal: Array,
    toward: Triple,
    diameter: float = SPOT_DIAMETER,
    is_alone: bool = True,
) -> Spot:
    if not 0 < diameter < math.inf:
        raise DomainError(f"The spot's diameter is {diameter:g} mm; give more than 0.")
    if not normal.any():
        msg = f"The face of {thing.name!r} has no area there; choose another place."
        raise MaterialError(msg)
    where, up = (tuple(float(x) for x in values) for values in (point, normal))
    return Spot(key(thing), key(carrier), material, where, up, toward, diameter, is_alone)  # type: ignore[arg-type]


def key(block: Any) -> Key:
    """Tell a datablock from all others, in the second Blender, too."""
    if block.library is None:
        return block.name, None
    # That one's path has no "..": Blender writes it so.
    return block.name, os.path.normpath(bpy.path.abspath(block.library.filepath))
