# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last measurement of a material, kept with it, and whether it is still of what is there.

Reads and compares text only, without numpy or color science: cheap enough for a panel to draw.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from . import nodes, stamp


@dataclass(frozen=True)
class Measured:
    """What the virtual spectrophotometer read.

    Parameters
    ----------
    rgb
        Reading at 45°/0° in scene-linear RGB of the working space then.
    delta_e
        ΔE00 from the prediction; None where the material stores no spectrum.
    current
        Whether the material is still as it was measured.
    """

    rgb: tuple[float, float, float]
    delta_e: float | None
    current: bool


def fingerprint(material: Any) -> str:
    """Digest of all that a measurement depends on and Rough Spectra knows of."""
    node = nodes.shader_node(material)
    sockets: tuple[float, ...] = ()
    if node is not None:
        color = nodes.color_socket(node).default_value[:3]
        sockets = (*color, nodes.roughness_socket(node).default_value)
    told = (
        stamp.inputs_digest(material.rough_spectra),
        stamp.working_space_name(),
        *(f"{value:.7f}" for value in sockets),
    )
    return hashlib.sha256("\n".join(told).encode()).hexdigest()[:16]


def note(material: Any, of: str, rgb: tuple[float, float, float], delta_e: float | None) -> None:
    """Keep a measurement with its material.

    Parameters
    ----------
    material
        A `bpy.types.Material` that is not linked.
    of
        Its `fingerprint` when the measurement began.
    rgb, delta_e
        As in `Measured`.
    """
    material.rough_spectra.measured = json.dumps({"of": of, "rgb": rgb, "delta_e_00": delta_e})


def get(material: Any) -> Measured | None:
    """Give the last measurement, or None where there is none that can be read."""
    found = _parsed(material.rough_spectra.measured)
    if found is None:
        return None
    of, rgb, delta_e = found
    return Measured(rgb, delta_e, of == fingerprint(material))


@lru_cache(maxsize=64)
def _parsed(text: str) -> tuple[str, tuple[float, float, float], float | None] | None:
    try:
        data = json.loads(text)
        red, green, blue = map(float, data["rgb"])
        delta_e = data["delta_e_00"]
        return str(data["of"]), (red, green, blue), None if delta_e is None else float(delta_e)
    except (ValueError, KeyError, TypeError):
        return None
