# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure a rough sample: the script that runs inside a second Blender.

Like the worker of flat samples, of which it borrows what both do, it imports nothing of the
extension, gets the path of a job as its last argument, and leaves an array beside it.

Light comes from suns without width, which light what the camera sees and what that is lit by: all
bounces, as many as Cycles has. The picture is one period of the surface, which goes on around it.
Here there is something to estimate, so pixels have random numbers of their own, and the same is
rendered again with other numbers, to know by how much they matter.
"""

import importlib.util
import json
import math
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np

WIDTH = 64.0
"""Of a period along x, in Blender's units: whatever a sample is measured in, its facets are neither
so small nor so large that single precision notices."""

BOUNCES = 1024
"""The most that Cycles has."""


def main(job_path: Path) -> None:
    """Measure the sample with all albedos."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    shared.end_if_orphaned(job["asked_by"], folder)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene, color = build(job, np.load(folder / "mesh.npz"))
    seeds, groups = job["seeds"], job["albedos"]
    rows, columns = scene.render.resolution_y, scene.render.resolution_x
    pictures = np.empty((len(groups), seeds, rows, columns, 3), np.float32)
    for number, albedos in enumerate(groups):
        color.default_value = (*albedos, 1.0)
        for seed in range(seeds):
            # Never 0: seeds of other groups of albedos are others, so that their noise is, too.
            scene.cycles.seed = 1 + number * seeds + seed
            turn_lights(scene, job["lights"], seed / seeds)
            pictures[number, seed] = shared.render(scene, folder / "render.exr")
            shared.report(folder, number * seeds + seed + 1, len(groups) * seeds)
            shared.end_if_orphaned(job["asked_by"], folder)
    np.save(folder / "pictures.npy", pictures)


def build(job: dict[str, Any], surface: Any) -> tuple[Any, Any]:
    """Lay out the surface, its copies, lights and camera; gives the scene and the albedo's socket.

    Parameters
    ----------
    job
        What `experiment` asks for.
    surface
        `vertices` and `faces`.
    """
    scene = bpy.data.scenes.new("Laboratory")
    scale = WIDTH / job["period"][0]
    across, along = (length * scale for length in job["period"])
    mesh = facets(surface["vertices"] * scale, surface["faces"])
    material = bpy.data.materials.new("Facets")
    if material.node_tree is None:
        material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = (nodes.new(f"Shader{kind}") for kind in ("NodeBsdfDiffuse", "NodeOutputMaterial"))
    diffuse.inputs["Roughness"].default_value = 0.0
    material.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    mesh.materials.append(material)
    rings_x, rings_y = job["rings"]
    for column in range(-rings_x, rings_x + 1):
        for row in range(-rings_y, rings_y + 1):
            copy = bpy.data.objects.new("Sample", mesh)
            copy.location = (column * across, row * along, 0)
            scene.collection.objects.link(copy)
    look(scene, across, along, job["view"], job["pixels"])
    for theta, _ in job["lights"]:
        sun = bpy.data.lights.new("Light", "SUN")
        sun.angle = 0.0
        # Together they have the irradiance π, so the radiance is the reflectance factor.
        sun.energy = math.pi / len(job["lights"]) / math.cos(theta)
        scene.collection.objects.link(bpy.data.objects.new("Light", sun))
    cycles = scene.cycles
    cycles.samples = job["samples"]
    cycles.max_bounces = cycles.diffuse_bounces = BOUNCES
    cycles.use_light_tree = False  # all suns alike
    cycles.light_sampling_threshold = 0.0
    return scene, diffuse.inputs["Color"]


def facets(vertices: Any, faces: Any) -> Any:
    """Make a mesh of flat facets from arrays, shapes (vertices, 3) and (faces, 3 or 4)."""
    mesh = bpy.data.meshes.new("Sample")
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(vertices, np.float32).ravel())
    count, corners = faces.shape
    mesh.loops.add(count * corners)
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(faces, np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, count * corners, corners, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.zeros(count, bool))
    mesh.update(calc_edges=True)
    return mesh


def look(scene: Any, across: float, along: float, view: float, pixels: int) -> None:
    """Fill the picture with one period, seen without perspective from the polar angle `view`."""
    settings = shared.plain(scene)
    settings.resolution_x = pixels
    settings.resolution_y = max(1, round(pixels * along / across))
    # A period seen from aside is narrower, but every pixel has to cover as much of it.
    aspect = along / settings.resolution_y / (across * math.cos(view) / settings.resolution_x)
    settings.pixel_aspect_x, settings.pixel_aspect_y = max(1, 1 / aspect), max(1, aspect)
    lens = bpy.data.cameras.new("View")
    lens.type, lens.sensor_fit = "ORTHO", "HORIZONTAL"
    lens.ortho_scale = across * math.cos(view)
    distance = 4 * max(across, along)
    lens.clip_end = 4 * distance
    camera = bpy.data.objects.new("View", lens)
    camera.rotation_euler = (0, view, 0)
    camera.location = (distance * math.sin(view), 0, distance * math.cos(view))
    scene.collection.objects.link(camera)
    scene.camera = camera


def turn_lights(scene: Any, lights: list[list[float]], part: float) -> None:
    """Aim the suns; those of a ring are turned by a part of the angle between two of them.

    A ring is told by its suns being even; a surface that knows directions, as grooves do, is then
    lit from as many azimuths as there are suns and seeds.
    """
    suns = [thing for thing in scene.objects if thing.type == "LIGHT"]
    turn = part * 2 * math.pi / len(lights) if is_ring(lights) else 0.0
    for sun, (theta, phi) in zip(suns, lights, strict=True):
        sun.rotation_euler = (0, theta, phi + turn)


def is_ring(lights: list[list[float]]) -> bool:
    """Whether the lights stand around the sample at even distances, at one polar angle."""
    count = len(lights)
    return count > 2 and all(
        math.isclose(theta, lights[0][0])
        and math.isclose(phi - lights[0][1], 2 * math.pi * number / count, abs_tol=1e-9)
        for number, (theta, phi) in enumerate(lights)
    )


def borrowed() -> ModuleType:
    """Load the worker that measures flat samples."""
    path = Path(__file__).resolve().parents[1] / "instrument" / "worker.py"
    spec = importlib.util.spec_from_file_location("spectrophotometer", path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is missing; install the extension again.")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


shared: Any = borrowed()

if __name__ == "__main__":
    main(Path(sys.argv[-1]))
