# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a material a measurement does not see as the user does, said in sentences.

A flat sample has neither the attributes nor the shape of an object; on an object itself only what
follows the camera, or is not in the file that the second Blender opens, is seen otherwise. Nodes
that reach no output of the material do not count.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..blender.surface import output_node

FLAT_MAP = "UVMap"
"""The one UV map of a flat sample."""
INSTEAD = "Measure Here, or bake --object, reads the object"
"""What to do where a flat sample is not what the object shows."""
_BY_CAMERA = {
    "ShaderNodeCameraData": ("View Vector", "View Z Depth", "View Distance"),
    "ShaderNodeTexCoord": ("Camera", "Window"),
}
"""Nodes whose outputs follow the camera."""
_BY_OBJECT: dict[str, tuple[str, ...] | None] = {
    "ShaderNodeAmbientOcclusion": None,
    "ShaderNodeBevel": None,
    "ShaderNodeHairInfo": None,
    "ShaderNodeNewGeometry": (
        *("Position", "Normal", "True Normal", "Pointiness"),
        *("Random Per Island", "Parametric"),
    ),
    "ShaderNodeObjectInfo": ("Location", "Color", "Alpha", "Object Index", "Random"),
    "ShaderNodeParticleInfo": None,
    "ShaderNodePointInfo": None,
    "ShaderNodeRaycast": None,
    "ShaderNodeTangent": None,
    "ShaderNodeTexCoord": ("Generated", "Normal", "Object"),
    "ShaderNodeWireframe": None,
}
"""Nodes whose outputs follow the shape or the place of the object; None stands for all of them."""
_GENERATED = {
    f"ShaderNodeTex{name}"
    for name in ("Brick", "Checker", "Gabor", "Gradient", "Magic", "Noise", "Voronoi", "Wave")
}
"""Textures that go by Generated coordinates where nothing else is linked."""

_OWN = "a flat sample has its own {}"

_Used = tuple[Any, tuple[str, ...]]
"""A node, and which of its outputs the surface depends on."""


def on_objects(material: Any) -> list[str]:
    """Say what is not read right wherever the instrument stands; nothing for most materials."""
    found: dict[str, None] = {}
    for node, outputs in _used(material):
        image = getattr(node, "image", None)
        if image is not None and image.is_dirty:
            found[f"image {image.name!r} has changes that are not saved, and are not read"] = None
        if set(outputs) & set(_BY_CAMERA.get(node.bl_idname, ())):
            text = f"material {material.name!r} follows the camera ({node.name})"
            found[f"{text}, and the instrument's is another"] = None
        if node.bl_idname == "ShaderNodeScript":
            found[f"material {material.name!r} has a script, which is not run"] = None
    return list(found)


def on_flat_samples(material: Any) -> list[str]:
    """Say what of a material a flat sample does not show right; nothing for most materials."""
    lacks: dict[str, list[str]] = {}
    for node, outputs in _used(material):
        for sentence in _of_node(node, outputs):
            lacks.setdefault(sentence, []).append(node.name)
    output = output_node(material)
    moved = output is not None and output.inputs["Displacement"].is_linked
    if moved and material.displacement_method != "BUMP":
        lacks["a flat sample is not displaced"] = []
    told = []
    for sentence, nodes in lacks.items():
        where = f" ({', '.join(nodes[:3])}{', …' if len(nodes) > 3 else ''})" if nodes else ""
        told.append(f"{sentence}{where}; {INSTEAD}")
    return [*told, *on_objects(material)]


def _of_node(node: Any, outputs: tuple[str, ...]) -> Iterator[str]:
    name = _attribute(node)
    if name and name != FLAT_MAP:
        yield f"a flat sample has no {name!r}"
    image = getattr(node, "image", None)
    if image is not None and image.source == "TILED":
        yield f"a flat sample shows one tile of {image.name!r} alone"
    by_object = _BY_OBJECT.get(node.bl_idname, ())
    for output in outputs:
        if by_object is None or output in by_object:
            yield _OWN.format(output) if by_object else "a flat sample has another shape"
    if node.bl_idname in _GENERATED:
        place = node.inputs["Vector"]
        if place.enabled and not place.is_linked:
            yield _OWN.format("Generated")


def _attribute(node: Any) -> str:
    """Name what a node takes of a mesh or an object; empty if nothing by name."""
    if node.bl_idname == "ShaderNodeVertexColor":
        return str(node.layer_name) or "color attribute"
    if node.bl_idname == "ShaderNodeAttribute" and node.attribute_type != "VIEW_LAYER":
        return str(node.attribute_name)
    return str(getattr(node, "uv_map", ""))


def _used(material: Any) -> list[_Used]:
    """Give the nodes that the output for Cycles depends on, those of groups too."""
    output = output_node(material)
    found: dict[Any, dict[str, None]] = {}
    if output is not None:
        _collect(output, found)
    return [(node, tuple(outputs)) for node, outputs in found.items()]


def _collect(output: Any, found: dict[Any, dict[str, None]]) -> None:
    waiting, seen = [output], {output}
    while waiting:
        for socket in waiting.pop().inputs:
            for link in socket.links if socket.is_linked else ():
                node = link.from_node
                if link.is_muted:
                    continue
                if not node.mute:
                    found.setdefault(node, {})[link.from_socket.name] = None
                if node in seen:
                    continue
                seen.add(node)
                waiting.append(node)
                if node.type == "GROUP" and node.node_tree is not None and not node.mute:
                    inner = [n for n in node.node_tree.nodes if n.type == "GROUP_OUTPUT"]
                    for end in inner:
                        if end not in found:
                            found[end] = {}
                            _collect(end, found)
