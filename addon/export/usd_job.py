# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let a second Blender export materials as USD, and give their spectra the type that they have."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..blender.background_job import Job, waited
from .entry import Entry
from .names import facts, numbers

_FILE = "squares.usda"
_PREFIX = "rough_spectra:"
_ARRAYS = ("wavelengths", "reading", "albedo")
_TEXT = re.compile(rf'custom string {_PREFIX}({"|".join(_ARRAYS)}) = "([^"]*)"')
"""What Blender's exporter makes of a text; it knows no arrays of more than four numbers."""


class _Export(Job):
    """Materials being exported in a second Blender."""

    doing = "exports USD"
    interrupted = "Interrupted; nothing was written."
    smaller = "export fewer materials at once"

    def __init__(self, entries: Sequence[Entry]) -> None:
        job = {
            "file": _FILE,
            "columns": math.ceil(math.sqrt(len(entries))),
            "materials": [
                {
                    "name": entry.identifier,
                    "color": entry.color.tolist(),
                    "properties": _properties(entry),
                }
                for entry in entries
            ],
        }
        super().__init__(Path(__file__).with_name("usd_worker.py"), lambda _folder: job)


def write(entries: Sequence[Entry], path: Path) -> None:
    """Write a .usda with a square for each material.

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    with waited(_Export(entries)) as job:
        text = job.output(_FILE).read_text(encoding="utf-8")
    path.write_text(_TEXT.sub(_array, text), encoding="utf-8")


def _properties(entry: Entry) -> dict[str, Any]:
    return {
        f"{_PREFIX}{name}": numbers(value) if name in _ARRAYS else value
        for name, value in facts(entry).items()
    }


def _array(found: re.Match[str]) -> str:
    return f"custom double[] {_PREFIX}{found[1]} = [{', '.join(found[2].split())}]"
