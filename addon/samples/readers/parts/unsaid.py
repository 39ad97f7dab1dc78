# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands for a geometry that a file does not state: its device's, its name's, or 45°/0°."""

from __future__ import annotations

from dataclasses import replace

from ...sample import Sample
from . import name_marks
from .document import plain, quote
from .geometry_words import (
    ASSUMED,
    device_in_text,
    geometry_of_device,
    in_text,
    instrument_of,
    specular_of,
)


def told(sample: Sample) -> Sample:
    """Return a sample of any format that does not count as 45°/0° without a word.

    What already has a geometry, or a note about it, is returned as it is, but for the note that one
    is assumed where the device is known.
    """
    if sample.kind != "reading" or sample.geometry or sample.specular:
        return sample
    assumed = instrument_of("")[1]
    about = [note for note in sample.notes if "geometry" in note]
    if sample.instrument != ASSUMED or (about and about != [assumed]):
        return sample
    geometry, specular = in_text(sample.device)
    known = geometry or geometry_of_device(sample.device)
    others = tuple(note for note in sample.notes if note != assumed)
    if not known and not specular:
        return sample if about else replace(sample, notes=(*others, assumed))
    instrument, why = instrument_of(known or "d/8", specular)
    note = f"The geometry {known or 'd/8'} is that of the device {quote(sample.device)}."
    return replace(
        sample,
        instrument=instrument,
        geometry=geometry,
        specular=specular,
        notes=(note, *((why,) if why else ()), *others),
    )


def by_file_name(samples: list[Sample], stem: str) -> list[Sample]:
    """Return samples for which 45°/0° is assumed as measured so as their file's name says.

    Parameters
    ----------
    samples
        Of one file, after `told`.
    stem
        The file's name without its ending, such as ``"brick_SCE"`` or ``"tiles CM-700d"``.
    """
    geometry, specular, device = _of_name(stem)
    if not (geometry or specular or device):
        return samples
    instrument, why = instrument_of(geometry or "d/8", specular)
    note = (
        f"The geometry {geometry or 'd/8'}{f', {specular},' if specular else ''} follows from the "
        f"file's name {quote(plain(stem))}; if it is another, state it in the file."
    )
    assumed = instrument_of("")[1]
    return [
        replace(
            sample,
            instrument=instrument,
            geometry=geometry,
            specular=specular,
            device=sample.device or device,
            notes=(note, *((why,) if why else ()), *(n for n in sample.notes if n != assumed)),
        )
        if assumed in sample.notes and not sample.others
        else sample
        for sample in samples
    ]


def _of_name(stem: str) -> tuple[str, str, str]:
    """Return geometry, specular component and device that a file's name states, mostly empty."""
    words = stem.replace("_", " ")
    mark = name_marks.of_name(stem)
    if mark.geometry:
        return mark.geometry, specular_of(mark.geometry), ""
    if mark.specular and mark.sure:
        return "", mark.specular, ""
    if mark.aspecular is not None and mark.sure:
        return f"45as{mark.aspecular}", "", ""
    geometry, specular = in_text(words)
    if geometry or specular:
        return geometry, specular, ""
    device = device_in_text(words)
    return geometry_of_device(device), "", device if geometry_of_device(device) else ""
