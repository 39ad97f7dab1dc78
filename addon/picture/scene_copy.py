# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of the open file for a second Blender, and what of it is to be rendered.

The file, as it is and unsaved, is copied into the job's folder: neither it nor its settings nor the
last render result are touched.
"""

from __future__ import annotations

from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import MaterialError


def check(scene: Any, what: str) -> None:
    """Refuse a scene that Cycles does not render, or nobody looks at.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`.
    what
        What needs Cycles, as in "a spectral picture".

    Raises
    ------
    MaterialError
        If it has another engine or no camera.
    """
    if scene.render.engine != "CYCLES":
        msg = (
            f"Scene {scene.name!r} renders with {scene.render.engine}; {what} needs Cycles: "
            "choose it in the render properties."
        )
        raise MaterialError(msg)
    check_camera(scene)


def check_camera(scene: Any) -> None:
    """Refuse a scene that nobody looks at; raises a MaterialError."""
    if scene.camera is None:
        msg = f"Scene {scene.name!r} has no camera; add one."
        raise MaterialError(msg)


def layer_of(scene: Any) -> Any:
    """Give the view layer that is rendered first.

    Raises
    ------
    MaterialError
        If none is.
    """
    used = [layer for layer in scene.view_layers if layer.use]
    if not used:
        msg = f"Scene {scene.name!r} has no view layer that is rendered; switch one on."
        raise MaterialError(msg)
    return used[0]


def evaluated(scene: Any, layer: Any) -> Any:
    """Give the depsgraph of a scene's view layer."""
    if bpy.context.scene == scene and bpy.context.view_layer == layer:
        return bpy.context.evaluated_depsgraph_get()
    with bpy.context.temp_override(scene=scene, view_layer=layer):
        return bpy.context.evaluated_depsgraph_get()


def save(
    folder: Path, scene: Any, layer: Any, samples: int | None, percentage: int | None
) -> dict[str, Any]:
    """Save the copy, and say what the worker has to render of it.

    Parameters
    ----------
    folder
        Of the job.
    scene, layer
        A scene of the open file, and its view layer.
    samples, percentage
        Of the renders, instead of the scene's; or None.
    """
    blend = folder / "scene.blend"
    with redirect_stdout(StringIO()):  # Blender tells of it there
        bpy.ops.wm.save_as_mainfile(
            filepath=str(blend), check_existing=False, compress=False, copy=True
        )
    return {
        "blend": blend.name,
        "scene": scene.name,
        "layer": layer.name,
        "frame": scene.frame_current,
        "subframe": scene.frame_subframe,
        "seed": _seed(scene),
        "samples": samples or scene.cycles.samples,
        "percentage": percentage or scene.render.resolution_percentage,
    }


def _seed(scene: Any) -> int:
    """Give the seed of all renders of a frame, another one in each where the scene wants that."""
    cycles = scene.cycles
    aside = scene.frame_current if cycles.use_animated_seed else 0
    return int((cycles.seed + aside) % (1 << 31))
