# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels say of a material: composed once for equal facts, and drawn at every redraw."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_tip as tip_

from ....core import instruments, limits, roughness, white_scale
from ....core.errors import RoughSpectraError
from ....core.numerics.memoized import memoized
from ...colorimetry import perceptibility
from ...material import derivation, last_measurement, settled, state, verdict
from ...material.snapshot import Snapshot
from ...samples import gloss_of_set, stated_white
from ...samples.readers.formats import library as library_format
from ...samples.sample import Sample
from .text import Format, Sentence

_KEPT = 1024
"""Materials whose sentences are kept, as many as their states."""

SWATCHES = 98.0
"""Pixels at UI scale 1 that the swatches take beside the numbers."""

_EVERYWHERE = "All angles, mean"
_BOX = 24.0
_ANGLES = (
    "What differs: slanting light, mostly, for Cycles has one roughness for all angles; only a "
    "smaller Roughness comes closer"
)
_LIMITS: dict[verdict.Limit, str] = {
    "nothing": "Nothing differs",
    "engine": "What differs: only Cycles shows the roughness",
    "solid": "Workbench shows no materials, only their viewport colors; the numbers are of Eevee",
    "flat": "Matched for Eevee, which shows no roughness: renew it for Cycles",
    "lights": "What differs: no one color is right under lights of several colors",
    "gloss": "What differs: gloss outshines the color below it, or lets too little of it pass",
    "white": "What differs: the sample reads more there than a white material",
    "gamut": "What differs: {space} cannot hold this color",
    "scene": "Matched to the light of the scene, so {place} differs by ΔE00 {apart}",
    "lambert": "What differs: the roughness was left out; a smaller Tolerance keeps it",
    "angles": _ANGLES,
}
_SLANTING = re.compile(
    r"off by more than ΔE00 (?P<least>\S+) in (?P<share>\d+) % of directions, all slanting, "
    r"at most (?P<most>[\d.]+)"
)
"""What `core.choice` says of a material that is off at slanting angles alone; so do stamps."""
_DAMAGED = (
    *(ValueError, TypeError, AttributeError, KeyError, RecursionError, OverflowError),
    RoughSpectraError,
)
"""What reading damaged text ends in."""

_SHOWN = (
    *(("device", "Device"), ("geometry", "Geometry"), ("aperture", "Aperture")),
    *(("condition", "Condition"), ("specular", "Specular"), ("license", "License")),
    ("gloss_source", "Gloss from"),
)


class Style(NamedTuple):
    """What sentences depend on besides the material: their format, and the language.

    The language is told by its name and by how two of our own texts read, for labels and tooltips
    are translated or not, each as the user prefers.
    """

    format: Format
    locale: str
    label: str
    tip: str


def style(form: Format) -> Style:
    """Give the style of a region in the language of now."""
    locale = bpy.app.translations.locale
    return Style(form, locale, iface_("not visible"), tip_(_ANGLES))


@memoized(maxsize=64)
def of(text: str, icon: str, how: Style) -> tuple[Sentence, ...]:
    """Give one sentence, from a label that is to be translated."""
    return (how.format.sentence(iface_(text), icon),)


def together(count: int, is_exact: bool, how: Style) -> tuple[Sentence, ...]:
    """Say how many selected objects balls and sliders act on."""
    of_all = iface_("{count} selected objects") if is_exact else iface_("up to {count} objects")
    return (how.format.sentence(of_all.format(count=count), "RESTRICT_SELECT_OFF"),)


@memoized(maxsize=_KEPT)
def reasons(found: Snapshot, how: Style) -> tuple[Sentence, ...]:
    """Say why a material's color does not follow from its spectrum."""
    known = state.evaluate(found)
    icon, sentences = "INFO" if known.kind in ("kept", "linked") else "ERROR", []
    for reason in map(tip_, known.reasons):
        sentences.append(how.format.sentence(_capital(reason), icon, _BOX))
        icon = "BLANK1"
    return tuple(sentences)


def refused(why: str, how: Style) -> tuple[Sentence, ...]:
    """Say why a material cannot be renewed, in the words of who would refuse it."""
    return (how.format.sentence(why, "INFO", _BOX),)


@memoized(maxsize=64)
def obstacle(found: settled.Obstacle, how: Style) -> tuple[Sentence, ...]:
    """Say why there is no number."""
    told = tip_(found.template).format(names=found.names)
    return (how.format.sentence(_capital(told), "INFO"),)


def remarks(found: Snapshot, how: Style, details: str = "") -> tuple[Sentence, ...]:
    """Say what was found of a fresh material that has no numbers, as of a texture that was scaled.

    `details` is as of `difference`.
    """
    last = state.evaluate(found).stamp
    notes = _details(details)[1]
    told = () if last is None else (each for each in last.warnings if each not in notes)
    return tuple(how.format.sentence(text, "INFO") for text in told)


@memoized(maxsize=_KEPT)
def numbers(apart: verdict.Numbers, read_at: str, beside: bool, how: Style) -> tuple[Sentence, ...]:
    """Tell how far Blender is from the target, beside the swatches or below them.

    `read_at` is the virtual instrument.
    """
    inset = SWATCHES if beside else 0.0
    told = [
        _difference(iface_(where), delta_e)
        for where, delta_e in zip((_instrument(read_at), iface_(_EVERYWHERE)), apart, strict=False)
    ]
    # The few angles that are further off are told without a word: what is visible is of the mean.
    told.append(iface_("95 % of them: below ΔE00 {}").format(f"{apart[2]:.2f}"))
    # Wrapped, they would run into each other without a mark where each begins.
    return tuple(how.format.sentence(text, "DOT", inset) for text in told)


@memoized(maxsize=_KEPT)
def difference(
    found: Snapshot, apart: verdict.Numbers | None, how: Style, details: str = ""
) -> tuple[Sentence, ...]:
    """Say what limits a fresh material, and why its model and shader were taken.

    `apart` is None until it is computed. `details` is what the file said besides: what was altered
    in reading it is no fault, and stands with the source.
    """
    last = state.evaluate(found).stamp
    if last is None:
        return ()
    told = [(_limit(last, apart, found), "INFO")]
    if found.inputs.model == "auto":
        # Whatever the engine, the target is the surface's.
        text = iface_("Target of the model {}" if found.flat else "Model {}")
        told.append((text.format(last.model_reason), "MODIFIER"))
    told.append((iface_("Material {}").format(_shader(last, found)), "MATERIAL"))
    notes = _details(details)[1]
    told += [(warning, "ERROR") for warning in last.warnings if warning not in notes]
    return tuple(how.format.sentence(text, icon) for text, icon in told)


@memoized(maxsize=_KEPT)
def measurement(
    predicted: float | None, found: last_measurement.LastMeasurement, how: Style
) -> tuple[Sentence, ...]:
    """Put a measured ΔE00 beside the predicted one, of which there may be none."""
    assert found.delta_e is not None
    told = [] if predicted is None else [(_difference(iface_("Predicted"), predicted), "BLANK1")]
    where = iface_("Measured")
    if found.place:
        where = iface_("Measured on {place}").format(place=found.place)
    if found.instrument != instruments.DEFAULT:
        at = (
            iface_("{where} at {instrument}") if found.place else iface_("Measured at {instrument}")
        )
        where = at.format(where=where, instrument=_instrument(found.instrument))
    told.append((_difference(where, found.delta_e), "BLANK1"))
    if found.spread is not None:
        told.append((_difference(iface_("95 % of the spot below"), found.spread), "BLANK1"))
    if not found.current:
        told.append((iface_("Measured before the last change; measure again"), "ERROR"))
    told += [(f"{sentence[:1].upper()}{sentence[1:]}", "ERROR") for sentence in found.unlike]
    return tuple(how.format.sentence(text, icon) for text, icon in told)


@memoized(maxsize=_KEPT)
def scene(found: Snapshot, name: str, how: Style) -> tuple[Sentence, ...]:
    """Say how right a material is under each light of its scene; `name` is the scene's of now."""
    if not found.analyzed:
        return of("Finds the lights and directions that meet the materials in view", "INFO", how)
    last, view = state.evaluate(found).stamp, found.inputs.scene_view
    if not view or last is None:
        return ()
    told = []
    if settled.numbers(found, found.flat) is not None:
        told = [(_difference(light, delta_e), "LIGHT") for light, delta_e in last.delta_e_lights]
        if last.scene_reason:
            told.append((last.scene_reason, "INFO"))
    analyzed = derivation.analyzed_scene(view)
    if analyzed not in {"", name}:
        text = iface_("Analyzed in scene {name}; analyze again if that is not this one")
        told.append((text.format(name=repr(analyzed)), "INFO"))
    return tuple(how.format.sentence(text, icon) for text, icon in told)


@memoized(maxsize=_KEPT)
def source(
    cited: str,
    details: str,
    sigma: tuple[float, str],
    white: tuple[str, float | None, str, str],
    how: Style,
    spectrum: str = "",
) -> tuple[tuple[Sentence, ...], ...]:
    """Say where a spectrum and its σ come from; what the file says of itself stands together.

    `sigma` is σ in degrees and its source; `white` what `core.white_scale.factor` takes: white,
    stated factor, plaque, and instrument. `spectrum` is stored text, for what a set says of gloss.
    """
    about, notes = _details(details)
    notes += _gloss(details, spectrum, white)
    write, (degrees, stated) = how.format.sentence, sigma
    told = [write(f"{iface_('σ from')}: {stated}", "FORCE_TURBULENCE")] if stated else []
    slopes = _slopes(degrees)
    if slopes:
        told.append(write(slopes, "BLANK1" if told else "FORCE_TURBULENCE"))
    return (
        (write(cited or iface_("The source is not known"), "FILE"),),
        tuple(write(f"{iface_(label)}: {value}") for label, value in about),
        (write(_white(*white)), *told, *(write(text, "INFO") for text in notes)),
    )


def _instrument(name: str) -> str:
    """Say an instrument; empty in a damaged file, whose material has no numbers."""
    return iface_(instruments.spoken(name or instruments.DEFAULT))


def _slopes(degrees: float) -> str:
    """Give σ as a profilometer states it; empty where no surface has it."""
    if not 0 <= degrees <= limits.MATCHED_SIGMA_DEGREES:
        return ""
    sigma = math.radians(degrees)
    rdq, sdq = roughness.rdq_from_sigma(sigma), roughness.sdq_from_sigma(sigma)
    text = iface_("σ {degrees}° is an Rdq of {rdq} and an Sdq of {sdq}")
    return text.format(degrees=f"{degrees:.4g}", rdq=f"{rdq:.3f}", sdq=f"{sdq:.3f}")


def _white(name: str, stated: float | None, plaque: str, instrument: str) -> str:
    """Say what values are relative to, and what makes them relative to the perfect diffuser."""
    words = f"{iface_('Relative to')}: {stated_white.told(name, stated, plaque)}"
    if name == white_scale.PERFECT or white_scale.fault(name, instrument, stated, plaque):
        return words
    factor = white_scale.factor(name, instrument, stated, plaque)
    text = iface_("times {factor} it is relative to the perfect diffuser")
    return f"{words}; {text.format(factor=f'{factor:.5g}')}"


def _capital(reason: str) -> str:
    return reason if reason.startswith("σ") else reason[:1].upper() + reason[1:]


def _difference(where: str, delta_e: float) -> str:
    return f"{where}: ΔE00 {delta_e:.2f}, {iface_(perceptibility.words(delta_e))}"


def _limit(last: derivation.Stamp, apart: verdict.Numbers | None, found: Snapshot) -> str:
    limit = verdict.limit(found, last, apart)
    return tip_(_LIMITS[limit]).format(
        space=last.working_space,
        place=_instrument(found.inputs.read_at),
        apart=f"{last.delta_e_instrument:.2f}",
    )


def _shader(last: derivation.Stamp, found: Snapshot) -> str:
    if last.roughness == 0.0 or not found.flat:
        return _SLANTING.sub(_from_the_front, last.shader_reason)
    if found.analyzed and not found.inputs.scene_view:
        return tip_(
            "lambert: this engine leaves the roughness out; check Light from the Scene for the "
            "closest color"
        )
    return tip_(
        "lambert: this engine leaves the roughness out; analyze the scene for the closest color"
    )


def _from_the_front(told: re.Match[str]) -> str:
    """Say first what is right: the few angles that are off are hardly seen."""
    least = float(told["least"])
    front = "looks right" if least < perceptibility.VISIBLE else f"within ΔE00 {least:g}"
    text = tip_(
        "{front} from the front; at slanting angles up to ΔE00 {most} ({share} % of directions)"
    )
    return text.format(front=tip_(front), most=told["most"], share=told["share"])


def _details(text: str) -> tuple[list[tuple[str, str]], list[str]]:
    try:
        data: dict[str, Any] = json.loads(text or "{}")
        shown = [(label, str(data[key])) for key, label in _SHOWN if data.get(key)]
        shown += _set(data.get("others", ()), data.get("gloss", {}))
        return shown, [*map(str, data.get("altered", ())), *map(str, data.get("notes", ()))]
    except _DAMAGED:
        return [], []


def _gloss(details: str, spectrum: str, white: tuple[str, float | None, str, str]) -> list[str]:
    """Say what a set tells of gloss; nothing where it is damaged, which the panel tells itself."""
    if not spectrum or not ('"others"' in details or '"gloss"' in details):
        return []
    relative_to, factor, plaque, instrument = white
    try:
        bands, data = json.loads(spectrum), json.loads(details)
        sample = Sample(
            name="",
            wavelengths=bands["wavelengths"],
            values=bands["values"],
            kind="reading",
            instrument=instrument,
            specular=data.get("specular", ""),
            white=relative_to,
            white_factor=factor,
            plaque="" if factor is not None else plaque,
        )
        held = {key: data[key] for key in ("others", "gloss") if key in data}
        return list(gloss_of_set.sentences(library_format.with_set(sample, held)))
    except _DAMAGED:
        return []


def _set(others: list[dict[str, Any]], gloss: dict[str, float]) -> Iterator[tuple[str, str]]:
    """Say which further readings of the surface a material stores."""
    titles = []
    for other in others:
        menu = instruments.REGISTRY[other.get("instrument", "45a:0")].menu
        titles.append(", ".join(part for part in (menu, other.get("surface", "")) if part))
    if titles:
        yield "Also Read", "; ".join(titles)
    if gloss:
        yield "Gloss", ", ".join(f"{units:g} GU at {angle}°" for angle, units in gloss.items())
