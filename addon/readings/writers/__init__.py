# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write readings to files. Predicted and measured never share one.

From the base name `out/chart` come `chart.json` with everything, `chart.predicted.*` and
`chart.measured.*`. Where nothing was predicted, or nothing measured, those files are left out: a
CGATS file without a table is no CGATS file.

A format is one module of this package, and nothing else has to know of it:

    NAME = "csv"                                       what --format calls it
    PLACE = 10                                         among the others, when files are named
    ENDINGS = r"predicted[.]csv"                       pattern of what may follow the base name
    CREATOR = rb"# creator: Rough Spectra "            pattern within its first 1,024 bytes
    def files(readings: Readings) -> list[tuple[str, Content]]    endings and content, none empty

By ending and creator the files are known that an earlier bake left and a later one does not write.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Protocol

from ...support import atomic_files, discovery
from ..document import Readings
from ..json_document import pieces

Content = bytes | Iterator[bytes] | Callable[[Path, Path], None]
"""All of a file, or its pieces, which are made while they are written; or what writes it, to the
first path, and names the second one in errors."""


class Writer(Protocol):
    """What a module of this package offers."""

    NAME: str
    PLACE: int
    ENDINGS: str
    CREATOR: bytes

    def files(self, readings: Readings) -> list[tuple[str, Content]]:
        """Give what follows the base name, and content, of each file; none without readings."""


_WRITERS: list[Writer] = sorted(
    discovery.modules(__name__, __path__), key=lambda writer: writer.PLACE
)

FORMATS = tuple(writer.NAME for writer in _WRITERS)
"""Written beside the JSON document, which is always written."""

_ENDING = re.compile("|".join(("json", *(f"(?:{writer.ENDINGS})" for writer in _WRITERS))))
"""What may follow the base name."""
_CREATOR = re.compile(b"|".join(writer.CREATOR for writer in _WRITERS), re.DOTALL)
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
    with atomic_files.publication() as files:

        def put(ending: str, content: Content) -> None:
            target = base.with_name(f"{base.name}.{ending}")
            if isinstance(content, (bytes, Iterator)):
                files.write(target, content)
            else:
                content(files.stage(target), target)
            written.append(target)

        for writer in _WRITERS:
            if writer.NAME in formats:
                for ending, content in writer.files(readings):
                    put(ending, content)
        put("json", pieces(readings))
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
