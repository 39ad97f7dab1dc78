# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell whether the color in a material's shader node still follows from its spectrum.

Only compares what is stored, without numpy or color science: cheap enough for a panel to draw.
What takes a material reads its `facts` and asks what takes those.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal, NamedTuple

from . import facts, nodes
from .facts import Facts, Inputs, has_spectrum
from .properties import SCHEMA, title

DERIVATION = 1
"""Raise when the same spectrum and settings come to give another color, beyond rounding; materials
derived before are then stale."""

_SOCKET_TOLERANCE = 1e-6
"""Sockets are single precision; a difference below this is not an edit by hand."""


class Stamp(NamedTuple):
    """What was written to the shader node, and from what.

    Parameters
    ----------
    inputs
        Digest of spectrum and settings.
    settings
        The settings by their labels, and a digest of the spectrum; empty in older files.
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
    delta_e_lights
        Name and predicted mean ΔE00 of each of the scene's lights; empty without a scene.
    scene_reason
        What the scene decided, in a sentence; empty without a scene.
    version, derivation
        Of the extension that derived it; see `DERIVATION`.
    kept
        What the surface showed when the user chose to keep edits by hand, else an empty string.
        The predictions are then not of what is shown.
    sigma_max
        Largest σ, degrees, that the reading allows; None where every σ fits.
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
    settings: tuple[tuple[str, str], ...] = ()
    delta_e_lights: tuple[tuple[str, float], ...] = ()
    scene_reason: str = ""
    version: str = ""
    derivation: int = 1
    kept: str = ""
    sigma_max: float | None = None


Kind = Literal["none", "fresh", "stale", "kept", "error", "linked"]


@dataclass(frozen=True)
class State:
    """What the panel says of a material.

    Parameters
    ----------
    kind
        "none": no spectrum. "fresh": what is shown follows from it. "stale": it does not, for
        `reasons`. "kept": edited by hand, and the user chose to keep that. "error": it could not be
        derived, or was stored by a newer version. "linked": it belongs to another file; the first
        reason says what to do, the others why it would be stale.
    reasons
        Sentences without their first capital and their full stop, most important first.
    stamp
        What was derived, if anything was.
    """

    kind: Kind
    reasons: tuple[str, ...] = ()
    stamp: Stamp | None = None


def get_stamp(material: Any) -> Stamp | None:
    """Give the stamp, or None where nothing was derived yet or it cannot be read."""
    return parse(material.rough_spectra.stamp)


def state(material: Any) -> State:
    """Tell whether the color still follows from the spectrum, and if not, why."""
    return judge(facts.of(material)) if has_spectrum(material) else _NONE


@lru_cache(maxsize=1024)
def judge(found: Facts) -> State:
    """Tell the same from a material's facts."""
    if not found.inputs.spectrum:
        return _NONE
    last = parse(found.stamp)
    reasons = tuple(_stale_reasons(found))
    if found.elsewhere:
        return State("linked", (found.elsewhere, *reasons), last)
    if found.schema > SCHEMA:
        newer = "it was stored by a newer Rough Spectra; update the extension to work with it"
        return State("error", (newer,), last)
    if found.error:
        return State("error", (found.error,), last)
    if reasons:
        return State("stale", reasons, last)
    if last is not None and last.kept:
        return State("kept", ("color or roughness was edited by hand, and is kept",), last)
    return State("fresh", (), last)


def numbers(found: Facts) -> tuple[float, float, float] | None:
    """Give the stamp's ΔE00 if they are those of what the scene's engine shows now.

    At the instrument, and mean and 95th percentile over all angles.
    """
    known = judge(found)
    last = known.stamp
    if last is None or known.kind != "fresh" or (found.flat and not found.inputs.scene_view):
        return None
    return last.delta_e_instrument, last.delta_e_mean, last.delta_e_95


def stale_reasons(material: Any, working_space: str) -> list[str]:
    """Say why the color in the shader node no longer follows from the spectrum; empty if it does.

    Empty, too, where the user chose to keep edits by hand and nothing changed since.
    """
    return _stale_reasons(facts.of(material)._replace(working_space=working_space))


def follows(material: Any) -> bool:
    """Whether the surface shows what was derived, so that it may be derived again unasked.

    Settings may have changed; edits by hand, kept or not, must not be overwritten.
    """
    found = facts.of(material)
    stamp = parse(found.stamp)
    return (
        stamp is not None
        and not stamp.kept
        and found.schema <= SCHEMA
        and not found.elsewhere
        and not _changed_surface(found, stamp)
    )


def edited_by_hand(material: Any) -> bool:
    """Whether renewing would overwrite what the user set in the shader node, kept or not."""
    found = facts.of(material)
    stamp, surface = parse(found.stamp), found.surface
    if stamp is None or stamp.kept or surface is None:
        return stamp is not None and bool(stamp.kept)
    if surface.disturbing:
        return True
    # A change of the working space converted the sockets: what they held is not known. Another
    # node holds what somebody set, unless it is the same one by another name.
    return stamp.working_space == found.working_space and _edited(surface, stamp)


def shown(surface: nodes.Surface | None) -> str:
    """Give all that a surface shows, as far as Rough Spectra sets it, in a text to compare."""
    if surface is None:
        return "no Diffuse or Principled BSDF"
    linked = (surface.color_linked, surface.roughness_linked, surface.muted)
    values = (*surface.color, surface.roughness)
    return repr((surface.node, values, linked, list(surface.disturbing)))


def settings(found: Inputs) -> dict[str, str]:
    """Every setting that the color follows from, by its label, and a digest of the spectrum."""
    return {
        "spectrum": hashlib.sha256(found.spectrum.encode()).hexdigest()[:16],
        "kind": found.kind,
        "instrument": found.instrument,
        "σ": f"{found.sigma_degrees:.5f}".rstrip("0").rstrip(".") + "°",
        "illuminant": found.illuminant,
        "model": found.model,
        "shader": found.shader,
        "tolerance": f"{found.tolerance:g}",
        **_scene_settings(found),
    }


@lru_cache(maxsize=2048)
def analyzed_scene(scene_view: str) -> str:
    """Name of the scene that an analysis is of, from its text; empty if it cannot be read."""
    try:
        return str(json.loads(scene_view)["scene"])
    except (ValueError, KeyError, TypeError, RecursionError):
        return ""


def inputs_digest(group: Any) -> str:
    """Digest of the spectrum and of every setting that the color follows from."""
    return facts.digest(facts.inputs(group))


_NONE = State("none")
_NUMBERS = ("roughness", "delta_e_instrument", "delta_e_mean", "delta_e_95")
_TEXTS = (
    *("inputs", "working_space", "node", "model", "model_reason", "shader_reason"),
    *("scene_reason", "version", "kept"),
)


def _scene_settings(found: Inputs) -> dict[str, str]:
    if not found.scene_view:
        return {"light": "the illuminant's"}
    analysis = hashlib.sha256(found.scene_view.encode()).hexdigest()[:6]
    engine = facts.engine_words(found.flat)
    return {"light": f"the scene's (analysis {analysis})", "render engine": engine}


@lru_cache(maxsize=2048)
def parse(text: str) -> Stamp | None:
    """Read a stored stamp; None where it cannot be read."""
    try:
        data = json.loads(text)
        # What a newer version noted besides is left out; it raises `SCHEMA` where that matters.
        data = {key: data[key] for key in Stamp._fields if key in data}
        red, green, blue = map(_number, data["color"])
        data |= {"color": (red, green, blue), "warnings": tuple(map(_text, data["warnings"]))}
        data |= {key: _number(data[key]) for key in _NUMBERS}
        data |= {key: _text(data.get(key, "")) for key in _TEXTS}
        if data.get("sigma_max") is not None:
            data["sigma_max"] = _number(data["sigma_max"])
        data["derivation"] = int(_number(data.get("derivation", 1)))
        lights = data.get("delta_e_lights", ())
        data["delta_e_lights"] = tuple((_text(name), _number(apart)) for name, apart in lights)
        data["settings"] = tuple((k, _text(v)) for k, v in data.get("settings", {}).items())
        return Stamp(**data)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError, OverflowError):
        return None


def _number(value: Any) -> float:
    number = float(value)
    if isinstance(value, (str, bool)) or not math.isfinite(number):
        raise ValueError("no number")
    return number


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError("no text")
    return value


def _stale_reasons(found: Facts) -> list[str]:
    stamp = parse(found.stamp)
    if stamp is None:
        return ["nothing was derived from the spectrum yet"]
    return [*_changed_inputs(found.inputs, stamp), *_changed_surface(found, stamp)]


def _changed_inputs(found: Inputs, stamp: Stamp) -> list[str]:
    if stamp.inputs == facts.digest(found):
        return []
    before = dict(stamp.settings)
    now = settings(found)
    changes = []
    for label, value in before.items():
        if now.get(label, value) == value:
            continue
        if label == "spectrum":
            changes.append("the spectrum was replaced")
            continue
        what = label if label == "σ" else f"the {label}"
        old, new = _told(label, value, now[label])
        changes.append(f"{what} was changed from {old} to {new}")
    return changes or ["the spectrum or a setting was changed"]


def _told(label: str, *values: str) -> list[str]:
    """Write two values of a setting as the panel does, with no more digits than tell them apart."""
    if label != "σ":
        return [title(label, value) for value in values]
    if not all(re.fullmatch(r"-?\d+(\.\d+)?°", value) for value in values):
        return list(values)  # no number of degrees, in a damaged stamp
    rounded = [f"{float(value.rstrip('°')):.2f}".rstrip("0").rstrip(".") + "°" for value in values]
    return rounded if len(set(rounded)) == len(values) else list(values)


def _changed_surface(found: Facts, stamp: Stamp) -> list[str]:
    surface, working_space = found.surface, found.working_space
    if stamp.kept and stamp.working_space == working_space:
        if stamp.kept == shown(surface):
            return []
        return ["color or roughness was edited by hand after earlier edits were kept"]
    reasons = []
    if stamp.working_space != working_space:
        reasons.append(f"the working space changed from {stamp.working_space} to {working_space}")
    if stamp.derivation != DERIVATION:
        when = "a newer" if stamp.derivation > DERIVATION else "an older"
        reasons.append(f"it was derived by {when} Rough Spectra {stamp.version}".rstrip())
    if surface is None or surface.node != stamp.node:
        reasons.append(f"the surface no longer comes from {stamp.node!r}")
    elif linked := surface.linked:
        reasons += [f"{name} comes from another node" for name in linked]
    elif stamp.working_space == working_space and _edited(surface, stamp):
        # A change of the working space converts sockets: whether they were edited can't be told.
        reasons.append("color or roughness was edited by hand")
    if surface is not None:
        if surface.muted:
            reasons.append(f"{surface.node!r} is muted")
        reasons += [f"{name} is in use" for name in surface.disturbing]
    return reasons


def _edited(surface: nodes.Surface, stamp: Stamp) -> bool:
    if surface.color_linked or surface.roughness_linked:
        return True
    written, found = (*stamp.color, stamp.roughness), (*surface.color, surface.roughness)
    # Sockets may hold NaN, which is near to nothing.
    near = (abs(a - b) <= _SOCKET_TOLERANCE for a, b in zip(written, found, strict=True))
    return not all(near)
