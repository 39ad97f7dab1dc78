# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Look at what color reaches shader nodes, over a flat square: the script of a second Blender.

It imports nothing of the extension, but runs `instrument/worker.py`, which says what both owe, and
whose square it is: from 0 to 1 of UV and of Generated coordinates. Here its color glows.
"""

import importlib.util
import json
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np

SIDE = 251
"""Pixels of a side, a place in the texture each. A prime: beside the texels of an image the places
then lie in all ways, and not on the middle of each."""
SHIFTS = ((0.0, 0.0), (0.5, 0.25), (0.25, 0.75), (0.75, 0.5))
"""Of the picture, in pixels: so often it is taken."""


def main(job_path: Path, measuring: Any) -> None:
    """Look at all materials of the job, and leave their colors, (materials, pixels, 3)."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    bpy.ops.wm.open_mainfile(filepath=str(folder / job["blend"]), load_ui=False, use_scripts=False)
    found = np.empty((len(job["materials"]), len(SHIFTS), SIDE * SIDE, 3), np.float32)
    scene, square = build(measuring)
    for number, (name, node, socket) in enumerate(job["materials"]):
        measuring.end_if_orphaned(job["asked_by"], folder)
        material = measuring.find(name, None)
        glow(material.node_tree, material.node_tree.nodes[node].inputs[socket])
        square.material_slots[0].material = material
        for shift, (x, y) in enumerate(SHIFTS):
            # Of one ray a pixel, Cycles sends it through the middle.
            scene.camera.location[:2] = (x - 0.5) / SIDE, (y - 0.5) / SIDE
            pixels = measuring.render(scene, folder / "render.exr")
            found[number, shift] = pixels.reshape(-1, 3)
        measuring.report(folder, number + 1, len(found))
    np.save(folder / "colors.npy", found.reshape(len(found), -1, 3))


def glow(tree: Any, socket: Any) -> None:
    """Let the surface emit what reaches a socket, and nothing else."""
    source = next(link.from_socket for link in tree.links if link.to_socket == socket)
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(source, emission.inputs["Color"])
    output = tree.get_output_node("CYCLES")
    for name in ("Volume", "Displacement"):
        for link in [link for link in tree.links if link.to_socket == output.inputs[name]]:
            tree.links.remove(link)
    tree.links.new(emission.outputs[0], output.inputs["Surface"])


def build(measuring: Any) -> tuple[Any, Any]:
    """Make a scene of a square that fills the picture, a ray a pixel."""
    scene = bpy.data.scenes.new("Texture")
    square = bpy.data.objects.new("Sample", measuring.square())
    square.material_slots[0].link = "OBJECT"
    lens = bpy.data.cameras.new("View")
    lens.type, lens.ortho_scale = "ORTHO", 1.0
    camera = bpy.data.objects.new("View", lens)
    camera.location = (0, 0, 1)
    for thing in (square, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    settings = measuring.plain(scene)
    settings.resolution_x = settings.resolution_y = SIDE
    settings.use_persistent_data = False
    scene.cycles.samples, scene.cycles.max_bounces = 1, 0
    return scene, square


def load_measuring() -> Any:
    """Give the script that measures."""
    path = Path(__file__).resolve().parents[1] / "instrument" / "worker.py"
    spec = importlib.util.spec_from_file_location("measuring", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    try:
        main(Path(sys.argv[-1]), load_measuring())
    finally:
        # See `instrument/worker.py`.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
