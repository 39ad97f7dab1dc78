# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hold verdicts on scenes such as people render to pictures of 36 bands in 12 passes.

    .venv/bpy-5.2/bin/python -m tools.checks.check_verdict --write

For each of `demo_scenes`: the verdict, what RGB really is off by, and what the rung that it
recommends is, done as a user would: the working space switched, the materials matched, the bands
rendered. Seconds are of the processor, over all cores that it has. --write puts the table into
docs/verdict-table.md.
"""

from __future__ import annotations

import argparse
import os
import resource
from typing import Any

import bpy
import numpy as np

from tools.checks import demo_scenes
from tools.run.run_command_line import ROOT, load_extension

TABLE = ROOT / "docs" / "verdict-table.md"
TRUTH = 36
BLOCK = 3
HEAD = (
    "| scene | RGB, by the verdict | by 12 passes | recommended | predicted | found | seconds |\n"
    "|---|---|---|---|---|---|---|\n"
)


def truth(scene: Any, bands: int, samples: int, percentage: int) -> Any:
    """Render a spectral picture and the ordinary one, on the same paths of light."""
    from rough_spectra.addon.picture import render

    wanted = render.Wanted(bands=bands, samples=samples, percentage=percentage, steady=True)
    return render.render(scene, wanted)


def off(shown: Any, whole: Any, white: Any) -> float:
    """ΔE00 at 95 % of blocks of pixels, XYZ each."""
    from rough_spectra.core.color import color_difference

    labs = (color_difference.xyz_to_lab(blocks(each), white) for each in (shown, whole))
    return float(np.quantile(color_difference.delta_e(*labs), 0.95))


def blocks(pixels: Any) -> Any:
    """Mean over blocks of `BLOCK` × `BLOCK` pixels."""
    rows, columns = (each // BLOCK for each in pixels.shape[:2])
    cut = pixels[: rows * BLOCK, : columns * BLOCK]
    return cut.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))


def plain_xyz(picture: Any) -> Any:
    """XYZ of the ordinary picture, in the working space that the file has now."""
    from rough_spectra.addon.blender import working_space

    to_xyz = np.linalg.inv(working_space.current().from_xyz)
    return picture.comparison.plain[..., :3] @ to_xyz.T


def white_of(scene: Any) -> Any:
    """XYZ of white under the scene's light."""
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.picture import find_colors, passes

    space = working_space.current()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return passes.lamps_of(find_colors.find(depsgraph, scene, space), space).white


def done(scene: Any, rung: Any, samples: int, percentage: int) -> Any:
    """Do what is recommended, and give XYZ of what comes of it."""
    from rough_spectra.addon import api
    from rough_spectra.addon.picture import verdict as verdicts
    from rough_spectra.addon.scene import analysis, follow_scene

    if rung.kind == "passes":
        return truth(scene, 3 * rung.renders, samples, percentage).xyz
    if "space" in rung.kind:
        bpy.ops.wm.set_working_color_space(convert_colors=True, working_space=verdicts.WIDE)
        api.renew(api.materials())
    if "lights" in rung.kind:
        depsgraph = bpy.context.evaluated_depsgraph_get()
        follow_scene.follow(analysis.analyze(depsgraph, scene))
    return plain_xyz(truth(scene, 3, samples, percentage))


def seconds() -> float:
    """Give processor time of this Blender and of those that have ended."""
    return sum(
        sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )


def row(name: str, options: argparse.Namespace) -> tuple[str, bool]:
    """Give the line of a scene, and whether the verdict is right."""
    from rough_spectra.addon import api

    scene = demo_scenes.build(name)
    start = seconds()
    verdict = api.picture_verdict(scene, percentage=options.verdict_percentage)
    took = (seconds() - start) / (os.cpu_count() or 1)
    more = options.samples, options.percentage
    whole, white = truth(scene, TRUTH, *more), white_of(scene)
    rgb, really = verdict.rungs[0].usual, off(plain_xyz(whole), whole.xyz, white)
    right = (rgb <= verdict.tolerance) == (really <= verdict.tolerance)
    words, predicted, came = "nothing", "", ""
    if verdict.chosen is not None:
        words, predicted = verdict.chosen.words, f"{verdict.chosen.usual:.2f}"
        found = really
        if not verdict.enough:
            found = off(done(scene, verdict.chosen, *more), whole.xyz, white)
        right &= found <= verdict.tolerance
        came = f"{found:.2f}"
    line = f"| {name} | {rgb:.2f} | {really:.2f} | {words} | {predicted} | {came} | {took:.0f} |\n"
    return line, right


def main() -> None:
    """Print the table, and write it if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--percentage", type=int, default=25)
    parser.add_argument("--verdict-percentage", type=int, help="of 480 × 270 pixels; 50")
    parser.add_argument("--scene", action="append", choices=demo_scenes.SCENES)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    extension = load_extension()
    extension.register()
    lines, wrong = {}, []
    if TABLE.exists():  # what is not asked for stays
        for line in TABLE.read_text(encoding="utf-8").splitlines(keepends=True)[2:]:
            lines[line.split("|")[1].strip()] = line
    for name in options.scene or demo_scenes.SCENES:
        line, right = row(name, options)
        lines[name] = line
        wrong += [] if right else [name]
        print(line, end="", flush=True)
        if options.write:
            kept = [lines[each] for each in demo_scenes.SCENES if each in lines]
            TABLE.write_text(HEAD + "".join(kept), encoding="utf-8")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.unregister()
    if wrong:
        raise SystemExit(f"wrong verdicts: {', '.join(wrong)}")


if __name__ == "__main__":
    main()
