# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a material can be renewed: asked for while drawing, found out in a timer after it.

What decides it are nodes, drivers and the stored spectrum, which take too long to look at while a
panel draws. The button is gray until it is known, and where renewing would fail; why stands beside
the numbers.
"""

from __future__ import annotations

import time
from typing import Any, NamedTuple

import bpy

from ....core.errors import RoughSpectraError
from ....core.numerics.memoized import kept
from ...material.snapshot import Snapshot
from ...preview import icons
from ...support import events

_LASTS = 1.0
"""Seconds after which is asked again: an unlinked driver changes nothing that a snapshot has."""


class _Answer(NamedTuple):
    """What was found of a material, of which facts, and when; why it cannot be, if it can't.

    `obstacle` is the kind and the socket of an `obstacles.SocketError`, if that is why.
    """

    found: Snapshot
    when: float
    reason: str
    obstacle: tuple[str, str] | None


_answers: dict[int, _Answer] = kept(__name__, "_answers")
_asked: set[int] = set()


def reason_against(uid: int, found: Snapshot) -> str | None:
    """Say why a material cannot be renewed, to be called while drawing.

    Parameters
    ----------
    uid
        Its `session_uid`.
    found
        Its facts.

    Returns
    -------
    A sentence, empty where it can, and None while that is not known.
    """
    answer = _answers.get(uid)
    known = answer is not None and answer.found == found
    if not known or answer is None or time.monotonic() - answer.when > _LASTS:
        if not _asked:
            events.unregistering.subscribe(clear)
        _asked.add(uid)
        if not bpy.app.timers.is_registered(_work):
            bpy.app.timers.register(_work, first_interval=0)
    return answer.reason if known and answer is not None else None


def obstacle(uid: int, found: Snapshot) -> tuple[str, str] | None:
    """Give the socket that is in the way and how it is freed, as far as `reason_against` knows.

    Parameters as there, which is to be asked before.
    """
    answer = _answers.get(uid)
    return answer.obstacle if answer is not None and answer.found == found else None


def _obstacle(material: Any) -> tuple[str, str] | None:
    from ...blender import obstacles, shader_nodes

    try:
        shader_nodes.find(material, material.rough_spectra.shader)
    except obstacles.SocketError as fault:
        return fault.kind, fault.socket
    except RoughSpectraError:
        pass  # why stands beside the numbers
    return None


def _work() -> None:
    from ...material import derive, snapshot

    changed = False
    for material in bpy.data.materials:
        if material.session_uid not in _asked:
            continue
        found, before = snapshot.of(material), _answers.get(material.session_uid)
        _, reasons = derive.renewable([material])
        fault = _obstacle(material) if reasons else None
        answer = _Answer(found, time.monotonic(), reasons[0] if reasons else "", fault)
        # The obstacle goes with the reason.
        changed |= before is None or before[::2] != answer[::2]
        _answers[material.session_uid] = answer
    _asked.clear()
    if changed:
        icons.redraw()


def clear() -> None:
    """Forget what was found."""
    if bpy.app.timers.is_registered(_work):
        bpy.app.timers.unregister(_work)
    _asked.clear()
    _answers.clear()
    events.unregistering.unsubscribe(clear)
