# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials under gloss, read by the virtual spectrophotometer.

Assigns seven presets to Principled BSDFs of every gloss of a grid, renders each, and compares the
reading with the sample's; beside it that of the same gloss over the color of a matte material,
which is what gloss costs where it is ignored. Writes docs/gloss-table.md, and fails where a
material is off that was not said to be. Needs an environment with bpy:

    python -m tools.checks.check_gloss
"""

from __future__ import annotations

import itertools
import math
import sys
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.instrument.measure import measure
from rough_spectra.addon.matching.request import Request
from rough_spectra.addon.matching.solution import Solution
from rough_spectra.addon.material import derive
from rough_spectra.addon.samples import presets
from rough_spectra.addon.support import atomic_files
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics.arrays import Array

SAMPLES = {
    "white": "colorchecker/19-white-9-5",
    "gray": "colorchecker/21-neutral-6-5",
    "black": "colorchecker/24-black-2",
    "brick": "everyday/brick",
    "paper": "everyday/paper",
    "terracotta": "everyday/terracotta",
    "concrete": "everyday/concrete",
}
LEVELS, COATS = (0.5, 1.0), (0.0, 1.0)
ROUGHNESS = tuple(step / 10 for step in range(1, 10))
SIGMA = math.radians(20)
TOLERANCE = 0.1
"""ΔE00 within which a material that can have its gloss has to read."""
NAMED = "cannot have this gloss"

TABLE = ROOT / "docs" / "gloss-table.md"
HEAD = (
    "| sample | gloss ignored, ΔE00 | counted, possible ones | ΔE00 | impossible ones | ΔE00 |\n"
    "|---|---|---|---|---|---|\n"
)


@dataclass(frozen=True)
class Case:
    """One sample under one gloss, rendered.

    Attributes
    ----------
    sample, level, roughness, coat
        What it is.
    measured, ignored
        ΔE00 of the rendered reading from the sample's, with the gloss counted and ignored.
    predicted
        What the first was said to be.
    told
        Whether the gloss was said to be impossible.
    """

    sample: str
    level: float
    roughness: float
    coat: float
    measured: float
    ignored: float
    predicted: float
    told: bool


def main() -> int:
    """Run the check and write the table; 1 if anything is off."""
    extension = sys.modules["rough_spectra"]
    extension.register()
    try:
        cases = run(tuple(SAMPLES), LEVELS, ROUGHNESS, COATS)
    finally:
        # Blender trips over classes that are still registered when it ends.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        extension.unregister()
    lines = [row(name, [case for case in cases if case.sample == name]) for name in SAMPLES]
    with atomic_files.publication() as files:
        files.write(TABLE, (HEAD + "".join(lines)).encode())
    wrong = [case for case in cases if is_wrong(case)]
    for case in wrong:
        sys.stderr.write(f"{case}\n")
    sys.stdout.write(HEAD + "".join(lines))
    sys.stdout.write(f"{len(cases)} materials, {len(wrong)} off that were not said to be\n")
    return 1 if wrong else 0


def is_wrong(case: Case) -> bool:
    """Whether a material is off without having been said to be, or said to be and is not."""
    surprising = abs(case.measured - case.predicted) > TOLERANCE / 10
    return surprising or (case.measured > TOLERANCE and not case.told)


def run(
    names: tuple[str, ...],
    levels: tuple[float, ...],
    roughness: tuple[float, ...],
    coats: tuple[float, ...],
) -> list[Case]:
    """Assign, render and compare every sample under every gloss."""
    grid = list(itertools.product(names, levels, roughness, coats))
    requests = [Request(presets.load(SAMPLES[name]), SIGMA) for name, *_ in grid]
    counted = [principled(*gloss) for _, *gloss in grid]
    solutions = derive.assign(list(zip(counted, requests, strict=True)))
    matte = [principled(*gloss) for _, *gloss in grid]
    derive.assign(list(zip(matte, requests, strict=True)), keep_gloss=False)
    for material, (_, *gloss) in zip(matte, grid, strict=True):
        set_gloss(material, *gloss)
    seen = measure([*counted, *matte], samples=8)[0, :, 0]
    apart = difference(seen.reshape(2, len(grid), 3), solutions)
    bpy.data.batch_remove([*counted, *matte])
    return [
        Case(
            *kind,
            measured=float(apart[0, i]),
            ignored=float(apart[1, i]),
            predicted=solution.delta_e_instrument,
            told=any(NAMED in warning for warning in solution.warnings),
        )
        for i, (kind, solution) in enumerate(zip(grid, solutions, strict=True))
    ]


def principled(level: float, roughness: float, coat: float) -> Any:
    """Make a material of a Principled BSDF with this gloss."""
    material = bpy.data.materials.new("Glossy")
    if material.node_tree is None:
        material.use_nodes = True
    set_gloss(material, level, roughness, coat)
    return material


def set_gloss(material: Any, level: float, roughness: float, coat: float) -> None:
    """Set the gloss of a material by hand."""
    node: Any = shader_nodes.shader_node(material)
    inputs = node.inputs
    inputs["Specular IOR Level"].default_value = level
    inputs["Roughness"].default_value = roughness
    inputs["Coat Weight"].default_value = coat


def difference(seen: Array, solutions: list[Solution]) -> Array:
    """ΔE00 of rendered readings (..., materials, 3) from their targets."""
    space = working_space.current()
    wanted = np.array([solution.target for solution in solutions])
    apart = color_difference.delta_e(space.to_lab(seen, "D65"), space.to_lab(wanted, "D65"))
    return np.asarray(apart)


def row(name: str, cases: list[Case]) -> str:
    """Write the row of one sample."""
    possible = [case.measured for case in cases if not case.told]
    others = [case.measured for case in cases if case.told]
    cells = [
        *(name, _range([case.ignored for case in cases]), str(len(possible))),
        *(f"{max(possible):.4f}" if possible else "", str(len(others)), _range(others)),
    ]
    return f"| {' | '.join(cells)} |\n"


def _range(values: list[float]) -> str:
    return f"{min(values):.2f} to {max(values):.2f}" if values else ""


if __name__ == "__main__":
    sys.exit(main())
