# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The colors that a user can set in a material: free sockets, RGB nodes and inputs of groups."""

from __future__ import annotations

from array import array
from typing import Any, NamedTuple

from ...core.errors import MaterialError
from .surface import output_node

_OWN = ("Base Color", "Color", "Color1", "A", "Diffuse Color")
"""Names that are more likely what is meant than tints, the first one first."""


class Place(NamedTuple):
    """Where a color is.

    Parameters
    ----------
    node
        Name of the node, in the material's own tree.
    side
        "inputs" or "outputs".
    number
        Of the socket among these.
    name
        For a person: node and socket.
    """

    node: str
    side: str
    number: int
    name: str


def places(material: Any) -> list[Place]:
    """List the colors that the surface depends on, the most likely first.

    Parameters
    ----------
    material
        A `bpy.types.Material`.

    Returns
    -------
    Colors that a value can be set for: nothing is linked to them, and their node is not muted.
    Those nearer to the output come first, of one node those named for its color.
    """
    output = output_node(material)
    found: list[tuple[int, int, Place]] = []
    if output is None:
        return []
    near, seen, distance = [output], {output.name}, 0
    while near:
        further = []
        for node in near:
            found += [(distance, rank, place) for rank, place in _of_node(node)]
            for socket in node.inputs:
                for link in socket.links if socket.is_linked else ():
                    if link.is_muted or link.from_node.name in seen:
                        continue
                    seen.add(link.from_node.name)
                    further.append(link.from_node)
        near, distance = further, distance + 1
    found.sort(key=lambda entry: (entry[1] >= len(_OWN), entry[0], entry[1]))
    return [place for _, _, place in found]


def find(material: Any, name: str = "") -> Place:
    """Give the color of a name as `places` has it, or the most likely one.

    Raises
    ------
    MaterialError
        If there is none; the message lists the names.
    """
    known = places(material)
    if not known:
        msg = (
            f"Material {material.name!r} has no color to set: everything that its surface depends "
            "on is linked; put an RGB node or a Mix node with a free color between."
        )
        raise MaterialError(msg)
    for place in known:
        if place.name == name or not name:
            return place
    names = ", ".join(repr(place.name) for place in known)
    msg = f"Material {material.name!r} has no color {name!r}; choose one of {names}."
    raise MaterialError(msg)


def get(material: Any, place: Place) -> tuple[float, float, float]:
    """Read a color, scene-linear RGB.

    Raises
    ------
    MaterialError
        If it is no longer there.
    """
    red, green, blue, _ = _socket(material, place).default_value
    return float(red), float(green), float(blue)


def put(material: Any, place: Place, color: tuple[float, float, float]) -> None:
    """Write a color, scene-linear RGB; alpha stays.

    Raises
    ------
    MaterialError
        If it is no longer there.
    """
    socket = _socket(material, place)
    # An item or the whole as a property costs time that grows with the file's materials.
    socket.default_value.foreach_set(array("f", (*color, socket.default_value[3])))
    material.node_tree.update_tag()
    material.update_tag()


def _socket(material: Any, place: Place) -> Any:
    node = None if material.node_tree is None else material.node_tree.nodes.get(place.node)
    sockets = () if node is None else getattr(node, place.side)
    if place.number >= len(sockets) or sockets[place.number].type != "RGBA":
        msg = f"Material {material.name!r} has no color {place.name!r} any more; start again."
        raise MaterialError(msg)
    return sockets[place.number]


def _of_node(node: Any) -> list[tuple[int, Place]]:
    if node.mute:
        return []
    title = node.label or node.name
    if node.bl_idname == "ShaderNodeRGB":
        return [(0, Place(node.name, "outputs", 0, title))]
    return [
        (
            _OWN.index(socket.name) if socket.name in _OWN else len(_OWN) + number,
            Place(node.name, "inputs", number, f"{title}: {socket.name}"),
        )
        for number, socket in enumerate(node.inputs)
        if socket.type == "RGBA" and socket.enabled and not socket.is_linked
    ]
