# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON of a bake, read back: of each material the predicted reading, and the facets' albedo.

What instruments a material was read at makes a set. `readings.json_document` knows the format.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....readings import json_document
from ....readings.document import Predicted, Reading
from ...sample import Sample
from ..parts import json_object
from ..parts.document import Document, quote

NAME = "Rough Spectra readings (the JSON of a bake)"
ENDINGS = ("json",)
PRIORITY = 100

_CHARACTERS_A_BRACKET = 12
"""As in libraries; what a bake writes has one in fifty or more."""
_COMPUTED = "The reading was computed from a stored spectrum, not measured."
_OF_FACETS = "The albedo was computed from a stored spectrum, for the σ beside it."


def sniff(document: Document) -> bool:
    """Return whether the head is of a JSON object that names this format."""
    return json_object.names(document, json_document.FORMAT)


def read(document: Document) -> list[Sample]:
    """Return a sample a predicted reading, named by its material, and one an albedo.

    Raises
    ------
    InputError
        It is no such document, or holds no predicted spectrum.
    """
    if json_object.has_too_many_brackets(document.json_text, _CHARACTERS_A_BRACKET):
        raise document.error("", f"it is no {NAME}: it has more brackets than readings have")
    found = json_document.of_bytes(document.path, document.data)
    samples: list[Sample] = []
    albedos: set[str] = set()
    for number, entry in enumerate(found.entries, start=1):
        if entry.predicted is None:
            continue
        for text in (entry.material, entry.surface, entry.instrument):
            if not isinstance(text, str):
                raise document.error(f"reading {number}", f"{quote(str(text))} is no name")
        name = f"{entry.surface}: {entry.material}" if entry.surface else entry.material
        common = _common(document, number, entry.predicted)
        samples.append(_reading(entry, name, entry.predicted, common))
        if entry.predicted.albedo and name not in albedos:
            albedos.add(name)
            samples.append(_albedo(name, entry.predicted, common))
    if not samples:
        raise document.error("", "it holds no predicted spectrum; bake materials that store one")
    return samples


def _common(document: Document, number: int, part: Predicted) -> dict[str, Any]:
    """Return what a reading and the albedo behind it share."""
    return {
        "wavelengths": np.array(part.wavelengths, dtype=np.float64),
        "sigma_degrees": part.sigma_degrees,
        "sigma_source": "as the material had it when it was baked",
        "source": str(document.path),
        "position": f"reading {number}",
    }


def _reading(entry: Reading, name: str, part: Predicted, common: dict[str, Any]) -> Sample:
    return Sample(
        **common,
        name=name,
        values=np.array(part.values, dtype=np.float64),
        kind="reading",
        instrument=entry.instrument,
        geometry=entry.instrument,
        illuminant=part.illuminant,
        observer=part.observer,
        lab=part.lab,
        notes=(_COMPUTED,),
    )


def _albedo(name: str, part: Predicted, common: dict[str, Any]) -> Sample:
    return Sample(
        **common | {"position": f"{common['position']}, albedo"},
        name=f"{name} (albedo)",
        values=np.array(part.albedo, dtype=np.float64),
        kind="albedo",
        quantity="reflectance of a facet",
        notes=(_OF_FACETS,),
    )
