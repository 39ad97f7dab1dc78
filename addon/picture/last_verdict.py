# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last verdict on a scene of the open file, for the panel, and whether it still counts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from ..blender import working_space
from .of_file import OfFile

if TYPE_CHECKING:
    from .verdict import Verdict


class Judged(NamedTuple):
    """A verdict, and what it is of.

    Parameters
    ----------
    verdict
        What was found.
    scene
        The scene's `session_uid`.
    spaces
        Names of working spaces in which it counts: the file's, and the one that it advises.
    """

    verdict: Verdict
    scene: int
    spaces: frozenset[str]


_last: OfFile[Judged] = OfFile()


def put(scene: Any, found: Verdict) -> None:
    """Keep a verdict on a scene."""
    spaces = {working_space.working_space_name()}
    if "space" in found.advised.kind:
        from .verdict import WIDE  # most sessions of Blender ask for no verdict

        spaces.add(WIDE)
    _last.put(Judged(found, scene.session_uid, frozenset(spaces)))


def of(scene: Any) -> Verdict | None:
    """Give the last verdict, if it is on this scene in a working space that it speaks of."""
    last = _last.get()
    if last is None or last.scene != scene.session_uid:
        return None
    return last.verdict if working_space.working_space_name() in last.spaces else None


def forget() -> None:
    """Let go of it, as the scene is another one now."""
    _last.forget()
