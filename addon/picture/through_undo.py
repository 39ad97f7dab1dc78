# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of pictures that undo and redo leave as they are, as they leave the render result.

They come to the file when a render ends, amid the user's steps. Undo goes back to a file from
before, in which there are none; so they are made again, and shown where they were.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import bpy
from bpy.app.handlers import persistent

from ..support import events
from .of_file import OfFile


class _Kept(NamedTuple):
    """What makes an image again, and the `session_uid`s of all that it made: they are alike."""

    make: Callable[[], Any]
    made: frozenset[int]


_images: OfFile[dict[str, _Kept]] = OfFile()
"""Our images, by their marks."""
_there: OfFile[dict[str, list[tuple[int, int]]]] = OfFile()
"""Our images before a step back, and the windows and areas that show them."""
MARK = "rough_spectra"
"""Custom property by which our images are known, whatever they are called."""


def keep(image: Any, make: Callable[[], Any]) -> None:
    """Let an image with a mark come through undo from now on; `make` makes it anew."""
    _put(image.get(MARK), _Kept(make, frozenset({image.session_uid})))
    if _before not in bpy.app.handlers.undo_pre:
        for handlers, handler in _handlers():
            handlers.append(handler)
        events.unregistering.subscribe(_end)


def _put(mark: str, kept: _Kept) -> None:
    _images.put({**(_images.get() or {}), mark: kept})


def _handlers() -> tuple[tuple[list[Any], Callable[..., None]], ...]:
    known = bpy.app.handlers
    return (
        (known.undo_pre, _before),
        (known.redo_pre, _before),
        (known.undo_post, _after),
        (known.redo_post, _after),
    )


def _end() -> None:
    events.unregistering.unsubscribe(_end)
    for handlers, handler in _handlers():
        if handler in handlers:
            handlers.remove(handler)


def find(mark: str) -> Any | None:
    """Give our image of a mark; None without one."""
    return next((image for image in bpy.data.images if image.get(MARK) == mark), None)


@persistent
def _before(*_: Any) -> None:
    """Note which images are there: one that the user removed shall not come back."""
    found: dict[str, list[tuple[int, int]]] = {}
    for mark in _images.get() or ():
        if find(mark) is not None:
            found[mark] = []
    for place, space in _editors():
        mark = "" if space.image is None else space.image.get(MARK, "")
        if mark in found:
            found[mark].append(place)
    _there.put(found)


@persistent
def _after(*_: Any) -> None:
    """Make again what went."""
    images, there = _images.get() or {}, _there.get()
    for mark, places in (there or {}).items():
        image, kept = find(mark), images[mark]
        if image is None or image.session_uid not in kept.made:  # none, or an earlier picture
            image = kept.make()
            _put(mark, _Kept(kept.make, kept.made | {image.session_uid}))
        for place, space in _editors():
            if place in places and space.image is None:
                space.image = image


def _editors() -> Iterator[tuple[tuple[int, int], Any]]:
    """Give all image editors, and where they are."""
    manager = bpy.context.window_manager
    for number, window in enumerate(manager.windows if manager else ()):
        for order, area in enumerate(window.screen.areas):
            if area.type == "IMAGE_EDITOR":
                yield (number, order), area.spaces.active
