# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What materials of the open file are to be in other renderers: the spectrum's target, matte."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from ...core.errors import RoughSpectraError
from ..blender import shader_nodes
from ..material import settled, snapshot, state
from .entry import Wanted

_GLOSS = "its gloss is left behind: what is exported is matte"
_TEXTURE = "its color is a texture's, and what is exported is its sample's one color"
_SCENE = "it is matched to its scene, and what is exported reads as its spectrum"
_EDITED = "what its node shows was edited by hand, and what is exported follows its spectrum"
_BUMPED = "its bump is left behind"


def wanted(materials: Iterable[Any]) -> tuple[list[Wanted], list[str]]:
    """Take down what materials store.

    Parameters
    ----------
    materials
        Of `bpy.types.Material`; one that comes twice counts once.

    Returns
    -------
    What each is to be, and for each that cannot be used a sentence.
    """
    found, faults = [], []
    for material in dict.fromkeys(materials):
        try:
            request = settled.of(material).request
        except RoughSpectraError as error:
            faults.append(str(error))
            continue
        bare = replace(request, scene=None, flat=False, gloss=None)
        found.append(Wanted(material.name, bare, tuple(_left_behind(material))))
    return found, faults


def _left_behind(material: Any) -> Iterable[str]:
    known = snapshot.of(material)
    surface = shader_nodes.surface(material)
    if known.inputs.scene_view:
        yield _SCENE
    if state.edited_by_hand(material):
        yield _EDITED
    if surface is None:
        return
    if surface.gloss is not None:
        yield _GLOSS
    if surface.scaled or surface.color_linked:
        yield _TEXTURE
    if surface.bumped:
        yield _BUMPED
    for name in surface.disturbing:
        yield f"its {name} is left behind"
