# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a color stands, and how datablocks are named and found again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy

from .scene_copy import path_of


@dataclass(frozen=True)
class Place:
    """Where a color stands.

    Parameters
    ----------
    of
        Collection of `bpy.data`, name and library's whole path of what it belongs to.
    node, socket
        Name of the node, and number of its input; empty and -1 for an attribute.
    attribute
        Name of a property of `of` itself, or empty.
    """

    of: tuple[str, str, str]
    node: str = ""
    socket: int = -1
    attribute: str = ""


def title(kind: str, data: Any) -> str:
    """Give the name by which a datablock is told, such as "Material 'Wall'"."""
    return f"{kind} {data.name!r}"


def key(collection: str, data: Any) -> tuple[str, str, str]:
    """Give where a datablock is found, as in `Place`."""
    return collection, str(data.name), path_of(data.library)


def owner(of: tuple[str, str, str]) -> Any:
    """Give the datablock that is found there; see `key`."""
    collection, name, path = of
    blocks = getattr(bpy.data, collection)
    for library in bpy.data.libraries if path else (None,):
        found = blocks.get((name, None if library is None else library.filepath))
        if found is not None and path_of(library) == path:
            return found
    raise KeyError(of)
