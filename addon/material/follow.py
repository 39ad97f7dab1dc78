# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let color and roughness follow at once: while a slider is dragged, and when σ is animated.

A material follows only as long as its shader node shows what was derived from its spectrum: an edit
of color or roughness by hand is never overwritten unasked. Gloss is set by hand, and the color
below follows. What goes wrong is kept with the material, for the panel.
Cheap to import; what computes is imported on the first change.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.handlers import persistent

from . import changes

_PATH = "rough_spectra."
"""How the data paths of animated settings begin."""


def _on_setting(material: Any) -> None:
    """Derive color and roughness again after a setting was changed."""
    from . import snapshot, state

    known = snapshot.of(material)
    if state.follows(known):
        _derive(material, known)


def _on_several(materials: Any) -> None:
    """Derive color and roughness of all that follow; those that are alike are solved once."""
    from . import derive, snapshot, state

    known = [(material, snapshot.of(material)) for material in materials]
    follow = [pair for pair in known if state.follows(pair[1])]
    if not follow:
        return
    with changes.paused():
        done = derive.follow_settings(follow)
    for each in done:
        changes.derived.announce(each)


def _derive(material: Any, known: Any) -> None:
    from . import derive

    with changes.paused():
        done = derive.follow_setting(material, known)
    changes.derived.announce(done)


def _on_nodes(depsgraph: Any) -> None:
    """Derive colors again below gloss that was set by hand, in those materials that changed."""
    from . import snapshot, state

    for update in depsgraph.updates:
        if not isinstance(update.id, bpy.types.Material):
            continue
        material = update.id.original
        if snapshot.has_spectrum(material):
            known = snapshot.of(material)
            if state.gloss_changed(known):
                _derive(material, known)


def animated(depsgraph: Any) -> list[tuple[Any, Any]]:
    """Find materials whose animated or driven settings are not what their color follows from.

    Returns
    -------
    Pairs of material and evaluated material. Rendering evaluates the scene apart from what the
    window shows, so that only the latter has the values of the frame.
    """
    from ..blender import shader_nodes
    from . import derivation, snapshot, state

    found = []
    for material in bpy.data.materials:
        animation = material.animation_data
        if animation is None or not snapshot.has_spectrum(material):
            continue
        if not any(curve.data_path.startswith(_PATH) for curve in shader_nodes.curves(animation)):
            continue
        evaluated = material.evaluated_get(depsgraph)
        last = derivation.get_stamp(material)
        now = snapshot.inputs(evaluated.rough_spectra)
        if last is None or derivation.is_current(last, now):
            continue
        if state.follows(snapshot.of(material)):
            found.append((material, evaluated))
    return found


@persistent
def _on_frame(_scene: Any, depsgraph: Any) -> None:
    found = animated(depsgraph)
    if found:
        from . import derive

        with changes.paused():
            derive.follow(found)


@persistent
def _on_update(scene: Any, depsgraph: Any) -> None:
    """Follow drivers, which also change between frames, and gloss."""
    if depsgraph.id_type_updated("MATERIAL"):
        _on_frame(scene, depsgraph)
        _on_nodes(depsgraph)


def register() -> None:
    """Follow settings and animation from now on, in every file."""
    changes.setting_changed.subscribe(_on_setting)
    changes.several_changed.subscribe(_on_several)
    bpy.app.handlers.frame_change_post.append(_on_frame)
    bpy.app.handlers.depsgraph_update_post.append(_on_update)


def unregister() -> None:
    """Undo `register`."""
    bpy.app.handlers.depsgraph_update_post.remove(_on_update)
    bpy.app.handlers.frame_change_post.remove(_on_frame)
    changes.several_changed.unsubscribe(_on_several)
    changes.setting_changed.unsubscribe(_on_setting)
