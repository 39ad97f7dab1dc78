# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell whether the color in a material's shader node still follows from its spectrum.

Only compares what is stored, without numpy or color science: cheap enough for a panel to draw.
"""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass
from typing import Any

import bpy

from . import nodes

DEFAULT_SPACE = "Linear Rec.709"
"""The working space before Blender 5.0, unless a custom OCIO configuration has another."""

_SOCKET_TOLERANCE = 1e-6
"""Sockets are single precision; a difference below this is not an edit by hand."""


@dataclass(frozen=True)
class Stamp:
    """What was written to the shader node, and from what.

    Parameters
    ----------
    inputs
        Digest of spectrum and settings.
    working_space
        Name of the working space the color is in.
    node, color, roughness
        The shader node and the values written to it.
    model, model_reason
        The model that gave the target, and why it was taken.
    shader_reason
        Whether the material is Lambertian or rough, and why.
    delta_e_instrument, delta_e_mean, delta_e_95
        Predicted ΔE00 at the instrument and over the hemisphere.
    warnings
        Sentences for the user.
    """

    inputs: str
    working_space: str
    node: str
    color: tuple[float, float, float]
    roughness: float
    model: str
    model_reason: str
    shader_reason: str
    delta_e_instrument: float
    delta_e_mean: float
    delta_e_95: float
    warnings: tuple[str, ...]


def has_spectrum(material: Any) -> bool:
    """Whether a spectrum was assigned to the material."""
    return bool(material.rough_spectra.spectrum)


def sigma(group: Any) -> float:
    """σ in radians, from the degrees that the user entered.

    The property is single precision: 15° comes back as 15.0000004°. Five decimals of a degree are
    what it can hold, and restore what was entered.
    """
    return math.radians(round(math.degrees(group.sigma), 5))


def sigma_degrees(group: Any) -> float:
    """σ in degrees as the user entered it."""
    return round(math.degrees(group.sigma), 5)


def working_space_name() -> str:
    """Name of the open file's working space."""
    data = getattr(bpy.data, "colorspace", None)
    return DEFAULT_SPACE if data is None else str(data.working_space)


def get_stamp(material: Any) -> Stamp | None:
    """Give the stamp, or None where nothing was derived yet or it is of another version."""
    try:
        data = json.loads(material.rough_spectra.stamp)
        return Stamp(**(data | {key: tuple(data[key]) for key in ("color", "warnings")}))
    except (ValueError, KeyError, TypeError):
        return None


def stale_reasons(material: Any, working_space: str) -> list[str]:
    """Say why the color in the shader node no longer follows from the spectrum; empty if it does.

    Only compares what is stored: cheap enough for a panel.
    """
    group = material.rough_spectra
    stamp = get_stamp(material)
    if stamp is None:
        return ["nothing was derived from the spectrum yet"]
    reasons = []
    if stamp.inputs != inputs_digest(group):
        reasons.append("the spectrum or a setting was changed")
    if stamp.working_space != working_space:
        reasons.append(f"the working space changed from {stamp.working_space} to {working_space}")
    node = nodes.shader_node(material)
    if node is None or node.name != stamp.node:
        reasons.append(f"the surface no longer comes from {stamp.node!r}")
    elif not reasons and _edited(node, stamp):
        reasons.append("color or roughness was edited by hand")
    if node is not None:
        if node.mute:
            reasons.append(f"{node.name!r} is muted")
        reasons += [f"{name} is in use" for name in nodes.disturbing_sockets(node)]
    return reasons


def _edited(node: Any, stamp: Stamp) -> bool:
    written = (*stamp.color, stamp.roughness)
    found = (
        *nodes.color_socket(node).default_value[:3],
        nodes.roughness_socket(node).default_value,
    )
    linked = nodes.color_socket(node).is_linked or nodes.roughness_socket(node).is_linked
    apart = max(abs(a - b) for a, b in zip(written, found, strict=True))
    return bool(linked or apart > _SOCKET_TOLERANCE)


def inputs_digest(group: Any) -> str:
    """Digest of the spectrum and of every setting that the color follows from."""
    settings = (
        group.spectrum,
        group.kind,
        group.instrument,
        f"{sigma_degrees(group):.5f}",
        group.illuminant,
        group.model,
        group.shader,
    )
    return hashlib.sha256("\n".join(settings).encode()).hexdigest()[:16]
