# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where in a texture the objects of the file that show a material look, and how much of it where.

A part of a texture counts by how often the UVs of all these objects cover it: an atlas's empty
corners not at all, and what is repeated as often as it is. Objects count as they are evaluated,
with their modifiers.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import bpy

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array

ACTIVE = ""
"""Stands for the UV map of each object that renders use unless a node names another."""
_MOST_MAPS = 7
"""Besides the active one: Blender has 8."""
_STEPS = (0.7548776662466927, 0.5698402909980532)
"""Of the plane's most even additive sequence: powers of the root of x³ = x + 1."""


def places(material: Any, count: int) -> dict[str, Array] | None:
    """Give places in the UV maps of a material, each of the same share of what is covered.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    count
        Of places.

    Returns
    -------
    UV coordinates, (count, 2), by the name of the map: `ACTIVE`, and those of the objects. None
    where no object shows the material by UVs.
    """
    import numpy as np

    parts = list(_triangles(material))
    corners = {ACTIVE: np.concatenate([part[ACTIVE] for part in parts])} if parts else {}
    if not parts:
        return None
    names = list(dict.fromkeys(name for part in parts for name in part if name != ACTIVE))
    for name in names[:_MOST_MAPS]:
        known = [part.get(name, np.zeros_like(part[ACTIVE])) for part in parts]
        corners[name] = np.concatenate(known)
    first, second, third = np.moveaxis(corners[ACTIVE], 1, 0)
    (ax, ay), (bx, by) = (second - first).T, (third - first).T
    edges = np.cumsum(np.abs(ax * by - ay * bx))
    if not (np.isfinite(edges[-1]) and edges[-1] > 0):
        return None
    number = np.arange(count)
    # Equal shares of the whole area, each in its triangle; there as even as can be.
    within = np.searchsorted(edges, (number + 0.5) / count * edges[-1], side="right")
    within = np.minimum(within, len(edges) - 1)
    u, v = ((0.5 + number * step) % 1.0 for step in _STEPS)
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    shares = np.stack([1 - u - v, u, v], axis=-1)[..., np.newaxis]
    return {name: (found[within] * shares).sum(axis=1) for name, found in corners.items()}


def _triangles(material: Any) -> Iterator[dict[str, Array]]:
    """Give UV coordinates, (triangles, 3, 2), of each object's triangles with a material."""
    import numpy as np

    depsgraph = None
    for thing in bpy.data.objects:
        if thing.type != "MESH" or not any(s.material == material for s in thing.material_slots):
            continue
        if thing.mode == "EDIT":
            thing.update_from_editmode()
        depsgraph = depsgraph or bpy.context.evaluated_depsgraph_get()
        shown = thing.evaluated_get(depsgraph)
        mesh = shown.data
        slots = [getattr(s.material, "original", None) for s in shown.material_slots]
        if material not in slots or not len(mesh.uv_layers) or not len(mesh.loop_triangles):
            continue
        of_slot = np.array([found == material for found in slots])
        index, loops = np.empty(len(mesh.loop_triangles), np.int32), None
        mesh.loop_triangles.foreach_get("material_index", index)
        loops = np.empty(3 * len(index), np.int32)
        mesh.loop_triangles.foreach_get("loops", loops)
        mine = loops.reshape(-1, 3)[of_slot[np.clip(index, 0, len(slots) - 1)]]
        if not len(mine):
            continue
        found, active = {}, None
        for layer in mesh.uv_layers:
            values = np.empty(2 * len(mesh.loops), np.float32)
            layer.uv.foreach_get("vector", values)
            found[layer.name] = values.reshape(-1, 2)[mine].astype(np.float64)
            active = layer.name if layer.active_render or active is None else active
        yield {ACTIVE: found[active], **found}
