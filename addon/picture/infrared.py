# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a camera sees that lets infrared light through, of lamps: a picture in gray or false color.

The band of the camera is split in parts, three for each render of a spectral picture's passes. In a
part a lamp sends its mean, and a surface reflects its mean under all lamps together: what light of
one spectrum meets first is exact. The heat that surfaces send of themselves is `thermal`'s.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ...core.numerics.arrays import Array
from ..blender import working_space
from ..blender.background_job import Job, waited
from . import find_colors, scene_copy
from .infrared_scene import InfraredScene
from .infrared_wanted import IN_A_RENDER, Wanted


@dataclass(frozen=True, eq=False)
class InfraredPicture:
    """What the camera sees, from the bottom up.

    Radiance is the mean per nanometer of what gets through, in the scene's units: 1 has as much of
    it as light of even power per nanometer, a luminance of 1 and the same in the infrared.

    Parameters
    ----------
    ends
        Of the band, nanometers.
    parts
        Radiance in the parts of the band, from the shortest, shape (rows, columns, parts); their
        mean is that of the band.
    alpha
        Shape (rows, columns).
    told
        By the names of materials, lamps and worlds, what they are there.
    assumed
        By name, why nothing is known of a material there: it is as bright as to the eye.
    dark
        By name, why a lamp sends nothing there.
    seconds
        Of each render.
    """

    ends: tuple[float, float]
    parts: Array
    alpha: Array
    told: Mapping[str, str]
    assumed: Mapping[str, str]
    dark: Mapping[str, str]
    seconds: tuple[float, ...]

    @property
    def gray(self) -> Array:
        """Radiance in the band, shape (rows, columns)."""
        return np.asarray(self.parts.mean(axis=-1))

    @property
    def false_color(self) -> Array:
        """Radiance in its thirds, the longest wavelengths as red, shape (rows, columns, 3)."""
        thirds = self.parts.reshape(*self.parts.shape[:2], 3, -1).mean(axis=-1)
        return np.asarray(thirds[..., ::-1])


class Infrared(Job):
    """An infrared picture under way.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`, as it is now.
    wanted
        What is asked for.

    Raises
    ------
    MaterialError
        If the scene has no camera or another engine than Cycles, nothing is known to shine in the
        band, or a name is nobody's.
    DomainError, InputError
        If a light is none that is known.
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing = "renders the infrared"
    interrupted = "The infrared picture was interrupted; nothing was written."
    smaller = "render a smaller picture"

    def __init__(self, scene: Any, wanted: Wanted) -> None:
        scene_copy.check(scene, "an infrared picture", wanted.percentage)
        layer = scene_copy.layer_of(scene)
        space = working_space.current()
        found = find_colors.find(scene_copy.evaluated(scene, layer), scene, space, is_visible=False)
        self._wanted = wanted
        self._there = InfraredScene(found, space, wanted)
        renders = wanted.parts // IN_A_RENDER

        def prepare(folder: Path) -> dict[str, Any]:
            return {
                **scene_copy.save(folder, scene, layer, wanted.samples, wanted.percentage),
                "plain": False,
                "apart": False,
                "steady": False,
                "passes": renders,
                "direct": [False] * renders,
                "edits": self._there.edits,
                "untranslated": [],
                "reset": [
                    {"of": list(place.of), "attribute": place.attribute, "value": value}
                    for place, value in found.reset
                ],
            }

        super().__init__(Path(__file__).with_name("worker.py"), prepare)
        self.total = renders

    def result(self) -> InfraredPicture:
        """Put the renders together, once `poll` says that they are done.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        seconds = json.loads(self.output("seconds.json").read_text(encoding="utf-8"))
        renders = range(self._wanted.parts // IN_A_RENDER)
        pixels = [np.load(self.output(f"pass-{n}.npy")).astype(np.float64) for n in renders]
        return InfraredPicture(
            self._wanted.ends,
            np.concatenate([each[..., :3] for each in pixels], axis=-1),
            pixels[0][..., 3],
            self._there.told,
            self._there.assumed,
            self._there.dark,
            tuple(clock for clock, _ in seconds),
        )


def render(
    scene: Any, wanted: Wanted, progress: Callable[[int, int], None] | None = None
) -> InfraredPicture:
    """Render an infrared picture and wait for it; see `Infrared`."""
    with waited(Infrared(scene, wanted), progress) as job:
        return job.result()
