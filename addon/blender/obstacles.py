# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a shader node keeps its color from being set, socket by socket, and how it is removed."""

from __future__ import annotations

from typing import Any, Literal

from ...core.errors import MaterialError
from . import texture_scale
from .links import link_to
from .sockets import OF_NODE, color_socket
from .surface import disturbing_sockets, gloss_of, shader_node

Kind = Literal["UNLINK", "CLEAR", "NEUTRAL"]
"""How an obstacle is removed: the link, the animation, or whatever is in use."""
MEASURED = "match it by measuring (Match by Measuring in the menu Rough Spectra)"
"""What remains where no formula tells what a surface reads."""


class SocketError(MaterialError):
    """A socket keeps the color from being set.

    Parameters
    ----------
    message
        Says which, and what to do.
    kind
        How `remove` does that.
    socket
        Its name.
    """

    def __init__(self, message: str, kind: Kind, socket: str) -> None:
        super().__init__(message)
        self.kind: Kind = kind
        self.socket = socket


def texture_of(node: Any | None) -> Any | None:
    """Give the socket that a texture reaches before it is scaled; None without a texture."""
    if node is None:
        return None
    color = color_socket(node)
    if not color.is_linked or link_to(color).is_muted:
        return None
    return texture_scale.source(color)


def refuse_unpredictable(material: Any, node: Any, keep_gloss: bool = True) -> None:
    """Refuse a node whose color cannot be set, or whose reading nobody could predict.

    Raises
    ------
    SocketError
        For the first socket that is in the way.
    MaterialError
        If the node is muted.
    """
    where = f"Material {material.name!r}, node {node.name!r}"
    if node.mute:
        msg = f"{where} is muted; unmute it first."
        raise MaterialError(msg)
    sockets = OF_NODE[node.bl_idname]
    for name in (sockets.color, sockets.roughness):
        if name == sockets.color and texture_of(node) is not None:
            continue
        if node.inputs[name].is_linked:
            msg = f"{where}: {name} comes from another node; unlink it, so that it can be set."
            raise SocketError(msg, "UNLINK", name)
        if is_animated(material.node_tree, node.inputs[name]):
            msg = f"{where}: {name} is animated or driven; clear that, so that it can be set."
            raise SocketError(msg, "CLEAR", name)
    counts = keep_gloss and gloss_of(node) is not None
    for name in disturbing_sockets(node):
        if not keep_gloss and name not in (*sockets.neutral, *sockets.zeroed):
            continue
        if name in sockets.gloss.values():
            msg = (
                f"{where}: {name} comes from another node; unlink it, so that the gloss is one, "
                f"choose Diffuse as the shader, or {MEASURED}."
            )
            raise SocketError(msg, "UNLINK", name)
        if name not in sockets.neutral:
            msg = (
                f"{where}: {name} is in use, which turns its gloss in a way that no formula here "
                f"counts; set it to 0 or unlink it, remove the gloss, or {MEASURED}."
            )
            raise SocketError(msg, "NEUTRAL", name)
        msg = (
            f"{where}: {name} is in use, which adds light that no diffuse reading accounts "
            f"for; set it to {sockets.neutral[name]:g}, choose Diffuse as the shader, or "
            f"{MEASURED}."
        )
        raise SocketError(msg, "NEUTRAL", name)
    for name in (*sockets.neutral, *(sockets.gloss.values() if counts else sockets.zeroed)):
        if is_animated(material.node_tree, node.inputs[name]):
            msg = f"{where}: {name} is animated or driven; clear that, or choose Diffuse."
            raise SocketError(msg, "CLEAR", name)


def remove(material: Any, kind: Kind, name: str) -> None:
    """Remove what a `SocketError` found, in the shader node of a material that may be changed.

    Raises
    ------
    MaterialError
        If there is no such socket, or its animation is not this material's alone; nothing was
        changed then.
    """
    node = shader_node(material)
    if node is None or name not in node.inputs:
        msg = f"Material {material.name!r}: its surface has no socket {name!r} any more."
        raise MaterialError(msg)
    socket = node.inputs[name]
    if kind != "UNLINK":
        _clear(material, socket)
    if kind != "CLEAR" and socket.is_linked:
        node.id_data.links.remove(link_to(socket))
    if kind == "NEUTRAL" and not hasattr(socket.default_value, "__len__"):
        socket.default_value = OF_NODE[node.bl_idname].neutral.get(name, 0.0)


def _clear(material: Any, socket: Any) -> None:
    """Take drivers and F-curves of a socket away."""
    data, path = material.node_tree.animation_data, socket.path_from_id("default_value")
    found = [] if data is None else _bags(data)
    of_socket = [(a, bag, c) for a, bag in found for c in bag.fcurves if c.data_path == path]
    for action, _, _ in of_socket:
        if not action.is_editable or action.users - action.use_fake_user > 1:
            msg = (
                f"Material {material.name!r}: {socket.name} is animated by {action.name!r}, which "
                "others use, too; clear it there, or make it a single-user copy."
            )
            raise MaterialError(msg)
    for _, bag, curve in of_socket:
        bag.fcurves.remove(curve)
    socket.driver_remove("default_value")


def is_animated(tree: Any, socket: Any) -> bool:
    """Whether a driver, or any action or strip, sets a socket."""
    if tree.animation_data is None:
        return False
    path = socket.path_from_id("default_value")
    return any(curve.data_path == path for curve in curves(tree.animation_data))


def curves(data: Any | None) -> list[Any]:
    """Give drivers, and F-curves of the action and of every strip in the NLA."""
    if data is None:
        return []
    return [*data.drivers, *(curve for _, bag in _bags(data) for curve in bag.fcurves)]


def _bags(data: Any) -> list[tuple[Any, Any]]:
    """Give the action and those of the NLA's strips, each with what holds the F-curves."""
    from bpy_extras import anim_utils

    slots = [(data.action, data.action_slot)]
    slots += [
        (strip.action, strip.action_slot) for track in data.nla_tracks for strip in track.strips
    ]
    bags = [
        (action, anim_utils.action_get_channelbag_for_slot(action, slot))
        for action, slot in slots
        if action is not None
    ]
    return [(action, bag) for action, bag in bags if bag is not None]
