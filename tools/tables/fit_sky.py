# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tabulate what Cycles' sky textures shed: mean radiance of the dome, and irradiance of the sun.

    .venv/bpy-5.2/bin/python -m tools.tables.fit_sky addon/scene/sky_table.json

No function of Blender gives the color of a sky without rendering. The table holds it over the
elevation of the sun, and for every other setting over that setting alone, the rest at its
default; `sky.read` multiplies the ratios. Each render is an equirectangular picture of the world.
"""

from __future__ import annotations

import json
import math
import sys
import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import load_extension

ELEVATIONS = (-5.0, 0.0, 2.0, 5.0, 10.0, 20.0, 40.0, 90.0)
SETTINGS: dict[str, tuple[float, ...]] = {
    "air_density": (0.3, 1.0, 2.0, 5.0),
    "aerosol_density": (0.3, 1.0, 2.0, 5.0),
    "ozone_density": (0.0, 1.0, 3.0),
    "altitude": (0.0, 100.0, 1000.0, 4000.0),
}
DEFAULTS = {"air_density": 1.0, "aerosol_density": 1.0, "ozone_density": 1.0, "altitude": 100.0}
TURBIDITIES = (2.0, 3.0, 5.0, 10.0)
SUN_SIZE = math.radians(8)
ROWS = 48


def main(path: Path) -> None:
    """Render and write the table."""
    load_extension()
    scene, node = build()
    table: dict[str, Any] = {"elevations": ELEVATIONS, "settings": SETTINGS, "defaults": DEFAULTS}
    table["turbidities"] = TURBIDITIES
    for kind in ("SINGLE_SCATTERING", "MULTIPLE_SCATTERING"):
        node.sky_type = kind
        rows: dict[str, Any] = {name: [] for name in ("base", *SETTINGS)}
        rows["base"] = series(scene, node, DEFAULTS)
        for name, values in SETTINGS.items():
            for value in values:
                same = value == DEFAULTS[name]
                settings = DEFAULTS | {name: value}
                rows[name].append(rows["base"] if same else series(scene, node, settings))
                print(kind, name, value, file=sys.stderr)
        table[kind] = rows
    for kind in ("PREETHAM", "HOSEK_WILKIE"):
        node.sky_type = kind
        table[kind] = [[elevated(scene, node, t, e) for e in ELEVATIONS] for t in TURBIDITIES]
    text = json.dumps(table, separators=(",", ":")).replace("],", "],\n")
    path.write_text(text + "\n", encoding="utf-8")


def build() -> tuple[Any, Any]:
    """Make a world with a sky, and a camera that sees all of it."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.world = world = bpy.data.worlds.new("Sky")
    if world.node_tree is None:
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputWorld")
    background = tree.nodes.new("ShaderNodeBackground")
    node = tree.nodes.new("ShaderNodeTexSky")
    tree.links.new(node.outputs[0], background.inputs[0])
    tree.links.new(background.outputs[0], output.inputs[0])
    world.cycles.sampling_method = "NONE"
    lens = bpy.data.cameras.new("All")
    lens.type = "PANO"
    (lens if hasattr(lens, "panorama_type") else lens.cycles).panorama_type = "EQUIRECTANGULAR"
    camera = bpy.data.objects.new("All", lens)
    camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = 2 * ROWS, ROWS
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.cycles.use_adaptive_sampling = False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    return scene, node


def series(scene: Any, node: Any, settings: dict[str, float]) -> list[list[float]]:
    """Six numbers an elevation: RGB of the dome's radiance, and of the sun's irradiance."""
    for name, value in settings.items():
        setattr(node, name, value)
    found = []
    for elevation in ELEVATIONS:
        node.sun_elevation, node.sun_disc = math.radians(elevation), False
        picture = render(scene)
        dome = over_dome(picture)
        sun = np.zeros(3)
        if elevation >= 0:
            node.sun_disc, node.sun_size = True, SUN_SIZE
            added = render(scene) - picture
            # At the horizon half of the disk is below it.
            sun = (added * solid_angles()[:, np.newaxis, np.newaxis]).sum(axis=(0, 1))
        found.append([float(f"{value:.5g}") for value in (*dome, *sun)])
    return found


def elevated(scene: Any, node: Any, turbidity: float, elevation: float) -> list[float]:
    """RGB of the dome's radiance for the older skies."""
    node.turbidity = turbidity
    angle = math.radians(elevation)
    node.sun_direction = (math.cos(angle), 0, math.sin(angle))
    return [float(f"{value:.5g}") for value in over_dome(render(scene))]


def solid_angles() -> np.ndarray:
    """Solid angle of a pixel in each row."""
    return np.sin((np.arange(ROWS) + 0.5) * np.pi / ROWS) * (np.pi / ROWS) ** 2


def over_dome(picture: np.ndarray) -> np.ndarray:
    """Mean radiance over the upper half as level ground sees it: weighted with the cosine."""
    cosine = np.cos((np.arange(ROWS // 2) + 0.5) * np.pi / ROWS)
    weight = (cosine * solid_angles()[: ROWS // 2])[:, np.newaxis, np.newaxis]
    return (picture[: ROWS // 2] * weight).sum(axis=(0, 1)) / (weight.sum() * 2 * ROWS)


def render(scene: Any) -> np.ndarray:
    """Render, and give the pixels from the zenith down."""
    bpy.utils.expose_bundled_modules()
    import OpenImageIO
    from rough_spectra.addon.instrument.worker import render_into

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sky.exr"
        render_into(scene, path)
        image = OpenImageIO.ImageInput.open(str(path))
        try:
            return np.asarray(image.read_image(OpenImageIO.FLOAT), np.float64)[..., :3]
        finally:
            image.close()


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
