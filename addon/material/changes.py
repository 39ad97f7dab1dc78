# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens to materials, for whoever wants to know.

A setting that changes is announced here, and so is what was derived from it. The properties, which
announce, thereby know nothing of those who subscribe: what derives, and what draws.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ..support.events import Event

setting_changed = Event()
"""Announced with the material, one with a spectrum, whose setting was changed."""

derived = Event()
"""Announced with the material whose color and roughness followed a setting at once."""

_pauses: list[None] = []


@contextmanager
def paused() -> Iterator[None]:
    """Announce no setting while several are written; whoever writes them derives afterwards."""
    _pauses.append(None)
    try:
        yield
    finally:
        _pauses.pop()


def on_setting(group: Any, _context: Any) -> None:
    """Announce that a setting of a material's `rough_spectra` was changed; update of properties."""
    if not _pauses and group.spectrum:
        setting_changed.announce(group.id_data)
