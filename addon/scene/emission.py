# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What color a shader tree emits, as far as a tree can be read without running it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np

from ...core.numerics.arrays import Array
from ..colorimetry import illuminant_spectra
from ..colorimetry.rgb_space import WorkingSpace

_DEPTH = 16
"""Nodes in a row that are followed; a tree has no loops, but groups may be deep."""
_BLACKBODY_RANGE = (800.0, 12000.0)
"""Kelvin within which Cycles' blackbody is one."""
_OTHER_WAYS = {
    *("Is Camera Ray", "Is Shadow Ray", "Is Glossy Ray", "Is Singular Ray"),
    *("Is Transmission Ray", "Is Volume Scatter Ray"),
}
"""What Light Path says no to, for light that falls on a diffuse surface."""


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
class _At:
    """Where reading a tree has come to.

    Parameters
    ----------
    space
        The working space.
    groups
        Group nodes that were entered, the outermost first.
    depth
        How many more nodes are followed.
    """

    space: WorkingSpace
    groups: tuple[Any, ...] = ()
    depth: int = _DEPTH


@dataclass(frozen=True)
class _Value:
    color: Array
    temperature: float | None = None
    unread: str = ""
    source: Any = None


def blackbody(temperature: float, space: WorkingSpace) -> Array:
    """Scene-linear RGB of Cycles' blackbody of a luminance of 1."""
    spd = illuminant_spectra.planck(float(np.clip(temperature, *_BLACKBODY_RANGE)))
    xyz = illuminant_spectra.to_xyz(spd)
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
    return _of_shader(*_end(outputs[0].inputs["Surface"], _At(space)))


def _of_shader(origin: Any, at: _At) -> Emission | None:
    if not origin.is_output or origin.node.mute or at.depth == 0:
        return None
    node = origin.node
    if node.bl_idname in {"ShaderNodeAddShader", "ShaderNodeMixShader"}:
        return _of_sum(node, at)
    names = {
        "ShaderNodeEmission": ("Color", "Strength"),
        "ShaderNodeBackground": ("Color", "Strength"),
        "ShaderNodeBsdfPrincipled": ("Emission Color", "Emission Strength"),
    }.get(node.bl_idname)
    if names is None:
        return None
    strength = _value(node.inputs[names[1]], at)
    color = _value(node.inputs[names[0]], at)
    rgb = color.color * float(strength.color.mean())
    if not rgb.max() > 0:
        return None
    return Emission(rgb, color.temperature, color.unread or _fault(strength), color.source)


def _of_sum(node: Any, at: _At) -> Emission | None:
    sockets = [socket for socket in node.inputs if socket.type == "SHADER"]
    shares, fault = [1.0, 1.0], ""
    if node.bl_idname == "ShaderNodeMixShader":
        factor = _value(node.inputs[0], at)
        second = float(np.clip(factor.color.mean(), 0, 1))
        shares = [1 - second, second]
        fault = _fault(factor)
    parts = []
    for socket, share in zip(sockets, shares, strict=True):
        found = _of_shader(*_end(socket, replace(at, depth=at.depth - 1)))
        if found is not None and share > 0:
            parts.append((found, share))
    if not parts:
        return None
    rgb = sum((found.rgb * share for found, share in parts), np.zeros(3))
    main = max(parts, key=lambda part: float(part[0].rgb.sum() * part[1]))[0]
    temperature = main.temperature if len(parts) == 1 else None
    return Emission(rgb, temperature, main.unread or fault, main.source)


def _end(socket: Any, at: _At) -> tuple[Any, _At]:
    """Follow an input to where its value comes from, seen through reroutes and groups.

    Returns
    -------
    An output socket, or an input whose own value counts; and where that is.
    """
    for _ in range(2 * _DEPTH):
        links = [link for link in socket.links if link.is_valid and not link.is_muted]
        if not links:
            break
        origin = links[0].from_socket
        node = origin.node
        if node.bl_idname == "NodeReroute":
            socket = node.inputs[0]
        elif node.bl_idname == "NodeGroupInput" and at.groups:
            socket = _by_identifier(at.groups[-1].inputs, origin)
            at = replace(at, groups=at.groups[:-1])
        elif (inner := _inside(origin)) is not None:
            socket = inner
            at = replace(at, groups=(*at.groups, node))
        else:
            return origin, at
    return socket, at


def _inside(origin: Any) -> Any | None:
    """Give the socket within a group that feeds one of its outputs; None if it is no group."""
    node = origin.node
    if node.bl_idname != "ShaderNodeGroup" or node.mute or node.node_tree is None:
        return None
    ends = [end for end in node.node_tree.nodes if end.bl_idname == "NodeGroupOutput"]
    active = next((end for end in ends if end.is_active_output), None)
    return None if active is None else _by_identifier(active.inputs, origin)


def _by_identifier(sockets: Any, like: Any) -> Any:
    return next(socket for socket in sockets if socket.identifier == like.identifier)


def _value(socket: Any, at: _At) -> _Value:
    """Value of a socket as three numbers."""
    origin, at = _end(socket, at)
    if not origin.is_output:
        return _Value(_three(origin.default_value))
    node = origin.node
    reader = _READERS.get(node.bl_idname)
    if at.depth == 0 or node.mute or reader is None:
        return _unread(node)
    return reader(origin, replace(at, depth=at.depth - 1))


def _unread(node: Any) -> _Value:
    return _Value(np.ones(3), unread=node.label or node.name)


def _fault(*parts: _Value) -> str:
    """Name the first node that could not be read where a texture can't be told of either."""
    named = (part.unread or (part.source.name if part.source else "") for part in parts)
    return next(filter(None, named), "")


def _three(value: Any) -> Array:
    numbers = np.asarray(value, np.float64)
    return np.full(3, float(numbers)) if numbers.ndim == 0 else numbers[:3].copy()


def _constant(origin: Any, _at: _At) -> _Value:
    return _Value(_three(origin.default_value))


def _blackbody(origin: Any, at: _At) -> _Value:
    found = _value(origin.node.inputs["Temperature"], at)
    if fault := _fault(found):
        return _Value(np.ones(3), unread=fault)
    kelvin = float(found.color[0])
    return _Value(blackbody(kelvin, at.space), float(np.clip(kelvin, *_BLACKBODY_RANGE)))


def _texture(origin: Any, _at: _At) -> _Value:
    return _Value(np.ones(3), source=origin.node)


def _falloff(origin: Any, at: _At) -> _Value:
    return _value(origin.node.inputs["Strength"], at)


def _light_path(origin: Any, _at: _At) -> _Value:
    return _Value(np.zeros(3)) if origin.name in _OTHER_WAYS else _unread(origin.node)


def _profile(_origin: Any, _at: _At) -> _Value:
    # An IES profile has no color: it shapes the beam, and the light keeps its own.
    return _Value(np.ones(3))


def _combine(origin: Any, at: _At) -> _Value:
    if origin.node.mode != "RGB":
        return _unread(origin.node)
    parts = [_value(socket, at) for socket in origin.node.inputs]
    return _Value(np.array([part.color[0] for part in parts]), unread=_fault(*parts))


def _math(origin: Any, at: _At) -> _Value:
    first, second = (_value(socket, at) for socket in list(origin.node.inputs)[:2])
    combine = {"ADD": np.add, "SUBTRACT": np.subtract, "MULTIPLY": np.multiply}
    if origin.node.operation not in combine:
        return _unread(origin.node)
    found = combine[origin.node.operation](first.color, second.color)
    return _Value(np.asarray(found), unread=_fault(first, second))


def _mix(origin: Any, at: _At) -> _Value:
    node = origin.node
    if node.data_type != "RGBA" or node.blend_type not in {"MIX", "MULTIPLY"}:
        return _unread(node)
    enabled = [socket for socket in node.inputs if socket.enabled]
    share, first, second = (_value(socket, at) for socket in enabled[:3])
    part = share.color[0]
    other = second.color * (first.color if node.blend_type == "MULTIPLY" else 1)
    source = first.source or second.source
    fault = _fault(share) or first.unread or second.unread
    return _Value(first.color * (1 - part) + other * part, None, fault, source)


_READERS = {
    "ShaderNodeRGB": _constant,
    "ShaderNodeValue": _constant,
    "ShaderNodeBlackbody": _blackbody,
    "ShaderNodeTexEnvironment": _texture,
    "ShaderNodeTexImage": _texture,
    "ShaderNodeTexSky": _texture,
    "ShaderNodeLightFalloff": _falloff,
    "ShaderNodeLightPath": _light_path,
    "ShaderNodeTexIES": _profile,
    "ShaderNodeCombineColor": _combine,
    "ShaderNodeMath": _math,
    "ShaderNodeMix": _mix,
}
