# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The evaluated scene's surfaces as triangles that rays can be sent at."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from mathutils.bvhtree import BVHTree

from ...core.numerics.arrays import Array
from . import dense_meshes
from .dense_meshes import Heavy
from .lamps import FAR
from .visibility import Rendered

_OTHER_SURFACES = {"CURVE", "SURFACE", "META", "FONT"}
_CLEAR_SHADERS = {
    "ShaderNodeBsdfGlass",
    "ShaderNodeBsdfRefraction",
    "ShaderNodeBsdfTransparent",
    "ShaderNodeHoldout",
}


@dataclass(frozen=True)
class _Mesh:
    """Arrays of one evaluated mesh; shared by all that show it."""

    points: Array
    corners: Array
    slots: Array
    normals: Array


@dataclass
class _Shown:
    """One appearance of a mesh in the scene.

    `seen`: by the camera; `blocks`: casts shadows; `sheds`: what it emits lights diffuse surfaces.
    """

    mesh: _Mesh
    matrix: Array
    materials: list[Any]
    name: str
    seen: bool
    blocks: bool
    sheds: bool
    start: int = 0


@dataclass(frozen=True)
class Hits:
    """Where rays met surfaces; arrays over the rays that did.

    Parameters
    ----------
    ray
        Index of the ray.
    points, normals, facing
        World space: where, the shading normal, and the triangle's own normal, both turned
        towards where the ray came from. Shape (hits, 3).
    materials
        Index into `Surfaces.materials`, -1 for none. Shape (hits,).
    objects
        Index into `Surfaces.objects`.
    """

    ray: Array
    points: Array
    normals: Array
    facing: Array
    materials: Array
    objects: Array


@dataclass
class Surfaces:
    """All surfaces of a scene.

    Parameters
    ----------
    materials
        Original materials, each once.
    objects
        Names of the objects, one an appearance.
    """

    materials: list[Any] = field(default_factory=list)
    objects: list[str] = field(default_factory=list)
    _shown: list[_Shown] = field(default_factory=list)
    _starts: Array = field(default_factory=lambda: np.zeros(0, int))
    _points: Array = field(default_factory=lambda: np.zeros((0, 3)))
    _triangles: Array = field(default_factory=lambda: np.zeros((0, 3), int))
    _material_of: Array = field(default_factory=lambda: np.zeros(0, int))
    _seen: tuple[Any, Array | None] = (None, None)
    _blocking: tuple[Any, Array | None] = (None, None)
    _heavy: list[Heavy] = field(default_factory=list)
    _heavy_slots: list[Array] = field(default_factory=list)

    @property
    def scale(self) -> float:
        """Diagonal of all there is."""
        widths = [2 * thing.radius for thing in self._heavy]
        if len(self._points):
            widths.append(float(np.linalg.norm(np.ptp(self._points, axis=0))))
        return max(widths, default=1.0)

    def shedding(self, index: int) -> Array:
        """Give the triangles (n, 3, 3) of a material that light diffuse surfaces if it emits."""
        mine = np.flatnonzero(self._material_of == index)
        owners = np.searchsorted(self._starts, mine, side="right") - 1
        sheds = np.array([shown.sheds for shown in self._shown], bool)
        return np.asarray(self._points[self._triangles[mine[sheds[owners]]]])

    def hit(self, origins: Array, directions: Array) -> Hits:
        """Send rays, each of shape (rays, 3), at what a camera sees."""
        tree, kept = self._seen
        found = []
        if tree is not None:
            cast = tree.ray_cast
            rays = zip(origins.tolist(), directions.tolist(), strict=True)
            for number, (origin, way) in enumerate(rays):
                point, _, triangle, _ = cast(origin, way)
                if triangle is not None:
                    found.append((number, triangle, *point))
        table = np.array(found, np.float64).reshape(-1, 5)
        ray, triangles = table[:, 0].astype(int), table[:, 1].astype(int)
        if kept is not None:
            triangles = kept[triangles]
        parts = [self._describe(ray, triangles, table[:, 2:], directions[ray])]
        reach = np.full(len(origins), FAR)
        reach[ray] = np.linalg.norm(table[:, 2:] - origins[ray], axis=1)
        for number, thing in enumerate(self._heavy):
            if thing.seen:
                parts.append(self._hit_heavy(number, origins, directions, reach))
        return _nearest(parts)

    def _hit_heavy(self, number: int, origins: Array, directions: Array, reach: Array) -> Hits:
        """Send rays at one heavy object, and shorten the reach of those that hit it."""
        thing, slots = self._heavy[number], self._heavy_slots[number]
        ray, distance, points, normals, faces = thing.cast(origins, directions, reach)
        reach[ray] = distance
        normals *= -np.sign(np.einsum("ij,ij->i", normals, directions[ray]))[:, np.newaxis]
        of_face = np.zeros(len(faces), int) if thing.slots is None else thing.slots[faces]
        materials = slots[np.minimum(of_face, len(slots) - 1)]
        owners = np.full(len(ray), len(self._shown) + number)
        return Hits(ray, points, normals, normals, materials, owners)

    def blocked(self, origins: Array, toward: Array, distance: Array) -> Array:
        """Tell which of the ways, from points of shape (n, 3), meet something; shape (n,)."""
        hidden = self._blocked_by_light(origins, toward, distance)
        for thing in self._heavy:
            if thing.blocks:
                open_ = np.flatnonzero(~hidden)
                met, *_ = thing.cast(origins[open_], toward[open_], distance[open_])
                hidden[open_[met]] = True
        return hidden

    def _blocked_by_light(self, origins: Array, toward: Array, distance: Array) -> Array:
        tree, _ = self._blocking
        if tree is None:
            return np.zeros(len(origins), bool)
        cast = tree.ray_cast
        rays = zip(origins.tolist(), toward.tolist(), distance.tolist(), strict=True)
        return np.array([cast(origin, way, far)[2] is not None for origin, way, far in rays], bool)

    def _describe(self, ray: Array, triangle: Array, points: Array, ways: Array) -> Hits:
        corners = self._points[self._triangles[triangle]]
        facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        facing /= np.maximum(np.linalg.norm(facing, axis=1, keepdims=True), 1e-30)
        owners = np.searchsorted(self._starts, triangle, side="right") - 1
        normals = facing.copy()
        shares = _barycentric(points, corners)
        for owner in np.unique(owners):
            mine = np.flatnonzero(owners == owner)
            shown = self._shown[owner]
            own = shown.mesh.normals[triangle[mine] - shown.start].astype(np.float64)
            smooth = np.einsum("ij,ijk->ik", shares[mine], own)
            # Normals go with the inverse transpose: row vectors times the inverse.
            normals[mine] = smooth @ np.linalg.pinv(shown.matrix[:3, :3])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        facing *= -np.sign(np.einsum("ij,ij->i", facing, ways))[:, np.newaxis]
        normals *= np.sign(np.einsum("ij,ij->i", normals, facing))[:, np.newaxis]
        return Hits(ray, points, normals, facing, self._material_of[triangle], owners)


def gather(depsgraph: Any) -> Surfaces:
    """Collect what is rendered of an evaluated scene.

    What light passes through (glass, transparent shaders) and what casts no shadow or is not
    seen by the camera is left out where that matters.
    """
    found = Surfaces()
    rendered = Rendered(depsgraph.view_layer)
    meshes: dict[int, _Mesh | None] = {}
    trees: dict[int, Any] = {}
    for instance in depsgraph.object_instances:
        thing = instance.object
        if thing.type != "MESH" and thing.type not in _OTHER_SURFACES:
            continue
        if not rendered.shows(instance):
            continue
        key = thing.data.as_pointer() if thing.type == "MESH" else thing.as_pointer()
        if dense_meshes.is_heavy(thing) and not any(map(_acts_on_light, _materials(thing))):
            if key not in trees:
                trees[key] = dense_meshes.grow(thing, depsgraph)
            matrix = np.array(instance.matrix_world)
            found._heavy.append(dense_meshes.read(thing, matrix, _materials(thing), trees[key]))
            continue
        if key not in meshes:
            meshes[key] = _read(thing)
        mesh = meshes[key]
        if mesh is None:
            continue
        found._shown.append(
            _Shown(
                mesh,
                np.array(instance.matrix_world),
                _materials(thing),
                thing.original.name,
                bool(thing.visible_camera),
                bool(thing.visible_shadow),
                bool(thing.visible_diffuse),
            )
        )
    _assemble(found)
    return found


def _read(thing: Any) -> _Mesh | None:
    mesh = thing.data if thing.type == "MESH" else thing.to_mesh()
    if mesh is None or not len(mesh.polygons):
        return None
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    points = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", points.ravel())
    corners, loops = np.empty((2, count, 3), np.int32)
    mesh.loop_triangles.foreach_get("vertices", corners.ravel())
    mesh.loop_triangles.foreach_get("loops", loops.ravel())
    slots = np.empty(count, np.int32)
    mesh.loop_triangles.foreach_get("material_index", slots)
    vectors = np.empty((len(mesh.loops), 3), np.float32)
    mesh.corner_normals.foreach_get("vector", vectors.ravel())
    found = _Mesh(points, corners, slots, vectors[loops])
    if thing.type != "MESH":
        thing.to_mesh_clear()
    return found


def _materials(thing: Any) -> list[Any]:
    slots = [slot.material for slot in thing.material_slots]
    own = list(getattr(thing.data, "materials", ()))
    # Geometry nodes may bring materials that no slot of the object names.
    named = slots + own[len(slots) :]
    return [None if material is None else material.original for material in named]


def _assemble(found: Surfaces) -> None:
    points, triangles, materials, seen, blocking, starts = [], [], [], [], [], []
    index: dict[Any, int] = {}
    clear: dict[int, bool] = {-1: False}
    offset = start = 0
    for shown in found._shown:
        shown.start = start
        starts.append(start)
        mesh = shown.mesh
        points.append(mesh.points @ shown.matrix[:3, :3].T + shown.matrix[:3, 3])
        triangles.append(mesh.corners + offset)
        numbers = []
        for material in shown.materials or [None]:
            number = -1 if material is None else index.setdefault(material, len(index))
            if number not in clear:
                clear[number] = _is_clear(material)
            numbers.append(number)
        of_slot = np.array(numbers)[np.minimum(mesh.slots, len(numbers) - 1)]
        materials.append(of_slot)
        opaque = ~np.array([clear[number] for number in numbers])
        passing = opaque[np.minimum(mesh.slots, len(numbers) - 1)]
        seen.append(passing & shown.seen)
        blocking.append(passing & shown.blocks)
        offset += len(mesh.points)
        start += len(mesh.corners)
    for thing in found._heavy:
        numbers = [
            -1 if material is None else index.setdefault(material, len(index))
            for material in thing.materials or [None]
        ]
        found._heavy_slots.append(np.array(numbers))
    found.materials = list(index)
    found.objects = [shown.name for shown in found._shown] + [big.name for big in found._heavy]
    if not triangles:
        return
    found._points = np.concatenate(points).astype(np.float64)
    found._triangles = np.concatenate(triangles)
    found._material_of = np.concatenate(materials)
    found._starts = np.array(starts)
    at = found._points.tolist()
    camera, shadow = np.concatenate(seen), np.concatenate(blocking)
    found._seen = _tree(at, found._triangles, camera)
    same = np.array_equal(camera, shadow)
    found._blocking = found._seen if same else _tree(at, found._triangles, shadow)


def _tree(points: list[Any], triangles: Array, kept: Array) -> tuple[Any, Array | None]:
    places = None if kept.all() else np.flatnonzero(kept)
    chosen = triangles if places is None else triangles[places]
    if not len(chosen):
        return None, None
    return BVHTree.FromPolygons(points, chosen.tolist(), all_triangles=True), places


def _acts_on_light(material: Any) -> bool:
    """Whether the material may emit or let light pass, so that its faces have to be known."""
    if material is None or material.node_tree is None:
        return False
    emits = any(
        node.bl_idname == "ShaderNodeEmission"
        or (
            node.bl_idname == "ShaderNodeBsdfPrincipled"
            and node.inputs["Emission Strength"].default_value > 0
        )
        for node in material.node_tree.nodes
    )
    return emits or _is_clear(material)


def _nearest(parts: list[Hits]) -> Hits:
    """Keep of each ray its last hit; each part only has hits nearer than those before."""
    joined = [
        np.concatenate(arrays) for arrays in zip(*(vars(p).values() for p in parts), strict=True)
    ]
    _, last = np.unique(joined[0][::-1], return_index=True)
    kept = len(joined[0]) - 1 - last
    return Hits(*(array[kept] for array in joined))


def _is_clear(material: Any) -> bool:
    """Whether light passes through the material, so that it neither hides nor shades."""
    if material.node_tree is None:
        return False
    output = material.node_tree.get_output_node("CYCLES")
    links = output.inputs["Surface"].links if output is not None else ()
    if not links:
        return output is not None and output.inputs["Volume"].is_linked
    node = links[0].from_node
    if node.bl_idname == "ShaderNodeBsdfPrincipled":
        transmission, alpha = (node.inputs[name] for name in ("Transmission Weight", "Alpha"))
        lets = not transmission.is_linked and transmission.default_value > 0.5
        return lets or (not alpha.is_linked and alpha.default_value < 0.5)
    return node.bl_idname in _CLEAR_SHADERS


def _barycentric(points: Array, corners: Array) -> Array:
    """Shares of three corners in points of triangles, shape (points, 3)."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    way = points - corners[:, 0]
    aa, ab, bb = (
        np.einsum("ij,ij->i", *pair) for pair in ((first, first), (first, second), (second, second))
    )
    wa, wb = np.einsum("ij,ij->i", way, first), np.einsum("ij,ij->i", way, second)
    area = np.maximum(aa * bb - ab * ab, 1e-30)
    u, v = (bb * wa - ab * wb) / area, (aa * wb - ab * wa) / area
    shares = np.clip(np.stack((1 - u - v, u, v), axis=-1), 0, 1)
    return np.asarray(shares / shares.sum(axis=1, keepdims=True))


__all__ = ["FAR", "Hits", "Surfaces", "gather"]
