# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure materials: the script that runs inside a second Blender.

It imports nothing of the extension, so it runs in a Blender with factory settings and in Python
with the bpy module alike. It gets the path of a job (JSON, written by `measure`) as its last
argument and leaves an array beside it.

Light comes from suns without width and goes to a camera without perspective, so every pixel of a
flat sample sees one exact geometry, and Cycles has nothing to estimate. Only where the hemisphere
glows, as in a sphere, rays are sent out to see what they meet there.

A reading is the same to the last bit wherever its sample lies and whatever lies beside it, so that
a bake in parts gives what a bake in one go gives. Three things see to that:

- Every number that a place goes through is exact in single precision. Pixels and samples have
  binary fractions for widths, and the samples lie in the quarter of a larger picture where all
  pixels' coordinates are rounded alike (`FIRST_PIXEL`); see `round_alike` too.
- Rays go where `passes` says, and every pixel gets the same random numbers for all else.
- No sample lights another, or is a light that Cycles might pick in place of a sun.

What asks for its place in the world is alone in its picture; see `asks_place`. A view from aside
keeps fewer digits.
"""

import atexit
import json
import math
import os
import shutil
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np

PIXELS = 6
"""Width of a sample in the picture; its outer ring is left out, where neighbors may show."""
PIXELS_PER_UNIT = 4
"""The ring lies around the sample's square of one unit; a pixel has to be a binary fraction."""
COLUMNS = 32
MAP_RESOLUTION = 512
"""Pixels around the horizon in which Cycles looks for a window that glows."""
SAMPLES_PER_RENDER = COLUMNS**2
FIRST_PIXEL = 256
"""Where the samples begin in the picture. They end before twice that: single precision then keeps
as many digits of each pixel's coordinates, and rounds the same ray in all samples alike."""
PLACED: dict[str, tuple[str, ...] | None] = {
    "ShaderNodeCameraData": None,
    "ShaderNodeNewGeometry": ("Position",),
    "ShaderNodeObjectInfo": ("Location",),
    "ShaderNodeRaycast": None,
    "ShaderNodeScript": None,
    "ShaderNodeTexCoord": ("Camera", "Window"),
    "ShaderNodeTexEnvironment": None,
    "ShaderNodeTexPointDensity": None,
    "ShaderNodeVectorTransform": None,
}
"""Nodes that know of a place outside the sample, and by which outputs; None stands for any."""


class LibraryError(Exception):
    """A linked material is not where its link says."""


def main(job_path: Path) -> None:
    """Measure all materials of the job in all its geometries."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    end_if_orphaned(job["asked_by"], folder)
    bpy.ops.wm.open_mainfile(filepath=str(folder / job["blend"]), load_ui=False, use_scripts=False)
    materials = [find(*key) for key in job["materials"]]
    if job["colors"]:
        pairs = zip(materials, job["colors"], strict=True)
        materials = [colored(material, color) for material, color in pairs]
    work = [
        (part, alike)
        for members, alike in together(job["geometries"])
        for part in batches(materials, members)
    ]
    total, done = sum(len(alike) for _, alike in work), 0
    result = np.full((len(job["geometries"]), len(materials), 2, 3), np.nan)
    for part, alike in work:
        scene, stretch = build([materials[i] for i in part])
        show(scene, job["frame"])
        for number in alike:
            how = (job["geometries"][number]["shots"], job["samples"], job["rays"], len(part))
            result[number, part] = measure(scene, stretch, folder / "render.exr", *how)
            done += 1
            report(folder, done, total)
            end_if_orphaned(job["asked_by"], folder)
    np.save(folder / "result.npy", result)


def together(geometries: list[dict[str, Any]]) -> list[tuple[list[int], list[int]]]:
    """Put geometries together that measure the same materials: these, and the geometries."""
    found: dict[tuple[int, ...], list[int]] = {}
    for number, geometry in enumerate(geometries):
        found.setdefault(tuple(geometry["members"]), []).append(number)
    return [(list(members), alike) for members, alike in found.items()]


def batches(materials: list[Any], members: list[int]) -> list[list[int]]:
    """Divide materials, by their numbers, among pictures.

    What asks for its place gets a picture of its own, and so does a second material of one name,
    as linked ones can be: no two samples in a picture can be named alike.
    """
    together: list[int] = []
    alone: list[list[int]] = []
    names: set[str] = set()
    for number in members:
        material = materials[number]
        if material.name in names or asks_place(material.node_tree, set()):
            alone.append([number])
        else:
            together.append(number)
            names.add(material.name)
    starts = range(0, len(together), SAMPLES_PER_RENDER)
    return [*(together[start : start + SAMPLES_PER_RENDER] for start in starts), *alone]


def asks_place(tree: Any, seen: set[Any]) -> bool:
    """Whether a node, in a group too, follows where in the world or picture the surface is."""
    if tree is None or tree in seen:
        return False
    seen.add(tree)
    for node in tree.nodes:
        outputs = PLACED.get(node.bl_idname, ())
        if outputs is None or any(node.outputs[name].is_linked for name in outputs):
            return True
        if node.bl_idname == "ShaderNodeTexCoord" and node.object is not None:
            return True
        if node.type == "GROUP" and asks_place(node.node_tree, seen):
            return True
    return False


_PARENT = os.getppid()
_LOOKS_SECONDS = 0.5
_is_ending = threading.Event()


def end_if_orphaned(asked_by: int, folder: Path) -> None:
    """Stop, and leave nothing behind, when the process that asked for this was killed.

    From the first call on a thread looks, too, until the folder is gone: one render may take hours.
    """
    if os.name != "posix":
        return  # there os.kill(pid, 0) would not ask but kill
    if is_gone(asked_by):
        shutil.rmtree(folder, ignore_errors=True)
        sys.exit("the Blender that asked for this measurement is gone")
    if str(folder) not in {thread.name for thread in threading.enumerate()}:
        own = [folder]
        session = Path(bpy.app.tempdir)
        if session.name.startswith("blender_"):
            own.append(session)
        watch = threading.Thread(target=_watch, args=(asked_by, own), name=str(folder), daemon=True)
        atexit.register(_end, watch)
        watch.start()


def is_gone(asked_by: int) -> bool:
    """Whether a process has ended, also while nobody has asked yet how."""
    if asked_by == _PARENT:
        return os.getppid() != asked_by
    try:
        os.kill(asked_by, 0)
    except ProcessLookupError:
        return True
    return False


def _watch(asked_by: int, own: list[Path]) -> None:
    """Do the same from a thread of its own, which calls nothing of Blender's."""
    while not _is_ending.wait(_LOOKS_SECONDS) and own[0].exists():
        if is_gone(asked_by):
            for each in own:
                shutil.rmtree(each, ignore_errors=True)
            os._exit(1)


def _end(watch: threading.Thread) -> None:
    _is_ending.set()
    watch.join(_LOOKS_SECONDS)


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


def colored(material: Any, color: tuple[str, str, int, list[float]] | None) -> Any:
    """Give a copy of a material that has another color at a socket; without a color, itself."""
    if color is None:
        return material
    node, side, number, rgb = color
    copied = material.copy()
    socket = getattr(copied.node_tree.nodes[node], side)[number]
    socket.default_value = (*rgb, socket.default_value[3])
    return copied


def round_alike(tree: Any, seen: set[Any]) -> None:
    """Let Object coordinates come from Generated ones, whose digits do not depend on the place.

    Cycles takes Object coordinates back from the place in the world, where the last ones are lost.
    """
    if tree is None or tree in seen:
        return
    seen.add(tree)
    for node in list(tree.nodes):
        if node.type == "GROUP":
            round_alike(node.node_tree, seen)
        elif node.type == "TEX_COORD" and node.object is None and node.outputs["Object"].is_linked:
            from_middle = tree.nodes.new("ShaderNodeVectorMath")
            from_middle.operation = "SUBTRACT"
            from_middle.inputs[1].default_value = (0.5, 0.5, 0.5)
            for link in list(node.outputs["Object"].links):
                tree.links.new(from_middle.outputs["Vector"], link.to_socket)
            tree.links.new(node.outputs["Generated"], from_middle.inputs[0])


def build(materials: list[Any]) -> tuple[Any, Any]:
    """Lay the samples side by side, each a square object of its own.

    Were they one mesh, a material with Generated or Object coordinates would read differently
    beside other neighbors.
    """
    scene = bpy.data.scenes.new("Spectrophotometer")
    mesh = square()
    changed: set[Any] = set()
    stretch = bpy.data.objects.new("Samples", None)
    scene.collection.objects.link(stretch)
    for index, material in enumerate(materials):
        sample = bpy.data.objects.new("Sample", mesh)
        # Named like the material: Object Info's Random follows the name.
        take_name(sample, material.name)
        sample.material_slots[0].link = "OBJECT"
        sample.material_slots[0].material = material
        pitch = PIXELS / PIXELS_PER_UNIT
        sample.location = (index % COLUMNS * pitch, index // COLUMNS * pitch, 0)
        sample.parent = stretch
        # Nothing here casts a shadow, but where a ray meets the seam of two triangles, the one
        # shades the other: one sample in 256 came out black.
        sample.visible_shadow = False
        scene.collection.objects.link(sample)
        # What glows is seen to, but is no light for its neighbors.
        material.cycles.emission_sampling = "NONE"
        round_alike(material.node_tree, changed)
    lens = bpy.data.cameras.new("View")
    lens.type, lens.sensor_fit = "ORTHO", "HORIZONTAL"
    lens.ortho_scale = 2 * FIRST_PIXEL / PIXELS_PER_UNIT
    camera = bpy.data.objects.new("View", lens)
    scene.collection.objects.link(camera)
    scene.camera = camera
    sun = bpy.data.lights.new("Light", "SUN")
    sun.angle = 0.0
    scene.collection.objects.link(bpy.data.objects.new("Light", sun))
    settings = plain(scene)
    settings.resolution_x = settings.resolution_y = 2 * FIRST_PIXEL
    settings.use_border = settings.use_crop_to_border = True
    settings.border_min_x = settings.border_min_y = 0.5
    columns, rows = min(len(materials), COLUMNS), math.ceil(len(materials) / COLUMNS)
    settings.border_max_x = 0.5 + columns * PIXELS / (2 * FIRST_PIXEL)
    settings.border_max_y = 0.5 + rows * PIXELS / (2 * FIRST_PIXEL)
    cycles = scene.cycles
    # Pixels usually get random numbers of their own; at a distance of 0 all get the same ones.
    cycles.auto_scrambling_distance, cycles.scrambling_distance = False, 0.0
    cycles.max_bounces = 0
    return scene, stretch


def show(scene: Any, frame: tuple[int, float]) -> None:
    """Let what is animated have the values that the user sees; a new scene shows its first frame.

    `frame` is the number and the part of a frame after it. Of a scene that is asked for by name,
    Blender renders the frame of the one that is open.
    """
    number, part = frame
    for each in (bpy.context.scene, scene):
        each.frame_set(number, subframe=part)


def plain(scene: Any) -> Any:
    """Let Cycles render what is there and nothing besides; gives the scene's render settings."""
    settings = scene.render
    settings.engine = "CYCLES"
    settings.resolution_percentage = 100
    settings.use_persistent_data = True  # only lights and camera move
    settings.use_compositing = settings.use_sequencer = False
    settings.film_transparent = False
    settings.image_settings.file_format = "OPEN_EXR"
    settings.image_settings.color_mode = "RGBA"
    settings.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.sampling_pattern = "TABULATED_SOBOL"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    return settings


def square() -> Any:
    """Make the mesh of all samples: the square from -0.5 to 0.5, and a margin for the ring.

    UV and Generated coordinates run from 0 to 1 over the square without the margin.
    """
    mesh = bpy.data.meshes.new("Sample")
    edge = PIXELS / PIXELS_PER_UNIT / 2
    corners = [(-edge, -edge), (edge, -edge), (edge, edge), (-edge, edge)]
    mesh.from_pydata([(x, y, 0) for x, y in corners], [], [range(4)])
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", np.array(corners, np.float32).ravel() + np.float32(0.5))
    mesh.use_auto_texspace = False
    mesh.texspace_location, mesh.texspace_size = (0, 0, 0), (0.5, 0.5, 1)
    mesh.materials.append(None)
    return mesh


def aim(scene: Any, stretch: Any, view: float, quarter: int) -> None:
    """Set the view; samples are stretched by as much as it foreshortens them.

    A view from another quarter is that of a camera which does not roll: up stays up as far as it
    can, and the samples lie in the picture as ever.
    """
    # Far enough for the far end of the stretched samples; a power of two for a view from above.
    scene.camera.data.clip_end = 8 * COLUMNS * (1 + math.tan(view))
    turned = ((0, view, 0), (-view, 0, 0), (0, -view, 0), (view, 0, 0))
    scene.camera.rotation_euler = turned[quarter]
    long = 1 / math.cos(view)
    stretch.scale = (1, long, 1) if quarter % 2 else (long, 1, 1)


def passes(
    shots: list[dict[str, Any]], samples: int
) -> Iterator[tuple[dict[str, Any], float, float]]:
    """Give a shot and a place within all pixels, from 0 to 1, for each ray that a pixel gets.

    Every light and view has as many rays as the others. Cycles would pick one by chance for each
    ray, and the chance would have to be another in each pixel, or all would miss the same lights.
    Places are Hammersley's: their mean is the middle.
    """
    count = len(shots) * max(1, round(samples / len(shots)))
    digits = max(1, (count - 1).bit_length())
    for number in range(count):
        mirrored = int(f"{number:0{digits}b}"[::-1], 2)
        yield shots[number % len(shots)], (number + 0.5) / count, (mirrored + 0.5) / 2**digits


def light(scene: Any, sun: Any, shot: dict[str, Any]) -> None:
    """Turn the sun to a light's direction, or let the hemisphere glow."""
    if "glow" in shot:
        glow(scene, shot["glow"])
    elif scene.world is not None:
        scene.world = None
    sun.hide_render = "sun" not in shot
    if "sun" in shot:
        theta, phi = shot["sun"]
        # The irradiance is π, so the radiance is the reflectance factor.
        sun.data.energy = math.pi / math.cos(theta)
        sun.rotation_euler = (0, theta, phi)


def glow(scene: Any, what: dict[str, Any]) -> None:
    """Make a world whose upper half glows, but for a trap, or in a window alone.

    Up is +z unless `what` says otherwise; its axes are those of the scene.

    An even one is best met by rays that go where the material sends most. To a small window they
    are sent on purpose as well. The world stays where it is the same as before: Cycles then has
    nothing to look at again.
    """
    told = json.dumps(what)
    before = scene.world
    if before is not None and before.get("told") == told:
        return
    world = bpy.data.worlds.new("Hemisphere")
    if world.node_tree is None:
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    toward = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    shines = above(tree, dot(tree, toward, what.get("up", [0, 0, 1])), 0.0)
    for name in ("window", "trap"):
        if what[name] is not None:
            within = inside(tree, toward, what[name])
            if name == "trap":
                within = math_node(tree, "SUBTRACT", 1.0, within)
            shines = math_node(tree, "MULTIPLY", shines, within)
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(
        math_node(tree, "MULTIPLY", shines, what["strength"]), background.inputs["Strength"]
    )
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    world.cycles.sampling_method = "NONE" if what["window"] is None else "MANUAL"
    world.cycles.sample_map_resolution = MAP_RESOLUTION
    world["told"] = told
    scene.world = world
    if before is not None:
        bpy.data.worlds.remove(before)


def inside(tree: Any, toward: Any, window: dict[str, Any]) -> Any:
    """1 where a direction lies in a window, else 0."""
    ahead, *sides = (dot(tree, toward, axis) for axis in window["axes"])
    if window["cosine"] is not None:
        return above(tree, ahead, window["cosine"])
    within = above(tree, ahead, 0.0)
    for side, tangent in zip(sides, window["tangents"], strict=True):
        reach = math_node(tree, "MULTIPLY", ahead, tangent)
        free = math_node(tree, "SUBTRACT", reach, math_node(tree, "ABSOLUTE", side))
        within = math_node(tree, "MULTIPLY", within, above(tree, free, 0.0))
    return within


def above(tree: Any, value: Any, bound: float) -> Any:
    """1 where a value is greater than a bound, else 0."""
    return math_node(tree, "GREATER_THAN", value, bound)


def dot(tree: Any, vector: Any, axis: list[float]) -> Any:
    """Component of a direction along an axis."""
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = "DOT_PRODUCT"
    tree.links.new(vector, node.inputs[0])
    node.inputs[1].default_value = axis
    return node.outputs["Value"]


def math_node(tree: Any, operation: str, *values: Any) -> Any:
    """Output of a Math node; each value is a number or another node's output."""
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for value, socket in zip(values, node.inputs, strict=False):
        if isinstance(value, (int, float)):
            socket.default_value = value
        else:
            tree.links.new(value, socket)
    return node.outputs[0]


def place(scene: Any, shot: dict[str, Any], x: float, y: float) -> None:
    """Move the camera to a place within pixels, from 0 to 1."""
    # The middle of the whole picture lies half a sample below the middle of the first one.
    aside, up = (place - 0.5 - PIXELS / 2 for place in (x, y))
    aside, up = aside / PIXELS_PER_UNIT, up / PIXELS_PER_UNIT
    view, quarter = shot["view"], shot["quarter"]
    distance = scene.camera.data.clip_end / 4
    # Along the tilt of the view, and at right angles to it.
    sign = -1 if quarter in (2, 3) else 1
    tilted, level = (up, aside) if quarter % 2 else (aside, up)
    ahead = distance * sign * math.sin(view) + tilted * math.cos(view)
    height = distance * math.cos(view) - sign * tilted * math.sin(view)
    scene.camera.location = (level, ahead, height) if quarter % 2 else (ahead, level, height)


def measure(
    scene: Any,
    stretch: Any,
    path: Path,
    shots: list[dict[str, Any]],
    samples: int,
    rays: int,
    count: int,
) -> Any:
    """Measure all samples in one geometry, shape (samples, 2, 3): mean and standard deviation."""
    (sun,) = (thing for thing in scene.objects if thing.type == "LIGHT")
    pictures, weights = [], []
    # Rays into a glowing hemisphere spread over the pixel by themselves.
    renders = list(passes(shots, 1 if "glow" in shots[0] else samples))
    for number, (shot, x, y) in enumerate(renders):
        scene.cycles.seed = number
        # The first ray meets a pixel's middle, to 1/2048.
        scene.cycles.samples = max(1, rays // len(renders)) if "glow" in shot else 1
        aim(scene, stretch, shot["view"], shot["quarter"])
        light(scene, sun, shot)
        place(scene, shot, *((x, y) if "sun" in shot else (0.5, 0.5)))
        pictures.append(render(scene, path))
        weights.append(shot["weight"])
    pixels = np.average(pictures, axis=0, weights=weights)
    rows, columns = pixels.shape[0] // PIXELS, pixels.shape[1] // PIXELS
    tiles = pixels.reshape(rows, PIXELS, columns, PIXELS, 3)[:, 1:-1, :, 1:-1]
    # Each sample's pixels in a row of their own: numpy then adds them up in one order, whatever
    # the shape of the picture.
    tiles = np.ascontiguousarray(tiles.transpose(0, 2, 4, 1, 3)).reshape(rows * columns, 3, -1)
    return np.stack((tiles.mean(axis=-1), tiles.std(axis=-1)), axis=1)[:count]


def render(scene: Any, path: Path) -> Any:
    """Render and give the pixels, from the bottom up."""
    render_into(scene, path)
    return read_exr(path)[::-1, :, :3].astype(np.float64)


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


def take_name(thing: Any, name: str) -> None:
    """Give an object this very name; one that has it already gets another."""
    other = bpy.data.objects.get((name, None))
    if other is not None:
        other.name = f"{name[:40]} aside"
    thing.name = name


def report(folder: Path, done: int, total: int) -> None:
    """Tell the progress to whoever polls; replaced whole, so it is never read half-written."""
    part = folder / "progress.part"
    part.write_text(f"{done} {total}", encoding="ascii")
    part.replace(folder / "progress")


if __name__ == "__main__":
    try:
        main(Path(sys.argv[-1]))
    finally:
        # Were drivers with Python in them still there when Python has ended, the bpy module of
        # 4.5 would wait for it for ever.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
