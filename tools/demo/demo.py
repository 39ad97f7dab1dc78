# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo: 24 presets at four roughnesses, their readings, a check, and a picture.

`dev.py demo` starts this file in an environment that has bpy, and `contact_sheet.py` after it:

    python -m tools.demo.demo FOLDER
"""

from __future__ import annotations

import math
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from tools.demo import demo_scene
from tools.run.run_command_line import load_extension

if TYPE_CHECKING:
    from rough_spectra.addon.readings.document import Readings

SIGMAS = (0, 15, 30, 45)
"""Degrees."""
LIMIT = 0.05
"""ΔE00 that no material whose color Cycles can hold may exceed."""

BLEND = "rough-spectra-demo.blend"
READINGS = "readings"
PICTURE = "demo-scene.png"


def main(folder: Path) -> int:
    """Make everything but the contact sheet; returns the exit status."""
    extension = load_extension()
    extension.register()
    say("Rough Spectra demo: 24 ColorChecker presets at σ = 0°, 15°, 30° and 45°")
    try:
        blend, strips = materials(folder)
        result = bake(folder, [material for _, row in strips for material in row])
        status = check(blend, result)
        picture(folder)
        return status
    finally:
        extension.unregister()  # the bpy module of 4.5 crashes at exit over what is left registered


def materials(folder: Path) -> tuple[Path, list[tuple[str, list[Any]]]]:
    """Assign every preset at every roughness, build the scene and save it."""
    from rough_spectra.addon.blender import blend_file
    from rough_spectra.addon.matching.solve import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import presets

    start = time.monotonic()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    pairs: list[tuple[Any, Request]] = []
    strips: list[tuple[str, list[Any]]] = []
    for sample in presets.load_all("colorchecker"):
        label = sample.name.removeprefix("ColorChecker ").partition(" (")[0].lower()
        row = [bpy.data.materials.new(f"{label} {degrees}°") for degrees in SIGMAS]
        requests = [Request(sample, math.radians(degrees)) for degrees in SIGMAS]
        pairs += zip(row, requests, strict=True)
        strips.append((label, row))
    solutions = derive.assign(pairs, keep_gloss=False)
    say(f"1/4  assigned {len(solutions)} materials in {time.monotonic() - start:.1f} s")
    demo_scene.build(
        strips,
        [f"{'σ = ' if degrees == 0 else ''}{degrees}°" for degrees in SIGMAS],
        "The same 24 albedos at four roughnesses σ: the rougher, the darker face on and the "
        "flatter to the rim.",
    )
    with demo_scene.quiet():
        return blend_file.save(folder / BLEND), strips


def bake(folder: Path, chosen: list[Any]) -> Readings:
    """Predict and measure all readings and write them."""
    from rough_spectra.addon.commands.progress import ProgressLine
    from rough_spectra.addon.instrument import bake as readings
    from rough_spectra.addon.readings import writers

    start = time.monotonic()
    progress = ProgressLine("     measuring")
    try:
        result = readings.bake([("", material) for material in chosen], progress=progress)
    finally:
        progress.close()
    written = writers.write(result, folder / READINGS)
    say(
        f"2/4  predicted and measured {len(result.entries)} readings in "
        f"{time.monotonic() - start:.1f} s, {len(written)} files"
    )
    return result


def check(blend: Path, result: Readings) -> int:
    """Measure the saved file again with the verb `check`; returns its exit status."""
    from rough_spectra.addon.commands import command_line

    start = time.monotonic()
    warned = [entry for entry in result.entries if entry.warnings]
    sound = [entry.material for entry in result.entries if not entry.warnings]
    words = ["check", "--blend", str(blend), "--max-delta-e", str(LIMIT)]
    for name in sound:
        words += ["--material", name]
    with demo_scene.quiet():
        status = command_line.main(words)
    outcome = "passed" if status == 0 else f"failed with exit status {status}"
    say(
        f"3/4  measured the saved file again: {len(sound)} materials {outcome} with the limit "
        f"ΔE00 {LIMIT}, in {time.monotonic() - start:.1f} s"
    )
    for entry in warned:
        say(f"     left out: {entry.material}, ΔE00 {entry.delta_e_00:.2f}: {entry.warnings[0]}")
    return status


def picture(folder: Path) -> None:
    """Render the scene of the open file."""
    from rough_spectra.addon.support import atomic_files

    start = time.monotonic()
    say(f"4/4  rendering {demo_scene.WIDTH} x {demo_scene.HEIGHT} in Cycles on the CPU")
    with atomic_files.publication() as files:
        demo_scene.render(bpy.context.scene, files.stage(folder / PICTURE))
    say(f"     rendered in {time.monotonic() - start:.1f} s")


def say(sentence: str) -> None:
    """Tell the user what is going on."""
    print(sentence, flush=True)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
