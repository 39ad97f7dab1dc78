# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What roughness costs in Cycles and what it gains: `python -m tools.chart.chart_blender FOLDER`.

The readings of traced Gaussian height fields at 45°/0° are assigned to materials, as a user would:
matched Diffuse, and a Lambertian material with the same reading. The virtual spectrophotometer
then measures both at other angles, which gives their distance from the surface they stand for. Time
is that of a picture of 24 spheres under sun and sky on one thread.
"""

from __future__ import annotations

import functools
import math
import statistics
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.chart.chart_judge import Judge
from tools.chart.chart_timing import in_turns
from tools.chart.chart_work import BANDS, Array, Work, summary, write_json
from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.blender import working_space
from rough_spectra.addon.instrument.measure import Geometry, measure
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core.color import color_difference

WIDTH, HEIGHT, SAMPLES, BOUNCES = 360, 240, 32, 4
SECONDS = 60.0
COLUMNS = 6


def assigned(work: Work) -> tuple[list[Any], list[Any], list[bool]]:
    """Make matched and Lambertian materials, σ by σ, and tell which fit the gamut."""
    requests = [
        solve.Request(
            Sample(f"{np.degrees(sigma):.0f}/{patch}", BANDS, values, "reading"), float(sigma)
        )
        for sigma, readings in zip(work.traced.sigmas, work.traced.reading, strict=True)
        for patch, values in enumerate(readings)
    ]
    rough = [bpy.data.materials.new(request.sample.name) for request in requests]
    solutions = derive.assign(list(zip(rough, requests, strict=True)))
    flat = [lambertian(solution.target) for solution in solutions]
    return rough, flat, [bool(np.all(solution.target >= 0)) for solution in solutions]


def lambertian(color: Array) -> Any:
    """Give a Diffuse BSDF without roughness that shows this RGB everywhere."""
    material = bpy.data.materials.new("Lambert")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (*np.clip(color, 0, 1), 1)
    shader.inputs["Roughness"].default_value = 0
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def judge(work: Work, rough: list[Any], flat: list[Any], fits: list[bool]) -> dict[str, Any]:
    """ΔE00 between renders and the traced surface by material and σ."""
    angles, sigmas = work.traced.angles, work.traced.sigmas
    geometries = [
        Geometry(((float(light), float(phi)),), float(view)) for light, view, phi in angles.T
    ]
    seen = measure([*rough, *flat], geometries)[:, :, 0]
    lab = working_space.current().to_lab(seen, "D65")
    lab = lab.reshape(len(geometries), 2, sigmas.size, -1, 3)
    truth = Judge().lab(work.traced.factor)
    inside = np.reshape(fits, (sigmas.size, -1))
    found: dict[str, Any] = {"patches": int(inside.sum())}
    for index, name in enumerate(("rough", "lambert")):
        apart = [
            color_difference.delta_e(lab[:, index, s], truth[s])[:, inside[s]]
            for s in range(sigmas.size)
        ]
        found[name] = {
            "delta_e": summary(np.concatenate([one.ravel() for one in apart])),
            "by_sigma": [summary(one) for one in apart],
        }
    return found


def picture(materials: list[Any]) -> Any:
    """Lay out spheres with these materials under sun and sky; returns the scene."""
    scene = bpy.data.scenes.new("Spheres")
    for index, material in enumerate([*materials, materials[0]]):
        mesh = bpy.data.meshes.new("Thing")
        if index < len(materials):
            mesh.from_pydata(*sphere())
            mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
        else:
            mesh.from_pydata(
                [(-9, -9, -1), (9, -9, -1), (9, 9, -1), (-9, 9, -1)], [], [(0, 1, 2, 3)]
            )
        mesh.materials.append(material)
        thing = bpy.data.objects.new("Thing", mesh)
        column, row = index % COLUMNS, index // COLUMNS
        if index < len(materials):
            thing.location = (2.2 * (column - 2.5), 2.2 * (row - 1.5), 0)
        scene.collection.objects.link(thing)
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy = 3
    lamp = bpy.data.objects.new("Sun", sun)
    lamp.rotation_euler = (0.6, 0.3, 0)
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.ortho_scale = "ORTHO", 14
    camera = bpy.data.objects.new("Camera", lens)
    camera.location, camera.rotation_euler = (0, -20, 20), (math.pi / 4, 0, 0)
    for thing in (lamp, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    world = bpy.data.worlds.new("Sky")
    scene.world = world
    settings = scene.render
    settings.engine = "CYCLES"
    settings.resolution_x, settings.resolution_y, settings.resolution_percentage = (
        WIDTH,
        HEIGHT,
        100,
    )
    settings.threads_mode, settings.threads = "FIXED", 1
    settings.use_compositing = settings.use_sequencer = False
    scene.cycles.device, scene.cycles.samples = "CPU", SAMPLES
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = BOUNCES
    return scene


def sphere(rings: int = 32) -> tuple[list[Any], list[Any], list[Any]]:
    """Vertices, edges and faces of a sphere of radius 1."""
    sectors = 2 * rings
    vertices = [
        (
            math.sin(math.pi * i / rings) * math.cos(2 * math.pi * j / sectors),
            math.sin(math.pi * i / rings) * math.sin(2 * math.pi * j / sectors),
            math.cos(math.pi * i / rings),
        )
        for i in range(rings + 1)
        for j in range(sectors)
    ]
    faces = [
        (
            i * sectors + j,
            (i + 1) * sectors + j,
            (i + 1) * sectors + (j + 1) % sectors,
            i * sectors + (j + 1) % sectors,
        )
        for i in range(rings)
        for j in range(sectors)
    ]
    return vertices, [], faces


def main(folder: Path) -> None:
    """Measure both materials and write blender.json."""
    extension: Any = sys.modules["rough_spectra"]
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.register()
    try:
        work = Work.load(folder / "work.npz")
        rough, flat, fits = assigned(work)
        found = judge(work, rough, flat, fits)
        middle = slice(len(work.albedo), 2 * len(work.albedo))
        scenes = {"rough": picture(rough[middle]), "lambert": picture(flat[middle])}

        def render(name: str) -> None:
            bpy.ops.render.render(scene=scenes[name].name)

        times = in_turns(
            {name: functools.partial(render, name) for name in scenes}, SECONDS, most=8
        )
        # Both of a turn are slowed down alike by what else runs.
        pairs = zip(times["rough"], times["lambert"], strict=False)
        found["rough"]["ratio"] = statistics.quantiles(
            [rough / plain for rough, plain in pairs], n=4, method="inclusive"
        )
        found["lambert"]["ratio"] = [1.0, 1.0, 1.0]
        found["sigmas"] = [round(float(sigma)) for sigma in np.degrees(work.traced.sigmas)]
        found["version"] = f"Blender {bpy.app.version_string}"
        write_json(folder / "blender.json", found)
    finally:
        # Blender trips over classes that are still registered when it ends.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        extension.unregister()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
