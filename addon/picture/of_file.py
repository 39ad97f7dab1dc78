# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept in memory as long as a file is open, and forgotten with it."""

from __future__ import annotations

from typing import Any, Generic, TypeVar

import bpy
from bpy.app.handlers import persistent

from ..support import events

_Thing = TypeVar("_Thing")
_kept: list[OfFile[Any]] = []
"""All that hold something."""


class OfFile(Generic[_Thing]):
    """A thing of the open file, the last one that was put here."""

    def __init__(self) -> None:
        self._thing: _Thing | None = None

    def put(self, thing: _Thing) -> None:
        """Keep it, in place of the one before."""
        if not _kept:
            bpy.app.handlers.load_post.append(_forget)
            events.unregistering.subscribe(_end)
        if self not in _kept:
            _kept.append(self)
        self._thing = thing

    def get(self) -> _Thing | None:
        """Give it; None where there is none."""
        return self._thing

    def forget(self) -> None:
        """Let go of it."""
        self._thing = None


@persistent
def _forget(_path: str) -> None:
    """Another file has other things."""
    _end()


def _end() -> None:
    for each in _kept:
        each.forget()
    _kept.clear()
    events.unregistering.unsubscribe(_end)
    if _forget in bpy.app.handlers.load_post:
        bpy.app.handlers.load_post.remove(_forget)
