# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of so many faces that reading them would take seconds: rays meet them one by one.

Blender builds the tree of one object itself, five times faster than from numbers; in exchange each
ray asks each such object, and their normals are those of the faces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from mathutils.bvhtree import BVHTree

from ...core.numerics.arrays import Array

TRIANGLES = 60_000
"""Triangles of an object from which on it counts as heavy."""


@dataclass(frozen=True)
class Heavy:
    """One appearance of a heavy object.

    Parameters
    ----------
    tree
        In the object's own space.
    matrix
        To world space, shape (4, 4).
    slots
        Material slot of each face, or None where all are of the first.
    materials
        Materials of the slots.
    name
        Of the object.
    seen, blocks
        Whether the camera sees it, and whether it casts shadows.
    center, radius
        Ball around it.
    """

    tree: Any
    matrix: Array
    slots: Array | None
    materials: list[Any]
    name: str
    seen: bool
    blocks: bool
    center: Array
    radius: float

    def cast(
        self, origins: Array, ways: Array, limits: Array
    ) -> tuple[Array, Array, Array, Array, Array]:
        """Send rays of at most some length.

        Returns
        -------
        ray, distance, points, normals, faces
            Of those that hit; the first and last are indices.
        """
        near = np.flatnonzero(self._near(origins, ways, limits))
        inverse = np.linalg.inv(self.matrix)
        starts = origins[near] @ inverse[:3, :3].T + inverse[:3, 3]
        local = ways[near] @ inverse[:3, :3].T
        reach = limits[near] * np.linalg.norm(local, axis=1)
        found = []
        rays = zip(near.tolist(), starts.tolist(), local.tolist(), reach.tolist(), strict=True)
        for ray, start, way, far in rays:
            point, normal, face, _ = self.tree.ray_cast(start, way, far)
            if face is not None:
                found.append((ray, face, *point, *normal))
        table = np.array(found, np.float64).reshape(-1, 8)
        ray, face = table[:, 0].astype(int), table[:, 1].astype(int)
        points = table[:, 2:5] @ self.matrix[:3, :3].T + self.matrix[:3, 3]
        normals = table[:, 5:] @ inverse[:3, :3]
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        return ray, np.linalg.norm(points - origins[ray], axis=1), points, normals, face

    def _near(self, origins: Array, ways: Array, limits: Array) -> Array:
        """Whether rays come near the ball around the object."""
        to = self.center - origins
        along = np.clip(np.einsum("ij,ij->i", to, ways), 0, limits)
        missed = np.linalg.norm(to - ways * along[:, np.newaxis], axis=1)
        return np.asarray(missed <= self.radius)


def read(thing: Any, matrix: Array, materials: list[Any], tree: Any) -> Heavy:
    """Read an evaluated mesh object, whose tree `grow` gave."""
    slots = None
    if len(materials) > 1:
        slots = np.empty(len(thing.data.polygons), np.int32)
        thing.data.polygons.foreach_get("material_index", slots)
    box = np.array([list(corner) for corner in thing.bound_box])
    box = box @ matrix[:3, :3].T + matrix[:3, 3]
    center = box.mean(axis=0)
    radius = float(np.linalg.norm(box - center, axis=1).max()) * (1 + 1e-6)
    name, flags = thing.original.name, (bool(thing.visible_camera), bool(thing.visible_shadow))
    return Heavy(tree, matrix, slots, materials, name, *flags, center, radius)


def grow(thing: Any, depsgraph: Any) -> Any:
    """Let Blender build the tree of an evaluated mesh object."""
    return BVHTree.FromObject(thing, depsgraph)


def is_heavy(thing: Any) -> bool:
    """Whether an evaluated object has so many faces, and Blender can build its tree itself."""
    if thing.type != "MESH":
        return False
    mesh = thing.data
    return len(mesh.loops) - 2 * len(mesh.polygons) > TRIANGLES
