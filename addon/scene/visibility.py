# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a render shows of a view layer: its viewports may show more, or less."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

_COUNTED = {"LIGHT", "MESH", "CURVE", "SURFACE", "META", "FONT"}
_NAMED = 5
"""Objects named in a sentence; of more only the number is told."""
_NESTED = 8
"""Instances within instances that Blender follows."""


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
        self._hidden: dict[Any, set[Any]] = {}

    def shows(self, instance: Any) -> bool:
        """Whether a render shows a `bpy.types.DepsgraphObjectInstance`."""
        if not instance.show_self:
            return False
        thing = instance.object.original
        if not instance.is_instance:
            return thing in self._objects and not _stands_for_instances(thing)
        source = instance.parent.original  # the outermost, of instances within instances
        if source not in self._objects:
            return False
        if source.instance_type == "COLLECTION" and source.instance_collection is not None:
            return thing not in self._hidden_in(source.instance_collection)
        # Geometry nodes show instances of an object that is hidden itself.
        return not thing.hide_render or any(change.type == "NODES" for change in source.modifiers)

    def _hidden_in(self, collection: Any) -> set[Any]:
        if collection not in self._hidden:
            shown: set[Any] = set()
            hidden: set[Any] = set()
            _sort(collection, shown, hidden, False, _NESTED)
            self._hidden[collection] = hidden - shown
        return self._hidden[collection]

    def unseen(self) -> list[Any]:
        """Give what a render shows and viewports don't, and what that instances: original objects.

        It is not evaluated: what its modifiers would make is unknown.
        """
        found: dict[Any, None] = {}
        for thing in self._objects:
            if not thing.visible_get(view_layer=self._layer):
                found.setdefault(thing)
                inner = thing.instance_collection if thing.instance_type == "COLLECTION" else None
                if inner is not None:
                    hidden = self._hidden_in(inner)
                    found |= dict.fromkeys(each for each in inner.all_objects if each not in hidden)
        return sorted(found, key=lambda thing: thing.name)

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


def _stands_for_instances(thing: Any) -> bool:
    """Whether only its instances are shown, on the vertices or faces of its parent."""
    return thing.parent is not None and thing.parent.instance_type in {"VERTS", "FACES"}


def _sort(collection: Any, shown: set[Any], hidden: set[Any], hide: bool, depth: int) -> None:
    """Tell the objects of an instanced collection that a render shows from those it doesn't."""
    hide = hide or collection.hide_render
    for thing in collection.objects:
        unseen = hide or thing.hide_render
        (hidden if unseen else shown).add(thing)
        inner = thing.instance_collection if thing.instance_type == "COLLECTION" else None
        if inner is not None and depth:
            _sort(inner, shown, hidden, unseen, depth - 1)
    for child in collection.children:
        _sort(child, shown, hidden, hide, depth)
