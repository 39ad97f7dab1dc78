# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of materials as icons that a panel draws with `layout.template_icon`.

A panel asks for an icon and gets at once what there is: drawing never computes. What is missing or
out of date is made in a timer, right after drawing, and the editors are drawn again. What follows
a slider is announced (`changes.derived`), and pictured in the same redraw; whoever else changes a
material while the user watches calls `refresh`.

Blender draws such an icon in a square: `template_icon(icon, scale=units)` takes as many widget
heights, less a border of 0.3, and scales the picture into the rest, letterboxed. A picture of
exactly `side(units)` pixels in both directions is drawn pixel for pixel; it is blended as
premultiplied, display-encoded color. All figures here are therefore squares, and the wide plots
share one, "sheet".
"""

from __future__ import annotations

import math
import time
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import bpy

from ...core.errors import RoughSpectraError
from ...core.numerics import memoized
from ..material import changes, snapshot
from ..material.snapshot import Snapshot
from . import theme
from .drawing import looks
from .kept import Kept

_BOUND = 64
"""Pictures kept; a sheet has about 0.3 MB at scale 1."""
_AT_ONCE = 0.012
"""Seconds of work in one go of the timer: less than a frame."""
_WATCHED = 2.0
"""Seconds since a picture was last drawn while it counts as visible."""

_BORDER = 0.3
"""Widget heights that `template_icon` leaves free, both sides together."""
_PANEL_MARGIN = 1.7
"""Widget heights that a panel and its scroll bar take of the width of a region."""

FIGURES = ("ball", "swatches", "sheet", "spectrum", "angles", "polar")
"""Names of pictures of a material: a ball of it; target and Blender side by side; range of σ,
spectrum and angles below each other; and each plot alone."""


Basis = tuple[Snapshot, looks.Look]
"""All that a material's pictures depend on: its facts, and how they are drawn."""


@dataclass
class _Picture:
    name: str
    basis: Basis
    icon: int
    drawn: float


class _Wish(NamedTuple):
    material: int
    figure: str
    side: int


_pictures: OrderedDict[_Wish, _Picture] = OrderedDict()
_pending: dict[_Wish, Basis] = {}
_differences: dict[int, tuple[Basis, tuple[float, float, float]]] = {}


def unit(scale: float, pixel_size: float) -> int:
    """Height of a widget in pixels, from the `theme.scale` and `preferences.system.pixel_size`."""
    # Blender rounds in single precision, where 18 times the scale at 150 dpi is 37.5 and goes up.
    body = math.floor(18 * scale + 0.5 + 1e-3)
    return body + 2 * max(int(pixel_size), 1)


def side(units: float, height: int) -> int:
    """Pixels of a picture that `template_icon(…, scale=units)` draws one to one.

    `height` is that of a widget, from `unit`.
    """
    return max(int(int(height * units) - _BORDER * height), 1)


def fit(width: int, height: int, inset: float = 0.0) -> float:
    """Give the `scale` for `template_icon` at which a picture fills the width of a panel.

    Parameters
    ----------
    width
        Of the region, pixels.
    height
        Of a widget, from `unit`.
    inset
        Widget heights that boxes around the picture take of the width.

    Half units, so that dragging the border of an editor does not make a picture for every pixel.
    """
    free = width / height - _PANEL_MARGIN - inset
    return max(int(free * 2) / 2, 1.0)


def icon_id(uid: int, figure: str, pixels: int, basis: Basis) -> int:
    """Give the icon of a figure, to be called while drawing; 0 while there is none yet.

    Parameters
    ----------
    uid
        The material's `session_uid`.
    figure
        One of `FIGURES`.
    pixels
        From `side`.
    basis
        What the picture depends on now.

    A picture that is out of date is shown until the new one is there, within a frame: an empty
    square for a moment would flicker.
    """
    wish = _Wish(uid, figure, pixels)
    picture = _pictures.get(wish)
    if picture is None or picture.basis != basis:
        _pending[wish] = basis
        if not bpy.app.timers.is_registered(_work):
            bpy.app.timers.register(_work, first_interval=0)
    if picture is None:
        return 0
    picture.drawn = time.monotonic()
    _pictures.move_to_end(wish)
    return picture.icon


def differences(uid: int, basis: Basis) -> tuple[float, float, float] | None:
    """Give ΔE00 of what is in the shader node, to be called while drawing, after `icon_id`.

    At the instrument, and mean and 95th percentile over all angles; None until they are computed
    along with the pictures. Parameters as with `icon_id`.
    """
    found = _differences.get(uid)
    return found[1] if found is not None and found[0] == basis else None


def refresh(material: Any) -> None:
    """Make the visible pictures of a material again, now; not to be called while drawing."""
    wishes = _visible(material)
    if wishes:
        _make(material, wishes)
        redraw()


def _on_derived(done: changes.Derived) -> None:
    """Make the visible pictures of a material that followed a setting, of what was found then."""
    wishes = _visible(done.material)
    if wishes:
        _make(done.material, wishes, done)
        redraw()


def _visible(material: Any) -> list[_Wish]:
    uid, now = material.session_uid, time.monotonic()
    return [
        wish
        for wish, picture in _pictures.items()
        if wish.material == uid and now - picture.drawn < _WATCHED
    ]


def clear() -> None:
    """Forget all pictures."""
    if bpy.app.timers.is_registered(_work):
        bpy.app.timers.unregister(_work)
    _pending.clear()
    _differences.clear()
    _pictures.clear()
    changes.derived.unsubscribe(_on_derived)
    _kept.close()


_kept = Kept(clear)
memoized.enlist(__name__, "_pictures", _pictures.__len__, clear)


def _work() -> float | None:
    """Make what drawing asked for; comes back where that takes longer than a frame."""
    end = time.monotonic() + _AT_ONCE
    by_uid = {material.session_uid: material for material in bpy.data.materials}
    while _pending:
        uid = next(iter(_pending)).material
        wishes = [wish for wish in _pending if wish.material == uid]
        for wish in wishes:
            del _pending[wish]
        if uid in by_uid:
            _make(by_uid[uid], wishes)
        if _pending and time.monotonic() > end:
            redraw()
            return 0.0
    redraw()
    return None


def _make(material: Any, wishes: Sequence[_Wish], done: changes.Derived | None = None) -> None:
    """Make pictures of a material, of what was derived from it just before or of what it stores."""
    from ..blender import working_space
    from ..material import settled
    from . import data
    from .figures import compose

    found = snapshot.of(material) if done is None else done.known
    look = theme.current(bpy.context.preferences)
    basis = (found, look)
    try:
        if done is not None and done.solved is not None:
            shown, apart = data.of_derived(done, done.solved)
        else:
            space = working_space.current()
            shown = data.collect(material, space, found.flat, found)
            apart = settled.differences(material, space, found.flat, found)
    except RoughSpectraError:
        # The panel says what is wrong with the material; there is nothing to picture.
        for wish in wishes:
            _store(wish, basis, None)
        return
    _differences[material.session_uid] = (basis, apart)
    for wish in wishes:
        _store(wish, basis, compose.picture(wish.figure, shown, wish.side, look))


def _store(wish: _Wish, basis: Basis, canvas: Any) -> None:
    picture = _pictures.get(wish)
    if picture is None:
        name = f"{wish.material}-{wish.figure}-{wish.side}"
        picture = _pictures[wish] = _Picture(name, basis, 0, time.monotonic())
    picture.basis = basis
    if canvas is None:
        picture.icon = 0
        return
    if not _kept:  # from the first picture on: before, there is nothing to draw anew
        changes.derived.subscribe(_on_derived)
    preview = _kept.get(picture.name)
    upload(preview, canvas)
    picture.icon = preview.icon_id
    while len(_pictures) > _BOUND:
        _, oldest = _pictures.popitem(last=False)
        _kept.forget(oldest.name)


def upload(preview: Any, canvas: Any, *, small: bool = False) -> None:
    """Give a canvas to Blender, which counts rows from the lowest up.

    `small` is for icons in buttons and lists.
    """
    import numpy as np

    height, width = canvas.shape[:2]
    flat = np.ascontiguousarray(canvas[::-1]).reshape(-1).view(np.int32)
    preview.image_size = (width, height)
    preview.image_pixels.foreach_set(flat)
    if small:
        preview.icon_size = (width, height)
        preview.icon_pixels.foreach_set(flat)


def redraw() -> None:
    """Draw the editors again that have the panel; not to be called while drawing."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"PROPERTIES", "NODE_EDITOR"}:
                area.tag_redraw()
            elif area.type == "VIEW_3D":
                # The sidebar alone: a viewport is dear.
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()
