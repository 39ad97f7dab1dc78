# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write readings to files. Predicted and measured never share one.

From the base name `out/chart` come `chart.json` with everything, `chart.predicted.*` and
`chart.measured.*`. Where nothing was predicted, or nothing measured, those files are left out: a
CGATS file without a table is no CGATS file.
"""

from __future__ import annotations

import re
from pathlib import Path

from ...support import atomic_files
from ..document import Readings, to_json
from . import cgats, images, tables

FORMATS = ("csv", "cgats", "exr")
"""Written beside the JSON document, which is always written."""

_ENDING = re.compile(
    r"json|(?:predicted|measured)\.(?:csv|cgats\.txt)"
    r"|predicted(?:-[1-9]\d*)?\.spectral\.exr|measured\.exr"
)
"""What may follow the base name."""
_CREATOR = re.compile(
    rb'# creator: Rough Spectra |ORIGINATOR\t"Rough Spectra |Software\0string\0.{4}Rough Spectra ',
    re.DOTALL,
)
_HEAD = 1024
"""Bytes within which every file says who made it."""


def check(base: Path) -> None:
    """Refuse a base name that `write` would, before an hour of measuring is spent on it.

    Raises
    ------
    OutputError
        If no file can come from the name, or one that is there may not be replaced.
    """
    atomic_files.check_base(base)
    if base.parent.is_dir():
        for path in atomic_files.listed(base.parent):
            if _is_of(base, path):
                atomic_files.check_target(path)


def write(readings: Readings, base: Path, formats: tuple[str, ...] = FORMATS) -> list[Path]:
    """Write all files of a bake, or none; what an earlier bake wrote beside them goes.

    Parameters
    ----------
    readings
        What to write.
    base
        Folder and base name; endings are added to the name.
    formats
        Any of `FORMATS`.

    Returns
    -------
    The files written.

    Raises
    ------
    OutputError
        If one cannot be written or removed; no file was touched then.
    """
    atomic_files.check_base(base)
    written: list[Path] = []
    is_predicted = any(entry.predicted is not None for entry in readings.entries)
    is_measured = any(entry.measured is not None for entry in readings.entries)
    with atomic_files.publication() as files:

        def put(ending: str, content: bytes) -> None:
            target = base.with_name(f"{base.name}.{ending}")
            files.write(target, content)
            written.append(target)

        for module, ending in ((tables, "csv"), (cgats, "cgats.txt")):
            if ending.partition(".")[0] not in formats:
                continue
            if is_predicted:
                put(f"predicted.{ending}", module.predicted(readings))
            if is_measured:
                put(f"measured.{ending}", module.measured(readings))
        if "exr" in formats:
            for ending, image in images.predicted(readings) + images.measured(readings):
                target = base.with_name(f"{base.name}.{ending}")
                images.write(image, files.stage(target), target)
                written.append(target)
        put("json", to_json(readings))
        files.clear(base.parent, lambda path: _is_of(base, path) and _is_ours(path))
    return written


def _is_of(base: Path, path: Path) -> bool:
    """Whether a bake to this base may write a file of this name."""
    start = f"{base.name}."
    return path.name.startswith(start) and bool(_ENDING.fullmatch(path.name.removeprefix(start)))


def _is_ours(path: Path) -> bool:
    """Whether we wrote a file: somebody's measurement may be called so too."""
    try:
        if not path.is_file():
            return False
        with path.open("rb") as file:
            return bool(_CREATOR.search(file.read(_HEAD)))
    except OSError:  # what cannot be read is not known to be ours
        return False
