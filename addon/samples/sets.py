# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several readings of one surface, held together by one sample: which is which, and in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ...core.instruments import REGISTRY
from .readers.parts.document import quote
from .readers.parts.geometry_words import NO_ANGLE, instrument_of
from .sample import Sample

SMOOTH = "smooth"

_LONGEST = 200  # characters of a geometry


def label(sample: Sample) -> str:
    """Name a reading among those of its set, such as ``"de:8°"`` or ``"45°:as15°, smooth"``.

    One that no instrument has is named as its file does.
    """
    title = REGISTRY[sample.instrument].title.split(",")[0]
    if not is_exact(sample):
        title = quote(stated(sample))
    surface = SMOOTH if is_smooth(sample) else ""
    return ", ".join(part for part in (title, surface) if part)


def is_smooth(sample: Sample) -> bool:
    """Return whether a reading is stated to be of the smooth surface of its material."""
    return sample.surface.strip().lower() == SMOOTH


def stated(sample: Sample) -> str:
    """Return the geometry in the file's words, a sphere's where it says no more than SCI or SCE."""
    return sample.geometry[:_LONGEST] or ("d/8" if sample.specular else "")


def is_exact(sample: Sample) -> bool:
    """Return whether the instrument is the geometry that the file states, and not one near it.

    A sphere's angle is 8° where nobody says another, and it is told whether gloss is in.
    """
    words = stated(sample)
    if not words:
        return True
    note = instrument_of(words, sample.specular)[1]
    return "azimuth" not in words and (not note or (NO_ANGLE in note and bool(sample.specular)))


def at(sample: Sample, instrument: str) -> Sample:
    """Return the set with the reading of an instrument first, if it has one of the same surface.

    Its name, σ and gloss stay. What has none such, or is no reading, is returned as it is.
    """
    if sample.kind != "reading" or sample.instrument == instrument or not sample.others:
        return sample
    found = [
        other
        for other in sample.others
        if (other.instrument, is_smooth(other)) == (instrument, is_smooth(sample))
        and is_exact(other)
    ]
    if len(found) != 1:
        return sample
    [first] = found
    alone = replace(sample, name=sample.called or sample.name, called="", others=(), gloss=())
    return replace(
        first,
        name=sample.name,
        called="" if first.name == sample.name else first.name,
        others=(alone, *(other for other in sample.others if other is not first)),
        gloss=sample.gloss,
        sigma_degrees=sample.sigma_degrees,
        sigma_source=sample.sigma_source,
    )


def count(sample: Sample) -> int:
    """Return how many readings a sample has, gloss units not counted."""
    return len(sample.readings)


def summary(sample: Sample) -> str:
    """Say what a set holds beside the reading that the color is made from; empty without one."""
    others = ", ".join(map(label, sample.others))
    parts = [f"{count(sample)} readings (also {others})"] if others else []
    units = ", ".join(f"{units:g} GU at {angle:g}°" for angle, units in sample.gloss)
    return "; ".join([*parts, *([units] if units else [])])


def by_name(samples: Sequence[Sample]) -> dict[str, Sample]:
    """Return samples by name, the first of each, and single readings of sets by their own names.

    What was chosen by the name that a reading has in its file stays that reading.
    """
    found: dict[str, Sample] = {}
    for sample in samples:
        found.setdefault(sample.name, sample)
    for sample in samples:
        for other in sample.others:
            found.setdefault(other.name, other)
        if sample.called:
            alone = replace(
                sample, name=sample.called, called="", others=(), gloss=(), gloss_source=""
            )
            found.setdefault(sample.called, alone)
    return found


def sentences(sample: Sample) -> Iterable[str]:
    """Give what is to be known of a sample's other readings, each named, and said once."""
    told = {*sample.notes, *sample.altered}
    for other in sample.others:
        for sentence in (*other.altered, *other.notes):
            if sentence not in told:
                told.add(sentence)
                yield f"Reading at {label(other)}: {sentence}"
