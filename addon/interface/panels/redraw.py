# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of a material ask about it: once in a redraw, and handed on from panel to panel.

Blender draws a panel and right after it those inside, and nothing can change in between. The
outermost panel asks anew, so that no redraw is shown what an earlier one found.
"""

from __future__ import annotations

import time
from typing import Any

from ...material import last_measurement, settled, snapshot, state, together
from ...preview import icons, theme
from ...preview.drawing import looks
from ..operators import targets
from . import sentences, text

_LONGEST = 0.1
"""Seconds that a redraw may last; what is older is not taken over."""

_last: list[Redraw] = []


class Redraw:
    """A region while its panels are drawn.

    Parameters
    ----------
    context
        Of the region.
    """

    def __init__(self, context: Any) -> None:
        self.began = time.monotonic()
        self.region = context.region  # to be compared alone: it may be gone already
        preferences = context.preferences
        look = theme.current(preferences)
        self.width = self.region.width
        form = text.format_of(preferences, look.scale, self.width, context.area.type)
        self.style = sentences.style(form)
        material: Any = targets.active_material(context)
        self.has_material = material is not None
        self.scale = look.scale
        self.previewed = False
        self.together = together.Together([], 0)
        self.shown = None
        self.measured = None
        found = None if material is None else snapshot.of(material)
        if found is not None and found.inputs.spectrum:
            unit = icons.unit(look.scale, preferences.system.pixel_size)
            self.together = together.shown(material, context.selected_objects, context.scene)
            self.shown = PanelMaterial(material.session_uid, found, look, unit)
            if self.shown.obstacle is not None:
                self.measured = last_measurement.get(material, found)
            # Of a scene for Cycles, Material Preview is of another engine than the scene's.
            self.previewed = not found.flat and bool(targets.previews(context))

    @property
    def format(self) -> text.Format:
        """Width and letters of the sentences."""
        return self.style.format


class PanelMaterial:
    """A material with a spectrum as it is while the panels are drawn, and its pictures.

    Parameters
    ----------
    uid
        Its `session_uid`.
    found
        Its facts.
    look
        How the pictures are drawn.
    unit
        Height of a button, pixels.
    """

    def __init__(self, uid: int, found: snapshot.Snapshot, look: looks.Look, unit: int) -> None:
        self.uid, self.facts, self.unit = uid, found, unit
        self.state = state.evaluate(found)
        self._pictured = (found, look)

    @property
    def obstacle(self) -> settled.Obstacle | None:
        """Why the surface cannot be compared with the target, if it cannot."""
        return settled.obstacle(self.facts.surface)

    @property
    def is_bumped(self) -> bool:
        """Whether the surface is turned point by point, which no number counts."""
        return self.facts.surface is not None and self.facts.surface.bumped

    @property
    def is_glossy(self) -> bool:
        """Whether gloss lies over the color."""
        return self.facts.surface is not None and self.facts.surface.gloss is not None

    def picture(self, figure: str, units: float) -> int:
        """Give the icon of a figure for `template_icon` with this scale."""
        return icons.icon_id(self.uid, figure, icons.side(units, self.unit), self._pictured)

    def apart(self) -> tuple[float, float, float] | None:
        """Give ΔE00 of what is in the shader node: as stored, or computed with the pictures."""
        stored = settled.numbers(self.facts, self.facts.flat)
        return stored or icons.differences(self.uid, self._pictured)


def begin(context: Any) -> Redraw:
    """Ask anew, for the outermost panel."""
    _last[:] = [Redraw(context)]
    return _last[0]


def current(context: Any) -> Redraw:
    """Give what the panel around this one found, for those inside."""
    if _last:
        last = _last[0]
        if time.monotonic() - last.began < _LONGEST and last.region == context.region:
            return last
    return begin(context)
