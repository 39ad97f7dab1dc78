# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of one surface in one file, joined to one sample: SCI and SCE, angles, smooth and rough.

Readings belong together that have one name, apart from such a mark, or that come from one record,
if each says how it was measured and no two say the same. Where that is not so, as with two readings
of one name and one geometry, all stay apart: which is which is not ours to guess.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Hashable, Sequence
from dataclasses import replace
from pathlib import PurePath

from .....core.instruments import HEMISPHERE, REGISTRY
from ... import sets
from ...sample import Sample
from . import name_marks
from .document import quote
from .geometry_words import ASSUMED, instrument_of, is_multi_angle, specular_of
from .name_marks import Mark

ANGLE = "angle "
"""How the geometry begins of readings whose file states just an angle."""

_ASPECULAR = {i.aspecular for i in REGISTRY.values() if i.aspecular is not None}
_LEAST_ANGLES = 3  # that tell a multi-angle instrument by themselves
_LEAST_NUMBERS = 5  # samples may be called 15, 25 and 45
_CONDITION = re.compile(r"[\s_(\[](M[0-3])[)\]]?$")
_BRACKETS = re.compile(r"\s*\([^()]*\)$")
_LONGEST = 200


def joined(samples: Sequence[Sample]) -> list[Sample]:
    """Return the samples of a file with each set as one, at the place of its first reading."""
    marks = [name_marks.of_name(sample.name) for sample in samples]
    marks = _trusted(samples, marks)
    known = [_resolved(sample, mark) for sample, mark in zip(samples, marks, strict=True)]
    groups: dict[Hashable, list[int]] = {}
    records = Counter((sample.position, sample.condition) for sample in known)
    for i, (sample, mark) in enumerate(zip(known, marks, strict=True)):
        place = (sample.position, sample.condition)
        of_record = bool(sample.position) and records[place] > 1
        key = ("record", *place) if of_record else ("name", mark.base, sample.condition)
        groups.setdefault(key, []).append(i)
    found: list[tuple[int, Sample]] = []
    for members in groups.values():
        for part in _surfaces(known, members):
            joint = _joint([known[i] for i in part], [marks[i] for i in part])
            found += [(part[0], joint)] if joint else [(i, known[i]) for i in part]
    return [sample for _, sample in sorted(found, key=lambda pair: pair[0])]


def rank(sample: Sample) -> tuple[bool, bool, int, int]:
    """Return what puts the reading first that a set's color is made from.

    The rough surface comes before the smooth one; then a geometry that is computed as stated; then
    45°/0° before the sphere without gloss and that with it; then angles far from the gloss.
    """
    instrument = REGISTRY[sample.instrument]
    aspecular = instrument.aspecular
    if instrument.light == HEMISPHERE:
        kind = 2 if instrument.trap else 3
    elif {instrument.light.tilt, instrument.view.tilt} == {0.0, 45.0}:
        kind = 0 if aspecular is None else 1
    else:
        kind = 4
    far = 0 if aspecular is None else -abs(aspecular)
    return sets.is_smooth(sample), not sets.is_exact(sample), kind, far


def _trusted(samples: Sequence[Sample], marks: list[Mark]) -> list[Mark]:
    """Return the marks with those taken away that may be part of a name like any other."""
    pairs: dict[str, set[str]] = {}
    angles: dict[str, set[int | None]] = {}
    devices: dict[str, bool] = {}
    for i, (sample, mark) in enumerate(zip(samples, marks, strict=True)):
        if sample.geometry.startswith(ANGLE) and mark.angle is mark.aspecular is None:
            mark = marks[i] = replace(
                mark, angle=name_marks.angle_of(sample.geometry.removeprefix(ANGLE))
            )
        pairs.setdefault(mark.base, set()).add(mark.specular or sample.specular)
        if mark.angle is not None:
            angles.setdefault(mark.base, set()).add(mark.angle)
        device = is_multi_angle(f"{sample.device} {sample.geometry}")
        devices[mark.base] = devices.get(mark.base, False) or device
    return [
        _settled(sample, mark, pairs[mark.base], angles.get(mark.base, set()), devices[mark.base])
        for sample, mark in zip(samples, marks, strict=True)
    ]


def _settled(
    sample: Sample, mark: Mark, speculars: set[str], angles: set[int | None], device: bool
) -> Mark:
    """Return a mark, or the whole name where it may be part of one.

    `speculars` and `angles` are those of all samples of that name; `device` whether one of them is
    a multi-angle device's.
    """
    if mark.specular:
        trusted = mark.sure or {"SCI", "SCE"} <= speculars
    elif mark.aspecular is not None:
        trusted = mark.sure or mark.aspecular in _ASPECULAR
    elif mark.angle is not None:
        least = _LEAST_NUMBERS if mark.bare else _LEAST_ANGLES
        known = angles <= _ASPECULAR and len(angles) >= least
        trusted = known or (device and mark.angle in _ASPECULAR)
        mark = replace(mark, aspecular=mark.angle)
    else:
        return mark
    return mark if trusted else Mark(sample.name)


def _resolved(sample: Sample, mark: Mark) -> Sample:
    """Return a sample with what its name says of the measurement, where its file does not."""
    if sample.kind != "reading":
        return sample
    condition = "" if sample.condition else _CONDITION.search(sample.name[-8:])
    if condition:
        sample = replace(sample, condition=condition[1])
    if mark.specular and not sample.specular and _may_be_a_sphere(sample):
        note = (
            f"That it is a sphere's reading, {mark.specular}, follows from its name; if it is not, "
            "state the geometry in the file."
        )
        return _measured(sample, sample.geometry or "d/8", note, mark.specular)
    bare = not sample.specular and (not sample.geometry or sample.geometry.startswith(ANGLE))
    if mark.geometry and bare:
        note = f"The geometry {mark.geometry} follows from its name."
        return _measured(sample, mark.geometry, note, specular_of(mark.geometry))
    if mark.aspecular is not None and bare:
        note = "" if mark.angle is None else _ANGLES
        return _measured(sample, f"45as{mark.aspecular}", note, "")
    if bare and not sample.geometry and is_multi_angle(sample.device):
        kept = (note for note in sample.notes if note != instrument_of("")[1])
        return replace(sample, notes=(_NO_ANGLE.format(quote(sample.device)), *kept))
    return sample


_ANGLES = "Its angle is taken from the mirror direction, with light at 45°: a multi-angle device's."
_NO_ANGLE = (
    "The device {} reads at several angles, and the file does not say at which; 45°/0° is assumed."
)


def _may_be_a_sphere(sample: Sample) -> bool:
    return not sample.geometry or REGISTRY[sample.instrument].light == HEMISPHERE


def _measured(sample: Sample, geometry: str, note: str, specular: str) -> Sample:
    """Return a sample measured so, with the notes on its geometry instead of those before."""
    before = {instrument_of(said, sample.specular)[1] for said in (sample.geometry, geometry)}
    instrument, why = instrument_of(geometry, specular)
    kept = (text for text in sample.notes if text not in before)
    return replace(
        sample,
        instrument=instrument,
        geometry=geometry if geometry != "d/8" else sample.geometry,
        specular=specular,
        notes=(*(text for text in (note, why) if text), *kept),
    )


def _surfaces(samples: Sequence[Sample], members: list[int]) -> list[list[int]]:
    """Return the members apart by their surface; a smooth one belongs to the only rough one."""
    rough = {s.surface for s in map(samples.__getitem__, members) if not sets.is_smooth(s)}
    if len(rough) <= 1:
        return [members]
    parts: dict[str, list[int]] = {}
    for i in members:
        parts.setdefault(samples[i].surface, []).append(i)
    return list(parts.values())


def _joint(members: list[Sample], marks: list[Mark]) -> Sample | None:
    """Return readings as one sample, or None where they are one or not clearly a set."""
    if len(members) < 2 or any(member.kind != "reading" for member in members):
        return None
    keys = [_key(member) for member in members]
    unsaid = Counter(smooth for smooth, stated in keys if not stated)
    counts = Counter(smooth for smooth, _ in keys)
    if len(set(keys)) < len(keys) or any(counts[smooth] > 1 for smooth in unsaid):
        return None
    gloss: dict[float, float] = {}
    for angle, units in (pair for member in members for pair in member.gloss):
        if gloss.setdefault(angle, units) != units:
            return None
    rough = [m.sigma_degrees for m in members if not sets.is_smooth(m)]
    stated = {sigma for sigma in rough if sigma is not None}
    if len(stated) > 1:
        return None
    main = min(members, key=rank)
    others = tuple(
        replace(member, gloss=(), gloss_source="") for member in members if member is not main
    )
    name = _name(main, members, marks)
    of_gloss = next((m for m in members if m.gloss and m.gloss_source), main)
    of_sigma = next((m for m in members if m.sigma_degrees in stated), main)
    return replace(
        main,
        name=name,
        called="" if main.name == name else main.name,
        others=others,
        gloss=tuple(gloss.items()),
        gloss_source=of_gloss.gloss_source,
        sigma_degrees=of_sigma.sigma_degrees,
        sigma_source=of_sigma.sigma_source,
        notes=(_note(main, others), *main.notes),
    )


def _key(sample: Sample) -> tuple[bool, str]:
    """Return which reading of a set one is; the text is empty where nothing says."""
    stated = sets.stated(sample)
    if not stated and sample.instrument == ASSUMED:
        return sets.is_smooth(sample), ""
    known = sample.instrument if sets.is_exact(sample) else f"{stated} {sample.specular}"
    return sets.is_smooth(sample), known


def _name(main: Sample, members: list[Sample], marks: list[Mark]) -> str:
    """Return the name of a set: what its readings' names have in common."""
    bases = {mark.base.strip() for mark in marks}
    plain = {_BRACKETS.sub("", member.name).strip() for member in members}
    for names in (bases, plain):
        if len(names) == 1 and names != {""}:
            return next(iter(names))
    if bases == {""} and main.source:
        return PurePath(main.source).stem
    return main.name or next((m.name for m in members if m.name), "")


def _note(main: Sample, others: Sequence[Sample]) -> str:
    also = ", ".join(map(sets.label, others))
    return (
        f"These are {len(others) + 1} readings of one surface: the color is made from that at "
        f"{sets.label(main)}; kept beside it: {also}."
    )
