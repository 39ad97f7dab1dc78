# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Export squares of materials by Blender's own USD exporter: a script for a second Blender.

Like the worker of flat samples, of which it borrows what both do, it imports nothing of the
extension, gets the path of a job as its last argument and leaves a .usda beside it. In the open
file names might be taken, and Blender exports no material that no object has.
"""

import importlib.util
import json
import sys
from pathlib import Path
from typing import Any

import bpy

APART = 1.25
"""From square to square, each of side 1."""


def main(job_path: Path) -> None:
    """Make the materials of the job, and export them."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    entries = job["materials"]
    for place, entry in enumerate(entries):
        mesh = bpy.data.meshes.new(entry["name"])
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
        mesh.materials.append(made(entry))
        square = bpy.data.objects.new(entry["name"], mesh)
        square.location = (place % job["columns"] * APART, -(place // job["columns"]) * APART, 0)
        bpy.context.scene.collection.objects.link(square)
    borrowed().end_if_orphaned(job["asked_by"], job_path.parent)
    bpy.ops.wm.usd_export(
        filepath=str(job_path.parent / job["file"]),
        selected_objects_only=False,
        export_materials=True,
        generate_preview_surface=True,
        generate_materialx_network=False,
        export_custom_properties=True,
        author_blender_name=False,
        export_cameras=False,
        export_lights=False,
        convert_world_material=False,
    )


def made(entry: dict[str, Any]) -> Any:
    """Make a material that the exporter turns into a preview surface without gloss."""
    material = bpy.data.materials.new(entry["name"])
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    shader.inputs["Base Color"].default_value = (*entry["color"], 1.0)
    # A preview surface knows no level of its gloss: with this index there is none.
    shader.inputs["IOR"].default_value = 1.0
    shader.inputs["Roughness"].default_value = 1.0
    for name, value in entry["properties"].items():
        material[name] = value
    return material


def borrowed() -> Any:
    """Load the worker that measures flat samples."""
    path = Path(__file__).resolve().parents[1] / "instrument" / "worker.py"
    spec = importlib.util.spec_from_file_location("spectrophotometer", path)
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} is missing; install the extension again.")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
