# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a verb did, for programs: the line of JSON that --json prints last."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..support.shown_text import Said
from ..support.version import version

FORMAT = "rough-spectra-result"
SCHEMA = 1


def add(options: argparse.Namespace, **facts: Any) -> None:
    """Add facts for the result: numbers, texts and lists of them, paths as well."""
    found = getattr(options, "result", None)  # a script that calls a verb has none
    if found is not None:
        found.update(facts)


def line(verb: str, status: int, error: str, said: Said, facts: dict[str, Any]) -> str:
    """Give the result as one line of JSON.

    Parameters
    ----------
    verb, status
        What was asked for, and the exit status.
    error
        The sentence that it ended with; empty where it was done.
    said
        What was printed.
    facts
        What the verb added.
    """
    whole = {
        "format": FORMAT,
        "schema": SCHEMA,
        "version": version(),
        "verb": verb,
        "status": status,
        "error": error,
        "messages": said.sentences,
        "rows": [list(row) for row in said.rows],
        "result": facts,
    }
    return json.dumps(whole, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, Sequence):
        return list(value)
    raise TypeError(f"{type(value).__name__} is no fact for JSON")
