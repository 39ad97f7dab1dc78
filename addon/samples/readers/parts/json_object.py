# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Our own JSON files as objects, if parsing them takes no more memory than their size allows."""

from __future__ import annotations

import json
import re
from typing import Any

from .document import Document

_STRING = re.compile(r'"[^"\\]*+(?:\\.[^"\\]*+)*+\\?(?:"|\Z)', re.DOTALL)
"""A string of JSON, or one that is not closed; never looks at a character twice."""


def names(document: Document, form: str) -> bool:
    """Return whether the head is of a JSON object that names a format."""
    head = document.json_head
    return head.lstrip().startswith("{") and f'"{form}"' in head


def parse(document: Document) -> dict[str, Any]:
    """Return the object.

    Raises
    ------
    InputError
        The file is not JSON, or no object.
    """
    try:
        fields = json.loads(document.json_text)
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


def has_too_many_brackets(text: str, characters: int) -> bool:
    """Return whether there is more than one bracket in so many characters.

    Small objects take up to 25 times their text in memory. Names may have as many as they like.
    """
    most = 8 + len(text) // characters
    return _brackets(text) > most and _brackets(_STRING.sub("", text)) > most


def _brackets(text: str) -> int:
    return text.count("[") + text.count("{")
