# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ask a second Blender to measure materials, without touching anything in this one.

A render in this Blender would add datablocks, replace the last Render Result and block the
window. The materials are written to a file of their own, and `worker` measures them there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.numerics.arrays import Array
from ..blender.background_job import Job, waited
from .arrangement import Arrangement, Shot, told

SAMPLES = 16
"""Rays a pixel unless told otherwise: with 16 pixels a sample, 256 places on a texture."""
RAYS = 4096
"""Those into a glowing hemisphere, over all views; there Cycles estimates."""


Colored = tuple[str, str, int, tuple[float, float, float]] | None
"""Node, side and number of a socket, as `addon.blender.colors` has them, and scene-linear RGB."""


@dataclass(frozen=True)
class Geometry:
    """Lights and view of one measurement.

    Parameters
    ----------
    lights
        Polar angle and azimuth of each light, radians; they share the irradiance equally.
    view
        Polar angle of the view, radians below π/2; its azimuth is 0.
    """

    lights: tuple[tuple[float, float], ...]
    view: float

    @property
    def arrangement(self) -> Arrangement:
        """Its renders, one a light."""
        return Arrangement(tuple(Shot(light, self.view) for light in self.lights))


RING_45_0 = Geometry(tuple((math.pi / 4, 2 * math.pi * k / 8) for k in range(8)), 0.0)
"""45°a:0°: eight lights around the sample at 45°, view along the normal."""


class Measurement(Job):
    """A measurement under way in a second Blender.

    Parameters
    ----------
    materials
        `bpy.types.Material`, linked ones too; each is measured as it is now.
    geometries
        Where to measure.
    samples
        Rays a pixel. One is exact for an even material; textures and bumps need more.
    rays
        Rays a pixel where it is a hemisphere that glows.
    colors
        For each material a color to measure it with instead of its own, or None; the material
        itself is not touched.

    Raises
    ------
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing = "measures"
    interrupted = "Measuring was interrupted; nothing was written."
    smaller = "measure fewer materials at once"

    def __init__(
        self,
        materials: Sequence[Any],
        geometries: Sequence[Geometry | Arrangement],
        samples: int = SAMPLES,
        rays: int = RAYS,
        colors: Sequence[Colored] = (),
    ) -> None:
        arrangements = [g.arrangement if isinstance(g, Geometry) else g for g in geometries]

        def prepare(folder: Path) -> dict[str, Any]:
            blend = folder / "materials.blend"
            # Blender leaves linked data out unless local data use it: the worker links it anew.
            local = {material for material in materials if material.library is None}
            bpy.data.libraries.write(
                str(blend), local, fake_user=True, path_remap="ABSOLUTE", compress=False
            )
            return {
                "blend": blend.name,
                "samples": samples,
                "materials": [[m.name, _library_path(m)] for m in materials],
                "rays": rays,
                "geometries": [told(each, len(materials)) for each in arrangements],
                "colors": list(colors),
            }

        super().__init__(Path(__file__).with_name("worker.py"), prepare)

    def result(self) -> Array:
        """Give what was measured, once `poll` says that it has ended.

        Returns
        -------
        Shape (geometries, materials, 2, 3): mean and standard deviation over the sample's area of
        the reflectance factor in scene-linear RGB. NaN for materials that are no members of an
        arrangement.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        return np.asarray(np.load(self.output("result.npy")))


def measure(
    materials: Sequence[Any],
    geometries: Sequence[Geometry | Arrangement] = (RING_45_0,),
    progress: Callable[[int, int], None] | None = None,
    samples: int = SAMPLES,
    rays: int = RAYS,
) -> Array:
    """Measure materials and wait for the result.

    Parameters
    ----------
    materials, geometries, samples, rays
        As in `Measurement`.
    progress
        Called with renders done and renders in all; may raise to stop.

    Returns
    -------
    Shape (geometries, materials, 2, 3), as in `Measurement.result`.

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    if not materials:
        return np.empty((len(geometries), 0, 2, 3))
    with waited(Measurement(materials, geometries, samples, rays), progress) as measurement:
        return measurement.result()


def _library_path(material: Any) -> str | None:
    if material.library is None:
        return None
    return bpy.path.abspath(material.library.filepath)
