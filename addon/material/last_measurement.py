# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last measurement of a material, kept with it, and whether it is still of what is there.

Reads and compares text only, without numpy or color science: cheap enough for a panel to draw.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ...core.instruments import DEFAULT, REGISTRY
from ...core.numerics.memoized import memoized
from ..blender import shader_nodes
from . import snapshot
from .snapshot import Snapshot


@dataclass(frozen=True)
class LastMeasurement:
    """What the virtual spectrophotometer read.

    Parameters
    ----------
    rgb
        Reading in scene-linear RGB of the working space then.
    delta_e
        ΔE00 from the prediction; None where the material stores no spectrum.
    current
        Whether the material is still as it was measured.
    predicted
        ΔE00 that was predicted of it then, with the target of its settings then; None where there
        is no prediction, and in older files.
    instrument
        The virtual one that read it.
    place
        The object and the size of the spot, as in "Ball, 8 mm"; empty of a flat sample.
    spread
        ΔE00 from the reading below which 95 % of the spot lie; None of a flat sample.
    unlike
        What a flat sample does not show as the object does, in sentences; empty for most materials.
    """

    rgb: tuple[float, float, float]
    delta_e: float | None
    current: bool
    predicted: float | None = None
    instrument: str = DEFAULT
    place: str = ""
    spread: float | None = None
    unlike: tuple[str, ...] = ()


def fingerprint(material: Any) -> str:
    """Digest of all that a measurement depends on and Rough Spectra knows of."""
    return _fingerprint(snapshot.of(material))


@memoized(maxsize=1024)
def _fingerprint(found: Snapshot) -> str:
    surface = found.surface
    sockets = () if surface is None else (*surface.color, surface.roughness)
    told = (
        snapshot.digest(found.inputs._replace(flat=False)),  # it is Cycles that measures
        found.working_space,
        *(f"{value:.7f}" for value in sockets),
        *_besides(surface),
    )
    return hashlib.sha256("\n".join(told).encode()).hexdigest()[:16]


def _besides(surface: shader_nodes.Surface | None) -> list[str]:
    """Tell what else shows; nothing for a plain surface, so that older notes stay valid."""
    if surface is None:
        return []
    told = [*surface.linked, *surface.disturbing, *(f"{value:.7f}" for value in surface.values)]
    if surface.gloss is not None:
        told += [f"{value:.7f}" for value in surface.gloss.numbers()]
    return told + ["muted"] * surface.muted + ["bumped"] * surface.bumped


def note(
    material: Any,
    of: str,
    rgb: tuple[float, float, float],
    delta_e: float | None,
    predicted: float | None = None,
    instrument: str = DEFAULT,
    place: str = "",
    spread: float | None = None,
    unlike: Sequence[str] = (),
) -> None:
    """Keep a measurement with its material.

    Parameters
    ----------
    material
        A `bpy.types.Material` that is not linked.
    of
        Its `fingerprint` when the measurement began.
    rgb, delta_e, predicted, instrument, place, spread, unlike
        As in `LastMeasurement`.
    """
    told: dict[str, Any] = {
        "of": of,
        "rgb": rgb,
        "delta_e_00": delta_e,
        "predicted_delta_e_00": predicted,
    }
    if instrument != DEFAULT:
        told["instrument"] = instrument
    if place:
        told["place"], told["spread"] = place, spread
    if unlike:
        told["unlike"] = list(unlike)
    material.rough_spectra.measured = json.dumps(told)


def get(material: Any, known: Snapshot | None = None) -> LastMeasurement | None:
    """Give the last measurement, or None where there is none that can be read.

    `known` are the material's facts, for who has just read them.
    """
    found = _parsed(material.rough_spectra.measured)
    if found is None:
        return None
    of, rgb, delta_e, predicted, instrument, place, spread, unlike = found
    current = of == _fingerprint(known or snapshot.of(material))
    return LastMeasurement(rgb, delta_e, current, predicted, instrument, place, spread, unlike)


_RGB = tuple[float, float, float]
_Note = tuple[str, _RGB, float | None, float | None, str, str, float | None, tuple[str, ...]]
"""Fingerprint, RGB, both ΔE00, the instrument, place, spread, and what is unlike the object."""


@memoized(maxsize=64)
def _parsed(text: str) -> _Note | None:
    try:
        data = json.loads(text)
        red, green, blue = map(float, data["rgb"])
        keys = (data["delta_e_00"], data.get("predicted_delta_e_00"), data.get("spread"))
        delta_e, predicted, spread = (None if value is None else float(value) for value in keys)
        numbers = (red, green, blue, *(value or 0.0 for value in (delta_e, predicted, spread)))
        if not all(map(math.isfinite, numbers)):
            return None
        instrument = str(data.get("instrument", DEFAULT))
        if instrument not in REGISTRY:
            return None
        place, unlike = str(data.get("place", "")), tuple(map(str, data.get("unlike", ())))
        of, rgb = str(data["of"]), (red, green, blue)
        return of, rgb, delta_e, predicted, instrument, place, spread, unlike
    except (ValueError, KeyError, TypeError, RecursionError, OverflowError):
        return None
