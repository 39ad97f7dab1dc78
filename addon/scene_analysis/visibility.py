# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a render shows of a view layer: its viewports may show more, or less."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

_COUNTED = {"LIGHT", "MESH", "CURVE", "SURFACE", "META", "FONT"}
_NAMED = 5
"""Objects named in a sentence; of more only the number is told."""


class Rendered:
    """Objects of a view layer that a render shows.

    Parameters
    ----------
    layer
        A `bpy.types.ViewLayer`.
    """

    def __init__(self, layer: Any) -> None:
        self._layer = layer
        self._objects = {thing for thing in _of(layer.layer_collection) if not thing.hide_render}

    def shows(self, instance: Any) -> bool:
        """Whether a render shows a `bpy.types.DepsgraphObjectInstance`."""
        if not instance.show_self:
            return False
        thing = instance.object.original
        if not instance.is_instance:
            return thing in self._objects
        source = instance.parent.original
        if thing.hide_render or source.hide_render:
            return False
        whole = source.instance_collection if source.instance_type == "COLLECTION" else None
        return whole is None or not whole.hide_render

    def left_out(self) -> str:
        """Name what a render shows and viewports don't: it is not evaluated; empty if nothing."""
        hidden = sorted(
            thing.name
            for thing in self._objects
            if thing.type in _COUNTED and not thing.visible_get(view_layer=self._layer)
        )
        if not hidden:
            return ""
        more = len(hidden) - _NAMED
        names = ", ".join(hidden[:_NAMED]) + (f" and {more} more" if more > 0 else "")
        return (
            f"Hidden in the viewport only, and left out: {names}; show them and analyze again, or "
            "hide them in renders too."
        )


def _of(layer_collection: Any) -> Iterator[Any]:
    """Objects of collections that are neither excluded nor hidden in renders."""
    if layer_collection.collection.hide_render:
        return
    if not layer_collection.exclude:
        yield from layer_collection.collection.objects
    for child in layer_collection.children:
        yield from _of(child)
