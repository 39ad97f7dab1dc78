# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of a material ask about it: once in a redraw, and handed on from panel to panel.

Blender draws a panel and right after it those inside, and nothing can change in between. The
outermost panel asks anew, so that no redraw is shown what an earlier one found.
"""

from __future__ import annotations

import time
from typing import Any

from .. import nodes, stamp
from .text import Writer

_LONGEST = 0.1
"""Seconds that a redraw may last; what is older is not taken over."""

_last: list[Redraw] = []


class Redraw:
    """A material as it is while the panels are drawn.

    Parameters
    ----------
    material
        A `bpy.types.Material` with a spectrum.
    context
        Of the region that is drawn.
    """

    def __init__(self, material: Any, context: Any) -> None:
        self.began = time.monotonic()
        self.of = _of(material, context)
        self._space = stamp.working_space_name()
        self.state = stamp.state(material, self._space)
        self.write = Writer(context)
        self._digest: int | None = None

    def digest(self, material: Any, context: Any) -> int:
        """Give what the material's pictures depend on; see `icons.digest`."""
        if self._digest is None:
            from ..preview import icons

            self._digest = icons.digest(material, context, self._space)
        return self._digest

    def is_textured(self, material: Any) -> bool:
        """Whether another node sets color or roughness, so that the sockets' values don't show."""
        if self.state.kind == "fresh":
            return False
        node = nodes.shader_node(material)
        return node is not None and bool(nodes.linked_sockets(node))


def begin(material: Any, context: Any) -> Redraw:
    """Ask anew, for the outermost panel."""
    _last[:] = [Redraw(material, context)]
    return _last[0]


def current(material: Any, context: Any) -> Redraw:
    """Give what the panel around this one found, for those inside."""
    of = _of(material, context)
    if _last and _last[0].of == of and time.monotonic() - _last[0].began < _LONGEST:
        return _last[0]
    return begin(material, context)


def _of(material: Any, context: Any) -> tuple[int, str, int]:
    return material.session_uid, context.area.type, context.region.width
