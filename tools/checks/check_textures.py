# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that the mean of scaled textures measures as their samples, over σ.

    .venv/bpy-5.2/bin/python -m tools.checks.check_textures [--rays 1024] [--output docs/…]

Five images and three procedurals get three samples at five σ, on both shaders in turn; each is then
measured at 45°/0° by rays that have nothing to do with how the texture was looked at. Takes some
minutes on two cores; needs an environment with bpy.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from math import radians
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.instrument import measure
from rough_spectra.addon.matching.solve import Request
from rough_spectra.addon.material import derive
from rough_spectra.addon.samples import presets
from rough_spectra.core.color import color_difference

from tools.checks.textures import PROCEDURALS, image, pictures

DEGREES = (0, 10, 20, 30, 45)
SAMPLES = ("terracotta", "concrete", "paper")
SHADERS = ("ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled")
BOUND = 0.1
"""ΔE00 that a mean may be off."""

PAGE = Path(__file__).resolve().parents[2] / "docs" / "textures-table.md"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, and write the page; exit status 1 where a bound is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rays", type=int, default=1024, help="a pixel; 16 pixels see a texture")
    parser.add_argument("--output", type=Path, default=PAGE)
    options = parser.parse_args(arguments)
    extension = load_extension()
    extension.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    try:
        lines, worst = table(options.rays)
    finally:
        extension.unregister()
    text = "\n".join(lines) + "\n"
    print(text)
    options.output.write_text(text, encoding="utf-8")
    return int(worst > BOUND)


def table(rays: int) -> tuple[list[str], float]:
    """Give the lines of the table, and the largest ΔE00."""
    images = {name: image(name, pixels) for name, pixels in pictures().items()}
    textures = {**images, **PROCEDURALS}
    pairs = []
    for name in textures:
        for i, degrees in enumerate(DEGREES):
            for j, sample in enumerate(SAMPLES):
                title = f"{name} {degrees} {sample}"
                material = make(title, textures[name], SHADERS[(i + j) % len(SHADERS)])
                pairs.append((material, Request(presets.load(sample), radians(degrees))))
    solutions = derive.assign(pairs)
    [found] = measure.measure([material for material, _ in pairs], samples=rays)
    space = working_space.current()
    targets = np.array([solution.target for solution in solutions])
    labs = (space.to_lab(rgb, "D65") for rgb in (found[:, 0], targets))
    shape = len(textures), len(DEGREES), len(SAMPLES)
    told = [np.reshape([any(words in note for note in each.warnings) for each in solutions], shape)
            for words in ("too dark in", "is clipped")]  # fmt: skip
    apart = np.where(told[0], 0.0, color_difference.delta_e(*labs).reshape(shape))
    titles = [*(f"σ = {each}°" for each in DEGREES), "clipped", "out of reach"]
    lines = ["| texture | " + " | ".join(titles) + " |", "|---" * (len(titles) + 1) + "|"]
    for name, row, dark, cut in zip(textures, apart, *told, strict=True):
        cells = [f"{value:.3f}" for value in row.max(axis=1)]
        for which in (cut, dark):
            cells.append(", ".join(np.array(SAMPLES)[which.any(axis=0)]) or "—")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return lines, float(apart.max())


def make(name: str, texture: Any, shader: str) -> Any:
    """Make a material that shows an image, or a procedural."""
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output, node = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(shader)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    if callable(texture):
        source = texture(tree)
    else:
        picture = tree.nodes.new("ShaderNodeTexImage")
        picture.image = texture
        source = picture.outputs["Color"]
    tree.links.new(source, shader_nodes.color_socket(node))
    return material


if __name__ == "__main__":
    sys.exit(main())
