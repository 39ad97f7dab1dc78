# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The button that removes what keeps a material from being renewed."""

from __future__ import annotations

from typing import Any

from bpy.app.translations import pgettext_iface as iface_

from ...blender.sockets import OF_NODE
from . import redraw, renewal

_TEXTS = {
    "UNLINK": ("Unlink {socket}", "Unlink"),
    "CLEAR": ("Clear Animation", "Clear"),
    "NEUTRAL": ("Set {socket} to {value:g}", "Set to {value:g}"),
}
"""By the kind of obstacle, with what is short enough for the narrowest sidebar."""


def texts(shown: redraw.PanelMaterial) -> list[str]:
    """Give what may stand on the button, the longest first; empty if nothing is in the way."""
    found = renewal.obstacle(shown.uid, shown.facts)
    if found is None:
        return []
    kind, socket = found
    surface = shown.facts.surface
    neutral = {} if surface is None else OF_NODE[surface.shader].neutral
    value = neutral.get(socket, 0.0)
    return [iface_(text).format(socket=socket, value=value) for text in _TEXTS[kind]]


def draw(layout: Any, here: redraw.Redraw, shown: redraw.PanelMaterial) -> bool:
    """Draw the button, if a socket is in the way; returns whether it is."""
    found = renewal.obstacle(shown.uid, shown.facts)
    if found is None:
        return False
    kind, socket = found
    button = layout.operator(
        "rough_spectra.remove_obstacle", text=here.format.fitting(texts(shown)), translate=False
    )
    button.kind, button.socket = kind, socket
    return True
