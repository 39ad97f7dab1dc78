# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read the surface of a material: the shader node it comes from, and what that shows."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import bpy

from ...core.gloss import WHITE, Gloss, Tint
from ...core.numerics.memoized import kept
from . import texture_scale
from .links import comparable, link_to
from .sockets import OF_NODE, Sockets

_DISPLACEMENT = "Displacement"


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
    gloss
        What of gloss lies over the diffuse lobe, or None.
    scaled
        Whether the color is a texture that a scale of ours multiplies; `color` is then that scale.
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
    gloss: Gloss | None = None
    scaled: bool = False

    @property
    def linked(self) -> list[str]:
        """Names of those of color and roughness that another node sets, other than a scale."""
        sockets = OF_NODE[self.shader]
        by_another = self.color_linked and not self.scaled
        return [sockets.color] * by_another + [sockets.roughness] * self.roughness_linked

    @property
    def gloss_linked(self) -> bool:
        """Whether another node sets the gloss, so that it is not one."""
        return any(name in self.disturbing for name in OF_NODE[self.shader].gloss.values())


def shader_node(material: Any) -> Any | None:
    """Give the target shader's node behind the active output, or None."""
    return _shader_of(output_node(material))


def surface(material: Any) -> Surface | None:
    """Read the target shader's node behind the active output; None where there is none."""
    output = output_node(material)
    node = _shader_of(output)
    if output is None or node is None:
        return None
    shader, inputs = node.bl_idname, node.inputs
    color_at, roughness_at, normal_at, of_gloss, neutral = _places(node, shader)
    color, roughness = inputs[color_at], inputs[roughness_at]
    scale = _scale(color) if color.is_linked else None
    red, green, blue = color.default_value[:3] if scale is None else scale
    gloss, used = _gloss(node, of_gloss)
    disturbing = tuple(used + _in_use(inputs, neutral))
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
        gloss,
        scale is not None,
    )


def written(before: Surface, color: Iterable[float], roughness: float) -> Surface:
    """Give what a surface shows after `shader_nodes.write` set the node that it comes from.

    `before` is what it showed, with nothing in use that writing would set to 0.
    """
    red, green, blue, rough = array("f", (*color, roughness))  # sockets are single precision
    return before._replace(color=(red, green, blue), roughness=rough)


def _scale(color: Any) -> tuple[float, float, float] | None:
    node = texture_scale.node_of(color)
    return None if node is None else texture_scale.factors(node)


def _shader_of(output: Any | None) -> Any | None:
    link = surface_link(output)
    if link is None or link.from_node.bl_idname not in OF_NODE:
        return None
    return link.from_node


class _OfGloss(NamedTuple):
    """The sockets that decide the gloss: by the fields of `Gloss`, name and number.

    What goes with the level and what with the coat stand apart: where there is no coat, nothing of
    it shows. `uncounted` are those that no formula counts.
    """

    level: tuple[str, int]
    with_level: tuple[tuple[str, int], ...]
    coat: tuple[str, int]
    with_coat: tuple[tuple[str, int], ...]
    uncounted_with_level: tuple[tuple[str, int], ...]
    uncounted_with_coat: tuple[tuple[str, int], ...]


class _Numbers(NamedTuple):
    """Numbers of the sockets for color, roughness, normal, gloss, and what has to be neutral."""

    color: int
    roughness: int
    normal: int
    gloss: _OfGloss | None
    neutral: tuple[tuple[str, int, float], ...]


def _places(node: Any, shader: str) -> _Numbers:
    """Give the numbers of the sockets that count.

    All nodes of a type have the same sockets. A panel reads eleven at every redraw: found by number
    that takes two thirds of the time (10 µs for nine, where by name it was 15).
    """
    if shader not in _numbers:
        find, sockets = node.inputs.find, OF_NODE[shader]
        rest = tuple((name, find(name), value) for name, value in sockets.neutral.items())
        own = find(sockets.color), find(sockets.roughness), find(sockets.normal)
        _numbers[shader] = _Numbers(*own, _places_of_gloss(find, sockets), rest)
    return _numbers[shader]


_numbers: dict[str, _Numbers] = kept(__name__, "_numbers")


def _places_of_gloss(find: Any, sockets: Sockets) -> _OfGloss | None:
    if not sockets.gloss:
        return None

    def named(*names: str) -> tuple[tuple[str, int], ...]:
        return tuple((name, find(name)) for name in names)

    level, *with_level, coat, coat_roughness, coat_ior, coat_tint = sockets.gloss.values()
    [of_level], [of_coat] = named(level), named(coat)
    return _OfGloss(
        *(of_level, named(*with_level), of_coat, named(coat_roughness, coat_ior, coat_tint)),
        *(named(*sockets.uncounted["level"]), named(*sockets.uncounted["coat"])),
    )


def gloss_of(node: Any) -> Gloss | None:
    """Read the gloss of a target shader's node, or None where it has none."""
    return _gloss(node, _places(node, node.bl_idname).gloss)[0]


def _gloss(node: Any, places: _OfGloss | None) -> tuple[Gloss | None, list[str]]:
    """Read the gloss, and name what of it comes from another node or is counted by no formula.

    Where there is no level or no coat, what goes with it does not count.
    """
    if places is None:
        return None, []
    inputs = node.inputs
    level, of_level, used = _layer(inputs, places.level, places.with_level, _NO_LEVEL)
    coat, of_coat, used_by_coat = _layer(inputs, places.coat, places.with_coat, _NO_COAT)
    if not (level or coat or used or used_by_coat):
        return None, []
    if level or used:
        used += [name for name, at in places.uncounted_with_level if _is_set(inputs[at])]
    if coat or used_by_coat:
        used_by_coat += [name for name, at in places.uncounted_with_coat if _is_set(inputs[at])]
    used += used_by_coat
    if not (level or coat):
        return None, used
    multiscatter = not level or node.distribution == "MULTI_GGX"
    return Gloss(level, *of_level, coat, *of_coat, multiscatter), used


_Lobe = tuple[float, float, Tint]
_NO_LEVEL: _Lobe = (0.5, 1.5, WHITE)
_NO_COAT: _Lobe = (0.03, 1.5, WHITE)


def _layer(
    inputs: Any,
    strength: tuple[str, int],
    others: tuple[tuple[str, int], ...],
    without: _Lobe,
) -> tuple[float, _Lobe, list[str]]:
    """Read level or coat with what goes with it, and name what of it is linked."""
    name, number = strength
    socket = inputs[number]
    value, linked = comparable(socket.default_value), socket.is_linked
    if value <= 0 and not linked:
        return 0.0, without, []
    used = [name] * linked + [other for other, at in others if inputs[at].is_linked]
    roughness, ior, tint = (inputs[at].default_value for _, at in others)
    red, green, blue, _ = map(comparable, tint)
    return (
        *(
            0.0 if value <= 0 else value,
            (comparable(roughness), comparable(ior), (red, green, blue)),
        ),
        used,
    )


def disturbing_sockets(node: Any) -> list[str]:
    """Name the sockets in use that make a node more than diffuse lobe and gloss of its shader.

    Always empty for a Diffuse BSDF.
    """
    found = _places(node, node.bl_idname)
    return _gloss(node, found.gloss)[1] + _in_use(node.inputs, found.neutral)


def _in_use(inputs: Any, neutral: tuple[tuple[str, int, float], ...]) -> list[str]:
    found = [(name, inputs[number], value) for name, number, value in neutral]
    return [
        name for name, socket, value in found if socket.default_value != value or socket.is_linked
    ]


def _is_set(socket: Any) -> bool:
    """Whether a socket is linked or holds a number besides 0; a direction counts where linked."""
    value: Any = socket.default_value
    return socket.is_linked or (not hasattr(value, "__len__") and value != 0)


def _values(inputs: Any) -> Iterator[float]:
    for socket in inputs:
        value: Any = getattr(socket, "default_value", 0.0)
        yield from map(comparable, value if hasattr(value, "__len__") else (value,))


def uses_nodes(material: Any) -> bool:
    """Up to Blender 4.5 a material may do without nodes; later the property only warns."""
    if bpy.app.version >= (5, 0, 0):
        return material.node_tree is not None
    return bool(material.use_nodes)


def output_node(material: Any) -> Any | None:
    """Give the output that Cycles uses, or None."""
    if not uses_nodes(material):
        return None
    return material.node_tree.get_output_node("CYCLES")


def surface_link(output: Any | None) -> Any | None:
    """Give the link that reaches the output's Surface, seen through reroutes."""
    if output is None:
        return None
    socket = output.inputs["Surface"]
    while socket.is_linked:
        link = link_to(socket)
        if link.is_muted or not link.is_valid:
            return None
        if link.from_node.bl_idname != "NodeReroute":
            return link
        socket = link.from_node.inputs[0]
    return None
