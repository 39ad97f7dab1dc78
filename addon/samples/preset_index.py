# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What lists show of the presets, from one file: their spectra are read when they are wanted.

Reading and judging all of them takes a quarter of a second, after installing a whole one; so does
finding the gloss of one.
`tools/tables/make_preset_index.py` writes the file. Of other presets than those it does not speak.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ...core.gloss import Gloss, from_numbers
from .entry import Entry

FOLDER = Path(__file__).resolve().parents[2] / "presets"
FILE = FOLDER / "index.json"

_UNREADABLE = (OSError, ValueError, TypeError, KeyError, AttributeError)
"""What reading a file that somebody changed ends in."""

_PLACED = {"id", "collection", "path", "is_preset"}
"""What follows from where the preset is."""


def _rows() -> dict[str, Any] | None:
    """Read the file, if it is of the presets that are there."""
    rows = json.loads(FILE.read_bytes())
    return rows if {name: row["bytes"] for name, row in rows.items()} == _sizes() else None


def glosses() -> dict[str, list[float]]:
    """Return what gloss was found of presets that have some, by their readings.

    See `matching.own_gloss`; the numbers are those of `core.gloss.Gloss`.
    """
    try:
        rows = _rows() or {}
        return dict(row["gloss"] for row in rows.values() if row["gloss"])
    except _UNREADABLE:
        return {}


def glosses_of_presets() -> dict[str, Gloss]:
    """Return the same by the ids of the presets."""
    try:
        rows = _rows() or {}
        glossy = {name: row["gloss"][1] for name, row in rows.items() if row["gloss"]}
        return {name: from_numbers(tuple(numbers)) for name, numbers in glossy.items()}
    except _UNREADABLE:
        return {}


def entries() -> tuple[Entry, ...] | None:
    """Return an entry for each preset, in the order of their ids; None where the file has others.

    Reads no preset: whether they are the same is told by names and sizes.
    """
    try:
        rows = _rows()
        return None if rows is None else tuple(_entry(name, row) for name, row in rows.items())
    except _UNREADABLE:
        return None  # they are read instead


def text(found: tuple[Entry, ...], glosses: Mapping[str, tuple[str, Sequence[float]]]) -> str:
    """Return the file's content for the entries of all presets, a preset a line.

    Parameters
    ----------
    glosses
        By the ids of presets with gloss, what `glosses` is to return of each.
    """
    sizes = _sizes()
    rows = []
    for entry in found:
        row = {key: value for key, value in asdict(entry).items() if key not in _PLACED}
        row |= {"bytes": sizes[entry.id], "gloss": glosses.get(entry.id)}
        rows.append(f"{json.dumps(entry.id)}: {json.dumps(row, ensure_ascii=False)}")
    return "{\n" + ",\n".join(rows) + "\n}\n"


def _entry(name: str, row: dict[str, Any]) -> Entry:
    known: dict[str, Any] = {
        key: tuple(value) if isinstance(value, list) else value for key, value in row.items()
    }
    del known["bytes"], known["gloss"]
    collection = name.partition("/")[0]
    path = FOLDER / f"{name}.json"
    return Entry(id=name, collection=collection, path=path, is_preset=True, **known)


def _sizes() -> dict[str, int]:
    """Give the bytes of each preset's file, by its id."""
    found = {}
    for folder in os.scandir(FOLDER):
        if folder.is_dir():
            for file in os.scandir(folder.path):
                stem, ending = os.path.splitext(file.name)
                if ending == ".json":
                    found[f"{folder.name}/{stem}"] = file.stat().st_size
    return found
