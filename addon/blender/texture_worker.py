# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Look at what color reaches shader nodes, over a flat square: the script of a second Blender.

It imports nothing of the extension, but runs `instrument/worker.py`, which says what both owe, and
whose square it is: from 0 to 1 of UV and of Generated coordinates. Here its color glows. Where it
is told places in the UV maps, the square is of as many tiles as pixels, each all at one place.
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
"""Of the picture, in pixels: so often it is taken. Of tiles it is by the first, so that their
middles are in the middles of the pixels."""


def main(job_path: Path, measuring: Any) -> None:
    """Look at all materials of the job, and leave the colors of each, (places, 3)."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    bpy.ops.wm.open_mainfile(filepath=str(folder / job["blend"]), load_ui=False, use_scripts=False)
    found = []
    for number, (name, node, socket, maps) in enumerate(job["materials"]):
        measuring.end_if_orphaned(job["asked_by"], folder)
        material = measuring.find(name, None)
        glow(material.node_tree, material.node_tree.nodes[node].inputs[socket])
        if maps:
            places = np.load(folder / f"places-{number}.npy")
            side, shifts = job["side"], [SHIFTS[0]]
            mesh = lay_tiles(measuring, side, maps, places)
        else:
            side, shifts = SIDE, list(SHIFTS)
            mesh = measuring.square()
        scene = build(measuring, mesh, material, side)
        measuring.show(scene, job["frame"])
        seen = []
        for x, y in shifts:
            # Of one ray a pixel, Cycles sends it through the middle.
            scene.camera.location[:2] = (x - 0.5) / side, (y - 0.5) / side
            seen.append(measuring.render(scene, folder / "render.exr").reshape(-1, 3))
        bpy.data.scenes.remove(scene)
        found.append(np.concatenate(seen))
        measuring.report(folder, number + 1, len(job["materials"]))
    np.savez(folder / "colors.npz", *found)


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


def lay_tiles(measuring: Any, side: int, maps: list[str], places: Any) -> Any:
    """Make a square of a tile a pixel, each at one place (side², 2) of the maps."""
    edge = np.linspace(-0.5, 0.5, side + 1) - 0.5 / side
    x, y = np.meshgrid(edge, edge)
    vertices = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    first = (np.arange(side)[:, np.newaxis] * (side + 1) + np.arange(side)).ravel()
    corners = np.stack([first, first + 1, first + side + 2, first + side + 1], axis=-1)
    mesh = measuring.square()
    mesh.clear_geometry()
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", vertices.astype(np.float32).ravel())
    mesh.loops.add(corners.size)
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32).ravel())
    mesh.polygons.add(len(corners))
    mesh.polygons.foreach_set("loop_start", np.arange(0, corners.size, 4, dtype=np.int32))
    mesh.update(calc_edges=True)
    for name, of_map in zip(maps, places, strict=True):
        layer = mesh.uv_layers.new(name=name or "Active", do_init=False)
        layer.uv.foreach_set("vector", np.repeat(of_map, 4, axis=0).ravel())
    mesh.uv_layers[0].active_render = True
    return mesh


def build(measuring: Any, mesh: Any, material: Any, side: int) -> Any:
    """Make a scene of a square that fills the picture, a ray a pixel."""
    scene = bpy.data.scenes.new("Texture")
    square = bpy.data.objects.new("Sample", mesh)
    square.material_slots[0].link = "OBJECT"
    square.material_slots[0].material = material
    lens = bpy.data.cameras.new("View")
    lens.type, lens.ortho_scale = "ORTHO", 1.0
    camera = bpy.data.objects.new("View", lens)
    camera.location = (0, 0, 1)
    for thing in (square, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    settings = measuring.plain(scene)
    settings.resolution_x = settings.resolution_y = side
    settings.use_persistent_data = False
    scene.cycles.samples, scene.cycles.max_bounces = 1, 0
    return scene


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
