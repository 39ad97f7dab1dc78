# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A row of balls in a sample's color, one a roughness, as icons for buttons.

Asked for while drawing, and made in a timer after it, once a sample: they depend on no setting that
is dragged. As with `icons`, drawing never computes.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from dataclasses import replace
from typing import Any, NamedTuple

import bpy

from ...core.errors import RoughSpectraError
from ...core.limits import TOLERANCE
from ...core.numerics import memoized
from ..material.roughness_words import STEPS
from ..material.snapshot import Inputs, Snapshot
from . import icons
from .kept import Kept

_SIDE = 16
"""Pixels of an icon in a button, at interface scale 1."""
_BOUND = 64
"""Samples whose balls are kept."""


class _Key(NamedTuple):
    """All that a row of balls depends on."""

    inputs: Inputs
    working_space: str
    side: int


_pending: dict[_Key, int] = {}
_rows: OrderedDict[_Key, tuple[int, ...]] = OrderedDict()


def icon_ids(uid: int, found: Snapshot, scale: float) -> tuple[int, ...]:
    """Give the icons of `STEPS`, to be called while drawing; empty while there are none.

    Parameters
    ----------
    uid
        The material's `session_uid`.
    found
        Its facts.
    scale
        Of the interface.
    """
    key = _Key(_alike(found.inputs), found.working_space, round(_SIDE * scale))
    row = _rows.get(key)
    if row is None:
        _pending[key] = uid
        if not bpy.app.timers.is_registered(_work):
            bpy.app.timers.register(_work, first_interval=0)
        return ()
    _rows.move_to_end(key)
    return row


def _alike(inputs: Inputs) -> Inputs:
    """Leave out what the balls do not depend on."""
    return inputs._replace(
        sigma_degrees=0.0, tolerance=TOLERANCE, scene_view="", flat=False, model="", shader=""
    )


def _work() -> None:
    by_uid = {material.session_uid: material for material in bpy.data.materials}
    for key, uid in list(_pending.items()):
        del _pending[key]
        if uid in by_uid:
            _rows[key] = _make(by_uid[uid], key)
    while len(_rows) > _BOUND:
        oldest, _ = _rows.popitem(last=False)
        for step in STEPS:
            _kept.forget(_name(oldest, step))
    icons.redraw()


def _make(material: Any, key: _Key) -> tuple[int, ...]:
    from ..blender import working_space
    from ..matching import solve
    from ..material import storage
    from . import figures
    from .figures import data

    space = working_space.current()
    try:
        request = replace(storage.load(material), model=solve.AUTO, gloss=None, scene=None)
        solved = solve.solve([replace(request, sigma=math.radians(s)) for s in STEPS], space)
    except RoughSpectraError:
        return ()  # the panel says what is wrong with the material
    found = []
    for step, solution in zip(STEPS, solved, strict=True):
        preview = _kept.get(_name(key, step))
        to_screen = data.to_screen(space.key)
        canvas = figures.ball(key.side, solution.color, solution.roughness, to_screen)
        icons.upload(preview, canvas, small=True)
        found.append(preview.icon_id)
    return tuple(found)


def _name(key: _Key, step: float) -> str:
    return f"{hash(key)}-{step:g}"


def clear() -> None:
    """Forget all balls."""
    if bpy.app.timers.is_registered(_work):
        bpy.app.timers.unregister(_work)
    _pending.clear()
    _rows.clear()
    _kept.close()


_kept = Kept(clear)
memoized.enlist(__name__, "_rows", _rows.__len__, clear)
