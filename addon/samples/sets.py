# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several readings of one surface, held together by one sample: which is which, and in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ...core.instruments import REGISTRY
from .sample import Sample

SMOOTH = "smooth"


def label(sample: Sample) -> str:
    """Name a reading among those of its set, such as ``"de:8°"`` or ``"45°:as15°, smooth"``."""
    title = REGISTRY[sample.instrument].title.split(",")[0]
    surface = SMOOTH if is_smooth(sample) else ""
    return ", ".join(part for part in (title, surface) if part)


def is_smooth(sample: Sample) -> bool:
    """Return whether a reading is stated to be of the smooth surface of its material."""
    return sample.surface.strip().lower() == SMOOTH


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
