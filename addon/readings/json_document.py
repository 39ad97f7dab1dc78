# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as a JSON document: everything that is known of a bake, and read back from there.

``readings.schema.json`` beside this file says the same for other programs; a test holds the two
together. Schema 1, which earlier versions wrote, is read as well: what it lacks stays empty.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ...core.errors import InputError
from ..support import user_files
from .document import GLOSS, CyclesReading, Predicted, Reading, Readings, SpotRead
from .origin import Derivation, Node

FORMAT = "rough-spectra-readings"
SCHEMA = 2
READ = (1, 2)
"""Schemas that are read."""

_INDENT = "  "  # of a reading, in a list in the document
_LONGEST = 200  # characters of what is wrong with a file


def to_json(readings: Readings) -> bytes:
    """Give the document that `from_json` reads; equal readings give equal bytes."""
    return b"".join(pieces(readings))


def pieces(readings: Readings) -> Iterator[bytes]:
    """Give the same document a reading after the other: of many it takes ten times their memory."""
    whole = {
        "format": FORMAT,
        "schema": SCHEMA,
        "version": readings.version,
        "blender": readings.blender,
        "working_space": readings.working_space,
        "instrument": ", ".join(readings.instruments),
        "aperture": readings.aperture,
        "units": {
            "values": "reflectance factor, 0..1",
            "albedo": "reflectance of a facet, 0..1; above 1 where white facets read less",
            "wavelengths": "nm",
            "colors": "scene-linear RGB, 2° observer, not clipped",
            "xyz": "Y = 100 for the perfect diffuser",
            "measured": "CIE 1931 2° observer",
            "gloss": "GU at 20°, 60° and 85°, ISO 2813",
            "spot": "mm; point in units of the scene",
        },
        "shard": readings.shard,
        "shards": readings.shards,
        "whole": readings.whole,
        "each": readings.each,
        "largest_delta_e_00": readings.largest_delta_e,
        "readings": [],
    }
    head, brackets, tail = _text(whole).rpartition("[]")
    if not readings.entries:
        yield _bytes(head + brackets + tail + "\n")
        return
    yield _bytes(head + "[")
    for number, entry in enumerate(readings.entries):
        # No line ends within a text: there it is an escape.
        indented = f"\n{_text(asdict(entry))}".replace("\n", "\n" + _INDENT)
        yield _bytes("," * (number > 0) + indented)
    yield _bytes("\n ]" + tail + "\n")


def _text(value: Any) -> str:
    return json.dumps(value, indent=1, ensure_ascii=False)


def _bytes(text: str) -> bytes:
    return text.encode(errors="backslashreplace")  # half a surrogate pair, as JSON escapes it


def from_json(path: Path) -> Readings:
    """Read back what `to_json` gave.

    Raises
    ------
    InputError
        If the file is not such a document.
    """
    return of_bytes(path, user_files.read(path))


def of_bytes(path: Path, data: bytes) -> Readings:
    """Read what a file holds; otherwise as `from_json`, which reads the file, too."""
    try:
        document = json.loads(data.decode())
    except (ValueError, RecursionError) as error:
        msg = f"{path} is not JSON ({error}); give a file that bake wrote."
        raise InputError(msg) from error
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        msg = f"{path} holds no readings; give the .json file that bake wrote."
        raise InputError(msg)
    if document.get("schema") not in READ:
        known = " and ".join(map(str, READ))
        msg = f"{path} has schema {document.get('schema')}; this version reads schema {known}."
        raise InputError(msg)
    try:
        entries = tuple(_entry(data) for data in document["readings"])
        return Readings(
            document["working_space"],
            document["blender"],
            entries,
            int(document["shard"]),
            int(document["shards"]),
            str(document["whole"]),
            str(document["version"]),
            max(1, int(document.get("each", 1))),
        )
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        msg = f"{path} is damaged ({repr(error)[:_LONGEST]}); bake it again."
        raise InputError(msg) from error


_ALBEDOS = ("albedo_lowest", "albedo_highest", "albedo")
_TRIPLES = {"rgb", "spread", "xyz", "lab", "preview", "color", "point", "normal", "azimuth"}
_SENTENCES = {"linked", "in_use", "reasons"}
_TABLES: dict[str, Callable[[Any], Any]] = {
    "colors": lambda value: _numbers(value, 3),
    "delta_e_lights": float,
    "settings": str,
}
"""What maps names to values, and how these are read."""


def _entry(data: dict[str, Any]) -> Reading:
    known = dict(data)
    known["predicted"] = _predicted(data["predicted"])
    known["measured"] = _whole(CyclesReading, data["measured"])
    known["node"] = _node(data.get("node"))
    known["derivation"] = _whole(Derivation, data.get("derivation"))
    known["spot"] = _whole(SpotRead, data.get("spot"))
    known["warnings"] = tuple(data["warnings"])
    known["gloss"] = tuple(map(float, data.get("gloss", ())))
    if len(known["gloss"]) not in (0, len(GLOSS)):
        raise ValueError("there is not one gloss an angle")
    return Reading(**known)


def _predicted(part: dict[str, Any] | None) -> Predicted | None:
    if part is None:
        return None
    pairs = {"gloss": tuple(_numbers(pair, 2) for pair in part.get("gloss", ()))}
    found: Predicted = _whole(Predicted, {k: v for k, v in part.items() if k != "gloss"} | pairs)
    if len(found.wavelengths) != len(found.values):
        raise ValueError("there is not one value a wavelength")
    if any(len(getattr(found, key)) not in (0, len(found.values)) for key in _ALBEDOS):
        raise ValueError("there is not one albedo a wavelength")
    return found


def _node(part: dict[str, Any] | None) -> Node | None:
    if part is None:
        return None
    gloss = part["gloss"]
    if gloss is not None:
        gloss = {k: _numbers(v, 3) if isinstance(v, list) else v for k, v in gloss.items()}
    found: Node = _whole(Node, part | {"gloss": gloss})
    return found


def _whole(kind: Any, part: dict[str, Any] | None) -> Any:
    """Make a dataclass of its fields, lists as tuples of what they hold."""
    if part is None:
        return None
    read = dict(part)
    for key, value in part.items():
        if key in _TABLES:
            read[key] = {str(name): _TABLES[key](each) for name, each in value.items()}
        elif isinstance(value, list):
            read[key] = tuple(map(str, value)) if key in _SENTENCES else _numbers(value)
            if key in _TRIPLES and len(value) != 3:
                raise ValueError("a color has three numbers")
    return kind(**read)


def _numbers(values: list[Any], count: int | None = None) -> tuple[float, ...]:
    if count is not None and len(values) != count:
        raise ValueError(f"there are not {count} numbers")
    return tuple(map(float, values))
