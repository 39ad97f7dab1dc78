# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a material's node shows and how its color was derived, as plain values for documents."""

from __future__ import annotations

import math
from typing import Any

from ..blender import shader_nodes
from ..blender.sockets import OF_SHADER
from ..colorimetry import standard_spaces
from ..colorimetry.rgb_space import WorkingSpace
from ..material import state
from ..readings.origin import Derivation, Node

_SHORT = {sockets.node: name.lower() for name, sockets in OF_SHADER.items()}


def node(material: Any, space: WorkingSpace) -> Node | None:
    """Read the shader node behind a material's output; None where it is no target shader's.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    space
        The working space that its color is in.
    """
    surface = shader_nodes.surface(material)
    if surface is None:
        return None
    color = surface.color if all(map(math.isfinite, surface.color)) else None
    gloss = surface.gloss
    if gloss is not None and not all(map(math.isfinite, gloss.numbers())):
        gloss = None
    return Node(
        name=surface.node,
        shader=_SHORT[surface.shader],
        color=color,
        roughness=surface.roughness if math.isfinite(surface.roughness) else None,
        colors={} if color is None else standard_spaces.of_rgb(color, space),
        textured=surface.scaled,
        linked=tuple(surface.linked),
        in_use=surface.disturbing,
        muted=surface.muted,
        bumped=surface.bumped,
        gloss=None if gloss is None else gloss._asdict(),
    )


def derivation(material: Any) -> Derivation | None:
    """Read how a material's color was derived; None where none was, or nobody can tell."""
    found = state.state(material)
    stamp = found.stamp
    if stamp is None:
        return None
    return Derivation(
        state=found.kind,
        reasons=found.reasons,
        version=stamp.version,
        working_space=stamp.working_space,
        color=stamp.color,
        roughness=stamp.roughness,
        model=stamp.model,
        model_reason=stamp.model_reason,
        shader_reason=stamp.shader_reason,
        delta_e_instrument=stamp.delta_e_instrument,
        delta_e_mean=stamp.delta_e_mean,
        delta_e_95=stamp.delta_e_95,
        delta_e_lights=dict(stamp.delta_e_lights),
        scene_reason=stamp.scene_reason,
        sigma_max=stamp.sigma_max,
        settings=dict(stamp.settings),
    )
