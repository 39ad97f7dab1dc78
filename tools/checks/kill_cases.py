# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `tools.checks.kills` kills: every verb that writes files, doing as little as it can.

`job` is not among them: it runs `bake`, `check` and the others. `texture` is two here: alone, and
with a material that is saved; so is `relight`, as the picture and the lights that it keeps are two
writings.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension().register()

from rough_spectra.addon.support import png

from tools.checks.check_farm import make_scene

Words = Callable[[Path, int], list[object]]
"""Words of a verb, from the folder that it writes to and which of the two options are meant."""

_FEW = 3  # materials of what renders, or is saved whole
_WIDTH, _HEIGHT = 12, 8  # pixels of a picture


def of_tables(folder: Path) -> dict[str, Words]:
    """Give the verbs that begin with measurement files and open no scene."""
    table, page, image = folder / "tiles.csv", folder / "which.csv", folder / "stripes.png"
    bands = "".join(
        f"{nm},{0.3 + nm / 9000:.4f},{0.2 + nm / 9000:.4f}\n" for nm in range(400, 701, 10)
    )
    table.write_text("# geometry: 45/0\nwavelength,Tile,Tile rough\n" + bands)
    rows = f"Tile,smooth,Tile,{table.name},\nTile rough,rough,Tile,{table.name},\n"
    page.write_text("sample,surface,material,file,sigma_deg\n" + rows)
    _stripes(image)

    def texture(to: Path, which: int) -> list[object]:
        return ["texture", image, "--sigma", 20 + 10 * which, "--output", to / "x.exr"]

    return {
        "import": lambda to, which: [
            *("import", table, "--folder", to, "--collection", "b" if which else "a"),
        ],
        "estimate": lambda to, which: [
            *("estimate", table, "--smooth", "Tile", "--rough", "Tile rough"),
            *("--repeatability", which + 1, "--output", to / "x.csv"),
        ],
        "compare": lambda to, which: [
            *("compare", f"{table}#Tile", f"{table}#Tile rough", "--output", to / "x.csv"),
            *("--sigma", 10 * which, 20),
        ],
        "emissivity": lambda to, which: [
            *("emissivity", table, "--sigma", 10 + 10 * which, "--output", to / "x"),
        ],
        "texture": texture,
        "texture --material": lambda to, which: [
            *texture(to, which),
            *("--material", "Wall", "--save", to / "x.blend"),
        ],
        "lab": lambda to, which: [
            *("lab", "--kind", "gaussian", "--sigma", 20 + 10 * which, "--albedo", 0.5),
            *("--cells", 32, "--rays", 16, "--seeds", 2, "--output", to / "x.csv"),
        ],
        "experiment": lambda to, which: [
            *("experiment", "--mapping", page, "--repeatability", which + 1),
            *("--output", to / "x"),
        ],
        "assets": lambda to, which: [
            *("assets", "--preset", 14, "--sigma", 10 + 10 * which, "--output", to),
        ],
    }


def of_scenes(folder: Path, materials: int) -> dict[str, Words]:
    """Give the verbs that begin with a scene; `materials` are those of what renders nothing."""
    scene = folder / "scene.blend"
    make_scene(scene, materials, 1)
    small = [_lit_scene(folder / f"small-{seed}.blend", seed) for seed in (1, 2)]
    some = ["--material", "Paint 0001", "--material", "Paint 0002"]
    picture = ["--bands", 3, "--samples", 1]
    return {
        "bake": lambda to, which: [
            *("bake", "--blend", scene, "--predicted-only", "--output", to / "x"),
            *(["--read-at", "di:8"] if which else []),
        ],
        "check": lambda to, which: [
            *("check", "--blend", small[which], "--output", to / "x"),
        ],
        "export": lambda to, which: [
            *("export", "--blend", scene, "--output", to / "x", *(some if which else [])),
            *("--target", "mitsuba", "--target", "pbrt"),
        ],
        "assign": lambda to, which: [
            *("assign", "--blend", small[0], "--preset", 14, "--material", "Paint 0000"),
            *("--sigma", 10 + 10 * which, "--output", to / "x.blend"),
        ],
        "analyze": lambda to, which: [
            *("analyze", "--blend", small[which], "--output", to / "x.blend"),
        ],
        "spectral": lambda to, which: [
            *("spectral", "--blend", small[which], *picture, "-o", to / "x.exr"),
            *("--spectral", to / "x.spectral.exr"),
        ],
        "relight": lambda to, which: [
            *("relight", "--blend", small[0], *picture, "--kept", folder / "kept.npz"),
            *("--intensity", f"World={1 + which}", "-o", to / "x.exr"),
        ],
        "relight --kept": lambda to, which: [
            *("relight", "--blend", small[0], *picture, "--kept", to / f"kept-{which}.npz"),
            *("-o", folder / "aside.exr"),
        ],
        "thermal": lambda to, which: [
            *("thermal", "--blend", small[0], "--samples", 1, "--sky", 250 + 20 * which),
            *("-o", to / "x.exr"),
        ],
        "spectral --frames": lambda to, which: [
            *("spectral", "--blend", small[which], *picture, "--frames", "1-4"),
            *("-o", to / "x.exr"),
        ],
        "infrared": lambda to, which: [
            *("infrared", "--blend", small[0], "--samples", 1, "--band", "700-1000"),
            *("--light", f"Sun={4000 + 1000 * which}K", "-o", to / "x.exr"),
        ],
        "verdict": lambda _, which: ["verdict", "--blend", small[which], "--samples", 2],
    }


def of_shards(shards: list[Path]) -> dict[str, Words]:
    """Give the verb that begins with parts of a bake."""
    return {
        "merge": lambda to, which: [
            *("merge", *shards, "--output", to / "x", *(["--format", "csv"] if which else [])),
        ],
    }


def _stripes(path: Path) -> None:
    stripes = np.linspace(25, 205, 128).astype(np.uint8)[:, np.newaxis]
    path.write_bytes(png.encode(np.tile(stripes, (128, 1, 3))))


def _lit_scene(path: Path, seed: int) -> Path:
    """Save a floor of measured material below a sun and an even world, with a camera over it."""
    make_scene(path, _FEW, seed)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = _WIDTH, _HEIGHT
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(bpy.data.materials["Paint 0000"])
    bpy.ops.object.light_add(type="SUN", location=(0, 0, 4))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path
