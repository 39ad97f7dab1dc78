# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Libraries: many samples in one JSON file, each on a line of its own.

An object with ``format`` ("rough-spectra-library"), ``schema`` (1) and ``samples``: an array of
objects with the fields of `Sample`, of which ``name``, ``kind``, ``wavelengths`` (nm) and
``values`` (fractions) are needed. ``rdq`` or ``sdq`` may state the roughness instead of
``sigma_degrees``. ``others`` holds further readings of the same surface, objects as the samples, of
which ``values`` are needed: ``name`` and ``wavelengths`` are the sample's where they aren't given.
``gloss`` holds gloss units by the angle, as in ``{"60": 23.5}``, and ``gloss_source`` says where
they come from. A sample's ``id`` tells it from
the others of the file. Other fields may stand beside them, and stay there when the library is
written again.
"""

from __future__ import annotations

import dataclasses
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from .....core import white_scale
from .....core.errors import InputError
from .....core.instruments import REGISTRY
from ...sample import KINDS, KINDS_NAMED, Sample, check_spectrum
from ...stated_sigma import FIELDS, StatedSigma
from ..parts import json_object
from ..parts.document import Document, quote

NAME = "Rough Spectra library"
ENDINGS = ("json",)
PRIORITY = 100
SETS = True

FORMAT = "rough-spectra-library"
SCHEMA = 1

_CHARACTERS_A_BRACKET = 12
"""A file with more brackets than one in so many characters is no library: a sample has three in a
hundred."""

_Grids = dict[tuple[float, ...], np.ndarray]
"""Wavelengths that samples share."""


def sniff(document: Document) -> bool:
    """Return whether the head is of a JSON object that names this format."""
    return json_object.names(document, FORMAT)


def read(document: Document) -> list[Sample]:
    """Return the samples of a library.

    Raises
    ------
    InputError
        See `parse` and `samples`.
    """
    return samples(document, parse(document))


def parse(document: Document) -> dict[str, Any]:
    """Return the whole object of a library file, with its samples as objects.

    Raises
    ------
    InputError
        The file is no JSON, no library, or of a newer schema.
    """
    if json_object.has_too_many_brackets(document.json_text, _CHARACTERS_A_BRACKET):
        raise document.error("", f"it is no {NAME}: it has more brackets than samples have")
    fields = json_object.parse(document)
    if fields.get("format") != FORMAT:
        raise document.error("", f"it is no {NAME}; its 'format' must be {FORMAT!r}")
    schema = fields.get("schema")
    if type(schema) is not int or schema < 1:
        raise document.error("field 'schema'", f"it must be {SCHEMA}")
    if schema > SCHEMA:
        raise document.error(
            "field 'schema'",
            f"it is {schema}, of a newer Rough Spectra than this; update the extension to use it",
        )
    found = fields.get("samples")
    if not isinstance(found, list) or not all(isinstance(record, dict) for record in found):
        raise document.error("field 'samples'", "it must be an array of objects, one a sample")
    return fields


def samples(document: Document, fields: dict[str, Any]) -> list[Sample]:
    """Return the samples of what `parse` gave.

    Raises
    ------
    InputError
        A field is missing or of another type than it should be, or a spectrum is none.
    """
    grids: _Grids = {}
    return [
        _with_set(
            document,
            f"sample {number} {quote(str(record.get('name')))}",
            _sample(document, f"sample {number}", record, grids),
            record,
            grids,
        )
        for number, record in enumerate(fields["samples"], start=1)
    ]


def sample_of(record: dict[str, Any], where: str) -> Sample:
    """Return the sample of one object, as `record` gives it.

    Parameters
    ----------
    record
        The object.
    where
        What messages name instead of a file.

    Raises
    ------
    InputError
        See `samples`.
    """
    return samples(Document(Path(where), b""), {"samples": [record]})[0]


def record(sample: Sample) -> dict[str, Any]:
    """Return the object that `samples` makes the same sample of, to the last bit."""
    found: dict[str, Any] = {}
    for field in _FIELDS:
        value = getattr(sample, field.name)
        if value != field.default:
            found[field.name] = list(value) if isinstance(value, tuple) else value
    found["wavelengths"] = _wavelengths(sample.wavelengths.tobytes())
    found["values"] = sample.values.tolist()
    return found | set_record(sample)


def set_record(sample: Sample) -> dict[str, Any]:
    """Return what an object has of a sample's set beside its own reading; nothing without one."""
    found: dict[str, Any] = {}
    if sample.others:
        found["others"] = [_other_record(other, sample) for other in sample.others]
    if sample.gloss:
        found["gloss"] = {repr(angle).removesuffix(".0"): units for angle, units in sample.gloss}
    return found


def _other_record(other: Sample, main: Sample) -> dict[str, Any]:
    found = record(other)
    del found["kind"]
    if np.array_equal(other.wavelengths, main.wavelengths):
        del found["wavelengths"]
    return found


def _wavelengths(data: bytes) -> list[float]:
    """Return whole nanometers without ".0": the same numbers, and a line a third shorter."""
    return [int(nm) if nm.is_integer() else nm for nm in np.frombuffer(data).tolist()]


def with_set(sample: Sample, fields: dict[str, Any]) -> Sample:
    """Return a sample with the set that `set_record` gave.

    Raises
    ------
    InputError
        It is damaged.
    """
    return _with_set(Document(Path(sample.source or sample.name), b""), "set", sample, fields, {})


def _with_set(
    document: Document, place: str, main: Sample, fields: dict[str, Any], grids: _Grids
) -> Sample:
    others, gloss = fields.get("others", []), fields.get("gloss", {})
    if others == [] and gloss == {}:
        return main
    if not isinstance(others, list) or not all(isinstance(other, dict) for other in others):
        raise document.error(place, "the field 'others' must be an array of objects, one a reading")
    if any(other.get("others") or other.get("gloss") for other in others):
        raise document.error(place, "one of its 'others' has a set of its own; give readings only")
    if not isinstance(gloss, dict) or not all(map(_is_number, gloss.values())):
        raise document.error(place, "the field 'gloss' must hold gloss units by the angle")
    shared = {"name": main.name, "kind": "reading", "wavelengths": main.wavelengths.tolist()}
    found = tuple(
        _sample(document, f"{place}, reading {number},", shared | other, grids)
        for number, other in enumerate(others, start=2)
    )
    units = tuple((_angle(document, place, angle), float(gloss[angle])) for angle in gloss)
    try:
        return dataclasses.replace(main, others=found, gloss=units)
    except InputError as error:
        # The sample names the file it came from, which is not the one to mend.
        sentence = str(error).partition(": ")[2].rstrip(".")
        raise document.error(place, sentence) from None


def _angle(document: Document, place: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise document.error(
            place, f"the field 'gloss' has {quote(text)} for an angle; give degrees"
        ) from None


def _sample(
    document: Document,
    place: str,
    fields: dict[str, Any],
    grids: _Grids,
) -> Sample:
    name = fields.get("name")
    if isinstance(name, str):
        place = f"{place} {quote(name)}"
    given: dict[str, Any] = {}
    for field in _FIELDS:
        if field.name not in fields:
            if field.default is dataclasses.MISSING:
                raise document.error(place, f"the field {field.name!r} is missing; add it")
            continue
        value = fields[field.name]
        holds, demand = _TYPES[str(field.type)]
        if not holds(value):
            raise document.error(place, f"the field {field.name!r} must be {demand}")
        given[field.name] = tuple(value) if isinstance(value, list) else value
    sigma = _stated_sigma(document, place, fields)
    if sigma.slope:
        given["sigma_degrees"] = sigma.settled
        given["sigma_source"] = sigma.source(given.get("sigma_source", ""))
    if given.get("instrument", "45a:0") not in REGISTRY:
        raise document.error(place, f"'instrument' must be one of {', '.join(REGISTRY)}")
    white, factor = given.get("white", white_scale.PERFECT), given.get("white_factor")
    fault = white_scale.fault(
        white, given.get("instrument", "45a:0"), factor, given.get("plaque", "")
    )
    if fault:
        raise document.error(place, fault)
    numbers = {key: fields.get(key) for key in ("wavelengths", "values")}
    for key, found in numbers.items():
        if not isinstance(found, list) or not set(map(type, found)) <= {int, float}:
            raise document.error(place, f"the field {key!r} must be an array of numbers")
    try:
        grid = tuple(numbers["wavelengths"] or ())
        nm = grids.get(grid)
        if nm is None:
            nm = grids[grid] = np.array(grid, dtype=np.float64)
            nm.flags.writeable = False
        values = np.array(numbers["values"], dtype=np.float64)
    except OverflowError:
        raise document.error(place, "it has a number too long; correct it") from None
    try:
        return Sample(wavelengths=nm, values=values, **given)
    except InputError:
        # The sample names the file it came from, which is not the one to mend.
        check_spectrum(nm, values, f"{document.path}, {place}")
        raise


def _stated_sigma(document: Document, place: str, fields: dict[str, Any]) -> StatedSigma:
    for name in FIELDS:
        value = fields.get(name)
        if value is not None and not _is_number(value):
            raise document.error(place, f"the field {name!r} must be a number or null")
    sigma = StatedSigma(*(fields.get(name) for name in FIELDS))
    _, fault = sigma.fault()
    if fault:
        raise document.error(place, fault)
    return sigma


def _is_number(value: Any) -> bool:
    if type(value) is int:
        return abs(value) <= sys.float_info.max
    return type(value) is float and math.isfinite(value)


def _is_triple(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(_is_number, value))


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(text, str) for text in value)


_TYPES: dict[str, tuple[Callable[[Any], bool], str]] = {
    "str": (lambda value: isinstance(value, str), "a text"),
    "Kind": (lambda value: value in KINDS, KINDS_NAMED),
    "float | None": (lambda value: value is None or _is_number(value), "a number or null"),
    "int | None": (lambda value: value is None or type(value) is int, "a whole number or null"),
    "tuple[float, float, float] | None": (
        lambda value: value is None or _is_triple(value),
        "three numbers or null",
    ),
    "tuple[str, ...]": (_are_texts, "an array of texts"),
}
"""By the annotation of a field of `Sample`: what a value must be."""

_APART = ("wavelengths", "values", "others", "gloss")
_FIELDS = [field for field in dataclasses.fields(Sample) if field.name not in _APART]
