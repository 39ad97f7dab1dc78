# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of this folder share that is no fixture."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
COMMAND = [sys.executable, str(ROOT / "tools" / "run" / "run_command_line.py")]
SECONDS = 120

ODD_NAME = '#1 "Ä" red\there'
"""A comment mark, quotation marks, a letter beyond ASCII and a tab: all that formats trip over."""


@dataclass
class Result:
    """Exit status and what was printed."""

    status: int
    err: str
    out: str = ""

    @property
    def sentence(self) -> str:
        """The one line on standard error."""
        assert "Traceback" not in self.err
        lines = self.err.strip("\n").split("\n")
        assert len(lines) == 1, self.err
        return lines[0]


def rgb_material(name, color=(0.5, 0.5, 0.5)):
    """Make a material by hand: a Diffuse BSDF of one color."""
    material = bpy.data.materials.new(name)
    material.use_fake_user = True
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (*color, 1)
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def checkered_and_glowing(name):
    """Make a material by hand whose color varies over the surface and which emits light."""
    material = rgb_material(name)
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs["Scale"].default_value = 2
    unwrapped = tree.nodes.new("ShaderNodeTexCoord").outputs["UV"]
    tree.links.new(unwrapped, checker.inputs["Vector"])
    tree.links.new(checker.outputs["Color"], shader.inputs["Color"])
    glow, both = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeAddShader")
    glow.inputs["Strength"].default_value = 0.25
    tree.links.new(shader.outputs[0], both.inputs[0])
    tree.links.new(glow.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], output.inputs["Surface"])
    return material


def spectrum_csv(path: Path, *names: str) -> Path:
    """Write a measurement file of 31 bands, 400 to 700 nm."""
    lines = [",".join(["wavelength", *names])]
    for band in range(31):
        values = [f"{0.2 + 0.01 * band + 0.001 * i:.6f}" for i in range(len(names))]
        lines.append(",".join([str(400 + 10 * band), *values]))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def contents(folder: Path) -> dict[str, bytes]:
    """Every file of a folder, hidden ones too."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


@dataclass
class Bake:
    """A finished bake: its base name and its files."""

    base: Path
    files: dict[str, bytes]
    result: Result

    def path(self, ending: str) -> Path:
        """One of the files."""
        return self.base.with_name(f"{self.base.name}.{ending}")

    @property
    def document(self) -> dict:
        """The JSON document."""
        return json.loads(self.path("json").read_bytes())
