# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the nodes of the target shaders and their sockets are called: one map a shader.

The shaders themselves are in `addon.matching.shaders`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple


class Sockets(NamedTuple):
    """What a shader node and its sockets are called.

    Parameters
    ----------
    node
        Type of the node.
    color, roughness, normal
        What all shader nodes have; roughness is that of the diffuse closure.
    gloss
        What decides the gloss, by the fields of `core.gloss.Gloss`: kept as it is set, and counted.
        Empty where the shader has none.
    zeroed
        What is set to 0 in a node that is made, and where gloss is removed.
    uncounted
        What has to be 0 and unlinked where there is gloss, because no formula here counts it: by
        the field of the gloss that it goes with.
    neutral
        What has to keep these values, and is never set: else the surface is more than the shader's
        lobe.
    """

    node: str
    color: str
    roughness: str
    normal: str
    gloss: Mapping[str, str] = {}
    zeroed: tuple[str, ...] = ()
    uncounted: Mapping[str, tuple[str, ...]] = {}
    neutral: Mapping[str, float] = {}


OF_SHADER: Mapping[str, Sockets] = {
    "DIFFUSE": Sockets("ShaderNodeBsdfDiffuse", "Color", "Roughness", "Normal"),
    "PRINCIPLED": Sockets(
        *("ShaderNodeBsdfPrincipled", "Base Color", "Diffuse Roughness", "Normal"),
        gloss={
            "level": "Specular IOR Level",
            "roughness": "Roughness",
            "ior": "IOR",
            "tint": "Specular Tint",
            "coat": "Coat Weight",
            "coat_roughness": "Coat Roughness",
            "coat_ior": "Coat IOR",
            "coat_tint": "Coat Tint",
        },
        zeroed=("Specular IOR Level", "Coat Weight"),
        uncounted={"level": ("Anisotropic",), "coat": ("Coat Normal",)},
        neutral={
            "Metallic": 0.0,
            "Alpha": 1.0,
            "Subsurface Weight": 0.0,
            "Transmission Weight": 0.0,
            "Sheen Weight": 0.0,
            "Emission Strength": 0.0,
            "Thin Film Thickness": 0.0,
        },
    ),
}
"""By the shader's name."""

OF_NODE: Mapping[str, Sockets] = {each.node: each for each in OF_SHADER.values()}
"""By the node's type."""


def color_socket(node: Any) -> Any:
    """Give the socket that holds a target shader's color."""
    return node.inputs[OF_NODE[node.bl_idname].color]


def roughness_socket(node: Any) -> Any:
    """Give the socket that holds Cycles' diffuse roughness."""
    return node.inputs[OF_NODE[node.bl_idname].roughness]
