# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a material's spectrum comes from, and what was noticed when it was read."""

from __future__ import annotations

import json
from functools import lru_cache
from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from . import redraw

_SHOWN = (
    *(("device", "Device"), ("geometry", "Geometry"), ("aperture", "Aperture")),
    *(("condition", "Condition"), ("specular", "Specular"), ("license", "License")),
)


def draw_source(layout: Any, context: Any, material: Any) -> None:
    """Draw source, what the file says of the measurement, and every note."""
    group = material.rough_spectra
    write = redraw.current(material, context).write
    details, sentences = _details(group.details)
    write.sentence(layout, group.source or iface_("The source is not known"), "FILE")
    column = layout.column(align=True)
    for label, value in details:
        write.sentence(column, f"{iface_(label)}: {value}")
    if group.sigma_source:
        text = f"{iface_('σ from')}: {group.sigma_source}"
        write.sentence(layout, text, "FORCE_TURBULENCE")
    for text in sentences:
        write.sentence(layout, text, "INFO")


@lru_cache(maxsize=32)
def _details(text: str) -> tuple[tuple[tuple[str, str], ...], tuple[str, ...]]:
    try:
        data = json.loads(text or "{}")
        shown = tuple((label, str(data[key])) for key, label in _SHOWN if data.get(key))
        return shown, (*map(str, data.get("altered", ())), *map(str, data.get("notes", ())))
    except (ValueError, TypeError, AttributeError):
        return (), ()
