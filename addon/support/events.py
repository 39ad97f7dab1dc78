# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Something that happens, announced to whoever subscribed: who announces knows none of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class Event:
    """Something that happens, announced to all that subscribed, in their order."""

    def __init__(self) -> None:
        self._subscribers: list[Callable[..., None]] = []

    def subscribe(self, subscriber: Callable[..., None]) -> None:
        """Call `subscriber` with what is announced, from now on."""
        self._subscribers.append(subscriber)

    def unsubscribe(self, subscriber: Callable[..., None]) -> None:
        """Undo `subscribe`; nothing happens if that was done already."""
        if subscriber in self._subscribers:
            self._subscribers.remove(subscriber)

    def announce(self, *what: Any) -> None:
        """Tell every subscriber."""
        for subscriber in tuple(self._subscribers):
            subscriber(*what)


unregistering = Event()
"""Announced when the extension is about to be disabled: what was kept for it is to go."""
