# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find, make and write the shader node that a material's surface comes from.

Finding never changes anything, so a whole selection is checked before the first is written.
"""

from __future__ import annotations

from array import array
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import bpy

from ...core.errors import MaterialError
from ...core.gloss import Gloss
from ...core.numerics.memoized import kept
from ..matching import shaders
from . import texture_scale
from .links import comparable, link_to
from .obstacles import MEASURED, curves, is_animated, refuse_unpredictable, texture_of
from .sockets import OF_NODE, OF_SHADER, color_socket, roughness_socket
from .surface import (
    Surface,
    disturbing_sockets,
    gloss_of,
    output_node,
    shader_node,
    surface,
    surface_link,
    uses_nodes,
    written,
)

__all__ = [
    "SocketTarget",
    "Surface",
    "color_socket",
    "comparable",
    "curves",
    "disturbing_sockets",
    "find",
    "gloss_at",
    "gloss_of",
    "new_material",
    "put_gloss",
    "remove_gloss",
    "roughness_socket",
    "set_gloss",
    "set_sockets",
    "shader_node",
    "surface",
    "unscale",
    "write",
    "written",
]

_SET_ASIDE = "rough_spectra_set_aside"
"""Custom property of a node that another one took the place of, with its name then: a copy that
somebody made of it has another name."""
_NODE_DISTANCE = 300.0


@dataclass(frozen=True)
class SocketTarget:
    """Where a material's color goes.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    node_name
        The shader node that is there already, in use or set aside by an earlier change of shader;
        or an empty string where one has to be made.
    make
        Type of the node to link to the output, or an empty string where it is.
    texture
        The socket that a texture reaches, which is to be scaled; None where there is one color.
    """

    material: Any
    node_name: str
    make: str
    texture: Any = None


def find(material: Any, shader: str = shaders.AUTO, keep_gloss: bool = True) -> SocketTarget:
    """Find where the color of a material's surface is set, changing nothing.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    shader
        "AUTO" takes the target shader that is there, or a new Diffuse BSDF where there is none.
        The name of one, such as "PRINCIPLED", asks for that node; where another one is in use it
        takes its place, and the other one stays in the tree. It is the node that an earlier
        change has set aside, if nobody uses that, else a new one.
    keep_gloss
        False where the gloss is to be removed: what decides it then does not count.

    Raises
    ------
    MaterialError
        If the material is linked or read-only, or its surface is made of nodes whose reading
        nobody could predict; the message says what to do.
    DomainError
        If no target shader has this name.
    """
    wanted = OF_SHADER[shaders.find(shader).name].node
    refuse_read_only(material)
    output = output_node(material)
    link = surface_link(output)
    if link is None:
        return _place_for(material, wanted)
    node = link.from_node
    if node.bl_idname not in OF_NODE:
        msg = (
            f"Material {material.name!r}: its surface comes from {node.name!r} "
            f"({node.bl_label}), which Rough Spectra cannot set; link a {shaders.listed()} to the "
            f"material output, or {MEASURED}."
        )
        raise MaterialError(msg)
    if shader != shaders.AUTO and node.bl_idname != wanted:
        return _place_for(material, wanted)
    refuse_unpredictable(material, node, keep_gloss)
    return SocketTarget(material, node.name, "", texture_of(node))


def write(
    place: SocketTarget,
    color: tuple[float, float, float],
    roughness: float,
    palette: texture_scale.Palette | None = None,
) -> str:
    """Set color and roughness at a place that `find` gave; returns the node's name.

    Where that has a texture, `color` is its scale and `palette` what it was found from; None
    leaves the one that is kept.
    """
    node = _make(place) if place.make else place.material.node_tree.nodes[place.node_name]
    sockets = OF_NODE[node.bl_idname]
    values: dict[str, Sequence[float]] = {sockets.roughness: (roughness,)}
    if place.texture is None:
        values[sockets.color] = color
    else:
        texture_scale.put(node.inputs[sockets.color], color, palette)
    set_sockets(node, values)
    # What setting a socket would have done, but for looking through all trees of the file.
    place.material.node_tree.update_tag()
    place.material.update_tag()
    return str(node.name)


def gloss_at(place: SocketTarget) -> Gloss | None:
    """Give the gloss of the node at a place that `find` gave; a node to be made has none."""
    if not place.node_name:
        return None
    return gloss_of(place.material.node_tree.nodes[place.node_name])


def new_material(name: str, shines: bool = False) -> Any:
    """Make a material, without the gloss that Blender gives to a new one.

    Gloss is kept because somebody set it; of what we make nobody did. What is to shine gets a node
    that can, which Blender 4.5 does not make by itself.
    """
    material = bpy.data.materials.new(name)
    if shines and not uses_nodes(material):
        material.use_nodes = True
    node = shader_node(material)
    if node is not None:
        _without_gloss(node)
    return material


def can_shine(place: SocketTarget) -> bool:
    """Whether the node at a place that `find` gave can have gloss, and it is ours to set."""
    if place.make and not place.node_name:
        return bool(OF_NODE[place.make].gloss)
    node = place.material.node_tree.nodes[place.node_name]
    names = OF_NODE[node.bl_idname].gloss.values()
    animated = (is_animated(place.material.node_tree, node.inputs[name]) for name in names)
    linked = (node.inputs[name].is_linked for name in names)
    return bool(names) and not any(linked) and not any(animated)


def put_gloss(material: Any, gloss: Gloss) -> None:
    """Set the gloss of the shader node that makes a material's surface, if its shader has any."""
    node = shader_node(material)
    if node is None or not OF_NODE[node.bl_idname].gloss:
        return
    fields = gloss._asdict()
    node.distribution = "MULTI_GGX" if fields.pop("multiscatter") else "GGX"
    names = OF_NODE[node.bl_idname].gloss
    set_sockets(
        node,
        {
            names[field]: value if isinstance(value, tuple) else (value,)
            for field, value in fields.items()
        },
    )
    material.node_tree.update_tag()
    material.update_tag()


def set_gloss(material: Any, name: str, gloss: Gloss) -> None:
    """Set level and roughness of the gloss in the node of this name, a Principled BSDF."""
    node = material.node_tree.nodes[name]
    names = OF_NODE[node.bl_idname].gloss
    set_sockets(node, {names["level"]: (gloss.level,), names["roughness"]: (gloss.roughness,)})
    material.node_tree.update_tag()
    material.update_tag()


def remove_gloss(place: SocketTarget) -> None:
    """Set the gloss to 0 of the node at a place that `find` gave, if it is there."""
    if place.node_name:
        _without_gloss(place.material.node_tree.nodes[place.node_name])
        place.material.node_tree.update_tag()
        place.material.update_tag()


def _without_gloss(node: Any) -> None:
    set_sockets(node, dict.fromkeys(OF_NODE[node.bl_idname].zeroed, (0.0,)))


def set_sockets(node: Any, values: Mapping[str, Sequence[float]]) -> None:
    """Set the first numbers of sockets; all others of the node stay as they are, to the bit.

    To each `default_value` that is set Blender looks through all node trees of the file: 0.1 ms
    among 1,000 materials, 4 ms among 10,000. All sockets of a node at once it just writes.
    """
    starts, size = _layout(node)
    numbers = array("f", bytes(4 * size))
    node.inputs.foreach_get("default_value", numbers)
    for name, given in values.items():
        numbers[starts[name] : starts[name] + len(given)] = array("f", given)
    node.inputs.foreach_set("default_value", numbers)


def _layout(node: Any) -> tuple[dict[str, int], int]:
    """Give where each socket's numbers begin among those of all, and how many these are."""
    if node.bl_idname not in _layouts:
        starts: dict[str, int] = {}
        size = 0
        for socket in node.inputs:
            starts.setdefault(socket.name, size)
            size += len(socket.default_value) if hasattr(socket.default_value, "__len__") else 1
        _layouts[node.bl_idname] = (starts, size)
    return _layouts[node.bl_idname]


_layouts: dict[str, tuple[dict[str, int], int]] = kept(__name__, "_layouts")


def unscale(material: Any) -> bool:
    """Let a material's texture reach the shader as it is; returns whether it was scaled.

    Raises
    ------
    MaterialError
        If the material is linked or read-only.
    """
    refuse_read_only(material)
    node = shader_node(material)
    return node is not None and texture_scale.remove(color_socket(node))


def refuse_read_only(material: Any) -> None:
    """Refuse a material whose nodes cannot be set.

    Raises
    ------
    MaterialError
        If it is linked, an override, read-only, or for Grease Pencil.
    """
    if material.library is not None:
        msg = (
            f"Material {material.name!r} is linked from {material.library.filepath!r}; make it "
            "local first, or assign in that file."
        )
        raise MaterialError(msg)
    if material.override_library is not None:
        msg = (
            f"Material {material.name!r} is a library override, whose nodes Blender resets on "
            "load; make it local first, or assign in its own file."
        )
        raise MaterialError(msg)
    if not material.is_editable:
        msg = f"Material {material.name!r} is read-only; make it local first."
        raise MaterialError(msg)
    if getattr(material, "is_grease_pencil", False):
        msg = f"Material {material.name!r} is for Grease Pencil; choose a surface material."
        raise MaterialError(msg)


def _place_for(material: Any, kind: str) -> SocketTarget:
    """Give the place of a node of this type that is to take over the surface.

    The one that was set aside keeps what the user chose in it, and no tree grows with each change.
    One that the user linked anywhere since, or that cannot be set, is left alone.
    """
    texture = texture_of(shader_node(material))
    for node in material.node_tree.nodes if uses_nodes(material) else ():
        if node.bl_idname == kind and color_socket(node).is_linked:
            continue
        if node.bl_idname != kind or node.get(_SET_ASIDE) != node.name or not _is_loose(node):
            continue
        try:
            refuse_unpredictable(material, node)
        except MaterialError:
            continue
        return SocketTarget(material, str(node.name), kind, texture)
    return SocketTarget(material, "", kind, texture)


def _is_loose(node: Any) -> bool:
    """Whether nothing comes of a node: no link leaves it, but to reroutes that end nowhere."""
    followers = [link.to_node for output in node.outputs for link in output.links]
    return all(each.bl_idname == "NodeReroute" and _is_loose(each) for each in followers)


def _make(place: SocketTarget) -> Any:
    """Link a node to the output, one that was set aside or a new one."""
    material = place.material
    if not uses_nodes(material):
        material.use_nodes = True
    tree = material.node_tree
    output = tree.get_output_node("CYCLES")
    if output is None:
        output = tree.nodes.new("ShaderNodeOutputMaterial")
    link = surface_link(output)
    before = None if link is None else link.from_node
    if place.node_name:
        node = tree.nodes[place.node_name]
        del node[_SET_ASIDE]
    else:
        node = tree.nodes.new(place.make)
        _without_gloss(node)
        x, y = output.location
        at = (x - _NODE_DISTANCE, y - (_NODE_DISTANCE if before else 0))
        locations = array("f", bytes(8 * len(tree.nodes)))
        tree.nodes.foreach_get("location", locations)
        locations[-2:] = array("f", at)  # the newest comes last
        tree.nodes.foreach_set("location", locations)  # see `set_sockets`
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    if before is not None:
        before[_SET_ASIDE] = before.name
        _carry_over(before, node)
    return node


def _carry_over(before: Any, node: Any) -> None:
    """Let a shader node show what the one before it did, beyond what is derived.

    Bump, alpha, and a texture, whose link goes over: the node that is set aside stays loose.
    """
    color_socket(node).default_value[3] = color_socket(before).default_value[3]
    old = before.inputs[OF_NODE[before.bl_idname].normal]
    new = node.inputs[OF_NODE[node.bl_idname].normal]
    links = node.id_data.links
    if texture_of(before) is not None:
        link = link_to(color_socket(before))
        links.new(link.from_socket, color_socket(node))
        links.remove(link)
    if new.is_linked:
        links.remove(link_to(new))
    if old.is_linked:
        link = link_to(old)
        links.new(link.from_socket, new).is_muted = link.is_muted
