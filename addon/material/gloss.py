# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gloss as one number, over the sockets of the Principled BSDF that decide it.

0 is matte. Above, it is how sharp the shine is: one less the node's Roughness, as renderers with a
glossiness have it. How strong the shine is, Specular IOR Level, stays as it was set, and so do tint
and coat: where there was none, it is that of most dielectrics. Nothing is stored besides: the
sockets are what counts, whoever sets them.
"""

from __future__ import annotations

from typing import Any

from ..blender import shader_nodes
from ..blender.sockets import OF_NODE, OF_SHADER

LEVEL = 0.5
"""Specular IOR Level of what has only its IOR to shine with."""

_SET_ASIDE = "rough_spectra_level"
"""Custom property of a node whose level was set to 0, with the level before."""

_GLOSSY = next(name for name, sockets in OF_SHADER.items() if sockets.gloss)


def shown(material: Any) -> float:
    """Give the gloss that a material shows, 0 to 1; 0 of what has none or another node's."""
    node = shader_nodes.shader_node(material)
    if node is None or not OF_NODE[node.bl_idname].gloss:
        return 0.0
    names = OF_NODE[node.bl_idname].gloss
    if node.inputs[names["level"]].default_value <= 0:
        return 0.0
    return min(max(1.0 - float(node.inputs[names["roughness"]].default_value), 0.0), 1.0)


def put(material: Any, gloss: float) -> None:
    """Set the sockets; a material of another shader becomes one that can shine.

    The color below is left to whoever follows settings. Nothing happens where the surface is not
    ours to change: the panel's slider is gray there.
    """
    if not material.is_editable:
        return
    node = shader_nodes.shader_node(material)
    if node is not None and gloss > 0 and not OF_NODE[node.bl_idname].gloss:
        material.rough_spectra.shader = _GLOSSY  # followed at once
        node = shader_nodes.shader_node(material)
    if node is None or not OF_NODE[node.bl_idname].gloss:
        return
    names = OF_NODE[node.bl_idname].gloss
    level = float(node.inputs[names["level"]].default_value)
    if gloss <= 0:
        if level > 0:
            node[_SET_ASIDE] = level
        shader_nodes.set_sockets(node, {names["level"]: (0.0,)})
    else:
        if level <= 0:
            level = float(node.pop(_SET_ASIDE, LEVEL))
        shader_nodes.set_sockets(
            node, {names["level"]: (level,), names["roughness"]: (1.0 - gloss,)}
        )
    material.node_tree.update_tag()
    material.update_tag()
