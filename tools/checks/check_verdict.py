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
HEAD = (
    "| scene | RGB, by the verdict | by 12 passes | recommended | predicted | found | seconds |\n"
    "|---|---|---|---|---|---|---|\n"
)


def truth(scene: Any, bands: int, samples: int, percentage: int, compare: bool) -> Any:
    """Render a spectral picture with little noise."""
    from rough_spectra.addon import api

    return api.spectral_picture(
        scene, bands=bands, samples=samples, percentage=percentage, compare=compare
    )


def off(shown: Any, whole: Any, white: Any) -> float:
    """ΔE00 at 95 % of the pixels, XYZ each."""
    from rough_spectra.core.color import color_difference

    labs = (color_difference.xyz_to_lab(each, white) for each in (shown, whole))
    return float(np.quantile(color_difference.delta_e(*labs), 0.95))


def found(scene: Any, verdict: Any, whole: Any, samples: int, percentage: int) -> float:
    """Do what is recommended, and see how far it is off."""
    from rough_spectra.addon import api
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.picture import colors, passes
    from rough_spectra.addon.picture import verdict as verdicts
    from rough_spectra.addon.scene import analysis, follow_scene

    rung = verdict.chosen
    depsgraph = bpy.context.evaluated_depsgraph_get()
    space = working_space.current()
    white = passes.lamps_of(colors.find(depsgraph, scene, space), space).white
    if rung.kind == "passes":
        bands = 3 * rung.renders
        return off(truth(scene, bands, samples, percentage, False).xyz, whole.xyz, white)
    if "space" in rung.kind:
        bpy.ops.wm.set_working_color_space(convert_colors=True, working_space=verdicts.WIDE)
        space = working_space.current()
        api.renew(api.materials())
    if "lights" in rung.kind:
        depsgraph = bpy.context.evaluated_depsgraph_get()
        follow_scene.follow(analysis.analyze(depsgraph, scene))
    plain = truth(scene, 3, samples, percentage, True).comparison.plain[..., :3]
    return off(plain @ np.linalg.inv(space.from_xyz).T, whole.xyz, white)


def seconds() -> float:
    """Give processor time of this Blender and of those that have ended."""
    return sum(
        sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )


def row(name: str, options: argparse.Namespace) -> tuple[str, bool]:
    """Give the line of a scene, and whether the verdict is right."""
    from rough_spectra.addon import api

    scene = demo_scenes.build(name)
    # What is compared must not be noise: no path ends by its color.
    scene.cycles.min_light_bounces = scene.cycles.max_bounces
    start = seconds()
    verdict = api.picture_verdict(scene)
    took = (seconds() - start) / (os.cpu_count() or 1)
    more = options.samples, options.percentage
    whole = truth(scene, TRUTH, *more, True)
    rgb, really = verdict.rungs[0].usual, whole.comparison.usual
    right = (rgb <= verdict.tolerance) == (really <= verdict.tolerance)
    cells = ["", "", ""]
    if verdict.chosen is not None:
        cells[:2] = verdict.chosen.words, f"{verdict.chosen.usual:.2f}"
        if verdict.chosen is not verdict.rungs[0]:
            done = found(scene, verdict, whole, *more)
            cells[2] = f"{done:.2f}"
            right &= done <= verdict.tolerance
        else:
            cells[2] = f"{really:.2f}"
    line = f"| {name} | {rgb:.2f} | {really:.2f} | {' | '.join(cells)} | {took:.0f} |\n"
    return line, right


def main() -> None:
    """Print the table, and write it if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--percentage", type=int, default=25)
    parser.add_argument("--scene", action="append", choices=demo_scenes.SCENES)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    extension = load_extension()
    extension.register()
    text, wrong = HEAD, []
    for name in options.scene or demo_scenes.SCENES:
        line, right = row(name, options)
        text += line
        wrong += [] if right else [name]
        print(line, end="", flush=True)
    if options.write:
        TABLE.write_text(text, encoding="utf-8")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.unregister()
    if wrong:
        raise SystemExit(f"wrong verdicts: {', '.join(wrong)}")


if __name__ == "__main__":
    main()
