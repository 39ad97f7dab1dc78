# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Say everything that is wrong with a preset, not only the first fault."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ...core.errors import InputError
from ...core.limits import COLOR_NM
from . import quality
from .readers import open_document
from .readers.formats import preset
from .readers.parts import preset_fields


@dataclass(frozen=True)
class Verdict:
    """What was found in one file.

    Parameters
    ----------
    faults
        Sentences with file, field and remedy; empty for a preset that can be used.
    remarks
        What to know of a spectrum that can be used.
    """

    faults: tuple[str, ...]
    remarks: tuple[str, ...]


def validate(path: Path) -> Verdict:
    """Check a preset file against all that the format asks for."""
    try:
        document = open_document(path)
        fields = preset.fields_of(document)
    except InputError as error:
        return Verdict((str(error),), ())
    found = [
        *preset_fields.faults(fields),
        *preset_fields.beyond(fields),
        *preset_fields.unknown(fields),
    ]
    faults = [str(document.error(f"field '{field}'", sentence)) for field, sentence in found]
    # A spectrum with faults of its own is looked at even where another field is wrong as well.
    if any(field in ("wavelengths", "values") for field, _ in found):
        return Verdict(tuple(faults), ())
    whole = {**_STAND_IN, **{name: fields[name] for name in ("wavelengths", "values")}}
    try:
        sample = preset.sample_of(document, whole if faults else fields)
    except InputError as error:
        return Verdict((*faults, str(error)), ())
    first, last = sample.wavelengths[0], sample.wavelengths[-1]
    # What has no color serves for emissivity, and a remark says so.
    if sample.has_color and (first > COLOR_NM[0] or last < COLOR_NM[1]):
        sentence = (
            f"it covers {first:g} to {last:g} nm, but a color needs {COLOR_NM[0]:g} to "
            f"{COLOR_NM[1]:g} nm; measure the whole range"
        )
        faults.append(str(document.error("field 'wavelengths'", sentence)))
    remarks = () if faults else quality.check_each([sample])[0]
    return Verdict(tuple(faults), tuple(f"{path}: {sentence}" for sentence in remarks))


_STAND_IN = {
    "name": "?",
    "source": "?",
    "license": "?",
    "kind": "reading",
    "instrument": "45a:0",
    "sigma_degrees": None,
    "sigma_source": "?",
}
"""For fields that are wrong themselves, so that the spectrum can be judged all the same."""
