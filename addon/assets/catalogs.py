# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Catalogs of an asset library: the file ``blender_assets.cats.txt``, whose lines of others stay.

A line is ``UUID:path/of/catalog:simple name``. Assets hold the UUID, so a catalog that was moved or
renamed in Blender stays where the user put it.
"""

from __future__ import annotations

import re
import uuid
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ...core.errors import InputError
from ..support import user_files

FILE_NAME = "blender_assets.cats.txt"
ROOT = "Rough Spectra"
"""Catalog that all others of the extension lie in."""

_NAMESPACE = uuid.uuid5(uuid.NAMESPACE_URL, "https://rough-spectra/asset-catalogs")
"""Of equal paths the UUIDs are equal, on every machine and in every year."""
_HEAD = """\
# This is an Asset Catalog Definition file for Blender.
#
# Empty lines and lines starting with `#` will be ignored.
# The first non-ignored line should be the version indicator.
# Other lines are of the format "UUID:catalog/path/for/assets:simple catalog name"

VERSION 1

"""
_LINE = re.compile(r"\s*([0-9a-fA-F-]{36})\s*:([^:]*)(?::.*)?")
_TITLES = {"colorchecker": "ColorChecker"}


@dataclass(frozen=True)
class Merged:
    """A catalog file with ours in it.

    Parameters
    ----------
    text
        The whole file.
    ids
        UUID of each catalog that was asked for.
    """

    text: str
    ids: dict[str, str]


def title(collection: str) -> str:
    """Give the name that a catalog shows for a collection such as "colorchecker"."""
    if collection in _TITLES:
        return _TITLES[collection]
    # Slashes would nest catalogs, and colons end the path.
    words = re.sub(r"[/:\\\s]+", " ", collection).strip() or "Other"
    return words[0].upper() + words[1:]


def merge(path: Path, titles: Iterable[str]) -> Merged:
    """Add our catalogs to those of a file, which need not be there yet.

    Raises
    ------
    InputError
        The file is not UTF-8 text, or of a version that is not known.
    """
    text = _read(path)
    paths = {}
    for line in text.splitlines():
        found = _LINE.fullmatch(line)
        if found and not line.lstrip().startswith("#"):
            paths[found[1].lower()] = found[2].strip()
    ids = {}
    added = []
    for name in (ROOT, *(f"{ROOT}/{name}" for name in titles)):
        own = str(uuid.uuid5(_NAMESPACE, name))
        same = next((key for key, value in paths.items() if value == name), own)
        ids[name] = own if own in paths else same
        if ids[name] not in paths:
            paths[own] = name
            added.append(f"{own}:{name}:{name.replace('/', '-')}\n")
    if added and not text.endswith("\n"):
        text += "\n"
    wanted = {name.partition("/")[2]: key for name, key in ids.items() if name != ROOT}
    return Merged(text + "".join(added), wanted)


def _read(path: Path) -> str:
    if not path.exists():
        return _HEAD
    data = user_files.read(path)
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        msg = f"{path}: it is not UTF-8 text ({error.reason}); repair it, or choose another folder."
        raise InputError(msg) from error
    lines = (line.strip() for line in text.splitlines())
    first = next((line for line in lines if line and not line.startswith("#")), "")
    if first != "VERSION 1":
        msg = (
            f"{path}: its version is {first!r}, and only 'VERSION 1' is known; choose another "
            "folder, or update the extension."
        )
        raise InputError(msg)
    return text
