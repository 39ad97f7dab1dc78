# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: one material a JSON file, whose fields `preset_fields` lists."""

from __future__ import annotations

from typing import Any

from ...sample import Sample, check_spectrum
from ...stated_white import fields as white_fields
from ..parts import json_object
from ..parts.document import Document
from ..parts.preset_fields import FORMAT, faults, stated_sigma

NAME = "Rough Spectra preset"
ENDINGS = ("json",)
PRIORITY = 100
SETS = True

_OPTIONAL = (
    *("quantity", "geometry", "aperture", "specular", "device", "condition"),
    *("illuminant", "observer", "lab", "xyz", "notes", "altered"),
)


def sniff(document: Document) -> bool:
    """Return whether the head is of a JSON object that names this format."""
    return json_object.names(document, FORMAT)


def read(document: Document) -> list[Sample]:
    """Return the one sample of a preset.

    Raises
    ------
    InputError
        The file is not JSON, is of a newer schema, or a field is missing or has another type than
        it should; the message names the field.
    """
    fields = fields_of(document)
    for field, sentence in faults(fields):
        raise document.error(f"field '{field}'", sentence)
    return [sample_of(document, fields)]


def sample_of(document: Document, fields: dict[str, Any]) -> Sample:
    """Make the sample of fields that have no fault.

    Raises
    ------
    InputError
        The spectrum cannot be one (`check_spectrum`).
    """
    wavelengths, values = check_spectrum(
        fields["wavelengths"],
        fields["values"],
        f"{document.path}, fields 'wavelengths' and 'values'",
        lambda band: f"number {band + 1}",
    )
    sigma = stated_sigma(fields)
    gloss = fields.get("gloss", {})
    optional: dict[str, Any] = {
        name: tuple(fields[name]) if isinstance(fields[name], list) else fields[name]
        for name in _OPTIONAL
        if name in fields
    }
    return Sample(
        name=fields["name"],
        wavelengths=wavelengths,
        values=values,
        kind=fields["kind"],
        instrument=fields["instrument"],
        sigma_degrees=sigma.settled,
        sigma_source=sigma.source(fields["sigma_source"]),
        source=fields["source"],
        license=fields["license"],
        gloss=tuple((float(angle), float(gloss[angle])) for angle in sorted(gloss)),
        gloss_source=fields.get("gloss_source", ""),
        **optional,
        **white_fields(fields.get("white"), fields.get("white_factor"))[0],
    )


def fields_of(document: Document) -> dict[str, Any]:
    """Return the fields of a preset, right or wrong.

    Raises
    ------
    InputError
        The file is not JSON, or no object.
    """
    return json_object.parse(document)
