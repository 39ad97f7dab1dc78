# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What color a shader tree emits, as far as a tree can be read without running it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ...core.arrays import Array
from .. import light_spectrum
from ..working_space import WorkingSpace

_DEPTH = 16
"""Nodes in a row that are followed; a tree has no loops, but groups may be deep."""
_BLACKBODY_RANGE = (800.0, 12000.0)
"""Kelvin within which Cycles' blackbody is one."""


@dataclass(frozen=True)
class Emission:
    """Radiance of an emitting shader.

    Parameters
    ----------
    rgb
        Scene-linear, strength included, shape (3,).
    temperature
        Kelvin where the color is a blackbody's, or None.
    unread
        Label of the node that could not be read and counts as white, or an empty string.
    source
        Texture node that the color comes from, or None.
    """

    rgb: Array
    temperature: float | None = None
    unread: str = ""
    source: Any = None


@dataclass(frozen=True)
class _Value:
    color: Array
    temperature: float | None = None
    unread: str = ""
    source: Any = None


def blackbody(temperature: float, space: WorkingSpace) -> Array:
    """Scene-linear RGB of Cycles' blackbody of a luminance of 1."""
    spd = light_spectrum.planck(float(np.clip(temperature, *_BLACKBODY_RANGE)))
    xyz = light_spectrum.to_xyz(spd)
    return np.maximum(space.from_xyz @ (xyz / xyz[1]), 0)


def tree(data: Any) -> Any | None:
    """Give the node tree that a light, world or material shines by, or None.

    Up to Blender 4.5 each of them may do without nodes; later the property only warns.
    """
    if bpy.app.version < (5, 0, 0) and not data.use_nodes:
        return None
    return data.node_tree


def of_tree(tree: Any, kind: str, space: WorkingSpace) -> Emission | None:
    """Read what a light's, world's or material's tree emits; None if nothing.

    Parameters
    ----------
    tree
        A `bpy.types.ShaderNodeTree`.
    kind
        Type of its output node, such as "ShaderNodeOutputWorld".
    space
        The working space.
    """
    outputs = [node for node in tree.nodes if node.bl_idname == kind and not node.mute]
    outputs.sort(key=lambda node: (not node.is_active_output, node.target == "EEVEE"))
    if not outputs or not outputs[0].inputs["Surface"].is_linked:
        return None
    shader = _origin(outputs[0].inputs["Surface"])
    return None if shader is None else _of_shader(shader.node, space, _DEPTH)


def _of_shader(node: Any, space: WorkingSpace, depth: int) -> Emission | None:
    if node.mute or depth == 0:
        return None
    if node.bl_idname in {"ShaderNodeAddShader", "ShaderNodeMixShader"}:
        return _of_sum(node, space, depth)
    names = {
        "ShaderNodeEmission": ("Color", "Strength"),
        "ShaderNodeBackground": ("Color", "Strength"),
        "ShaderNodeBsdfPrincipled": ("Emission Color", "Emission Strength"),
    }.get(node.bl_idname)
    if names is None:
        return None
    strength = _value(node.inputs[names[1]], space)
    color = _value(node.inputs[names[0]], space)
    rgb = color.color * float(strength.color.mean())
    if not rgb.max() > 0:
        return None
    return Emission(rgb, color.temperature, color.unread or strength.unread, color.source)


def _of_sum(node: Any, space: WorkingSpace, depth: int) -> Emission | None:
    sockets = [socket for socket in node.inputs if socket.type == "SHADER"]
    shares = [1.0, 1.0]
    if node.bl_idname == "ShaderNodeMixShader":
        second = float(_value(node.inputs[0], space).color.mean())
        shares = [1 - second, second]
    parts = []
    for socket, share in zip(sockets, shares, strict=True):
        origin = _origin(socket)
        found = None if origin is None else _of_shader(origin.node, space, depth - 1)
        if found is not None and share > 0:
            parts.append((found, share))
    if not parts:
        return None
    rgb = sum((found.rgb * share for found, share in parts), np.zeros(3))
    main = max(parts, key=lambda part: float(part[0].rgb.sum() * part[1]))[0]
    temperature = main.temperature if len(parts) == 1 else None
    return Emission(rgb, temperature, main.unread, main.source)


def _origin(socket: Any) -> Any | None:
    """Give the output socket that feeds an input, seen through reroutes."""
    for _ in range(_DEPTH):
        links = [link for link in socket.links if link.is_valid and not link.is_muted]
        if not links:
            return None
        origin = links[0].from_socket
        if origin.node.bl_idname != "NodeReroute":
            return origin
        socket = origin.node.inputs[0]
    return None


def _value(socket: Any, space: WorkingSpace, depth: int = _DEPTH) -> _Value:
    """Value of a socket as three numbers."""
    origin = _origin(socket)
    if origin is None:
        return _Value(_three(socket.default_value))
    node = origin.node
    reader = _READERS.get(node.bl_idname)
    if depth == 0 or node.mute or reader is None:
        return _Value(np.ones(3), unread=node.label or node.name)
    return reader(node, space, depth - 1)


def _three(value: Any) -> Array:
    numbers = np.asarray(value, np.float64)
    return np.full(3, float(numbers)) if numbers.ndim == 0 else numbers[:3].copy()


def _constant(node: Any, _space: WorkingSpace, _depth: int) -> _Value:
    return _Value(_three(node.outputs[0].default_value))


def _blackbody(node: Any, space: WorkingSpace, depth: int) -> _Value:
    kelvin = float(_value(node.inputs["Temperature"], space, depth).color[0])
    return _Value(blackbody(kelvin, space), float(np.clip(kelvin, *_BLACKBODY_RANGE)))


def _texture(node: Any, _space: WorkingSpace, _depth: int) -> _Value:
    return _Value(np.ones(3), source=node)


def _falloff(node: Any, space: WorkingSpace, depth: int) -> _Value:
    return _value(node.inputs["Strength"], space, depth)


def _profile(_node: Any, _space: WorkingSpace, _depth: int) -> _Value:
    # An IES profile has no color: it shapes the beam, and the light keeps its own.
    return _Value(np.ones(3))


def _combine(node: Any, space: WorkingSpace, depth: int) -> _Value:
    if node.mode != "RGB":
        return _Value(np.ones(3), unread=node.label or node.name)
    parts = [_value(socket, space, depth) for socket in node.inputs]
    return _Value(np.array([part.color[0] for part in parts]))


def _math(node: Any, space: WorkingSpace, depth: int) -> _Value:
    first, second = (_value(socket, space, depth) for socket in list(node.inputs)[:2])
    combine = {"ADD": np.add, "SUBTRACT": np.subtract, "MULTIPLY": np.multiply}
    if node.operation not in combine:
        return _Value(np.ones(3), unread=node.label or node.name)
    return _Value(np.asarray(combine[node.operation](first.color, second.color)))


def _mix(node: Any, space: WorkingSpace, depth: int) -> _Value:
    if node.data_type != "RGBA" or node.blend_type not in {"MIX", "MULTIPLY"}:
        return _Value(np.ones(3), unread=node.label or node.name)
    enabled = [socket for socket in node.inputs if socket.enabled]
    share, first, second = (_value(socket, space, depth) for socket in enabled[:3])
    part = share.color[0]
    other = second.color * (first.color if node.blend_type == "MULTIPLY" else 1)
    source = first.source or second.source
    return _Value(first.color * (1 - part) + other * part, None, "", source)


_READERS = {
    "ShaderNodeRGB": _constant,
    "ShaderNodeValue": _constant,
    "ShaderNodeBlackbody": _blackbody,
    "ShaderNodeTexEnvironment": _texture,
    "ShaderNodeTexImage": _texture,
    "ShaderNodeTexSky": _texture,
    "ShaderNodeLightFalloff": _falloff,
    "ShaderNodeTexIES": _profile,
    "ShaderNodeCombineColor": _combine,
    "ShaderNodeMath": _math,
    "ShaderNodeMix": _mix,
}
