# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Judge Cycles' own pictures of a room: matched to its scene, against made for D65.

    .venv/bpy-5.2/bin/python -m tools.checks.judge_render

The room of make_room.py is rendered once with each, without indirect light, each lamp in a pass of
its own. What the picture should show at a pixel is the spectral model's reflectance toward the
camera, in the directions that the lamp's light comes from, times the light that the pass of that
lamp shows to be there. The error is the color difference between the two, seen under the light of
that place. Beside judge_scene.py, which adds up the light itself, this one takes it from renders.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.checks import judge_scene, make_room
from tools.run.run_command_line import load_extension

sys.path.insert(0, str(Path(__file__).resolve().parent))

WIDTH, HEIGHT, SAMPLES = 320, 180, 256
PIXELS = 150
"""Of each material, at most; fewer than `FEWEST` are not judged."""
FEWEST = 20
DARK = 0.01
"""Part of the picture's median light below which a pixel is black, and shows no color."""
AROUND = 48
"""Directions in which a pixel looks for the world."""
SEED = 99


def prepare(scene: Any, materials: list[Any]) -> None:
    """Ask for direct light only, and for passes of lamps, places, normals and materials."""
    for number, material in enumerate(materials):
        material.pass_index = number + 1
    layer = scene.view_layers[0]
    for name in ("material_index", "position", "normal"):
        setattr(layer, f"use_pass_{name}", True)
    for thing in (*(o for o in scene.objects if o.type == "LIGHT"), scene.world):
        layer.lightgroups.add(name=thing.name)
        thing.lightgroup = thing.name
    render, cycles = scene.render, scene.cycles
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"
    cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = SAMPLES, False, False
    cycles.max_bounces = cycles.diffuse_bounces = 0
    # One place a pixel: normals and positions are then those of all its light.
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 0.01


def rendered(scene: Any) -> dict[str, np.ndarray]:
    """Render; gives every channel of every pass by its name."""
    from rough_spectra.addon.instrument.worker import render_into

    with tempfile.TemporaryDirectory() as folder:
        render_into(scene, Path(folder) / "picture")
        if hasattr(bpy.utils, "expose_bundled_modules"):
            bpy.utils.expose_bundled_modules()
        import OpenImageIO

        [path] = Path(folder).iterdir()
        file, found, number = OpenImageIO.ImageInput.open(str(path)), {}, 0
        while file.seek_subimage(number, 0):
            spec = file.spec()
            pixels = file.read_image(number, 0, 0, spec.nchannels, OpenImageIO.FLOAT)
            pixels = np.asarray(pixels, np.float64).reshape(spec.height, spec.width, -1)
            for index, name in enumerate(spec.channelnames):
                found[name.partition(".")[2]] = pixels[..., index]
            number += 1
        file.close()
    return found


def channels(passes: dict[str, np.ndarray], name: str, letters: str) -> np.ndarray:
    """Give the channels of one pass in the last axis."""
    return np.stack([passes[f"{name}.{letter}"] for letter in letters], axis=-1)


def to_lamp(lamp: Any, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directions from places to all parts of a lamp, (places, parts, 3), and their weights."""
    if lamp.data.type == "AREA":
        across = (np.arange(4) + 0.5) / 4 - 0.5
        grid = np.stack(np.meshgrid(across, across), axis=-1).reshape(-1, 2) * lamp.data.size
        local = np.column_stack((grid, np.zeros(len(grid)), np.ones(len(grid))))
    else:
        local = np.array([[0.0, 0.0, 0.0, 1.0]])
    parts = (local @ np.array(lamp.matrix_world).T)[:, :3]
    ways = parts - places[:, np.newaxis]
    far = np.linalg.norm(ways, axis=-1, keepdims=True)
    return ways / far, np.ones(ways.shape[:2])


def to_world(scene: Any, places: np.ndarray, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Directions all around the normals and whether the world is seen there."""
    random = np.random.default_rng(SEED)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    ways = random.normal(size=(len(places), AROUND, 3))
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    ways *= np.sign((ways * normals[:, np.newaxis]).sum(axis=-1, keepdims=True))
    starts = places + 1e-4 * normals
    free = [
        [not scene.ray_cast(depsgraph, tuple(start), tuple(way))[0] for way in around]
        for start, around in zip(starts, ways, strict=True)
    ]
    return ways, np.array(free, float)


def angles(ways: np.ndarray, normals: np.ndarray, eyes: np.ndarray) -> tuple[np.ndarray, ...]:
    """θi, θr and Δφ of light from `ways` (places, parts, 3), seen from `eyes` (places, 3)."""
    normals, eyes = normals[:, np.newaxis], eyes[:, np.newaxis]
    cos_i, cos_r = (np.clip((v * normals).sum(axis=-1), -1, 1) for v in (ways, eyes))
    flat_i, flat_r = ways - cos_i[..., None] * normals, eyes - cos_r[..., None] * normals
    norm = np.linalg.norm(flat_i, axis=-1) * np.linalg.norm(flat_r, axis=-1)
    turn = (flat_i * flat_r).sum(axis=-1) / np.maximum(norm, 1e-9)
    theta_i, theta_r = (np.arccos(np.clip(c, 0, 1)) for c in (cos_i, cos_r))
    theta_i, theta_r = np.broadcast_arrays(theta_i, theta_r)
    return theta_i, theta_r, np.arccos(np.clip(turn, -1, 1))


def errors(scene: Any, materials: list[Any], passes: dict[str, np.ndarray]) -> dict[Any, float]:
    """Mean ΔE00 of the rendered pixels of each material."""
    from rough_spectra.addon.blender import shader_nodes, working_space
    from rough_spectra.addon.colorimetry import illuminant_spectra
    from rough_spectra.addon.material import storage
    from rough_spectra.addon.scene import sources, surfaces
    from rough_spectra.core import cycles, ladder

    space = working_space.current()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    lamps, _ = sources.find(depsgraph, scene, surfaces.gather(depsgraph), space)
    inverse = np.linalg.inv(space.from_xyz)
    random = np.random.default_rng(SEED)
    number = channels(passes, "Material Index", "X")[..., 0]
    eye = np.array(scene.camera.matrix_world.translation)
    found = {}
    for index, material in enumerate(materials):
        where = np.argwhere(np.abs(number - index - 1) < 1e-3)
        if len(where) < FEWEST:
            continue
        rows, columns = random.permutation(where)[:PIXELS].T
        places = channels(passes, "Position", "XYZ")[rows, columns]
        normals = channels(passes, "Normal", "XYZ")[rows, columns]
        eyes = eye - places
        eyes /= np.linalg.norm(eyes, axis=-1, keepdims=True)
        request, node = storage.load(material), shader_nodes.shader_node(material)
        color = np.array(shader_nodes.color_socket(node).default_value[:3])
        roughness = shader_nodes.roughness_socket(node).default_value
        bands = request.sample.wavelengths
        truth, shown, white = np.zeros((3, len(rows), 3))
        for lamp in lamps:
            thing = scene.objects.get(lamp.name)
            light = channels(passes, f"Combined_{lamp.name}", "RGB")[rows, columns] @ inverse.T
            if thing is None:
                ways, weight = to_world(scene, places, normals)
            else:
                ways, weight = to_lamp(thing, places)
            weight = weight * np.maximum((ways * normals[:, np.newaxis]).sum(axis=-1), 0)
            there = weight.sum(axis=-1) > 0
            weight /= np.where(there, weight.sum(axis=-1), 1)[:, np.newaxis]
            theta_i, theta_r, phi = angles(ways, normals, eyes)
            xyz = np.linalg.solve(space.from_xyz, lamp.rgb)
            spd, _ = illuminant_spectra.like(xyz, lamp.temperature)
            own_white = illuminant_spectra.to_xyz(spd)
            matrix = illuminant_spectra.weights(tuple(bands.tolist()), tuple(spd.tolist()))
            model = ladder.reflectance(
                request.model, request.sample.reflectance, theta_i, theta_r, phi, request.sigma
            )
            model = np.einsum("ps,psb->pb", weight, np.maximum(model, 0)) @ matrix
            closure = cycles.reflectance(color, roughness, theta_i, theta_r, phi)
            closure = np.einsum("ps,psc->pc", weight, closure) * (space.from_xyz @ own_white)
            level = np.where(there, light[:, 1] / np.maximum((closure @ inverse.T)[:, 1], 1e-9), 0)
            truth += model * level[:, np.newaxis]
            white += own_white * level[:, np.newaxis]
            shown += np.where(there[:, np.newaxis], light, 0)
        found[material] = shown, truth, white
    dark = DARK * np.median(np.concatenate([white[:, 1] for *_, white in found.values()]))
    return {
        material: difference(*(xyz[parts[2][:, 1] > dark] for xyz in parts))
        for material, parts in found.items()
        if (parts[2][:, 1] > dark).sum() >= FEWEST
    }


def difference(shown: np.ndarray, truth: np.ndarray, white: np.ndarray) -> float:
    """Mean ΔE00 of colors (pixels, 3), each seen under the light of its place."""
    from rough_spectra.core.color import color_difference

    level = white[:, 1:2]
    labs = [color_difference.xyz_to_lab(xyz / level, white / level) for xyz in (shown, truth)]
    return float(np.mean(color_difference.delta_e(*labs)))


def main() -> None:
    """Print the mean of each material."""
    extension = load_extension()
    extension.register()
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.scene import analysis, follow_scene

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    materials = make_room.furnish()
    scene = bpy.context.scene
    prepare(scene, materials)
    judge_scene.dress(materials)
    tables = {"made for D65": errors(scene, materials, rendered(scene))}
    report = analysis.analyze(bpy.context.evaluated_depsgraph_get(), scene)
    around = {material: judge_scene.everywhere(view) for material, view in report.views.items()}
    derive.follow_scene(around)
    tables["made for the lights, from all around"] = errors(scene, materials, rendered(scene))
    follow_scene.follow(report)
    after = errors(scene, materials, rendered(scene))
    both = [m for m in after if m in report.views and all(m in table for table in tables.values())]
    now = np.array([after[m] for m in both])
    for material in both:
        numbers = " ".join(f"{table[material]:6.2f}" for table in tables.values())
        print(f"{material.name}: {numbers}  scene {after[material]:6.2f}")
    print(f"{len(both)} materials, made for the scene: mean ΔE00 {now.mean():.3f}")
    for name, table in tables.items():
        was = np.array([table[m] for m in both])
        print(f"{name}: {was.mean():.3f}; the scene is better for {np.mean(now < was):.0%}")
    extension.unregister()


if __name__ == "__main__":
    main()
