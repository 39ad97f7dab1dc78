# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell whether the color in a material's shader node still follows from its spectrum.

Only compares what is stored, without numpy or color science: cheap enough for a panel to draw.
"""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any, Literal

import bpy

from . import nodes
from .properties import SCHEMA, title

DEFAULT_SPACE = "Linear Rec.709"
"""The working space before Blender 5.0, unless a custom OCIO configuration has another."""

DERIVATION = 1
"""Raise when the same spectrum and settings come to give another color, beyond rounding; materials
derived before are then stale."""

_USUAL_TOLERANCE = 1.0
"""ΔE00; that of all materials before it could be set."""

_SOCKET_TOLERANCE = 1e-6
"""Sockets are single precision; a difference below this is not an edit by hand."""


@dataclass(frozen=True)
class Stamp:
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


def tolerance(group: Any) -> float:
    """ΔE00 as the user entered it: the property is single precision, as that of `sigma`."""
    return round(group.tolerance, 5)


def working_space_name() -> str:
    """Name of the open file's working space."""
    data = getattr(bpy.data, "colorspace", None)
    return DEFAULT_SPACE if data is None else str(data.working_space)


def get_stamp(material: Any) -> Stamp | None:
    """Give the stamp, or None where nothing was derived yet or it cannot be read."""
    return _parsed(material.rough_spectra.stamp)


def state(material: Any, working_space: str = "") -> State:
    """Tell whether the color still follows from the spectrum, and if not, why.

    `working_space` is the open file's, for who has just asked for it.
    """
    group = material.rough_spectra
    if not group.spectrum:
        return _NONE
    found = get_stamp(material)
    reasons = tuple(stale_reasons(material, working_space or working_space_name()))
    place = elsewhere(material)
    if place:
        return State("linked", (place, *reasons), found)
    if group.schema > SCHEMA:
        newer = "it was stored by a newer Rough Spectra; update the extension to work with it"
        return State("error", (newer,), found)
    if group.error:
        return State("error", (group.error,), found)
    if reasons:
        return State("stale", reasons, found)
    if found is not None and found.kept:
        return State("kept", ("color or roughness was edited by hand, and is kept",), found)
    return State("fresh", (), found)


def numbers_hold(material: Any, known: State | None = None) -> bool:
    """Whether the stamp's ΔE00 are those of what the scene's engine shows of the material now.

    `known` is its state, for who has just asked for it.
    """
    if (known or state(material)).kind != "fresh":
        return False
    return has_scene(material.rough_spectra) or not engine_is_flat()


def stale_reasons(material: Any, working_space: str) -> list[str]:
    """Say why the color in the shader node no longer follows from the spectrum; empty if it does.

    Empty, too, where the user chose to keep edits by hand and nothing changed since.
    """
    stamp = get_stamp(material)
    if stamp is None:
        return ["nothing was derived from the spectrum yet"]
    return [
        *_changed_inputs(material.rough_spectra, stamp),
        *_changed_surface(material, stamp, working_space),
    ]


def follows(material: Any) -> bool:
    """Whether the surface shows what was derived, so that it may be derived again unasked.

    Settings may have changed; edits by hand, kept or not, must not be overwritten.
    """
    stamp = get_stamp(material)
    return (
        stamp is not None
        and not stamp.kept
        and material.rough_spectra.schema <= SCHEMA
        and not elsewhere(material)
        and not _changed_surface(material, stamp, working_space_name())
    )


def edited_by_hand(material: Any) -> bool:
    """Whether renewing would overwrite what the user set in the shader node, kept or not."""
    stamp, node = get_stamp(material), nodes.shader_node(material)
    if stamp is None or stamp.kept or node is None:
        return stamp is not None and bool(stamp.kept)
    if nodes.disturbing_sockets(node):
        return True
    # A change of the working space converted the sockets: what they held is not known. Another
    # node holds what somebody set, unless it is the same one by another name.
    return stamp.working_space == working_space_name() and _edited(node, stamp)


def shown(material: Any) -> str:
    """Give all that a surface shows, as far as Rough Spectra sets it, in a text to compare."""
    node = nodes.shader_node(material)
    if node is None:
        return "no Diffuse or Principled BSDF"
    color, roughness = nodes.color_socket(node), nodes.roughness_socket(node)
    values = (*color.default_value[:3], roughness.default_value)
    linked = (color.is_linked, roughness.is_linked, node.mute)
    return repr((node.name, values, linked, nodes.disturbing_sockets(node)))


def settings(group: Any) -> dict[str, str]:
    """Every setting that the color follows from, by its label, and a digest of the spectrum."""
    return {
        "spectrum": hashlib.sha256(group.spectrum.encode()).hexdigest()[:16],
        "kind": group.kind,
        "instrument": group.instrument,
        "σ": f"{sigma_degrees(group):.5f}".rstrip("0").rstrip(".") + "°",
        "illuminant": group.illuminant,
        "model": group.model,
        "shader": group.shader,
        "tolerance": f"{tolerance(group):g}",
        **_scene_settings(group),
    }


def has_scene(group: Any) -> bool:
    """Whether the color follows from an analysis of the scene."""
    return bool(group.use_scene and group.scene_view)


@lru_cache(maxsize=2048)
def analyzed_scene(scene_view: str) -> str:
    """Name of the scene that an analysis is of, from its text; empty if it cannot be read."""
    try:
        return str(json.loads(scene_view)["scene"])
    except (ValueError, KeyError, TypeError):
        return ""


def engine_is_flat() -> bool:
    """Whether the scene's render engine ignores diffuse roughness."""
    scene = bpy.context.scene
    return scene is not None and scene.render.engine in _FLAT_ENGINES


def inputs_digest(group: Any) -> str:
    """Digest of the spectrum and of every setting that the color follows from."""
    told: tuple[str, ...] = (
        group.spectrum,
        group.kind,
        group.instrument,
        f"{sigma_degrees(group):.5f}",
        group.illuminant,
        group.model,
        group.shader,
    )
    if has_scene(group):
        told += (group.scene_view, _engine())
    if tolerance(group) != _USUAL_TOLERANCE:
        told += (f"{tolerance(group)}",)  # so that older stamps stay valid
    return hashlib.sha256("\n".join(told).encode()).hexdigest()[:16]


def elsewhere(material: Any) -> str:
    """Say where a material that cannot be changed here belongs, and what to do."""
    if material.library is not None:
        path = material.library.filepath
        return f"it is linked from {path!r}; make it local to change it, or change it there"
    if material.override_library is not None:
        return "it is a library override, whose nodes Blender resets; make it local to change it"
    if not material.is_editable:
        return "it is read-only; make it local to change it"
    return ""


_NONE = State("none")
_FIELDS = {field.name for field in fields(Stamp)}
_NUMBERS = ("roughness", "delta_e_instrument", "delta_e_mean", "delta_e_95")
_FLAT_ENGINES = {"BLENDER_EEVEE", "BLENDER_EEVEE_NEXT", "BLENDER_WORKBENCH"}


def _engine() -> str:
    return "one without diffuse roughness" if engine_is_flat() else "one with diffuse roughness"


def _scene_settings(group: Any) -> dict[str, str]:
    if not has_scene(group):
        return {"light": "the illuminant's"}
    analysis = hashlib.sha256(group.scene_view.encode()).hexdigest()[:6]
    return {"light": f"the scene's (analysis {analysis})", "render engine": _engine()}


@lru_cache(maxsize=2048)
def _parsed(text: str) -> Stamp | None:
    """Parse a stamp once: a panel asks for it at every draw."""
    try:
        data = json.loads(text)
        # What a newer version noted besides is left out; it raises `SCHEMA` where that matters.
        data = {key: data[key] for key in data if key in _FIELDS}
        red, green, blue = map(float, data["color"])
        data |= {"color": (red, green, blue), "warnings": tuple(map(str, data["warnings"]))}
        data |= {key: float(data[key]) for key in _NUMBERS}
        lights = data.get("delta_e_lights", ())
        data["delta_e_lights"] = tuple((str(name), float(apart)) for name, apart in lights)
        data["settings"] = tuple((str(k), str(v)) for k, v in data.get("settings", {}).items())
        return Stamp(**data)
    except (ValueError, KeyError, TypeError, AttributeError):
        return None


def _changed_inputs(group: Any, stamp: Stamp) -> list[str]:
    if stamp.inputs == inputs_digest(group):
        return []
    before = dict(stamp.settings)
    now = settings(group)
    found = []
    for label, value in before.items():
        if now.get(label, value) == value:
            continue
        if label == "spectrum":
            found.append("the spectrum was replaced")
            continue
        what = label if label == "σ" else f"the {label}"
        old, new = _told(label, value, now[label])
        found.append(f"{what} was changed from {old} to {new}")
    return found or ["the spectrum or a setting was changed"]


def _told(label: str, *values: str) -> list[str]:
    """Write two values of a setting as the panel does, with no more digits than tell them apart."""
    if label != "σ":
        return [title(label, value) for value in values]
    rounded = [f"{float(value.rstrip('°')):.2f}".rstrip("0").rstrip(".") + "°" for value in values]
    return rounded if len(set(rounded)) == len(values) else list(values)


def _changed_surface(material: Any, stamp: Stamp, working_space: str) -> list[str]:
    if stamp.kept and stamp.working_space == working_space:
        if stamp.kept == shown(material):
            return []
        return ["color or roughness was edited by hand after earlier edits were kept"]
    reasons = []
    if stamp.working_space != working_space:
        reasons.append(f"the working space changed from {stamp.working_space} to {working_space}")
    if stamp.derivation != DERIVATION:
        when = "a newer" if stamp.derivation > DERIVATION else "an older"
        reasons.append(f"it was derived by {when} Rough Spectra {stamp.version}".rstrip())
    node = nodes.shader_node(material)
    if node is None or node.name != stamp.node:
        reasons.append(f"the surface no longer comes from {stamp.node!r}")
    elif linked := nodes.linked_sockets(node):
        reasons += [f"{name} comes from another node" for name in linked]
    elif stamp.working_space == working_space and _edited(node, stamp):
        # A change of the working space converts sockets: whether they were edited can't be told.
        reasons.append("color or roughness was edited by hand")
    if node is not None:
        if node.mute:
            reasons.append(f"{node.name!r} is muted")
        reasons += [f"{name} is in use" for name in nodes.disturbing_sockets(node)]
    return reasons


def _edited(node: Any, stamp: Stamp) -> bool:
    color, roughness = nodes.color_socket(node), nodes.roughness_socket(node)
    if color.is_linked or roughness.is_linked:
        return True
    written = (*stamp.color, stamp.roughness)
    found = (*color.default_value[:3], roughness.default_value)
    # Sockets may hold NaN, which is near to nothing.
    near = (abs(a - b) <= _SOCKET_TOLERANCE for a, b in zip(written, found, strict=True))
    return not all(near)
