# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The materials that come with the extension, found by whatever a person calls them.

A preset is a file ``presets/<collection>/<name>.json``, the name with a number before it where the
collection has an order; its id is that path without the ending, such as ``colorchecker/14-green``
or ``everyday/brick``. Ids and names come from the folder alone: a file is read
only when its spectrum is wanted.
"""

from __future__ import annotations

import difflib
import os
import re
from pathlib import Path
from typing import NamedTuple

from ...core.errors import InputError
from ...core.numerics.memoized import memoized
from . import preset_index, readers
from .readers.formats import preset as preset_file
from .readers.parts.document import quote
from .sample import Sample


def folder() -> Path:
    """Return the folder of the bundled presets."""
    return preset_index.FOLDER


def names() -> list[str]:
    """Return the ids of all presets, such as ``"colorchecker/14-green"``, sorted.

    Lists folders and reads no file.
    """
    return list(_listed().names)


def is_called(preset: str) -> bool:
    """Return whether one preset or several are called so; see `path_of`."""
    return _slug(preset) in _listed().by_slug


def path_of(preset: str) -> Path:
    """Return the file of a preset.

    Parameters
    ----------
    preset
        Its id (``"colorchecker/14-green"``), its name (``"ColorChecker 14 Green"``), the color's
        name (``"green"``) or its number (``"14"``); case and punctuation do not matter.

    Raises
    ------
    InputError
        No preset is called so, or several are.
    """
    wanted = _slug(preset)
    listed = _listed()
    known, found = listed.names, listed.by_slug.get(wanted, ())
    if len(found) == 1:
        return folder() / f"{found[0]}.json"
    if found:
        raise InputError(
            f"{folder()}: preset {preset!r} could be any of {', '.join(found)}; give the whole id."
        )
    if not known:
        raise InputError(f"{folder()}: no presets are there; install the extension again.")
    close = difflib.get_close_matches(wanted, reversed(listed.by_slug), n=3, cutoff=0.5)
    near = list(dict.fromkeys(listed.by_slug[slug][0] for slug in close))
    hint = f"the closest are {', '.join(near)}" if near else f"the first is {known[0]}"
    raise InputError(f"{folder()}: there is no preset {quote(preset)}; {hint}.")


def load(preset: str | os.PathLike[str]) -> Sample:
    """Return a preset.

    Parameters
    ----------
    preset
        What `path_of` takes, or the path of a preset file anywhere (``….json``).

    Raises
    ------
    InputError
        It cannot be found, or its file has a fault.
    """
    given = os.fspath(preset)
    path = Path(given) if given.lower().endswith(".json") else path_of(given)
    document = readers.open_document(path)
    # Without asking every format, which would import them all for the first preset of a session.
    if preset_file.sniff(document):
        return preset_file.read(document)[0]
    return readers.read(path)[0]


def load_all(collection: str | None = None) -> list[Sample]:
    """Return all presets, or those of one collection, in the order of `names`.

    Raises
    ------
    InputError
        A file has a fault, or there is no such collection.
    """
    wanted = names() if collection is None else names_of(collection)
    return [load(folder() / f"{name}.json") for name in wanted]


def collections() -> list[str]:
    """Return the names of the collections, sorted."""
    return sorted({name.partition("/")[0] for name in names()})


def names_of(collection: str) -> list[str]:
    """Return the ids of one collection's presets, sorted.

    Raises
    ------
    InputError
        There is no such collection.
    """
    found = [name for name in names() if name.startswith(f"{collection}/")]
    if not found:
        raise InputError(
            f"{folder()}: there is no collection {collection!r}; take one of: "
            f"{', '.join(collections())}."
        )
    return found


class _Listed(NamedTuple):
    """The ids of all presets, sorted, and those of all that a person may call them."""

    names: tuple[str, ...]
    by_slug: dict[str, tuple[str, ...]]


def _listed() -> _Listed:
    """List the presets; from memory while no folder of them has changed."""
    root = folder()
    try:
        with os.scandir(root) as found:
            inner = sorted((entry.name, entry.stat().st_mtime_ns) for entry in found)
    except OSError:
        inner = []
    return _list(root, tuple(inner))


@memoized(maxsize=8)
def _list(root: Path, _changed: tuple[tuple[str, int], ...]) -> _Listed:
    files = root.glob("*/*.json")
    names = sorted(path.relative_to(root).with_suffix("").as_posix() for path in files)
    by_slug: dict[str, tuple[str, ...]] = {}
    for name in names:
        for slug in _slugs(name):
            by_slug[slug] = (*by_slug.get(slug, ()), name)
    return _Listed(tuple(names), by_slug)


def _slug(name: str) -> str:
    """Return a name in lower case with hyphens; what stands in parentheses at its end is left out.

    So "ColorChecker 20 Neutral 8 (.23 D)" and colorchecker/20-neutral-8 are the same.
    """
    name = re.sub(r"\s*\([^()]*\)\s*$", "", name)
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def _slugs(name: str) -> set[str]:
    """Return all that a preset with this id is called."""
    collection, _, stem = name.rpartition("/")
    number, _, color = stem.partition("-")
    found = {_slug(name), _slug(stem)}
    if number.isdecimal():
        found |= {_slug(color)}
        for digits in (number, str(int(number))):
            found |= {digits, _slug(f"{collection} {digits}")}
    return found - {""}
