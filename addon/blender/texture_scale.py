# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The node that scales a texture's color on its way into the shader, found again by its mark.

It is a Mix node that multiplies, and clamps: no color above 1 sends back more than it got. What
colors the texture had when it was looked at is kept with the node, so that it can be scaled anew
while σ is dragged.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from .links import comparable, link_to
from .working_space import working_space_name

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array

NAME = "Rough Spectra Scale"
_MARK = "rough_spectra_scale"
_CHANNELS = "rough_spectra_channels"
_COLORS = "rough_spectra_colors"
_SOURCE = "rough_spectra_source"
_A, _B, _RESULT = "A_Color", "B_Color", "Result_Color"
_NODE_DISTANCE = 200.0


class Palette(NamedTuple):
    """Colors that stand for a texture, scene-linear.

    Parameters
    ----------
    channels
        Values of each channel from small to large, each of as large a share of the surface, shape
        (values, 3): what stands in a row is of no one color.
    colors, weights
        Colors, shape (colors, 3), and the share of the surface that each stands for.
    """

    channels: Array
    colors: Array
    weights: Array


def node_of(color_socket: Any) -> Any | None:
    """Give the scale between a texture and this socket of a shader node; None without one."""
    if not color_socket.is_linked:
        return None
    node = link_to(color_socket).from_node
    return node if node.bl_idname == "ShaderNodeMix" and node.get(_MARK) else None


def factors(node: Any) -> tuple[float, float, float] | None:
    """Give what a scale multiplies by; None where it does not just multiply a texture."""
    if node.mute or (node.data_type, node.blend_type) != ("RGBA", "MULTIPLY"):
        return None
    if not (node.clamp_result and node.inputs[0].default_value == 1.0):
        return None
    if node.inputs[0].is_linked or _socket(node, _B).is_linked or not _socket(node, _A).is_linked:
        return None
    red, green, blue, _ = _socket(node, _B).default_value
    return comparable(red), comparable(green), comparable(blue)


def source(color_socket: Any) -> Any:
    """Give the linked socket that the texture itself reaches: of the scale, or the shader's own."""
    node = node_of(color_socket)
    if node is not None and _socket(node, _A).is_linked:
        return _socket(node, _A)
    return color_socket


def put(color_socket: Any, scale: tuple[float, float, float], palette: Palette | None) -> Any:
    """Scale what reaches a linked socket, by the node that is there or a new one.

    A palette is kept with it; None leaves the one that is there.
    """
    node, tree = node_of(color_socket), color_socket.id_data
    if node is None:
        link = link_to(color_socket)
        node = tree.nodes.new("ShaderNodeMix")
        node.name = node.label = NAME
        node[_MARK] = True
        x, y = color_socket.node.location
        node.location = (x - _NODE_DISTANCE, y)
        node.data_type, node.blend_type, node.clamp_result = "RGBA", "MULTIPLY", True
        tree.links.new(link.from_socket, _socket(node, _A))
        tree.links.new(next(s for s in node.outputs if s.identifier == _RESULT), color_socket)
    node.mute = False
    node.data_type, node.blend_type, node.clamp_result = "RGBA", "MULTIPLY", True
    node.inputs[0].default_value = 1.0
    _socket(node, _B).default_value = (*scale, 1.0)
    if palette is not None:
        node[_CHANNELS] = palette.channels.ravel().tolist()
        node[_COLORS] = [*palette.colors.ravel().tolist(), *palette.weights.tolist()]
        node[_SOURCE] = _told(_socket(node, _A))
    return node


def kept_palette(color_socket: Any) -> Palette | None:
    """Give the palette that is kept with a scale; None if its texture is another one since."""
    import numpy as np

    node = node_of(color_socket)
    if node is None or not _socket(node, _A).is_linked:
        return None
    if node.get(_SOURCE) != _told(_socket(node, _A)):
        return None
    channels = np.array(node.get(_CHANNELS, ()), np.float64)
    values = np.array(node.get(_COLORS, ()), np.float64)
    whole = channels.size and values.size and not (channels.size % 3 or values.size % 4)
    if not whole or not (np.isfinite(channels).all() and np.isfinite(values).all()):
        return None
    count = values.size // 4
    return Palette(
        channels.reshape(-1, 3), values[: 3 * count].reshape(count, 3), values[3 * count :]
    )


def remove(color_socket: Any) -> bool:
    """Let the texture reach the shader as it is; returns whether there was a scale."""
    node, tree = node_of(color_socket), color_socket.id_data
    if node is None:
        return False
    if _socket(node, _A).is_linked:
        tree.links.new(link_to(_socket(node, _A)).from_socket, color_socket)
    tree.nodes.remove(node)
    return True


def _socket(node: Any, identifier: str) -> Any:
    return next(socket for socket in node.inputs if socket.identifier == identifier)


def _told(socket: Any) -> str:
    """Tell a texture from another, as far as that is quickly told."""
    link = link_to(socket)
    image = getattr(link.from_node, "image", None)
    which = "" if image is None else f"{image.name}, {image.filepath}"
    return f"{link.from_node.name}, {link.from_socket.identifier}, {which}, {working_space_name()}"
