# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of the open file for a second Blender, and what of it is to be rendered.

The file, as it is and unsaved, is copied into the job's folder: neither it nor its settings nor the
last render result are touched.
"""

from __future__ import annotations

import os
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import MaterialError


def check(scene: Any, what: str, percentage: int | None) -> None:
    """Refuse a scene that Cycles does not render, or of which no picture comes.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`.
    what
        What needs Cycles, as in "a spectral picture".
    percentage
        Of the resolution, instead of the scene's; or None.

    Raises
    ------
    MaterialError
        If it has another engine, or as `check_view` says.
    """
    if scene.render.engine != "CYCLES":
        msg = (
            f"Scene {scene.name!r} renders with {scene.render.engine}; {what} needs Cycles: "
            "choose it in the render properties."
        )
        raise MaterialError(msg)
    check_view(scene, percentage)


def check_view(scene: Any, percentage: int | None) -> None:
    """Refuse a scene that nobody looks at, or whose picture has no pixels.

    Raises
    ------
    MaterialError
        If it is one, or linked: then it is not in the copy.
    """
    if scene.library is not None:
        msg = f"Scene {scene.name!r} is linked from {scene.library.filepath!r}; open that file."
        raise MaterialError(msg)
    camera = scene.camera
    if camera is None:
        msg = f"Scene {scene.name!r} has no camera; add one."
        raise MaterialError(msg)
    if not camera.users_scene:  # Blender itself forgets such a camera with the file
        msg = (
            f"Camera {camera.name!r} of scene {scene.name!r} is in no scene: link it to a "
            "collection, or choose another camera in the scene properties."
        )
        raise MaterialError(msg)
    _check_libraries(scene)
    check_size(scene, percentage or scene.render.resolution_percentage)


def _check_libraries(scene: Any) -> None:
    """Refuse a scene of which something is linked from a file that the copy would not find."""
    for thing in scene.objects:
        slots = [slot.material for slot in thing.material_slots]
        for each in (thing, thing.data, thing.instance_collection, scene.world, *slots):
            library = None if each is None else each.library
            if library is None or library.packed_file or os.path.exists(path_of(library)):
                continue
            msg = (
                f"{library.filepath} is missing, from which scene {scene.name!r} has "
                f"{each.name!r}; relocate the library in the Outliner, or make it local."
            )
            raise MaterialError(msg)


def path_of(library: Any | None) -> str:
    """Give the whole path of a library, empty for none.

    A relative one is relative to the .blend, and another one in the copy of it that is rendered.
    """
    return "" if library is None else os.path.normpath(bpy.path.abspath(library.filepath))


def size(scene: Any, percentage: int) -> tuple[int, int]:
    """Give columns and rows of a picture, as Blender counts them."""
    render = scene.render
    width, height = (
        side * percentage // 100 for side in (render.resolution_x, render.resolution_y)
    )
    return width, height


def check_size(scene: Any, percentage: int) -> None:
    """Refuse a picture without a pixel, as Blender counts them; raises a MaterialError."""
    render = scene.render
    width, height = size(scene, percentage)
    if not (width and height):
        msg = (
            f"Scene {scene.name!r} has no pixels at {percentage} % of {render.resolution_x} × "
            f"{render.resolution_y}; give it a larger resolution or percentage."
        )
        raise MaterialError(msg)
    if not render.use_border:
        return
    columns = int(render.border_max_x * width) - int(render.border_min_x * width)
    rows = int(render.border_max_y * height) - int(render.border_min_y * height)
    if not (columns > 0 and rows > 0):
        msg = (
            f"The render region of scene {scene.name!r} has no pixels at {percentage} %; draw a "
            "larger one, or switch Render Region off in the output properties."
        )
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
