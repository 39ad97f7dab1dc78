# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a material a measurement does not see as the user does, said in sentences.

A flat sample has neither the attributes nor the shape of an object; on an object itself only what
follows the camera, or is not in the file that the second Blender opens, is seen otherwise.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

FLAT_MAP = "UVMap"
"""The one UV map of a flat sample."""
_BY_CAMERA = {
    "ShaderNodeCameraData": ("View Vector", "View Z Depth", "View Distance"),
    "ShaderNodeTexCoord": ("Camera", "Window"),
}
"""Nodes whose outputs follow the camera."""
_ON_OBJECT = "measure it on its object"


def on_objects(material: Any) -> list[str]:
    """Say what is not read right wherever the instrument stands; nothing for most materials."""
    found: dict[str, None] = {}
    for node in _nodes(material.node_tree, set()):
        image = getattr(node, "image", None)
        if image is not None and image.is_dirty:
            found[f"image {image.name!r} has changes that are not saved, and are not read"] = None
        outputs = _BY_CAMERA.get(node.bl_idname, ())
        if any(output.is_linked and output.name in outputs for output in node.outputs):
            text = f"material {material.name!r} follows the camera ({node.name})"
            found[f"{text}, and the instrument's is another"] = None
        if node.bl_idname == "ShaderNodeScript":
            found[f"material {material.name!r} has a script, which is not run"] = None
    return list(found)


def on_flat_samples(material: Any) -> list[str]:
    """Say what a flat sample of a material lacks; nothing for most materials."""
    found: dict[str, None] = {}
    for node in _nodes(material.node_tree, set()):
        name = _attribute(node)
        if name and name != FLAT_MAP and any(output.is_linked for output in node.outputs):
            found[f"a flat sample has no {name!r} ({node.name}); {_ON_OBJECT}"] = None
        image = getattr(node, "image", None)
        if image is not None and image.source == "TILED":
            found[f"a flat sample shows one tile of {image.name!r} alone; {_ON_OBJECT}"] = None
        if node.bl_idname == "ShaderNodeOutputMaterial" and node.is_active_output:
            is_moved = material.displacement_method != "BUMP"
            if is_moved and node.inputs["Displacement"].is_linked:
                found[f"a flat sample is not displaced; {_ON_OBJECT}"] = None
    return list(found)


def _attribute(node: Any) -> str:
    """Name what a node takes of a mesh or an object; empty if nothing by name."""
    if node.bl_idname == "ShaderNodeVertexColor":
        return str(node.layer_name) or "color attribute"
    if node.bl_idname == "ShaderNodeAttribute" and node.attribute_type != "VIEW_LAYER":
        return str(node.attribute_name)
    return str(getattr(node, "uv_map", ""))


def _nodes(tree: Any, seen: set[Any]) -> Iterator[Any]:
    """Give the nodes of a tree and of the groups in it."""
    if tree is None or tree in seen:
        return
    seen.add(tree)
    for node in tree.nodes:
        yield node
        if node.type == "GROUP":
            yield from _nodes(node.node_tree, seen)
