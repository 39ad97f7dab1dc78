# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fields of a preset and what each of them must hold.

``presets/schema.json`` says the same for editors and other programs; a test holds the two together.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from .....core import white_scale
from .....core.instruments import REGISTRY
from .....core.limits import LARGEST_SIGMA_DEGREES, MATCHED_SIGMA_DEGREES, sigma_fault
from ...sample import KINDS, KINDS_NAMED, MOST_GLOSS_UNITS
from ...stated_sigma import FIELDS, StatedSigma
from ...stated_white import PLAQUES
from ...stated_white import fields as white_fields
from .document import quote

FORMAT = "rough-spectra-preset"
SCHEMA = 1

_WHITE = ("white", "white_factor")
_GLOSS_ANGLES = ("20", "45", "60", "75", "85")
"""Degrees of gloss meters: ISO 2813, and the papers' 75 and films' 45."""
_ID = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*/[a-z0-9]+(-[a-z0-9]+)*")


@dataclass(frozen=True)
class Rule:
    """What one field must hold.

    Parameters
    ----------
    demand
        What the field must be, as the end of a sentence.
    fault
        Gives what is wrong with a value and what to make of it, or an empty string.
    required
        Whether a preset cannot do without the field.
    """

    demand: str
    fault: Callable[[Any], str]
    required: bool = False


def faults(fields: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Give every field that is missing or wrong, with a sentence that says what to make of it."""
    for name, rule in RULES.items():
        if name in fields:
            fault = rule.fault(fields[name])
            if fault:
                yield name, fault
        elif rule.required:
            yield name, f"it is missing and {rule.demand}"
    if not any(name in fields for name in FIELDS):
        yield FIELDS.degrees, f"it is missing and {RULES[FIELDS.degrees].demand}"
    elif all(RULES[name].fault(fields[name]) == "" for name in FIELDS if name in fields):
        name, fault = stated_sigma(fields).fault()
        if fault:
            yield name, fault
    if "gloss" in fields and "gloss_source" not in fields:
        yield "gloss_source", f"it is missing beside 'gloss' and {RULES['gloss_source'].demand}"
    if all(RULES[name].fault(fields[name]) == "" for name in _WHITE if name in fields):
        white, fault = white_fields(*map(fields.get, _WHITE))
        instrument: Any = fields.get("instrument")
        if not fault and RULES["instrument"].fault(instrument) == "":
            fault = white_scale.fault(
                white.get("white", white_scale.PERFECT),
                instrument,
                white.get("white_factor"),
                white.get("plaque", ""),
            )
        if fault:
            yield "white_factor" if "white_factor" in fields else "white", fault


def beyond(fields: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Give a σ that no material has. A file may keep it: another one can be chosen."""
    sigma: Any = fields.get(FIELDS.degrees)
    if is_number(sigma) and MATCHED_SIGMA_DEGREES < sigma <= LARGEST_SIGMA_DEGREES:
        yield FIELDS.degrees, sigma_fault(sigma).rstrip(".")


def stated_sigma(fields: dict[str, Any]) -> StatedSigma:
    """Give what fields without a fault state of σ."""
    given = {name: fields.get(name) for name in FIELDS}
    return StatedSigma(*(None if value is None else float(value) for value in given.values()))


def unknown(fields: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Give the fields that no preset has, which no program reads: often a slip of the pen."""
    for name in fields:
        if name not in RULES:
            close = difflib.get_close_matches(name, RULES, n=1)
            yield name, f"it is unknown; {f'call it {close[0]!r}' if close else 'leave it out'}"


def _rule(holds: Callable[[Any], bool], demand: str, required: bool = False) -> Rule:
    def fault(value: Any) -> str:
        return "" if holds(value) else f"it is {quote(str(value))} and {demand}"

    return Rule(demand, fault, required)


def _text(required: bool = False) -> Rule:
    demand = "must be a text that is not empty"
    return _rule(lambda value: isinstance(value, str) and bool(value.strip()), demand, required)


def _choice(choices: tuple[Any, ...], required: bool = False) -> Rule:
    named = ", ".join(map(str, choices))

    def holds(value: Any) -> bool:
        return type(value) is type(choices[0]) and value in choices

    what = "a text, one of" if isinstance(choices[0], str) else "one of"
    return _rule(holds, f"must be {what} {named}", required)


def _numbers(count: int | None = None, required: bool = False) -> Rule:
    demand = f"must be a list of {'' if count is None else f'{count} '}numbers"

    def fault(value: Any) -> str:
        if not isinstance(value, list) or (count is not None and len(value) != count):
            return f"it is {quote(str(value))} and {demand}"
        for i, number in enumerate(value, start=1):
            # Python reads NaN, which JSON has not. A spectrum's is named by its wavelength later.
            if not is_number(number) or (count is not None and not math.isfinite(number)):
                return f"number {i} is {quote(str(number))}; make it a number"
        return ""

    return Rule(demand, fault, required)


def _is_sigma(value: Any) -> bool:
    return value is None or (is_number(value) and 0 <= value <= LARGEST_SIGMA_DEGREES)


def _is_gloss(value: Any) -> bool:
    return isinstance(value, dict) and all(
        angle in _GLOSS_ANGLES and is_number(units) and 0 <= units <= MOST_GLOSS_UNITS
        for angle, units in value.items()
    )


def _is_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(text, str) and text for text in value)


def is_number(value: Any) -> bool:
    """Return whether a JSON value is a number that fits a float; true and false are none."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        float(value)
    except OverflowError:
        return False
    return True


RULES: dict[str, Rule] = {
    "$schema": _text(),
    "format": _rule(lambda value: value == FORMAT, f"must be {FORMAT!r}", required=True),
    "schema": _rule(
        lambda value: type(value) is int and 1 <= value <= SCHEMA,
        f"must be {SCHEMA} (a larger one needs a newer version of Rough Spectra)",
        required=True,
    ),
    "id": _rule(
        lambda value: isinstance(value, str) and _ID.fullmatch(value) is not None,
        "must be collection/name in small letters, digits and hyphens",
    ),
    "name": _text(required=True),
    "source": _text(required=True),
    "license": _text(required=True),
    "kind": _rule(lambda value: value in KINDS, f"must be {KINDS_NAMED}", required=True),
    "instrument": _choice(tuple(REGISTRY), required=True),
    "sigma_degrees": _rule(
        _is_sigma,
        f"must be a number from 0 to {MATCHED_SIGMA_DEGREES:.0f}, or null if nobody knows",
    ),
    "rdq": _rule(is_number, "must be a number, the rms slope of a profile"),
    "sdq": _rule(is_number, "must be a number, the rms slope of an area"),
    "sigma_source": _text(required=True),
    "gloss": _rule(
        _is_gloss,
        f"must hold gloss units, 0 to {MOST_GLOSS_UNITS:.0f}, by the angle, one of "
        f"{', '.join(map(repr, _GLOSS_ANGLES))}; {{}} for none",
    ),
    "gloss_source": _text(),
    "quantity": _text(),
    "geometry": _text(),
    "aperture": _text(),
    "specular": _choice(("SCI", "SCE")),
    "device": _text(),
    "white": _choice(tuple(white_scale.REGISTRY)),
    "white_factor": _rule(
        lambda value: is_number(value) or (isinstance(value, str) and value in PLAQUES),
        f"must be a number near 1, or {' or '.join(map(repr, PLAQUES))}",
    ),
    "condition": _choice(("M0", "M1", "M2", "M3")),
    "illuminant": _text(),
    "observer": _choice((2, 10)),
    "lab": _numbers(3),
    "xyz": _numbers(3),
    "notes": _rule(_is_texts, "must be a list of texts"),
    "altered": _rule(_is_texts, "must be a list of texts"),
    "wavelengths": _numbers(required=True),
    "values": _numbers(required=True),
}
