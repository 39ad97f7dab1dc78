# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A digest of all that a render of a material follows from: nodes, their values and their links.

Two machines that bake parts of one file have to render the same. What pictures hold is not
looked at, only which ones are used.
"""

from __future__ import annotations

import hashlib
from typing import Any

import bpy

from ...core.numerics.memoized import memoized

_OF_SOCKETS = "default_value"
_LEFT_OUT = {"rna_type", "color_mapping", "use_auto_update", "bytecode"}
"""What Cycles does not look at."""


def digest(material: Any) -> str:
    """Give the digest; names and places of nodes, which no render shows, do not count."""
    told = (material.pass_index, tuple(material.diffuse_color), _tree(material.node_tree, ()))
    return hashlib.sha256(repr(told).encode()).hexdigest()[:16]


def _tree(tree: Any, around: tuple[Any, ...]) -> Any:
    if tree is None or tree in around:
        return None
    number = {node: i for i, node in enumerate(tree.nodes)}
    nodes = [_node(node, (*around, tree)) for node in tree.nodes]
    links = [
        (
            *(number[link.from_node], link.from_socket.identifier),
            *(number[link.to_node], link.to_socket.identifier, link.is_muted),
        )
        for link in tree.links
    ]
    return nodes, links


def _node(node: Any, around: tuple[Any, ...]) -> Any:
    sockets = [
        (socket.identifier, _plain(getattr(socket, _OF_SOCKETS)))
        for socket in (*node.inputs, *node.outputs)
        if hasattr(socket, _OF_SOCKETS)
    ]
    return node.bl_idname, node.mute, sockets, _properties(node, around)


def _properties(thing: Any, around: tuple[Any, ...]) -> Any:
    return [
        (name, _told(getattr(thing, name), around))
        for name in _names(type(thing).bl_rna.identifier)
    ]


@memoized(maxsize=1024)
def _names(kind: str) -> tuple[str, ...]:
    """Properties of what nodes hold, or of a kind of node: those that not every node has."""
    asked, left_out = getattr(bpy.types, kind), set(_LEFT_OUT)
    if issubclass(asked, bpy.types.Node):
        left_out |= {prop.identifier for prop in bpy.types.Node.bl_rna.properties}
    names = (prop.identifier for prop in asked.bl_rna.properties)
    return tuple(name for name in names if name not in left_out)


def _told(value: Any, around: tuple[Any, ...]) -> Any:
    if isinstance(value, bpy.types.NodeTree):
        return _tree(value, around)
    if isinstance(value, bpy.types.Node):
        return value.name
    if isinstance(value, bpy.types.ID):
        library = "" if value.library is None else value.library.filepath
        return value.bl_rna.identifier, value.name, library, getattr(value, "filepath", "")
    if isinstance(value, bpy.types.bpy_prop_collection):
        return [_properties(item, around) for item in value]
    if isinstance(value, bpy.types.bpy_struct):
        return _properties(value, around)
    return _plain(value)


def _plain(value: Any) -> Any:
    """Numbers and texts as they are, and what holds several of them as a tuple."""
    if isinstance(value, (str, bytes, int, float, type(None))):
        return value
    if isinstance(value, (set, frozenset)):
        return sorted(value)
    if isinstance(value, bpy.types.ID):
        return value.bl_rna.identifier, value.name
    return tuple(_plain(part) for part in value)
