# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render what a thermal camera sees: the script that runs inside a second Blender.

Like the worker of spectral pictures, of which it borrows what both do, it imports nothing of the
extension and gets the path of a job as its last argument. All materials become gray in each part
of the band: they emit, and reflect the rest. Lamps are off: they shine where eyes see.
"""

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np

LIGHT = "rough_spectra_light"
BOUNCES = 128
"""So much light is followed: of an emissivity of 0.05 a seven-hundredth is left then."""


def main(job_path: Path) -> None:
    """Render all parts of the band."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    folder = job_path.parent
    shared.end_if_orphaned(job["asked_by"], folder)
    bpy.ops.wm.open_mainfile(filepath=str(folder / job["blend"]), load_ui=False, use_scripts=False)
    scene = prepare(job)
    kept = np.load(folder / "table.npz")
    variants = [variant(each) for each in job["variants"]]
    things = [worker.owner(["objects", each["name"], each["library"]]) for each in job["objects"]]
    if len(bpy.data.libraries):  # slots of linked objects cannot be set
        bpy.ops.object.make_local(type="ALL")
    for each, thing in zip(job["objects"], things, strict=True):
        dress(thing, [variants[number][0] for number in each["slots"]])
        if any(job["variants"][number]["by_vertex"] for number in each["slots"]):
            for number in range(job["renders"]):
                by_vertex(thing.data, job["attribute"], kept, number)
    background = sky(scene)
    progress = worker.Progress(folder, job["renders"])
    for number in range(job["renders"]):
        shared.end_if_orphaned(job["asked_by"], folder)
        part = slice(3 * number, 3 * number + 3)
        background.default_value = (*job["sky"][part], 1)
        for each, (_, put) in zip(job["variants"], variants, strict=True):
            put(each["emissivity"][part], each["sent"][part], number)
        worker.take(scene, folder, f"pass-{number}", False)
        progress.step()


def prepare(job: dict[str, Any]) -> Any:
    """Give the scene, set to follow light as far as it goes."""
    scene = worker.prepare({**job, "apart": False, "steady": True, "groups": []})
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.render.film_transparent = False
    layer = scene.view_layers[job["layer"]]
    layer.material_override = None
    if hasattr(layer, "world_override"):
        layer.world_override = None
    cycles = scene.cycles
    cycles.max_bounces = cycles.diffuse_bounces = cycles.min_light_bounces = BOUNCES
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.use_fast_gi = False
    for thing in bpy.data.objects:
        if thing.type in {"LIGHT", "LIGHT_PROBE"}:
            thing.hide_render = True
    return scene


def variant(each: dict[str, Any]) -> tuple[Any, Any]:
    """Make a material that emits and reflects; gives it and what sets both for a render."""
    material = bpy.data.materials.new("Thermal")
    if material.node_tree is None:
        material.use_nodes = True
    # It is not looked for: paths meet it anyway, and nothing is left to chance then.
    material.cycles.emission_sampling = "NONE"
    tree = material.node_tree
    tree.nodes.clear()
    kinds = ("OutputMaterial", "AddShader", "BsdfDiffuse", "Emission")
    output, both, diffuse, glow = (tree.nodes.new(f"ShaderNode{kind}") for kind in kinds)
    tree.links.new(diffuse.outputs[0], both.inputs[0])
    tree.links.new(glow.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], output.inputs["Surface"])
    attribute = times = None
    if each["by_vertex"]:
        attribute = tree.nodes.new("ShaderNodeAttribute")
        times = tree.nodes.new("ShaderNodeVectorMath")
        times.operation = "MULTIPLY"
        tree.links.new(attribute.outputs["Vector"], times.inputs[0])
        tree.links.new(times.outputs[0], glow.inputs["Color"])

    def put(emissivity: list[float], sent: list[float], number: int) -> None:
        diffuse.inputs["Color"].default_value = (*(1 - value for value in emissivity), 1)
        if attribute is None or times is None:
            own = (e * s for e, s in zip(emissivity, sent, strict=True))
            glow.inputs["Color"].default_value = (*own, 1)
        else:
            attribute.attribute_name = f"{LIGHT}{number}"
            times.inputs[1].default_value = emissivity

    return material, put


def dress(thing: Any, materials: list[Any]) -> None:
    """Give an object materials of its own, whatever its data have."""
    if not thing.material_slots:
        thing.data.materials.append(None)
    for slot, material in zip(thing.material_slots, materials, strict=False):
        slot.link = "OBJECT"
        slot.material = material


def by_vertex(mesh: Any, name: str, kept: Any, number: int) -> None:
    """Let vertices know what they send in the parts of a render."""
    kelvin = np.empty(len(mesh.vertices), np.float32)
    mesh.attributes[name].data.foreach_get("value", kelvin)
    part = slice(3 * number, 3 * number + 3)
    light = [np.interp(kelvin, kept["kelvin"], sent) for sent in kept["sent"][:, part].T]
    layer = mesh.attributes.get(f"{LIGHT}{number}")
    if layer is None:
        layer = mesh.attributes.new(f"{LIGHT}{number}", "FLOAT_VECTOR", "POINT")
    layer.data.foreach_set("vector", np.stack(light, axis=-1).astype(np.float32).ravel())


def sky(scene: Any) -> Any:
    """Let the world be a black body; gives the socket of its light."""
    world = scene.world = bpy.data.worlds.new("Thermal")
    if world.node_tree is None:
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    kinds = ("OutputWorld", "Background")
    output, background = (tree.nodes.new(f"ShaderNode{kind}") for kind in kinds)
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    return background.inputs["Color"]


def borrow(path: Path) -> ModuleType:
    """Import another worker by its path."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


worker = borrow(Path(__file__).resolve().with_name("worker.py"))
shared = worker.shared

if __name__ == "__main__":
    try:
        main(Path(sys.argv[-1]))
    finally:
        # As in the other worker: scripted drivers.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
