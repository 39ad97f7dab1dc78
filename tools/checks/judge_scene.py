# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Judge the picture of a room: matched to its scene, against matched to the whole hemisphere.

    .venv/bpy-5.2/bin/python -m tools.checks.judge_scene

Rays of another seed than the analysis uses meet the room's surfaces. At each hit the light of all
lamps is added up twice, without indirect light: spectrally, by the model of the material, and as
Cycles adds it up in RGB, by its closure's formula, which the tests hold to renders within 1e-6.
The color difference of the two, seen under the light of that place, is a pixel's error.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.checks import make_room
from tools.run.run_command_line import load_extension

sys.path.insert(0, str(Path(__file__).resolve().parent))

SEED = 4711


def dress(materials: list[Any], illuminant: str = "D65") -> None:
    """Assign the ColorChecker to materials, with σ of 20, 30 and 40° in turn."""
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import presets

    names = [name for name in presets.names() if name.startswith("colorchecker/")]
    samples = [presets.load(name) for name in names]
    pairs = []
    for number, material in enumerate(materials):
        sigma = float(np.radians((20, 30, 40)[number % 3]))
        sample = samples[number % len(samples)]
        pairs.append((material, solve.Request(sample, sigma, "closure", illuminant)))
    derive.assign(pairs)


def picture(depsgraph: Any, scene: Any) -> dict[Any, tuple[Any, ...]]:
    """Give the ways of light that reach each material's hits, and the spectra of the lamps."""
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.colorimetry import illuminant_spectra
    from rough_spectra.addon.scene import analysis, camera, sources, surfaces

    random = np.random.default_rng(SEED)
    space = working_space.current()
    origins, ways = camera.rays(depsgraph, scene, None, random)
    found = surfaces.gather(depsgraph)
    lamps, _ = sources.find(depsgraph, scene, found, space)
    hits = found.hit(origins, ways)
    samples, places = analysis.look(found, hits, ways, lamps, space, random)
    colors = [np.linalg.solve(space.from_xyz, lamp.rgb) for lamp in lamps]
    spectra = np.stack(
        [
            illuminant_spectra.like(xyz, lamp.temperature)[0]
            for xyz, lamp in zip(colors, lamps, strict=True)
        ]
    )
    of_hit = hits.materials[places][samples.hit]
    return {
        material: (samples[of_hit == index], spectra)
        for index, material in enumerate(found.materials)
        if (of_hit == index).any()
    }


def errors(seen: Mapping[Any, tuple[Any, ...]]) -> dict[Any, float]:
    """Mean ΔE00 over the hits of each material, as its shader is now."""
    from rough_spectra.addon.blender import shader_nodes, working_space
    from rough_spectra.addon.colorimetry import illuminant_spectra
    from rough_spectra.addon.material import storage
    from rough_spectra.core import cycles, ladder
    from rough_spectra.core.color import color_difference

    from_xyz = working_space.current().from_xyz
    found = {}
    for material, (samples, spectra) in seen.items():
        request = storage.load(material)
        node = shader_nodes.shader_node(material)
        color = np.array(shader_nodes.color_socket(node).default_value[:3])
        roughness = shader_nodes.roughness_socket(node).default_value
        angles = (samples.theta_i, samples.theta_r, samples.delta_phi)
        bands = request.sample.wavelengths
        # Rows: XYZ of each way of light that a white surface would send on.
        whites = illuminant_spectra.to_xyz(spectra)[samples.lamp]
        reflected = ladder.reflectance(
            request.model, request.sample.reflectance, *angles, request.sigma
        )
        weights = np.stack(
            [illuminant_spectra.weights(tuple(bands.tolist()), tuple(s)) for s in spectra.tolist()]
        )
        truth = np.einsum("gb,gbx->gx", np.maximum(reflected, 0), weights[samples.lamp])
        shown = cycles.reflectance(color, roughness, *angles) * (whites @ from_xyz.T)
        rendered = shown @ np.linalg.inv(from_xyz).T
        _, places = np.unique(samples.hit, return_inverse=True)
        sums = np.zeros((3, places.max() + 1, 3))
        for total, part in zip(sums, (truth, rendered, whites), strict=True):
            np.add.at(total, places, part * samples.light[:, np.newaxis])
        level = sums[2, :, 1:2]
        labs = [_lab(part / level, sums[2] / level) for part in sums[:2]]
        found[material] = float(color_difference.delta_e(*labs).mean())
    return found


def everywhere(view: Any) -> Any:
    """Give the same lights from directions all over the hemisphere."""
    from dataclasses import replace

    from rough_spectra.core.numerics import direction_grid

    spread = np.column_stack(direction_grid.hemisphere(16)).tolist()
    rows = tuple(
        (*angles, index, light.share / len(spread))
        for index, light in enumerate(view.lights)
        for angles in spread
    )
    return replace(view, geometries=rows)


def _lab(xyz: np.ndarray, white: np.ndarray) -> np.ndarray:
    from rough_spectra.core.color import color_difference

    return color_difference.xyz_to_lab(xyz, white)


def main() -> None:
    """Print how long the analysis takes and what it gains."""
    extension = load_extension()
    extension.register()
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.scene import analysis, follow_scene

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    materials = make_room.furnish()
    scene = bpy.context.scene
    depsgraph = bpy.context.evaluated_depsgraph_get()
    rows = {}
    for illuminant in ("D65", "A"):
        dress(materials, illuminant)
        seen = picture(depsgraph, scene)
        rows[f"hemisphere, {illuminant}"] = errors(seen)
    seconds = [analysis.analyze(depsgraph, scene).seconds for _ in range(5)]
    report = analysis.analyze(depsgraph, scene)
    derive.follow_scene({material: everywhere(view) for material, view in report.views.items()})
    rows["hemisphere, the scene's lights"] = errors(
        {material: parts for material, parts in seen.items() if material in report.views}
    )
    start = time.perf_counter()
    report = analysis.analyze(depsgraph, scene)
    follow_scene.follow(report)
    whole = time.perf_counter() - start
    seen = {material: parts for material, parts in seen.items() if material in report.views}
    after = errors(seen)
    print(f"analysis: median {np.median(seconds):.3f} s; with matching {whole:.2f} s")
    print(f"scene: mean ΔE00 {np.mean(list(after.values())):.3f} of {len(after)} materials")
    for name, before in rows.items():
        better = np.mean([after[material] < before[material] for material in after])
        mean = np.mean([before[material] for material in after])
        print(f"{name}: mean ΔE00 {mean:.3f}; the scene is better for {better:.0%} of materials")
    extension.unregister()


if __name__ == "__main__":
    main()
