# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Roughness and gloss of all selected objects that carry the same sample, set in one go.

A sample is chosen for all selected objects, each of which may have a material of its own. What the
panel's balls and sliders then set goes to all of these, while scripts, keyframes and *Details* mean
one material. Cheap to ask while drawing.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any, NamedTuple

import bpy

from ...core.numerics import memoized
from ..blender import shader_nodes
from ..blender.sockets import OF_NODE
from . import changes, snapshot

_LOOKED_AT = 64
"""Selected objects that are looked at while a panel draws: of more, it says "up to"."""


class Together(NamedTuple):
    """What is set in one go.

    Parameters
    ----------
    materials
        The one at hand first.
    objects
        How many selected objects carry one of them; 0 where the one at hand is on none of them.
    is_exact
        Whether all selected objects were looked at.
    others
        How many objects of the scene carry one of them and are not selected: they change, too.
    """

    materials: list[Any]
    objects: int
    is_exact: bool = True
    others: int = 0


_counted: list[tuple[float, tuple[Any, ...], frozenset[int]]] = []
"""When, for what, and which objects carry the materials that were asked for last: to find them
takes milliseconds where a scene has thousands."""
memoized.enlist(__name__, "_counted", _counted.__len__, _counted.clear)
_LASTS = 0.5
"""Seconds for which what was found counts, unless it is seen that something changed."""


def of(material: Any, selected: Sequence[Any], most: int | None = None) -> Together:
    """Find the materials that are set with one: local, on selected objects, and of its sample.

    Parameters
    ----------
    material
        A `bpy.types.Material` with a spectrum.
    selected
        The selected objects.
    most
        How many of them are looked at; None for all.
    """
    if len(selected) < 2:
        return Together([material], 0)
    alike: dict[Any, bool] = {material: True}
    name, spectrum = material.rough_spectra.sample_name, material.rough_spectra.spectrum
    count, is_on_one = 0, False
    for thing in selected[:most]:
        carries = False
        for slot in thing.material_slots:
            other = slot.material
            if other is None:
                continue
            if other not in alike:
                alike[other] = _is_alike(other, name, spectrum)
            carries |= alike[other]
            is_on_one |= other == material
        count += carries
    if not is_on_one:  # as of a pinned one, which has nothing to do with the selection
        return Together([material], 0)
    exact = most is None or len(selected) <= most
    materials = [other for other, is_alike in alike.items() if is_alike]
    return Together(materials, count if exact else len(selected), exact)


def shown(material: Any, selected: Sequence[Any], scene: Any) -> Together:
    """Find the same while a panel draws, which may take no time, and who else has the materials."""
    found = of(material, selected, _LOOKED_AT)
    if found.objects < 2 or not found.is_exact:
        return found
    everyone = _carriers(found.materials, scene)
    return found._replace(others=len(everyone - {thing.session_uid for thing in selected}))


def _carriers(materials: Sequence[Any], scene: Any) -> frozenset[int]:
    """Give the `session_uid` of a scene's objects that carry one of some materials."""
    key = (
        tuple((material.session_uid, material.users) for material in materials),
        *(scene.session_uid, len(scene.objects), len(bpy.data.objects)),
    )
    now = time.monotonic()
    if not _counted or _counted[0][1] != key or now - _counted[0][0] > _LASTS:
        wanted = set(materials)
        users = _users(wanted)
        things = {user for user in users if isinstance(user, bpy.types.Object)}
        things |= {user for user in _users(users - things) if isinstance(user, bpy.types.Object)}
        here = frozenset(
            thing.session_uid
            for thing in things
            if scene.objects.get(thing.name) == thing
            and any(slot.material in wanted for slot in thing.material_slots)
        )
        _counted[:] = [(now, key, here)]
    return _counted[0][2]


def _users(data: set[Any]) -> set[Any]:
    if not data:
        return set()
    return set().union(*bpy.data.user_map(subset=data).values())


def set_sigma(material: Any, selected: Sequence[Any], sigma: float) -> None:
    """Set the roughness, in radians, of a material and of those that are set with it."""
    materials = of(material, selected).materials
    with changes.paused():
        for each in materials:
            each.rough_spectra.sigma = sigma
    changes.announce_several(materials)


def set_gloss(material: Any, selected: Sequence[Any], gloss: float) -> None:
    """Set the gloss, 0 to 1, of a material and of those that are set with it."""
    materials = of(material, selected).materials
    # One whose shader cannot shine gets another, and follows that by itself.
    able = [each for each in materials if _can_shine(each)]
    for each in materials:
        if each not in able:
            each.rough_spectra.gloss = gloss
    with changes.paused():
        for each in able:
            each.rough_spectra.gloss = gloss
    changes.announce_several(able)


def _is_alike(other: Any, name: str, spectrum: str) -> bool:
    group = other.rough_spectra
    if group.sample_name != name or group.spectrum != spectrum:
        return False
    return not snapshot.elsewhere(other)


def _can_shine(material: Any) -> bool:
    node = shader_nodes.shader_node(material)
    return node is not None and bool(OF_NODE[node.bl_idname].gloss)
