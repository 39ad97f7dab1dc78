# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read and write what a material stores, and tell whether its derived color still holds.

The truth is the spectrum; color and roughness in the shader node are derived from it. The stamp
says from what, so that a changed setting, working space or socket is noticed.
"""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass
from typing import Any

from ..core.errors import MaterialError
from . import nodes
from .properties import SCHEMA
from .sample import Sample
from .target import Request, Solution

_SOCKET_TOLERANCE = 1e-6
"""Sockets are single precision; a difference below this is not an edit by hand."""
_DETAILS = ("license", "position", "device", "condition", "illuminant", "observer", "lab", "xyz")


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
    model
        The model that gave the target.
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
    delta_e_instrument: float
    delta_e_mean: float
    delta_e_95: float
    warnings: tuple[str, ...]


def has_spectrum(material: Any) -> bool:
    """Whether a spectrum was assigned to the material."""
    return bool(material.rough_spectra.spectrum)


def store(material: Any, request: Request, shader: str) -> None:
    """Write the spectrum and all settings of a request into the material."""
    sample, group = request.sample, material.rough_spectra
    group.schema = SCHEMA
    group.sample_name = sample.name
    group.source = sample.source
    group.kind = sample.kind
    group.instrument = sample.instrument
    # repr of a float keeps every bit of it.
    group.spectrum = json.dumps(
        {"wavelengths": sample.wavelengths.tolist(), "values": sample.values.tolist()}
    )
    group.details = json.dumps(
        {key: getattr(sample, key) for key in _DETAILS} | {"notes": list(sample.notes)}
    )
    group.sigma = request.sigma
    group.sigma_source = sample.sigma_source
    group.illuminant = request.illuminant
    group.observer = str(request.observer)
    group.model = request.model
    group.shader = shader


def load(material: Any) -> Request:
    """Read back what `store` wrote.

    Raises
    ------
    MaterialError
        If the material has no spectrum, or one stored by a newer version.
    """
    group = material.rough_spectra
    if not group.spectrum:
        msg = f"Material {material.name!r} has no measured spectrum; assign one first."
        raise MaterialError(msg)
    if group.schema > SCHEMA:
        msg = (
            f"Material {material.name!r} was stored by a newer Rough Spectra (schema "
            f"{group.schema}); update the extension to work with it."
        )
        raise MaterialError(msg)
    try:
        spectrum, details = json.loads(group.spectrum), json.loads(group.details or "{}")
        pairs = {key: tuple(details[key]) for key in ("lab", "xyz", "notes") if details.get(key)}
        plain = {key: details[key] for key in _DETAILS if key in details and key not in pairs}
        sample = Sample(
            name=group.sample_name,
            wavelengths=spectrum["wavelengths"],
            values=spectrum["values"],
            kind=group.kind,
            instrument=group.instrument,
            sigma_source=group.sigma_source,
            source=group.source,
            **(plain | pairs),
        )
    except (ValueError, KeyError, TypeError) as error:
        msg = (
            f"Material {material.name!r}: its stored spectrum cannot be read ({error}); assign "
            "the sample again."
        )
        raise MaterialError(msg) from error
    return Request(
        sample=sample,
        sigma=sigma(group),
        model=group.model,
        illuminant=group.illuminant,
        observer=int(group.observer),
    )


def sigma(group: Any) -> float:
    """σ in radians, from the degrees that the user entered.

    The property is single precision: 15° comes back as 15.0000004°. Five decimals of a degree are
    what it can hold, and restore what was entered.
    """
    return math.radians(round(math.degrees(group.sigma), 5))


def sigma_degrees(group: Any) -> float:
    """σ in degrees as the user entered it."""
    return round(math.degrees(group.sigma), 5)


def set_stamp(material: Any, solution: Solution, working_space: str, node: str) -> None:
    """Note what was derived and from what."""
    group = material.rough_spectra
    stamp = {
        "inputs": _inputs(group),
        "working_space": working_space,
        "node": node,
        "color": solution.color.tolist(),
        "roughness": solution.roughness,
        "model": group.model,
        "delta_e_instrument": solution.delta_e_instrument,
        "delta_e_mean": solution.delta_e_mean,
        "delta_e_95": solution.delta_e_95,
        "warnings": list(solution.warnings),
    }
    group.stamp = json.dumps(stamp)


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
    if stamp.inputs != _inputs(group):
        reasons.append("the spectrum or a setting was changed")
    if stamp.working_space != working_space:
        reasons.append(f"the working space changed from {stamp.working_space} to {working_space}")
    node = nodes.shader_node(material)
    if node is None or node.name != stamp.node:
        reasons.append(f"the surface no longer comes from {stamp.node!r}")
    elif not reasons and _edited(node, stamp):
        reasons.append("color or roughness was edited by hand")
    return reasons


def _edited(node: Any, stamp: Stamp) -> bool:
    written = (*stamp.color, stamp.roughness)
    found = (
        *nodes.color_socket(node).default_value[:3],
        nodes.roughness_socket(node).default_value,
    )
    linked = nodes.color_socket(node).is_linked or nodes.roughness_socket(node).is_linked
    apart = max(abs(a - b) for a, b in zip(written, found, strict=True))
    return linked or apart > _SOCKET_TOLERANCE


def _inputs(group: Any) -> str:
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
