# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The renderers and formats that materials are exported for, one file each, found by itself.

NAME = "pbrt"                                        what the user types
TITLE = "pbrt-4"                                     what a person calls it
PLACE = 50                                           among the others, when they are listed
ENDING = "pbrt"                                      what follows the base name
LOBES = (LAMBERT,)                                   what it shows of light, the simplest first
SPACES = (SPECTRA,)                                  what its colors are in; of several, the
                                                     first that a color lies in
NEEDS = "usd"                                        only where Blender may lack it: one of
                                                     bpy.app.build_options
def content(entries: Sequence[Entry]) -> Content     all of the file
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Protocol

from ....core.errors import DomainError
from ....core.lobes import Lobe
from ...support import discovery
from ..entry import Entry

Written = Callable[[Path], None]
"""Writes a whole file to a path."""

Content = bytes | Written
"""All of a file, or what writes it."""


class Target(Protocol):
    """What a module of this package offers."""

    NAME: str
    TITLE: str
    PLACE: int
    ENDING: str
    LOBES: tuple[Lobe, ...]
    SPACES: tuple[str, ...]

    def content(self, entries: Sequence[Entry]) -> Content:
        """Give all of the file with these materials."""


REGISTRY: Mapping[str, Target] = MappingProxyType(
    {
        target.NAME: target
        for target in sorted(discovery.modules(__name__, __path__), key=lambda each: each.PLACE)
    }
)
"""Every target by its name."""

NAMES = tuple(REGISTRY)


def find(name: str) -> Target:
    """Give the target of this name.

    Raises
    ------
    DomainError
        If there is none; the message lists the names.
    """
    if name not in REGISTRY:
        msg = f"The target {name!r} is not known; choose of {', '.join(NAMES)}."
        raise DomainError(msg)
    return REGISTRY[name]
