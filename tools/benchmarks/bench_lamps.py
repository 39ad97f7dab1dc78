# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Cycles' light tree does for spectral pictures, by the number of lamps.

    .venv/bpy-5.2/bin/python -m tools.benchmarks.bench_lamps

A room of ColorChecker patches with lamps of many colors all over it, rendered with and without the
tree, which picks lamps by what they send. Noise is what two pictures of other random numbers differ
by, over √2, in blocks of pixels; "RGB off" is the mean of the map, with these samples and with many
more: where it is larger with few, renders of one picture don't follow the same paths. Seconds are
the processor's, of a render.
"""

from __future__ import annotations

import argparse
import random
import sys
from typing import Any

import bpy
import numpy as np

from tools.checks import check_spectral as room
from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon import api
from rough_spectra.core.color import color_difference

COUNTS = (3, 8, 20, 60)
_BANDS, _MORE, _POWER = 6, 4, 60.0


def furnish(count: int) -> Any:
    """Make the room, with small colored lamps in place of the one in its ceiling."""
    scene = room.build()
    bpy.data.materials["Lamp"].node_tree.nodes["Emission"].inputs["Strength"].default_value = 0
    chance = random.Random(7)
    for number in range(count):
        light = bpy.data.lights.new(f"Lamp {number}", "POINT")
        light.energy, light.shadow_soft_size = _POWER / count, 0.03
        light.color = [chance.uniform(0.05, 1.0) for _ in range(3)]
        thing = bpy.data.objects.new(light.name, light)
        low = (-1.9, -1.9, 0.2), (1.9, 1.9, 2.9)
        thing.location = [chance.uniform(*ends) for ends in zip(*low, strict=True)]
        scene.collection.objects.link(thing)
    return scene


def pictures(scene: Any, samples: int) -> tuple[float, float, float]:
    """Noise, how far RGB is off, and seconds of a render."""
    found: list[Any] = []
    for seed in (1, 2):
        scene.cycles.seed = seed
        found.append(api.spectral_picture(scene, bands=_BANDS, samples=samples))
    blocks = [room.blocks(each.xyz) for each in found]
    seen = blocks[0][..., 1] < 2 * np.median(blocks[0][..., 1])
    white = found[0].white
    assert white is not None, "a scene with lamps has a white"
    labs = (color_difference.xyz_to_lab(each, white) for each in blocks)
    noise = color_difference.delta_e(*labs)[seen].mean() / np.sqrt(2)
    off = np.mean([each.comparison.delta_e.mean() for each in found if each.comparison])
    seconds = np.mean([each.processor_seconds[1:] for each in found])
    return float(noise), float(off), float(seconds)


def main() -> None:
    """Print a line for each number of lamps, with the tree and without."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--lamps", type=int, action="append")
    options = parser.parse_args()
    sys.modules["rough_spectra"].register()
    print("lamps  tree  noise  RGB off  with more  seconds")
    for count in options.lamps or COUNTS:
        for tree in (True, False):
            scene = furnish(count)
            scene.cycles.use_light_tree = tree
            noise, off, seconds = pictures(scene, options.samples)
            _, truly, _ = pictures(scene, options.samples * _MORE)
            told = "yes" if tree else "no"
            line = f"{count:5}  {told:4}  {noise:5.2f}  {off:7.2f}  {truly:9.2f}  {seconds:7.2f}"
            print(line, flush=True)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    sys.modules["rough_spectra"].unregister()


if __name__ == "__main__":
    main()
