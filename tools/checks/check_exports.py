# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check what other renderers make of exported materials, and write docs/export-table.md.

    .venv/bpy-5.2/bin/python -m tools.checks.check_exports [--output docs/…]

The 24 ColorChecker patches at four σ are exported for all targets. Mitsuba, LuxCore and MaterialX
read their files in the environment of the chart (`python3 dev.py chart` makes it), Blender imports
glTF and USD again and measures them in Cycles, and pbrt's file is read as pbrt does. All are asked
in the same directions and compared with the spectra. Exit status 1 where a bound is broken. Takes
a minute; needs an environment with bpy.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.export import spaces, targets
from rough_spectra.addon.instrument import measure
from rough_spectra.addon.matching import assess
from rough_spectra.core.color.color_difference import delta_e, xyz_to_lab
from rough_spectra.core.numerics import direction_grid
from rough_spectra.core.numerics.arrays import Array

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "export-table.md"
PEERS = ROOT / ".venv" / "chart" / "bin" / "python"
DEGREES = (0, 15, 30, 45)
DIRECTIONS = 32
RING = np.radians([[45.0], [0.0], [0.0]])
FINE = np.arange(380.0, 781.0, 5.0)
BOUNDS = {"gltf": 0.5, "usd": 0.5}
"""ΔE00 at 45°/0° of what the renderer's colors can hold; elsewhere `BOUND`."""
BOUND = 0.1
HOW = {
    "materialx": "formula: its own GLSL, run by numpy; validated",
    "usd": "imported by Blender, Cycles",
    "gltf": "imported by Blender, Cycles",
    "mitsuba": "`BSDF.eval` of the scene",
    "pbrt": "formula: the file's spectrum, Lambert's law",
    "luxcore": "rendered",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Export, ask, print and write the page; exit status 1 where a bound is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=PAGE)
    options = parser.parse_args(arguments)
    extension = load_extension()
    extension.register()
    try:
        with tempfile.TemporaryDirectory() as folder:
            lines, broken = table(Path(folder))
    finally:
        extension.unregister()
    text = "\n".join(lines) + "\n"
    print(text)
    options.output.write_text(text, encoding="utf-8")
    for sentence in broken:
        print(sentence, file=sys.stderr)
    return 1 if broken else 0


def table(folder: Path) -> tuple[list[str], list[str]]:
    """Give the page's lines, and which bounds are broken."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    made = chart()
    found = api.export(made, folder / "chart")
    angles = np.append(np.array(direction_grid.hemisphere(DIRECTIONS)), RING, axis=1)
    seen, versions = ask(found, folder, angles)
    lines = [
        "| target | how it was asked | 45°/0°, largest | outside of Rec.709 | σ 0° | 15° | 30° "
        "| 45° | 95 % | largest |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    broken = []
    for name, target in targets.REGISTRY.items():
        entries = found.of(name)
        apart = np.array(
            [delta_e(seen[name][i], goal(entry, angles)) for i, entry in enumerate(entries)]
        )
        inside = np.array([not any("outside" in text for text in e.warnings) for e in entries])
        at_ring, over = apart[:, -1], apart[:, :-1].reshape(len(DEGREES), -1)
        bound = BOUNDS.get(name, BOUND)
        if at_ring[inside].max() > bound:
            broken.append(f"{target.TITLE} is off by ΔE00 {at_ring[inside].max():.2f} at 45°/0°.")
        outside = "" if inside.all() else f"{at_ring[~inside].max():.1f}"
        title = f"{target.TITLE}{versions.get(name, '')}"
        cells = [
            *(title, HOW[name], told(at_ring[inside].max()), outside),
            *(f"{mean:.2f}" for mean in over.mean(axis=1)),
            *(f"{np.percentile(over, 95):.1f}", f"{over.max():.1f}"),
        ]
        lines.append(f"| {' | '.join(cells)} |")
    lines += ["", *notes(seen, found, angles)]
    return lines, broken


def chart() -> list[Any]:
    """Make the materials, σ by σ."""
    pairs = []
    for degrees in DEGREES:
        for patch in api.presets("colorchecker"):
            material = bpy.data.materials.new(f"{patch.split('/')[1]} {degrees}")
            sigma = float(np.radians(degrees))
            pairs.append((material, api.request(api.find(patch), sigma, kind="albedo")))
    api.assign(pairs, gloss="none")
    return [material for material, _ in pairs]


def ask(
    found: api.Exported, folder: Path, angles: Array
) -> tuple[dict[str, Array], dict[str, str]]:
    """Give L*a*b* (materials, directions, 3) of each target, and versions of renderers."""
    names = [entry.identifier for entry in found.of("mitsuba")]
    work = {"names": names, "angles": angles.tolist()}
    (folder / "work.json").write_text(json.dumps(work), encoding="utf-8")
    if not PEERS.exists():
        raise SystemExit(f"{PEERS} is missing; python3 dev.py chart makes it.")
    words = [str(PEERS), "-m", "tools.checks.export_referees", str(folder)]
    log = folder / "log"
    with log.open("wb") as file:
        # Not the bpy module's OCIO, and no picture of what LuxCore thinks.
        status = subprocess.run(
            words, cwd=ROOT, stdout=file, stderr=file, env=clean(), check=False
        ).returncode
    if status:
        raise SystemExit(log.read_text(encoding="utf-8", errors="replace"))
    told_by = json.loads((folder / "seen.json").read_text(encoding="utf-8"))
    if told_by["wrong"]:
        raise SystemExit(f"MaterialX does not validate: {told_by['wrong']}")
    raw = np.load(folder / "seen.npz")
    colors = {"pbrt": pbrt(folder / "chart.pbrt", angles.shape[1]), "mitsuba": raw["mitsuba"]}
    seen = {name: to_lab(values, spaces.SPECTRA) for name, values in colors.items()}
    for name in ("materialx", "luxcore"):
        pairs = zip(raw[name], found.of(name), strict=True)
        seen[name] = np.stack([to_lab(values, entry.space) for values, entry in pairs])
    seen["luxcore texture"] = to_lab(raw["luxcore_textures"], spaces.REC709)
    seen |= imported(found, folder, angles)
    numbers = told_by["versions"]
    labels = {"materialx": "MaterialX", "mitsuba": "mitsuba", "luxcore": "pyluxcore"}
    return seen, {name: f" ({numbers[label]})" for name, label in labels.items()}


def clean() -> dict[str, str]:
    """Give the environment without what the bpy module set for its own libraries."""
    return {name: value for name, value in os.environ.items() if not name.startswith("PXR_")}


def imported(found: api.Exported, folder: Path, angles: Array) -> dict[str, Array]:
    """Import glTF and USD again, and measure both in Cycles."""
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(folder / "chart.gltf"))
    of_gltf = [bpy.data.materials[entry.name] for entry in found.of("gltf")]
    bpy.ops.wm.usd_import(filepath=str(folder / "chart.usda"))
    of_usd = [bpy.data.materials[entry.identifier] for entry in found.of("usd")]
    geometries = [measure.Geometry(((light, turn),), view) for light, view, turn in angles.T]
    read = measure.measure([*of_gltf, *of_usd], geometries)[:, :, 0]
    lab = to_lab(np.swapaxes(read, 0, 1), spaces.REC709)
    return {"gltf": lab[: len(of_gltf)], "usd": lab[len(of_gltf) :]}


def pbrt(path: Path, directions: int) -> Array:
    """Read the spectra of a file as pbrt does, shape (materials, directions, bands of `FINE`)."""
    found = []
    for text in re.findall(r'"spectrum reflectance" \[ (.+) \]', path.read_text("utf-8")):
        wavelengths, values = np.array(text.split(), float).reshape(-1, 2).T
        found.append(np.tile(np.interp(FINE, wavelengths, values), (directions, 1)))
    return np.stack(found)


def to_lab(values: Array, space: str) -> Array:
    """L*a*b* of spectra at `FINE`, or of RGB, under D65."""
    if space == spaces.SPECTRA:
        weights = tristimulus.weights(FINE, "D65")
        return xyz_to_lab(values @ weights, weights.sum(axis=0))
    return spaces.find(space).to_lab(values, "D65")


def goal(entry: api.Entry, angles: Array) -> Array:
    """L*a*b* of the spectrum in all directions, the instrument's last."""
    elsewhere = assess.in_directions(entry.request, entry.albedo, tuple(angles[:, :-1]))
    spectra = np.vstack((elsewhere, entry.reading))
    weights = tristimulus.weights(entry.wavelengths, "D65")
    return xyz_to_lab(spectra @ weights, weights.sum(axis=0))


def notes(seen: dict[str, Array], found: api.Exported, angles: Array) -> list[str]:
    """Say what the table leaves out."""
    entries = found.of("luxcore")
    wanted = np.stack([goal(entry, angles)[-1] for entry in entries])
    texture = delta_e(seen["luxcore texture"], wanted)
    predicted = np.mean([entry.delta_e_mean for entry in found.of("materialx")])
    return [
        f"The texture of a spectrum that LuxCore turns into RGB itself is off by ΔE00 "
        f"{texture.mean():.1f} in the mean and {texture.max():.1f} at most. MaterialX's GLSL "
        "holds the cosine between light and view at least at 0, which EON does not: by EON "
        f"itself the mean over all four σ is {predicted:.2f}.",
    ]


def told(value: float) -> str:
    """Write a ΔE00, and of next to none that it is."""
    return "< 0.005" if value < 0.005 else f"{value:.2f}"


if __name__ == "__main__":
    sys.exit(main())
