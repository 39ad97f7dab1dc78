# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands for a geometry that a file does not state: its device's, or 45°/0°, and told."""

from __future__ import annotations

from dataclasses import replace

from ...sample import Sample
from .document import quote
from .geometry_words import ASSUMED, geometry_of_device, in_text, instrument_of


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
