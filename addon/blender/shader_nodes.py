# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find, make and write the shader node that a material's surface comes from.

Finding never changes anything, so a whole selection is checked before the first is written.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import bpy

from ...core.errors import MaterialError

Shader = Literal["AUTO", "DIFFUSE", "PRINCIPLED"]

_SPECULAR_SOCKET = "Specular IOR Level"
_PURE_DIFFUSE = {
    "Metallic": 0.0,
    "Alpha": 1.0,
    "Subsurface Weight": 0.0,
    "Transmission Weight": 0.0,
    "Coat Weight": 0.0,
    "Sheen Weight": 0.0,
    "Emission Strength": 0.0,
    "Thin Film Thickness": 0.0,
}
"""Principled sockets that have to keep these values for the surface to be the Diffuse closure."""


class _Sockets(NamedTuple):
    """What a shader node and its sockets are called.

    Parameters
    ----------
    node
        Type of the node.
    color, roughness, normal
        What all shader nodes have; roughness is that of the diffuse closure.
    zeroed
        What is set to 0 besides.
    neutral
        What has to keep these values, and is never set.
    """

    node: str
    color: str
    roughness: str
    normal: str
    zeroed: tuple[str, ...]
    neutral: Mapping[str, float]


_SHADERS = {
    "DIFFUSE": _Sockets("ShaderNodeBsdfDiffuse", "Color", "Roughness", "Normal", (), {}),
    "PRINCIPLED": _Sockets(
        *("ShaderNodeBsdfPrincipled", "Base Color", "Diffuse Roughness", "Normal"),
        zeroed=(_SPECULAR_SOCKET,),
        neutral=_PURE_DIFFUSE,
    ),
}
_SOCKETS = {sockets.node: sockets for sockets in _SHADERS.values()}
_SET_ASIDE = "rough_spectra_set_aside"
"""Custom property of a node that another one took the place of, with its name then: a copy that
somebody made of it has another name."""
_DISPLACEMENT = "Displacement"
_NODE_DISTANCE = 300.0


@dataclass(frozen=True)
class Place:
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
    """

    material: Any
    node_name: str
    make: str


class Surface(NamedTuple):
    """What a surface shows, as far as Rough Spectra sets it or cannot predict it.

    Parameters
    ----------
    node, shader
        Name and type of the shader node.
    color, roughness
        Values of its sockets. What is no number is `math.nan` itself, so that surfaces compare.
    color_linked, roughness_linked
        Whether another node sets them, so that the values don't show.
    muted
        Whether the node is.
    disturbing
        See `disturbing_sockets`.
    values
        Values of all sockets where any disturbs, since the light depends on all of them then; else
        empty.
    bumped
        Whether the surface is turned point by point: by its Normal, or by the output's
        displacement.
    """

    node: str
    shader: str
    color: tuple[float, float, float]
    roughness: float
    color_linked: bool
    roughness_linked: bool
    muted: bool
    disturbing: tuple[str, ...]
    values: tuple[float, ...]
    bumped: bool

    @property
    def linked(self) -> list[str]:
        """Names of those of color and roughness that another node sets."""
        sockets = _SOCKETS[self.shader]
        return [sockets.color] * self.color_linked + [sockets.roughness] * self.roughness_linked


def find(material: Any, shader: Shader = "AUTO") -> Place:
    """Find where the color of a material's surface is set, changing nothing.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    shader
        "AUTO" takes the Diffuse or Principled BSDF that is there, or a new Diffuse BSDF where
        there is none. "DIFFUSE" and "PRINCIPLED" ask for that node; where the other one is in
        use it takes its place, and the other one stays in the tree. It is the node that an earlier
        change has set aside, if nobody uses that, else a new one.

    Raises
    ------
    MaterialError
        If the material is linked or read-only, or its surface is made of nodes whose reading
        nobody could predict; the message says what to do.
    """
    _refuse_read_only(material)
    output = _output(material)
    link = _surface_link(output)
    if link is None:
        return _place_for(material, _SHADERS["DIFFUSE" if shader == "AUTO" else shader].node)
    node = link.from_node
    if node.bl_idname not in _SOCKETS:
        msg = (
            f"Material {material.name!r}: its surface comes from {node.name!r} "
            f"({node.bl_label}), which Rough Spectra cannot set; link a Diffuse or Principled "
            "BSDF to the material output."
        )
        raise MaterialError(msg)
    if shader != "AUTO" and node.bl_idname != _SHADERS[shader].node:
        return _place_for(material, _SHADERS[shader].node)
    _refuse_unpredictable(material, node)
    return Place(material, node.name, "")


def shader_node(material: Any) -> Any | None:
    """Give the Diffuse or Principled BSDF behind the active output, or None."""
    return _shader_of(_output(material))


def surface(material: Any) -> Surface | None:
    """Read the Diffuse or Principled BSDF behind the active output; None where there is none."""
    output = _output(material)
    node = _shader_of(output)
    if output is None or node is None:
        return None
    shader, inputs = node.bl_idname, node.inputs
    color_at, roughness_at, normal_at, neutral = _places(node, shader)
    color, roughness = inputs[color_at], inputs[roughness_at]
    red, green, blue, _ = color.default_value
    disturbing = tuple(_in_use(inputs, neutral))
    return Surface(
        node.name,
        shader,
        (comparable(red), comparable(green), comparable(blue)),
        comparable(roughness.default_value),
        color.is_linked,
        roughness.is_linked,
        node.mute,
        disturbing,
        tuple(_values(inputs)) if disturbing else (),
        inputs[normal_at].is_linked or output.inputs[_DISPLACEMENT].is_linked,
    )


def written(before: Surface, color: Iterable[float], roughness: float) -> Surface:
    """Give what a surface shows after `write` set the node that it comes from.

    `before` is what it showed, with nothing in use that `write` would set to 0.
    """
    red, green, blue, rough = array("f", (*color, roughness))  # sockets are single precision
    return before._replace(color=(red, green, blue), roughness=rough)


def comparable(value: float) -> float:
    """Give NaN as `math.nan` itself: no other is equal to itself in a tuple."""
    return math.nan if math.isnan(value) else value


def write(place: Place, color: tuple[float, float, float], roughness: float) -> str:
    """Set color and roughness at a place that `find` gave; returns the node's name."""
    node = _make(place) if place.make else place.material.node_tree.nodes[place.node_name]
    sockets = _SOCKETS[node.bl_idname]
    zeros = dict.fromkeys(sockets.zeroed, (0.0,))
    _set_sockets(node, {sockets.color: color, sockets.roughness: (roughness,), **zeros})
    # What setting a socket would have done, but for looking through all trees of the file.
    place.material.node_tree.update_tag()
    place.material.update_tag()
    return str(node.name)


def _set_sockets(node: Any, values: dict[str, Sequence[float]]) -> None:
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


_layouts: dict[str, tuple[dict[str, int], int]] = {}


def color_socket(node: Any) -> Any:
    """Give the socket that holds a Diffuse or Principled BSDF's color."""
    return node.inputs[_SOCKETS[node.bl_idname].color]


def roughness_socket(node: Any) -> Any:
    """Give the socket that holds Cycles' diffuse roughness."""
    return node.inputs[_SOCKETS[node.bl_idname].roughness]


def _shader_of(output: Any | None) -> Any | None:
    link = _surface_link(output)
    if link is None or link.from_node.bl_idname not in _SOCKETS:
        return None
    return link.from_node


def _places(node: Any, shader: str) -> tuple[int, int, int, tuple[tuple[str, int, float], ...]]:
    """Give the numbers of the sockets for color, roughness, normal, and what has to be neutral.

    All nodes of a type have the same sockets. A panel reads eleven at every redraw: found by number
    that takes two thirds of the time (10 µs for nine, where by name it was 15).
    """
    if shader not in _numbers:
        find, sockets = node.inputs.find, _SOCKETS[shader]
        neutral = dict.fromkeys(sockets.zeroed, 0.0) | dict(sockets.neutral)
        rest = tuple((name, find(name), value) for name, value in neutral.items())
        own = find(sockets.color), find(sockets.roughness), find(sockets.normal)
        _numbers[shader] = (*own, rest)
    return _numbers[shader]


_numbers: dict[str, tuple[int, int, int, tuple[tuple[str, int, float], ...]]] = {}


def disturbing_sockets(node: Any) -> list[str]:
    """Name the sockets in use that make a Principled BSDF more than the Diffuse closure.

    Empty for a Diffuse BSDF. The specular level counts, which `write` sets to 0.
    """
    return _in_use(node.inputs, _places(node, node.bl_idname)[-1])


def _in_use(inputs: Any, neutral: tuple[tuple[str, int, float], ...]) -> list[str]:
    found = [(name, inputs[number], value) for name, number, value in neutral]
    return [
        name for name, socket, value in found if socket.default_value != value or socket.is_linked
    ]


def _values(inputs: Any) -> Iterator[float]:
    for socket in inputs:
        value: Any = getattr(socket, "default_value", 0.0)
        yield from map(comparable, value if hasattr(value, "__len__") else (value,))


def _refuse_read_only(material: Any) -> None:
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


def _refuse_unpredictable(material: Any, node: Any) -> None:
    where = f"Material {material.name!r}, node {node.name!r}"
    if node.mute:
        msg = f"{where} is muted; unmute it first."
        raise MaterialError(msg)
    sockets = _SOCKETS[node.bl_idname]
    for name in (sockets.color, sockets.roughness, *sockets.zeroed):
        if node.inputs[name].is_linked:
            msg = f"{where}: {name} comes from another node; unlink it, so that it can be set."
            raise MaterialError(msg)
        if _is_animated(material.node_tree, node.inputs[name]):
            msg = f"{where}: {name} is animated or driven; clear that, so that it can be set."
            raise MaterialError(msg)
    for name in disturbing_sockets(node):
        if name in sockets.neutral:
            msg = (
                f"{where}: {name} is in use, which adds light that no diffuse reading accounts "
                f"for; set it to {sockets.neutral[name]:g}, or choose Diffuse as the shader."
            )
            raise MaterialError(msg)
    for name in sockets.neutral:
        if _is_animated(material.node_tree, node.inputs[name]):
            msg = f"{where}: {name} is animated or driven; clear that, or choose Diffuse."
            raise MaterialError(msg)


def _is_animated(tree: Any, socket: Any) -> bool:
    if tree.animation_data is None:
        return False
    path = socket.path_from_id("default_value")
    return any(curve.data_path == path for curve in curves(tree.animation_data))


def curves(data: Any | None) -> list[Any]:
    """Give drivers, and F-curves of the action and of every strip in the NLA."""
    if data is None:
        return []
    from bpy_extras import anim_utils

    slots = [(data.action, data.action_slot)]
    slots += [
        (strip.action, strip.action_slot) for track in data.nla_tracks for strip in track.strips
    ]
    found = list(data.drivers)
    for action, slot in slots:
        bag = None if action is None else anim_utils.action_get_channelbag_for_slot(action, slot)
        found += [] if bag is None else list(bag.fcurves)
    return found


def _uses_nodes(material: Any) -> bool:
    """Up to Blender 4.5 a material may do without nodes; later the property only warns."""
    if bpy.app.version >= (5, 0, 0):
        return material.node_tree is not None
    return bool(material.use_nodes)


def _output(material: Any) -> Any | None:
    if not _uses_nodes(material):
        return None
    return material.node_tree.get_output_node("CYCLES")


def _surface_link(output: Any | None) -> Any | None:
    """Give the link that reaches the output's Surface, seen through reroutes."""
    if output is None:
        return None
    socket = output.inputs["Surface"]
    while socket.is_linked:
        link = _link_to(socket)
        if link.is_muted or not link.is_valid:
            return None
        if link.from_node.bl_idname != "NodeReroute":
            return link
        socket = link.from_node.inputs[0]
    return None


def _link_to(socket: Any) -> Any:
    """Give the link that ends in a socket. `socket.links` would look twice at each of the tree."""
    for link in socket.id_data.links:
        if link.to_socket == socket:
            return link
    msg = f"{socket.name!r} is not linked"
    raise ValueError(msg)


def _place_for(material: Any, kind: str) -> Place:
    """Give the place of a node of this type that is to take over the surface.

    The one that was set aside keeps what the user chose in it, and no tree grows with each change.
    One that the user linked anywhere since, or that cannot be set, is left alone.
    """
    for node in material.node_tree.nodes if _uses_nodes(material) else ():
        if node.bl_idname != kind or node.get(_SET_ASIDE) != node.name or not _is_loose(node):
            continue
        try:
            _refuse_unpredictable(material, node)
        except MaterialError:
            continue
        return Place(material, str(node.name), kind)
    return Place(material, "", kind)


def _is_loose(node: Any) -> bool:
    """Whether nothing comes of a node: no link leaves it, but to reroutes that end nowhere."""
    followers = [link.to_node for output in node.outputs for link in output.links]
    return all(each.bl_idname == "NodeReroute" and _is_loose(each) for each in followers)


def _make(place: Place) -> Any:
    """Link a node to the output, one that was set aside or a new one."""
    material = place.material
    if not _uses_nodes(material):
        material.use_nodes = True
    tree = material.node_tree
    output = tree.get_output_node("CYCLES")
    if output is None:
        output = tree.nodes.new("ShaderNodeOutputMaterial")
    link = _surface_link(output)
    before = None if link is None else link.from_node
    if place.node_name:
        node = tree.nodes[place.node_name]
        del node[_SET_ASIDE]
    else:
        node = tree.nodes.new(place.make)
        x, y = output.location
        at = (x - _NODE_DISTANCE, y - (_NODE_DISTANCE if before else 0))
        locations = array("f", bytes(8 * len(tree.nodes)))
        tree.nodes.foreach_get("location", locations)
        locations[-2:] = array("f", at)  # the newest comes last
        tree.nodes.foreach_set("location", locations)  # see `_set_sockets`
    tree.links.new(node.outputs["BSDF"], output.inputs["Surface"])
    if before is not None:
        before[_SET_ASIDE] = before.name
        _carry_over(before, node)
    return node


def _carry_over(before: Any, node: Any) -> None:
    """Let a shader node show what the one before it did, beyond what is derived: bump and alpha."""
    color_socket(node).default_value[3] = color_socket(before).default_value[3]
    old = before.inputs[_SOCKETS[before.bl_idname].normal]
    new = node.inputs[_SOCKETS[node.bl_idname].normal]
    links = node.id_data.links
    if new.is_linked:
        links.remove(_link_to(new))
    if old.is_linked:
        link = _link_to(old)
        links.new(link.from_socket, new).is_muted = link.is_muted
