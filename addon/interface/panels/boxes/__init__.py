# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The boxes inside the panel. A box is one file here, found by itself.

    LABEL = "Difference"                            its title
    TOOLTIP = "Target and Blender side by side"     without a period
    PLACE = 10                                      among the others, from the top
    IN_SIDEBAR = True                               whether it is in the shader editor's sidebar too
    IS_CLOSED = False                               whether it is until the user opens it
    def poll(context: Any) -> bool                  whether there is something to show
    def draw(layout: Any, context: Any) -> None     shows what is stored, and computes nothing

Blender reads the files at its start, and most sessions never show them: what they draw with is
imported inside their functions.
"""

from __future__ import annotations

from typing import Any, Protocol

from ....support.discovery import modules


class Box(Protocol):
    """What a module of this package offers."""

    __name__: str
    LABEL: str
    TOOLTIP: str
    PLACE: int
    IN_SIDEBAR: bool
    IS_CLOSED: bool

    def poll(self, context: Any) -> bool:
        """Whether the box is shown."""

    def draw(self, layout: Any, context: Any) -> None:
        """Draw it."""


def boxes() -> list[Box]:
    """Import all boxes, and give them from the top."""
    return sorted(modules(__name__, __path__), key=lambda box: box.PLACE)
