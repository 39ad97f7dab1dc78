# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which white values are relative to, as files and options state it, and as people are told.

Files have two words: ``white``, a name of `core.white_scale`, and ``white_factor``, a number or the
name of a plaque. A `Sample` has them apart, for a plaque's factor follows from the instrument.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from ...core import white_scale
from ...core.errors import InputError
from .sample import Sample

PLAQUES = {white_scale.PTFE: "sintered PTFE"}


def fields(white: Any, factor: Any) -> tuple[dict[str, Any], str]:
    """Give the fields of `Sample`, and what is wrong as the end of a sentence; empty if nothing.

    Parameters
    ----------
    white, factor
        As stated, texts or numbers; None or empty where nothing is.
    """
    said = "" if factor is None else str(factor).strip()
    if white is None or white == "":
        return {}, "white_factor stands without white; say which white, too" if said else ""
    name = white_scale.parse(white) if isinstance(white, str) else None
    if name is None:
        known = ", ".join(white_scale.REGISTRY)
        return {}, f"white is {str(white)[:40]!r}; make it one of {known}"
    found: dict[str, Any] = {"white": name}
    if said.lower() in PLAQUES:
        return found | {"plaque": said.lower()}, ""
    if said:
        number = _number(factor)
        if number is None:
            plaques = " or ".join(PLAQUES)
            return {}, f"white_factor is {said[:40]!r}; make it a number near 1, or {plaques}"
        found["white_factor"] = number
    return found, ""


def given(sample: Sample, white: Any, factor: Any) -> Sample:
    """Give a sample with another white, as options state it; the same where they state none.

    Raises
    ------
    InputError
        If they cannot be used, or the factor does not follow from them.
    """
    found, fault = fields(white, factor)
    if fault:
        raise InputError(f"{sample.source or 'Sample'}, {sample.name!r}: {fault}.")
    if not found:
        return sample
    others = tuple(given(other, white, factor) for other in sample.others)
    return replace(sample, others=others, **{"white_factor": None, "plaque": ""} | found)


def told(white: str, factor: float | None, plaque: str) -> str:
    """Say in words what values are relative to, such as "8°/d certificate, sintered PTFE"."""
    known = white_scale.REGISTRY.get(white)
    words = [white if known is None else known.menu.lower()]
    if plaque:
        words.append(PLAQUES.get(plaque, plaque))
    if factor is not None:
        words.append(f"factor {factor:g}")
    return ", ".join(words)


def remark(sample: Sample) -> str:
    """Say what is done with values that are not relative to the perfect diffuser; else nothing."""
    if sample.white == white_scale.PERFECT:
        return ""
    relative = told(sample.white, sample.white_factor, sample.plaque)
    return (
        f"{sample.name!r} is relative to the {relative}: its values times {sample.scale:.5g} are "
        "relative to the perfect diffuser."
    )


def _number(value: Any) -> float | None:
    try:
        found = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return None if isinstance(value, bool) or not math.isfinite(found) else found
