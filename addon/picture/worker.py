# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a scene in bands: the script that runs inside a second Blender.

Like the worker of flat samples, of which it borrows what both do, it imports nothing of the
extension, gets the path of a job as its last argument, and leaves its pictures beside it.

The job names places of colors and what they are in each render. A color that comes from other nodes
is multiplied by a 3 × 3 matrix of ordinary nodes. The scene stays in memory between renders, whose
random numbers are the same. The file that is open here is a copy, and is not saved.
"""

import importlib.util
import json
import os
import re
import sys
import time
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np

_DIRECT = (
    ("Diffuse Direct", "Diffuse Color"),
    ("Glossy Direct", "Glossy Color"),
    ("Transmission Direct", "Transmission Color"),
)
"""Light that met one surface, and by what it is to be multiplied."""
_STRAIGHT = ("Emission", "Environment", "Volume Direct")
"""Light that met none, or a volume once."""
_OLDER = {"Diff": "Diffuse", "Gloss": "Glossy", "Trans": "Transmission"}
_OLDER |= {"Dir": "Direct", "Col": "Color", "Emit": "Emission", "Env": "Environment"}
"""How Blender 4.5 shortens the names of passes in files, as in DiffDir."""


_SAMPLES = re.compile(r"Sample (\d+)/(\d+)")
_TILES = re.compile(r"Rendered (\d+)/(\d+) Tiles")
"""How Cycles says how far it is."""
_TOLD_SECONDS = 0.2
DRAWN = {"GREASEPENCIL", "GPENCIL"}
"""Types of objects that are drawn over what Cycles has rendered."""
_ENOUGH = 200_000
"""Pixels by which the part of a picture is counted."""


class Progress:
    """Tells how much is rendered, also within a render, by what Cycles says of its samples.

    Parameters
    ----------
    folder
        Of the job.
    total
        Number of renders.
    each
        Times that the scene is rendered for one of them.
    """

    def __init__(self, folder: Path, total: int, each: int = 1) -> None:
        self._folder, self._total, self._each = folder, total, each
        self._done, self._told = 0.0, 0.0
        self._times = 0
        shared.report(folder, 0, total)
        bpy.app.handlers.render_stats.append(self)  # until another file is opened
        bpy.app.handlers.render_complete.append(self._rendered)

    def __call__(self, text: str, _: Any = None) -> None:
        """Take what Cycles says."""
        found = _SAMPLES.search(text)
        if found is None or time.monotonic() - self._told < _TOLD_SECONDS:
            return
        self._told = time.monotonic()
        tiles = _TILES.search(text)
        parts = [int(number) for number in found.groups()]
        share = parts[0] / max(parts[1], 1)
        if tiles is not None:
            share = (int(tiles[1]) + share) / int(tiles[2])
        within = (min(self._times, self._each - 1) + min(share, 1.0)) / self._each
        shared.report(self._folder, round(self._done + min(within, 0.99), 3), self._total)

    def _rendered(self, *_: Any) -> None:
        self._times += 1
        self._told = time.monotonic()  # at the end Cycles counts from 0 again

    def step(self) -> None:
        """Note that one more is done."""
        self._done += 1
        self._times = 0
        shared.report(self._folder, int(self._done), self._total)


def main(job_path: Path) -> None:
    """Render all passes of the job."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    shared.end_if_orphaned(job["asked_by"], folder)
    bpy.ops.wm.open_mainfile(filepath=str(folder / job["blend"]), load_ui=False, use_scripts=False)
    scene = prepare(job)
    groups = job.get("groups", [])
    gather(scene.view_layers[job["layer"]], scene, groups)
    total = job["passes"] + bool(job["plain"])
    seconds: list[tuple[float, float]] = []
    progress = Progress(folder, total, 1 + job.get("halves", False))
    if job["plain"]:
        start = now()
        take(scene, folder, "plain", job["apart"], halves=job.get("halves", False))
        seconds.append(tuple(np.subtract(now(), start).tolist()))
        progress.step()
    for each in job["reset"]:
        setattr(owner(each["of"]), each["attribute"], each["value"])
    setters = [setter(each, scene.cycles.use_light_tree) for each in job["edits"]]
    for number in range(job["passes"]):
        shared.end_if_orphaned(job["asked_by"], folder)
        for put in setters:
            put(number)
        start = now()
        name = f"pass-{number}"
        if groups:
            take_groups(scene, folder, name, groups)
        else:
            halves = job.get("halves", False)
            take(scene, folder, name, job["apart"], job["direct"][number], halves=halves)
        seconds.append(tuple(np.subtract(now(), start).tolist()))
        progress.step()
    if job["untranslated"]:
        share = seen(scene, folder, job["layer"], job["untranslated"])
        (folder / "touched.json").write_text(json.dumps(share), encoding="utf-8")
    (folder / "seconds.json").write_text(json.dumps(seconds), encoding="utf-8")


def now() -> tuple[float, float]:
    """Seconds: on the clock, and those of the processor, which other programs don't lengthen."""
    return time.perf_counter(), time.process_time()


def seen(scene: Any, folder: Path, layer: str, wanted: list[list[str]]) -> float:
    """Render which material each pixel shows; gives the part that shows one of those wanted.

    Parameters
    ----------
    scene, folder, layer
        Where.
    wanted
        Keys of materials, as `owner` takes them.
    """
    for material in bpy.data.materials:
        material.pass_index = 0
    for of in wanted:
        owner(of).pass_index = 1
    scene.view_layers[layer].use_pass_material_index = True
    render, cycles = scene.render, scene.cycles
    cycles.samples, cycles.max_bounces = 1, 0
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    pixels = render.resolution_x * render.resolution_y * (render.resolution_percentage / 100) ** 2
    if pixels > _ENOUGH:
        smaller = render.resolution_percentage * (_ENOUGH / pixels) ** 0.5
        render.resolution_percentage = max(round(smaller), 1)
    put_format(render, several=True)
    path = folder / "render.exr"
    shared.render_into(scene, path)
    [index] = [pixels for name, pixels in channels(path).items() if "Index" in name]
    return float((index > 0.5).mean())


def prepare(job: dict[str, Any]) -> Any:
    """Give the scene, set to render what the job asks for and nothing around it."""
    scene = bpy.data.scenes[job["scene"]]
    if bpy.context.window is not None:
        bpy.context.window.scene = scene
    scene.frame_set(job["frame"], subframe=job["subframe"])
    for layer in scene.view_layers:
        layer.use = layer.name == job["layer"]
    render = scene.render
    # What is drawn into the render or comes after it is no light: it cannot be done to bands.
    render.use_compositing = render.use_sequencer = render.use_multiview = False
    render.use_freestyle = render.use_stamp = False
    for thing in bpy.data.objects:
        if thing.type in DRAWN:
            thing.hide_render = True
    render.use_persistent_data = True
    render.resolution_percentage = job["percentage"]
    scene.cycles.samples = job["samples"]
    scene.cycles.use_animated_seed = False
    scene.cycles.seed = job["seed"]
    # Faint light is left out by chance, and whether it is faint depends on its color.
    scene.cycles.light_sampling_threshold = 0
    for material in bpy.data.materials:
        if material.cycles.emission_sampling == "AUTO":  # which looks at how much it sends
            material.cycles.emission_sampling = "FRONT_BACK"
    if job.get("few_lamps"):  # which it costs little to pick without a look at what they send
        scene.cycles.use_light_tree = False
    if job["steady"]:
        keep_paths(scene.cycles)
    several = job["apart"] or bool(job.get("groups"))
    put_format(render, several)
    if job["apart"]:
        layer = scene.view_layers[job["layer"]]
        for name in ("diffuse", "glossy", "transmission"):
            setattr(layer, f"use_pass_{name}_direct", True)
            setattr(layer, f"use_pass_{name}_color", True)
        layer.use_pass_emit = layer.use_pass_environment = True
        layer.cycles.use_pass_volume_direct = True
    return scene


def put_format(render: Any, several: bool) -> None:
    """Let files hold a picture, or `several` passes of it."""
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "MULTI_LAYER_IMAGE" if several else "IMAGE"
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER" if several else "OPEN_EXR"
    if not several:
        render.image_settings.color_mode = "RGBA"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"


def keep_paths(cycles: Any) -> None:
    """Let no path of light depend on its color: what two renders differ by is color alone."""
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.min_light_bounces = cycles.max_bounces
    cycles.min_transparent_bounces = cycles.transparent_max_bounces
    cycles.use_light_tree = False  # it picks lamps by what they send


def take(
    scene: Any,
    folder: Path,
    name: str,
    apart: bool,
    direct: bool | None = None,
    *,
    halves: bool = False,
) -> None:
    """Render, and leave a picture, (rows, columns, 4) from the bottom up.

    Parameters
    ----------
    scene, folder, name
        What, and where to.
    apart
        Whether the file has passes of direct and of indirect light.
    direct
        If so: whether only direct light is wanted, or the rest; None for both.
    halves
        Whether to render twice, with random numbers of their own, and leave both and their mean.
    """
    bounces, seed = scene.cycles.max_bounces, scene.cycles.seed
    if apart and direct:
        scene.cycles.max_bounces = 0
    path = folder / "render.exr"
    found = []
    for number in range(1 + halves):
        scene.cycles.seed = (seed + number) % (1 << 31)
        shared.render_into(scene, path)
        pixels = layers(path, without_direct=direct is False) if apart else shared.read_exr(path)
        found.append(pixels[::-1].astype(np.float32))
        if halves:
            np.save(folder / f"{name}-half-{number}.npy", found[-1])
    scene.cycles.max_bounces, scene.cycles.seed = bounces, seed
    np.save(folder / f"{name}.npy", np.mean(found, axis=0))


def gather(layer: Any, scene: Any, groups: list[dict[str, Any]]) -> None:
    """Put what shines together into light groups, and take it out of those it is in."""
    if not groups:
        return
    for thing in bpy.data.objects:
        thing.lightgroup = ""
    while layer.lightgroups:
        layer.lightgroups.remove(layer.lightgroups[0])
    for group in groups:
        layer.lightgroups.add(name=group["name"])
        for place in group["objects"]:
            owner(["objects", *place]).lightgroup = group["name"]
        if group["world"]:
            world = getattr(layer, "world_override", None) or scene.world
            world.lightgroup = group["name"]


def take_groups(scene: Any, folder: Path, name: str, groups: list[dict[str, Any]]) -> None:
    """Render, and leave the light of each group, (groups, rows, columns, 4) from the bottom up."""
    path = folder / "render.exr"
    shared.render_into(scene, path)
    found = channels(path)
    alpha = found["Combined.A"]
    pictures = [
        np.stack([*(found[f"{each['name']}.{letter}"] for letter in "RGB"), alpha], axis=-1)
        for each in groups
    ]
    np.save(folder / f"{name}.npy", np.stack(pictures)[:, ::-1].astype(np.float32))


def layers(path: Path, without_direct: bool) -> Any:
    """Read a file of passes; gives what was rendered, or what of it is indirect light."""
    found = channels(path)

    def three(name: str) -> Any:
        return np.stack([found[f"{name}.{letter}"] for letter in "RGB"], axis=-1)

    rgb = three("Combined")
    if without_direct:
        for light, color in _DIRECT:
            rgb = rgb - three(light) * three(color)
        for name in _STRAIGHT:
            rgb = rgb - three(name)
    return np.concatenate((rgb, found["Combined.A"][..., np.newaxis]), axis=-1)


def channels(path: Path) -> dict[str, Any]:
    """Every channel of every pass by its name."""
    if hasattr(bpy.utils, "expose_bundled_modules"):
        bpy.utils.expose_bundled_modules()
    import OpenImageIO

    file, found, number = OpenImageIO.ImageInput.open(str(path)), {}, 0
    while file.seek_subimage(number, 0):
        spec = file.spec()
        pixels = file.read_image(number, 0, 0, spec.nchannels, OpenImageIO.FLOAT)
        pixels = np.asarray(pixels, np.float64).reshape(spec.height, spec.width, -1)
        for index, name in enumerate(spec.channelnames):
            kind, letter = name.split(".")[-2:]
            # The light of a group: its name is ours, and is left as it is.
            kind = kind.removeprefix("Combined_") if "_" in kind else whole(kind)
            found[f"{kind}.{letter}"] = pixels[..., index]
        number += 1
    file.close()
    return found


def whole(kind: str) -> str:
    """Give the name of a pass as Blender 5 has it."""
    parts = re.findall("[A-Z][a-z]*", kind)
    return " ".join(_OLDER.get(part, part) for part in parts)


def owner(of: list[str]) -> Any:
    """Find a datablock of a collection by its name and its library's whole path."""
    collection, name, path = of
    blocks = getattr(bpy.data, collection)
    for library in bpy.data.libraries if path else (None,):
        file = None if library is None else library.filepath
        found = blocks.get((name, file))
        if found is not None and (file is None or whole_path(file) == path):
            return found
    raise shared.LibraryError(f"{path or 'the file'} has no {name!r} any more")


def whole_path(path: str) -> str:
    """Give a library's path as who asked for the render gives it."""
    return os.path.normpath(bpy.path.abspath(path))


def setter(edit: dict[str, Any], is_picked: bool) -> Any:
    """Give a function that sets a color to what it is in the render of a number.

    Parameters
    ----------
    edit
        Where, and what.
    is_picked
        Whether Cycles picks lamps by what they send.
    """
    thing = owner(edit["of"])
    # Curves and drivers would set what they set again before every render.
    thing.animation_data_clear()
    if is_picked and edit.get("picked") and edit["of"][0] != "worlds":
        return picked_alike(edit, thing)
    if edit["attribute"]:
        name, extra = edit["attribute"], len(getattr(thing, edit["attribute"])) - 3

        def put_attribute(number: int) -> None:
            setattr(thing, name, (*edit["colors"][number], *(1.0,) * extra))

        return put_attribute
    tree = thing if edit["of"][0] == "node_groups" else thing.node_tree
    tree.animation_data_clear()
    socket = tree.nodes[edit["node"]].inputs[edit["socket"]]
    if "matrices" in edit:
        rows = multiplied(tree, socket)

        def put_matrix(number: int) -> None:
            for row, values in zip(rows, edit["matrices"][number], strict=True):
                row.default_value = values

        return put_matrix
    for link in list(socket.links):  # an RGB node or a blackbody, whose spectrum is known
        tree.links.remove(link)
    extra = len(socket.default_value) - 3

    def put(number: int) -> None:
        socket.default_value = (*edit["colors"][number], *(1.0,) * extra)

    return put


def picked_alike(edit: dict[str, Any], thing: Any) -> Any:
    """Give such a function for a lamp, which Cycles is then to pick as often in all renders.

    The light tree goes by strength times color, where the color is constant: other ones in each
    render would be noise of color. So it gets the strength that it has in the ordinary render, and
    a color that is as good as constant, but that Cycles does not know to be.
    """
    picked = edit["picked"]
    if edit["attribute"]:
        if not thing.use_nodes or thing.node_tree is None:
            thing.use_nodes = True
        tree = thing.node_tree
        socket = next(n for n in tree.nodes if n.type == "EMISSION").inputs["Color"]
        thing.color = (picked,) * 3
    else:
        tree = thing if edit["of"][0] == "node_groups" else thing.node_tree
        tree.animation_data_clear()
        node = tree.nodes[edit["node"]]
        socket = node.inputs[edit["socket"]]
        is_emission_apart = socket.name == "Emission Color"
        strength = node.inputs["Emission Strength" if is_emission_apart else "Strength"]
        if strength.is_linked:
            picked = 1.0
        else:
            strength.default_value *= picked
    path, one, color = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("LightPath", "Math", "VectorMath")
    )
    one.operation, one.inputs[1].default_value = "GREATER_THAN", -1.0
    color.operation = "SCALE"
    tree.links.new(path.outputs[0], one.inputs[0])
    tree.links.new(one.outputs[0], color.inputs["Scale"])
    tree.links.new(color.outputs[0], socket)

    def put(number: int) -> None:
        color.inputs[0].default_value = [value / picked for value in edit["colors"][number]]

    return put


def multiplied(tree: Any, socket: Any) -> list[Any]:
    """Multiply what reaches a socket by a matrix; gives the inputs that hold its rows."""
    [link] = [link for link in tree.links if link.to_socket == socket]
    source = link.from_socket
    tree.links.remove(link)
    rows = []
    together = tree.nodes.new("ShaderNodeCombineXYZ")
    for number in range(3):
        dot = tree.nodes.new("ShaderNodeVectorMath")
        dot.operation = "DOT_PRODUCT"
        tree.links.new(source, dot.inputs[0])
        tree.links.new(dot.outputs["Value"], together.inputs[number])
        rows.append(dot.inputs[1])
    # A saturated color of a wide space has bands below 0, as no surface and no lamp.
    floor = tree.nodes.new("ShaderNodeVectorMath")
    floor.operation = "MAXIMUM"
    tree.links.new(together.outputs[0], floor.inputs[0])
    tree.links.new(floor.outputs[0], socket)
    return rows


def borrow(path: Path) -> ModuleType:
    """Import another worker by its path."""
    spec = importlib.util.spec_from_file_location("shared_worker", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


shared = borrow(Path(__file__).resolve().parents[1] / "instrument" / "worker.py")

if __name__ == "__main__":
    try:
        main(Path(sys.argv[-1]))
    finally:
        # As in the other worker: scripted drivers.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
