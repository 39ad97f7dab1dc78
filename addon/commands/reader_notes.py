# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What readers have to tell of measurement files, on standard error."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import replace

from ..samples import sets
from ..samples.readers.parts.geometry_words import instrument_of
from ..samples.sample import Sample
from ..support.shown_text import tell


def tell_notes(samples: Iterable[Sample]) -> None:
    """Tell the notes of samples that come from files, each once, with the first file it is of.

    Presets and what is no reading any more are passed over: their geometry does not count.
    """
    files: dict[str, list[str]] = {}
    for sample in samples:
        if sample.kind == "reading" and os.path.isfile(sample.source):
            for sentence in (*sample.notes, *sets.sentences(sample)):
                files.setdefault(sentence, []).append(sample.source)
    for sentence, sources in files.items():
        first, *others = dict.fromkeys(sources)
        more = f" and {len(others)} more" if others else ""
        tell(f"warning: {first}{more}: {sentence}")


def read_by(sample: Sample, instrument: str) -> Sample:
    """Return a sample that the user says was read by an instrument, whatever its file says.

    What was noted about the file's geometry is settled then.
    """
    settled = instrument_of(sample.geometry, sample.specular)[1]
    kept = tuple(note for note in sample.notes if note != settled)
    return replace(sample, instrument=instrument, notes=kept)
