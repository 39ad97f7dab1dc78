# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens to materials, for whoever wants to know.

A setting that changes is announced here, and so is what was derived from it. The properties, which
announce, thereby know nothing of those who subscribe: what derives, and what draws.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

from ..support.events import Event

if TYPE_CHECKING:
    from ..colorimetry.rgb_space import WorkingSpace
    from ..matching.request import Request
    from ..matching.solution import Solution
    from .snapshot import Snapshot


class Solved(NamedTuple):
    """What a setting led to.

    Parameters
    ----------
    request
        With a settled model.
    solution
        What was written for it.
    space
        The working space that its color is in.
    """

    request: Request
    solution: Solution
    space: WorkingSpace


class Derived(NamedTuple):
    """A material that followed a setting, for whoever would else load and solve it again.

    Parameters
    ----------
    material
        The `bpy.types.Material`.
    known
        Its facts as they are now.
    solved
        None where nothing could be derived; the material then says why.
    """

    material: Any
    known: Snapshot
    solved: Solved | None


setting_changed = Event()
"""Announced with the material, one with a spectrum, whose setting was changed."""

several_changed = Event()
"""Announced with a list of materials with a spectrum that had a setting changed in one go."""

derived = Event()
"""Announced, as `Derived`, when a setting was followed at once."""

_pauses: list[None] = []


@contextmanager
def paused() -> Iterator[None]:
    """Announce no setting while several are written; whoever writes them derives afterwards."""
    _pauses.append(None)
    try:
        yield
    finally:
        _pauses.pop()


def announce_several(materials: Sequence[Any]) -> None:
    """Announce that settings of several materials were changed, while `paused`."""
    if materials and not _pauses:
        several_changed.announce(materials)


def on_setting(group: Any, _context: Any) -> None:
    """Announce that a setting of a material's `rough_spectra` was changed; update of properties."""
    if not _pauses and group.spectrum:
        setting_changed.announce(group.id_data)
