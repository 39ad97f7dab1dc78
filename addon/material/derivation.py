# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What was derived from a material's spectrum and from which settings: the stamp it stores."""

from __future__ import annotations

import hashlib
import json
import math
from collections import OrderedDict
from typing import Any, NamedTuple

from ...core.numerics.memoized import enlist, memoized
from ..samples import stated_white
from . import snapshot
from .snapshot import Inputs

WHAT_CHANGED = {
    2: "σ is the angle of a profilometer's Rdq now, and the surface one of random heights",
}
"""Add a line when the same spectrum and settings come to give another color, beyond rounding:
materials derived before are then stale for that reason, and are renewed with one click."""

DERIVATION = max(WHAT_CHANGED)
"""Version of the way from spectrum and settings to the color."""

_KEPT = 2048
"""Stamps whose texts need no reading; one has about 2 kB."""


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
    gloss
        `Gloss.numbers` of what lay over the color, empty without; None in older files, whose
        colors were matched without gloss.
    measured
        Where the color is that was found by measuring, else an empty string; it is kept then.
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
    gloss: tuple[float, ...] | None = None
    measured: str = ""


def get_stamp(material: Any) -> Stamp | None:
    """Give the stamp, or None where nothing was derived yet or it cannot be read."""
    return parse(material.rough_spectra.stamp)


def settings(found: Inputs) -> dict[str, str]:
    """Every setting that the color follows from, by its label, and a digest of the spectrum."""
    return {
        "spectrum": hashlib.sha256(found.spectrum.encode()).hexdigest()[:16],
        "kind": found.kind,
        "instrument": found.instrument,
        "white": stated_white.told(*found.white),
        "σ": f"{found.sigma_degrees:.5f}".rstrip("0").rstrip(".") + "°",
        "illuminant": found.illuminant,
        "model": found.model,
        "shader": found.shader,
        "tolerance": f"{found.tolerance:g}",
        "virtual instrument": found.read_at,
        **_scene_settings(found),
    }


@memoized(maxsize=2048)
def analyzed_scene(scene_view: str) -> str:
    """Name of the scene that an analysis is of, from its text; empty if it cannot be read."""
    try:
        return str(json.loads(scene_view)["scene"])
    except (ValueError, KeyError, TypeError, RecursionError):
        return ""


def inputs_digest(group: Any) -> str:
    """Digest of the spectrum and of every setting that the color follows from."""
    return snapshot.digest(snapshot.inputs(group))


def is_current(stamp: Stamp, found: Inputs) -> bool:
    """Whether a stamp is of spectrum and settings as they are.

    Which engine it was matched for is no setting: what is in the node is right or not as before,
    whichever engine shows it.
    """
    either = (found, found._replace(flat=not found.flat)) if found.scene_view else (found,)
    return stamp.inputs in map(snapshot.digest, either)


def matched_flat(stamp: Stamp) -> bool | None:
    """Whether it was matched for an engine without roughness; None where there was no scene."""
    engine = dict(stamp.settings).get(_ENGINE)
    return None if engine is None else engine == snapshot.engine_words(True)


_ENGINE = "render engine"
_NUMBERS = ("roughness", "delta_e_instrument", "delta_e_mean", "delta_e_95")


def _scene_settings(found: Inputs) -> dict[str, str]:
    if not found.scene_view:
        return {"light": "the illuminant's"}
    analysis = hashlib.sha256(found.scene_view.encode()).hexdigest()[:6]
    engine = snapshot.engine_words(found.flat)
    return {"light": f"the scene's (analysis {analysis})", _ENGINE: engine}


_TEXTS = (
    *("inputs", "working_space", "node", "model", "model_reason", "shader_reason"),
    *("scene_reason", "version", "kept", "measured"),
)


def to_text(stamp: Stamp) -> str:
    """Write a stamp as it is stored; `parse` then knows the text without reading it."""
    data = stamp._asdict() | {"settings": dict(stamp.settings)}
    text = json.dumps(data)
    if all(map(math.isfinite, _numbers(stamp))):  # else nobody could read it
        _keep(text, stamp)
    return text


def parse(text: str) -> Stamp | None:
    """Read a stored stamp; None where it cannot be read."""
    if text in _known:
        _known.move_to_end(text)
    else:
        _keep(text, _read(text))
    return _known[text]


_known: OrderedDict[str, Stamp | None] = OrderedDict()
"""Stamps by their texts, those used last: who drags a slider writes one a step, and reads it."""
enlist(__name__, "_known", _known.__len__, _known.clear)


def _numbers(stamp: Stamp) -> list[float]:
    found = [*stamp.color, *(getattr(stamp, name) for name in _NUMBERS)]
    found += [apart for _, apart in stamp.delta_e_lights]
    found += stamp.gloss or ()
    return found if stamp.sigma_max is None else [*found, stamp.sigma_max]


def _keep(text: str, stamp: Stamp | None) -> None:
    _known[text] = stamp
    _known.move_to_end(text)
    if len(_known) > _KEPT:
        _known.popitem(last=False)


def _read(text: str) -> Stamp | None:
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
        if data.get("gloss") is not None:
            data["gloss"] = tuple(map(_number, data["gloss"]))
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
