# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a material is still as Blender makes a new one, by its name too: nobody chose it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import bpy
from bpy.app.translations import pgettext_data as data_

from .surface import shader_node, uses_nodes

_NODES = ["BSDF_PRINCIPLED", "OUTPUT_MATERIAL"]
_OTHER_IOR = 1.45
"""That of the cube with which Blender 4.5 begins, where a new node has another."""
_SAME = 1e-5
_NUMBER = re.compile(r"\.\d{3,}$")


def among(materials: Sequence[Any]) -> list[Any]:
    """Give those materials that are as Blender makes them."""
    likely = [material for material in materials if _may_be(material)]
    if not likely:
        return []
    template = bpy.data.materials.new("Material")
    try:
        if not uses_nodes(template):
            template.use_nodes = True
        new = _values(shader_node(template))
        return [material for material in likely if _alike(_values(shader_node(material)), new)]
    finally:
        bpy.data.materials.remove(template)


def without_number(name: str) -> str:
    """Leave out what Blender puts behind a name that is taken.

    Examples
    --------
    >>> without_number("Brick.001"), without_number("Brick No. 1")
    ('Brick', 'Brick No. 1')
    """
    return _NUMBER.sub("", name)


def _may_be(material: Any) -> bool:
    if without_number(material.name) not in {"Material", data_("Material")}:
        return False
    if not material.is_editable or material.override_library is not None:
        return False
    if material.use_fake_user or material.asset_data is not None or not uses_nodes(material):
        return False
    tree = material.node_tree
    if material.animation_data is not None or tree.animation_data is not None:
        return False
    if sorted(node.type for node in tree.nodes) != _NODES or len(tree.links) != 1:
        return False
    node = shader_node(material)
    return node is not None and node.type == _NODES[0] and not node.mute


def _values(node: Any) -> dict[str, tuple[float, ...]]:
    found = {}
    for socket in node.inputs:
        value: Any = getattr(socket, "default_value", 0.0)
        found[socket.identifier] = tuple(value) if hasattr(value, "__len__") else (float(value),)
    return found


def _alike(one: dict[str, tuple[float, ...]], new: dict[str, tuple[float, ...]]) -> bool:
    return one.keys() == new.keys() and all(
        all(abs(a - b) < _SAME for a, b in zip(values, new[name], strict=True))
        or (name == "IOR" and abs(values[0] - _OTHER_IOR) < _SAME)
        for name, values in one.items()
    )
