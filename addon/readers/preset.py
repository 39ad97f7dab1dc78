# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: one material a JSON file.

An object with ``format`` ("rough-spectra-preset"), ``schema`` (1), ``name``, ``source``,
``license``, ``kind`` ("albedo" or "reading"), ``instrument`` ("45a:0"), ``sigma_degrees`` (a number
or null), ``sigma_source``, ``wavelengths`` (nm) and ``values`` (fractions). Other fields may stand
beside them.
"""

from __future__ import annotations

import json
from typing import Any, cast

from ...core.instruments import REGISTRY
from ..sample import KINDS, Kind, Sample, check_spectrum
from ._document import Document, quote

NAME = "Rough Spectra preset"
PRIORITY = 100

FORMAT = "rough-spectra-preset"
SCHEMA = 1

_SIGMA_LIMIT = 90.0  # degrees: a facet cannot be steeper on average than a wall


def sniff(document: Document) -> bool:
    """Return whether the head is of a JSON object that names this format."""
    head = document.head_text
    return head.lstrip().startswith("{") and f'"{FORMAT}"' in head


def read(document: Document) -> list[Sample]:
    """Return the one sample of a preset.

    Raises
    ------
    InputError
        The file is not JSON, is of a newer schema, or a field is missing or has another type than
        it should; the message names the field.
    """
    fields = _fields(document)
    _require(document, fields, "format", fields.get("format") == FORMAT, f"must be {FORMAT!r}")
    schema = fields.get("schema")
    _require(
        document,
        fields,
        "schema",
        type(schema) is int and schema <= SCHEMA,
        f"must be {SCHEMA} (a larger one needs a newer version of Rough Spectra)",
    )
    kind = fields.get("kind")
    _require(document, fields, "kind", kind in KINDS, "must be 'reading' or 'albedo'")
    sigma = fields.get("sigma_degrees")
    _require(
        document,
        fields,
        "sigma_degrees",
        "sigma_degrees" in fields
        and (sigma is None or (_is_number(sigma) and 0 <= sigma <= _SIGMA_LIMIT)),
        f"must be a number from 0 to {_SIGMA_LIMIT:.0f}, or null if nobody knows",
    )
    instrument = _text(document, fields, "instrument")
    known = instrument in REGISTRY
    _require(document, fields, "instrument", known, f"must be one of {', '.join(REGISTRY)}")
    name = _text(document, fields, "name")
    wavelengths, values = check_spectrum(
        _numbers(document, fields, "wavelengths"),
        _numbers(document, fields, "values"),
        f"{document.path}, fields 'wavelengths' and 'values'",
        lambda band: f"number {band + 1}",
    )
    return [
        Sample(
            name=name,
            wavelengths=wavelengths,
            values=values,
            kind=cast(Kind, kind),
            instrument=instrument,
            sigma_degrees=None if sigma is None else float(sigma),
            sigma_source=_text(document, fields, "sigma_source"),
            source=_text(document, fields, "source"),
            license=_text(document, fields, "license"),
        )
    ]


def _fields(document: Document) -> dict[str, Any]:
    try:
        fields = json.loads(document.text)
    except json.JSONDecodeError as error:
        raise document.error(
            f"line {error.lineno}", f"the JSON is broken ({error.msg}); correct it"
        ) from None
    except (ValueError, RecursionError):
        # An integer of thousands of digits, or thousands of brackets inside each other.
        raise document.error("", "the JSON is too deep or has a number too long") from None
    if not isinstance(fields, dict):
        raise document.error("line 1", "the JSON is not an object; begin it with '{'")
    return fields


def _require(
    document: Document, fields: dict[str, Any], field: str, holds: bool, demand: str
) -> None:
    if not holds:
        found = f"is {quote(str(fields[field]))}" if field in fields else "is missing"
        raise document.error(f"field '{field}'", f"it {found} and {demand}")


def _text(document: Document, fields: dict[str, Any], field: str) -> str:
    text = fields.get(field)
    holds = isinstance(text, str) and bool(text.strip())
    _require(document, fields, field, holds, "must be a text that is not empty")
    return str(text)


def _numbers(document: Document, fields: dict[str, Any], field: str) -> list[float]:
    numbers = fields.get(field)
    holds = isinstance(numbers, list)
    _require(document, fields, field, holds, "must be a list of numbers")
    for i, number in enumerate(cast(list[Any], numbers), start=1):
        if not _is_number(number):
            raise document.error(
                f"field '{field}'", f"number {i} is {quote(str(number))}; make it a number"
            )
    return cast(list[float], numbers)


def _is_number(value: Any) -> bool:
    """Return whether a JSON value is a number that fits a float; true and false are none."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        float(value)
    except OverflowError:
        return False
    return True
