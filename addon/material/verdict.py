# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One verdict on a material: whether it looks as it was measured, and the one thing to do if not.

Only compares what is stored and what was computed with the pictures: cheap enough for a panel to
draw. What it says is of the mean over all angles and of the reading at the instrument; the few
angles near grazing that are further off are told among the numbers.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

from ...core.gloss import IMPOSSIBLE
from ...core.limits import MATCHED_SIGMA_DEGREES
from ..colorimetry import perceptibility
from ..matching import outside
from . import settled, state
from .derivation import DERIVATION, Stamp, is_current, matched_flat
from .last_measurement import LastMeasurement
from .properties import SCHEMA
from .snapshot import KNOWN_ENGINES, Snapshot
from .state import State

Mark = Literal["right", "near", "off", "open"]
Limit = Literal[
    "nothing",
    "engine",
    "lights",
    "gloss",
    "white",
    "gamut",
    "scene",
    "lambert",
    "angles",
    "flat",
    "solid",
]
Remedy = Literal[
    "", "cycles", "rendered", "local", "renew", "wide", "matte", "smoother", "measure", "unmute"
]

WIDE_SPACE = "ACEScg"
"""Working space that holds nearly all colors of surfaces."""

_WORKBENCH = "BLENDER_WORKBENCH"
_WIDE = {WIDE_SPACE, "Linear Rec.2020"}
_NOTHING = 0.005
"""ΔE00 that is written as 0.00."""
_MISSED = 0.05
"""ΔE00 at the instrument from where on the reading is missed: below, it is rounding."""

Numbers = tuple[float, float, float]
"""ΔE00 at the instrument, and mean and 95th percentile over all angles."""

_DIFFERS: dict[Limit, tuple[str, Remedy]] = {
    "solid": ("Workbench shows no materials", "cycles"),
    "engine": ("differs: Eevee lacks roughness", "cycles"),
    "flat": ("matched for Eevee, flat", "renew"),
    "lights": ("differs: several lights", ""),
    "gloss": ("differs: too glossy", "matte"),
    "white": ("differs: beyond white", ""),
    "gamut": ("differs: out of gamut", "wide"),
    "scene": ("differs: matched to scene", ""),
    "lambert": ("differs: left smooth", ""),
    "angles": ("differs: some angles", ""),
    "nothing": ("differs: unknown", ""),
}

_NEARLY: dict[Limit, str] = {
    "engine": "Eevee lacks roughness",
    "flat": "matched for Eevee, flat",
    "gloss": "slightly too glossy",
    "white": "slightly beyond white",
    "gamut": "slightly out of gamut",
    "lights": "slightly off: several lights",
    "scene": "slightly off: matched to scene",
    "lambert": "slightly off: left smooth",
    "angles": "slightly off at some angles",
}
"""What is said of these where the difference is small: where it is, or what it comes from."""

_SLIGHTLY = "slightly off"


class Verdict(NamedTuple):
    """What is said of a material, in three words or so.

    Parameters
    ----------
    mark
        "right", "near": seen beside the sample only, "off", or "open" where nothing is predicted.
    words
        An English label, to be translated.
    remedy
        The one thing to do about it; empty where there is none.
    """

    mark: Mark
    words: str
    remedy: Remedy = ""


def of(
    found: Snapshot,
    apart: Numbers | None,
    previewed: bool = False,
    measured: LastMeasurement | None = None,
) -> Verdict:
    """Judge a material with a spectrum.

    Parameters
    ----------
    found
        Its facts.
    apart
        ΔE00 of what it shows; None until they are computed, or where there are none.
    previewed
        Whether the window shows it by another engine than the scene's.
    measured
        Its last measurement, which counts where nothing is predicted.
    """
    known = state.evaluate(found)
    if known.kind == "linked":
        return Verdict("open", "linked: settings locked", "local")
    if known.kind == "error":
        return _failed(found)
    if known.kind == "stale":
        return _stale(found, known.stamp, measured)
    if known.kind == "kept":
        return _kept(known)
    if found.surface is not None and found.surface.scaled:
        return _scaled(found, known.stamp)
    if settled.obstacle(found.surface) is not None:
        return _measured(measured)
    if apart is None or known.stamp is None:
        return Verdict("open", "comparing")
    judged = _judged(found, known.stamp, apart)
    if previewed and judged.mark != "off":
        return Verdict("near", "preview is Eevee", "rendered")
    return judged


def _scaled(found: Snapshot, last: Stamp | None) -> Verdict:
    """Judge a texture by its mean reading, which is all that a scale decides."""
    apart = 0.0 if last is None else last.delta_e_instrument
    if last is None or apart < perceptibility.SIDE_BY_SIDE:
        return Verdict("right", "texture follows sample")
    mark: Mark = "near" if apart < perceptibility.VISIBLE else "off"
    if any(outside.TOO_DARK in each for each in last.warnings):
        return Verdict(mark, "differs: texture too dark")
    words, remedy = _DIFFERS[limit(found, last, None)]
    if remedy == "wide" and not has_wider_space(found.working_space):
        remedy = ""
    return Verdict(mark, words, remedy)


def limit(found: Snapshot, last: Stamp, apart: Numbers | None) -> Limit:
    """Say what keeps the match of a material that is up to date from being better."""
    if found.engine == _WORKBENCH:
        return "solid"
    is_flat = bool(matched_flat(last)) and found.inputs.sigma_degrees > 0.0
    if is_flat and not found.flat:
        return "flat"
    if apart is not None and max(apart) < _NOTHING:
        return "nothing"
    if found.flat and (last.roughness > 0.0 or is_flat):
        return "engine"
    lights = [delta_e for _, delta_e in last.delta_e_lights]
    several = len(lights) > 1
    # Where lights mix everywhere, it is at the instrument, under the main one alone, that it shows.
    if (
        several
        and max(max(lights) - min(lights), last.delta_e_instrument) >= perceptibility.SIDE_BY_SIDE
    ):
        return "lights"
    if last.delta_e_instrument > _MISSED:
        # It is the gloss where no color below it reads as the sample.
        if any(IMPOSSIBLE in each for each in last.warnings):
            return "gloss"
        if any(map(outside.is_beyond_white, last.warnings)):
            return "white"
        if any(map(outside.is_of_gamut, last.warnings)):
            return "gamut"
        if lights and not several:
            return "scene"  # the least mean over its directions is not at the instrument
    return "lambert" if last.roughness == 0.0 else "angles"


def _judged(found: Snapshot, last: Stamp, apart: Numbers) -> Verdict:
    if last.sigma_max is not None and last.sigma_max < found.inputs.sigma_degrees:
        # However well it is matched: no surface this rough reads so.
        return Verdict("off", "brighter than possible", "smoother")
    seen, why = max(apart[:2]), limit(found, last, apart)
    words, remedy = _DIFFERS[why]
    if why == "solid":
        return Verdict("open", words, remedy)
    if found.engine not in KNOWN_ENGINES:
        return Verdict("open", "engine not predicted", "cycles")
    if seen < perceptibility.SIDE_BY_SIDE:
        if matched_flat(last) and why in {"engine", "flat"}:
            # Right for its scene, and yet not as rough as stands above.
            return Verdict("near", _NEARLY["flat"], remedy)
        return Verdict("right", "looks right")
    if remedy == "wide" and not has_wider_space(found.working_space):
        remedy = ""
    near = seen < perceptibility.VISIBLE
    if near:
        words = _NEARLY.get(why, _SLIGHTLY)
    return Verdict("near" if near else "off", words, remedy)


def has_wider_space(name: str) -> bool:
    """Whether the file can be let work in a wider space than the one of this name."""
    import bpy

    return hasattr(bpy.data, "colorspace") and name not in _WIDE


def _failed(found: Snapshot) -> Verdict:
    if found.schema > SCHEMA:
        return Verdict("open", "needs newer version")
    if found.inputs.sigma_degrees > MATCHED_SIGMA_DEGREES:
        return Verdict("off", "too rough", "smoother")
    return Verdict("off", "could not follow", "renew")


def _measured(last: LastMeasurement | None) -> Verdict:
    """Judge by a measurement what no number is predicted of; its ΔE00 is told in Details."""
    if last is None or last.delta_e is None:
        return Verdict("open", "cannot be predicted", "measure")
    if not last.current:
        return Verdict("open", "changed since measured", "measure")
    if last.delta_e >= perceptibility.VISIBLE:
        return Verdict("off", "measured: differs", "measure")
    near = last.delta_e >= perceptibility.SIDE_BY_SIDE
    words = _SLIGHTLY if near else "looks right"
    if last.unlike:
        return Verdict("open", f"measured flat: {words}")
    return Verdict("near" if near else "right", f"measured: {words}")


def _stale(found: Snapshot, last: Stamp | None, measured: LastMeasurement | None) -> Verdict:
    surface = found.surface
    if last is None:
        return Verdict("off", "not matched yet", "renew")
    if found.inputs.sigma_degrees > MATCHED_SIGMA_DEGREES:
        return Verdict("off", "too rough", "smoother")
    if surface is not None and surface.muted:
        return Verdict("off", "node is muted", "unmute")
    if surface is not None and surface.disturbing:
        return _measured(measured)
    if surface is not None and surface.roughness_linked:
        return Verdict("off", "roughness is linked", "renew")
    if surface is not None and surface.linked:
        return Verdict("off", "texture not matched", "renew")
    if surface is None or surface.node != last.node:
        return Verdict("off", "another shader", "renew")
    if last.working_space != found.working_space:
        return Verdict("off", "color space changed", "renew")
    if last.derivation != DERIVATION:
        return Verdict("off", "of another version", "renew")
    if state.edited(surface, last):
        return Verdict("off", "edited by hand", "renew")
    if not is_current(last, found.inputs):
        return Verdict("off", "settings changed", "renew")
    return Verdict("off", "gloss changed", "renew")


def _kept(known: State) -> Verdict:
    if known.stamp is not None and known.stamp.measured:
        return Verdict("right", "found by measuring")
    return Verdict("open", "edited, and kept", "renew")
