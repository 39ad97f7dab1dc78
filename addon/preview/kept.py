# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that Blender keeps as icons for us, from the first one on until the extension ends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bpy.utils import previews

from ..support import events


class Kept:
    """A collection of Blender's previews that is made when it is first needed.

    Parameters
    ----------
    clear
        Called when the extension is disabled; has to call `close`.
    """

    def __init__(self, clear: Callable[[], None]) -> None:
        self._clear = clear
        self._collection: Any = None

    def __len__(self) -> int:
        return 0 if self._collection is None else len(self._collection)

    def __bool__(self) -> bool:
        """Whether there has been a picture, even if none is left."""
        return self._collection is not None

    def get(self, name: str) -> Any:
        """Give the preview of this name, a new one where there is none."""
        if self._collection is None:
            self._collection = previews.new()
            events.unregistering.subscribe(self._clear)
        return self._collection.get(name) or self._collection.new(name)

    def icon_id(self, name: str) -> int:
        """Give the icon of this name; 0 where there is none."""
        if self._collection is None or name not in self._collection:
            return 0
        return int(self._collection[name].icon_id)

    def forget(self, name: str) -> None:
        """Let Blender forget the preview of this name, if there is one."""
        if self._collection is not None and name in self._collection:
            del self._collection[name]

    def close(self) -> None:
        """Let Blender forget all; a picture after that begins anew."""
        if self._collection is not None:
            previews.remove(self._collection)
            self._collection = None
            events.unregistering.unsubscribe(self._clear)
