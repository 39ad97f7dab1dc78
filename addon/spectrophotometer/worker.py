# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure materials: the script that runs inside a second Blender.

It imports nothing of the extension, so it runs in a Blender with factory settings and in Python
with the bpy module alike. It gets the path of a job (JSON, written by `measure`) as its last
argument and leaves an array beside it.

Light comes from suns without width and goes to a camera without perspective, so every pixel of a
flat sample sees one exact geometry, and Cycles has nothing to estimate.
"""

import json
import math
import os
import shutil
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np

PIXELS = 6
"""Width of a sample in the picture; its outer ring is left out, where neighbors may show."""
SAMPLES_PER_RENDER = 1024


class LibraryError(Exception):
    """A linked material is not where its link says."""


def main(job_path: Path) -> None:
    """Measure all materials of the job in all its geometries."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    end_if_orphaned(job["asked_by"], folder)
    bpy.ops.wm.open_mainfile(filepath=str(folder / job["blend"]), load_ui=False, use_scripts=False)
    materials = [find(*key) for key in job["materials"]]
    batches = [
        materials[start : start + SAMPLES_PER_RENDER]
        for start in range(0, len(materials), SAMPLES_PER_RENDER)
    ]
    total, done = len(batches) * len(job["geometries"]), 0
    results = []
    for batch in batches:
        scene, camera, stretch = build(batch, job["samples"])
        of_batch = []
        for geometry in job["geometries"]:
            aim(scene, camera, stretch, geometry)
            of_batch.append(render(scene, folder / "render.exr", len(batch)))
            done += 1
            report(folder, done, total)
            end_if_orphaned(job["asked_by"], folder)
        results.append(np.stack(of_batch))
    np.save(folder / "result.npy", np.concatenate(results, axis=1))


def end_if_orphaned(asked_by: int, folder: Path) -> None:
    """Stop, and leave nothing behind, when the process that asked for this was killed."""
    if os.name != "posix":
        return  # there os.kill(pid, 0) would not ask but kill
    try:
        os.kill(asked_by, 0)
    except ProcessLookupError:
        shutil.rmtree(folder, ignore_errors=True)
        sys.exit("the Blender that asked for this measurement is gone")


def find(name: str, library: str | None) -> Any:
    """Give a material by name and the path of the library it is linked from."""
    if library is None:
        return bpy.data.materials[name, None]
    try:
        with bpy.data.libraries.load(library, link=True) as (_, wanted):
            wanted.materials = [name]
    except OSError as error:
        raise LibraryError(f"{library} with the linked material {name!r} cannot be read") from error
    if wanted.materials[0] is None:
        raise LibraryError(f"{library} has no material {name!r} any more")
    return wanted.materials[0]


def build(materials: list[Any], samples: int) -> tuple[Any, Any, Any]:
    """Lay the samples side by side, each a square object of its own.

    Were they one mesh, a material with Generated or Object coordinates would read differently
    beside other neighbors.
    """
    scene = bpy.data.scenes.new("Spectrophotometer")
    columns = math.ceil(math.sqrt(len(materials)))
    rows = math.ceil(len(materials) / columns)
    mesh = bpy.data.meshes.new("Sample")
    square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    mesh.from_pydata([(x, y, 0) for x, y in square], [], [range(4)])
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", np.array(square, np.float32).ravel() + np.float32(0.5))
    mesh.materials.append(None)
    stretch = bpy.data.objects.new("Samples", None)
    scene.collection.objects.link(stretch)
    for index, material in enumerate(materials):
        # Named like the material: Object Info's Random follows the name.
        sample = bpy.data.objects.new(material.name, mesh)
        sample.material_slots[0].link = "OBJECT"
        sample.material_slots[0].material = material
        x, y = index % columns - columns / 2, index // columns - rows / 2
        sample.location = (x + 0.5, y + 0.5, 0)
        sample.parent = stretch
        # Nothing here casts a shadow, but where a ray meets the seam of two triangles, the one
        # shades the other: one sample in 256 came out black.
        sample.visible_shadow = False
        scene.collection.objects.link(sample)
    lens = bpy.data.cameras.new("View")
    lens.type, lens.sensor_fit, lens.ortho_scale = "ORTHO", "HORIZONTAL", columns
    lens.clip_end = 1000 * columns
    camera = bpy.data.objects.new("View", lens)
    scene.collection.objects.link(camera)
    scene.camera = camera
    settings = scene.render
    settings.engine = "CYCLES"
    settings.resolution_x, settings.resolution_y = columns * PIXELS, rows * PIXELS
    settings.resolution_percentage = 100
    settings.use_compositing = settings.use_sequencer = False
    settings.film_transparent = False
    settings.image_settings.file_format = "OPEN_EXR"
    settings.image_settings.color_mode = "RGBA"
    settings.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device, cycles.seed, cycles.samples = "CPU", 0, samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.max_bounces = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    return scene, camera, stretch


def aim(scene: Any, camera: Any, stretch: Any, geometry: dict[str, Any]) -> None:
    """Set lights and view; samples are stretched by as much as the view foreshortens them."""
    view = geometry["view"]
    distance = 100.0 * camera.data.ortho_scale
    camera.location = (distance * math.sin(view), 0, distance * math.cos(view))
    camera.rotation_euler = (0, view, 0)
    stretch.scale = (1 / math.cos(view), 1, 1)
    for old in [thing for thing in scene.objects if thing.type == "LIGHT"]:
        bpy.data.objects.remove(old)
    for theta, phi in geometry["lights"]:
        sun = bpy.data.lights.new("Light", "SUN")
        sun.angle = 0.0
        # The irradiances add up to π, so the radiance is the reflectance factor.
        sun.energy = math.pi / math.cos(theta) / len(geometry["lights"])
        lamp = bpy.data.objects.new("Light", sun)
        lamp.rotation_euler = (0, theta, phi)
        scene.collection.objects.link(lamp)


def render(scene: Any, path: Path, count: int) -> Any:
    """Render and give each sample's mean and standard deviation, shape (samples, 2, 3)."""
    render_into(scene, path)
    pixels = read_exr(path)[::-1, :, :3].astype(np.float64)
    rows, columns = pixels.shape[0] // PIXELS, pixels.shape[1] // PIXELS
    tiles = pixels.reshape(rows, PIXELS, columns, PIXELS, 3)[:, 1:-1, :, 1:-1]
    return np.stack((tiles.mean(axis=(1, 3)), tiles.std(axis=(1, 3))), axis=2).reshape(-1, 2, 3)[
        :count
    ]


def render_into(scene: Any, path: Path) -> None:
    """Render a picture into a file.

    Both LTS versions take what stands in braces in this path, and in no other one that is used
    here, for a template, such as {blend_name}; doubled braces are braces.
    """
    scene.render.filepath = str(path).replace("{", "{{").replace("}", "}}")
    bpy.ops.render.render(write_still=True, scene=scene.name)


def read_exr(path: Path) -> Any:
    """Pixels of an EXR file as they are stored."""
    if hasattr(bpy.utils, "expose_bundled_modules"):
        bpy.utils.expose_bundled_modules()
    import OpenImageIO

    image = OpenImageIO.ImageInput.open(str(path))
    try:
        return image.read_image(OpenImageIO.FLOAT)
    finally:
        image.close()


def report(folder: Path, done: int, total: int) -> None:
    """Tell the progress to whoever polls; replaced whole, so it is never read half-written."""
    part = folder / "progress.part"
    part.write_text(f"{done} {total}", encoding="ascii")
    part.replace(folder / "progress")


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
