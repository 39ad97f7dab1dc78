# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ask a second Blender to measure spots on surfaces, and say what it found in plain sentences.

The scene is written to a file of its own with all that it depends on, and `spot_worker` measures
there. The open file is not touched.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.color import color_difference
from ...core.errors import MaterialError
from ...core.numerics.arrays import Array
from ..blender.background_job import Job, waited
from ..matching import scene_match
from ..readings.document import SpotRead
from . import unseen
from .arrangement import Arrangement, told
from .spot import Key, Spot, key

WHOLE = 0.995
"""Share of the spot from which on nothing is said of the rest."""
HALF = 0.5
"""Share that has to be there, as in the worker."""
TOLD = 0.1
"""ΔE00 from which on curvature and noise are told."""
RAISED = 0.5
"""Diameters by which the surface may lie off the place that was asked for."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What one instrument saw of one spot.

    Parameters
    ----------
    halves
        Scene-linear RGB with two sets of random numbers, shape (2, rows, columns, 3).
    weights
        How much each pixel counts, shape (rows, columns).
    """

    halves: Array
    weights: Array

    def mean(self) -> Array:
        """Give the reading, shape (3,)."""
        return self._mean(self.halves.mean(axis=0))

    def deviation(self) -> Array:
        """Give the standard deviation over the spot without the noise, shape (3,)."""
        one, two = self.halves - self.mean()
        # Noise of two pictures has nothing in common.
        return np.asarray(np.sqrt(np.maximum(self._mean(one * two), 0)))

    def spread(self, to_lab: Callable[[Array], Array]) -> tuple[float, float, float]:
        """ΔE00 from the reading over the spot, mean and 95th percentile, and noise of the reading.

        Noise of single pixels is taken out in the mean of squares; both are shortened by as much.
        """
        within = self.weights > 0
        weights, pixels = self.weights[within], self.halves[:, within]
        middle = to_lab(self.mean())
        apart, by_chance = (
            color_difference.delta_e(to_lab(np.maximum(values, 0)), middle)
            for values in (pixels.mean(axis=0), self.mean() + (pixels[0] - pixels[1]) / 2)
        )
        squares = float(weights @ apart**2)
        left = max(0.0, squares - float(weights @ by_chance**2)) / squares if squares > 0 else 0.0
        apart = apart * math.sqrt(left)
        mean = float(weights @ apart / weights.sum())
        beyond = float(scene_match.percentile(apart, weights, 0.95))
        noise = float(weights @ by_chance**2 / weights.sum())
        return mean, beyond, math.sqrt(noise / len(weights))

    def _mean(self, pixels: Array) -> Array:
        return np.asarray(np.einsum("ij,ijk->k", self.weights, pixels) / self.weights.sum())


class SpotMeasurement(Job):
    """Spots under measurement in a second Blender.

    Parameters
    ----------
    spots
        Of the open scene, which is measured as it is now.
    arrangements
        Of each spot, the renders of each of its instruments.

    Raises
    ------
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing = "measures the surface"
    interrupted = "Measuring was interrupted; nothing was written."
    smaller = "hide what is not needed from renders, or measure fewer spots at once"

    def __init__(
        self, spots: Sequence[Spot], arrangements: Sequence[Sequence[Arrangement]]
    ) -> None:
        self._spots = list(spots)
        self._unseen = [_unseen(spot.thing) for spot in spots]
        self._counts = [len(each) for each in arrangements]
        scene, view_layer = bpy.context.scene, bpy.context.view_layer

        def prepare(folder: Path) -> dict[str, Any]:
            blend = folder / "scene.blend"
            for thing in {_object(spot.thing) for spot in spots}:
                if thing.mode == "EDIT":
                    thing.update_from_editmode()
            bpy.data.libraries.write(
                str(blend), {scene}, fake_user=True, path_remap="ABSOLUTE", compress=False
            )
            pairs = zip(spots, arrangements, strict=True)
            return {
                "blend": blend.name,
                "scene": scene.name,
                "view_layer": view_layer.name,
                "spots": [_asked(spot, each) for spot, each in pairs],
            }

        super().__init__(Path(__file__).with_name("spot_worker.py"), prepare)

    def result(self) -> list[SpotResult]:
        """Give what was found of each spot, once `poll` says that it has ended.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        told = json.loads(self.output("spots.json").read_text(encoding="utf-8"))
        found = []
        with np.load(self.output("pictures.npz")) as pictures:
            for number, (spot, each) in enumerate(zip(self._spots, told, strict=True)):
                seen = [
                    Seen(
                        *(np.asarray(pictures[f"{number} {place} {of}"]) for of in ("halves", "in"))
                    )
                    if f"{number} {place} in" in pictures
                    else None
                    for place in range(self._counts[number])
                ]
                found.append(SpotResult(spot, each, seen, self._unseen[number]))
        return found


@dataclass(frozen=True, eq=False)
class SpotResult:
    """What was found of one spot.

    Parameters
    ----------
    spot
        That was asked for.
    found
        What `spot_worker.put_down` tells.
    seen
        By each instrument; None where too little of the object is there.
    unseen
        What of its materials cannot be read right, as sentences.
    """

    spot: Spot
    found: dict[str, Any]
    seen: list[Seen | None]
    unseen: tuple[str, ...] = ()

    @property
    def fault(self) -> str:
        """Say why nothing could be measured; empty if something was."""
        name, size = self.spot.thing[0], f"{self.spot.diameter:g} mm"
        if self.found["is_moved"]:
            return (
                f"Object {name!r} stands elsewhere when it is rendered: apply or bake its physics, "
                "and what Python moves."
            )
        if self.found["covered"] < HALF:
            return (
                f"Object {name!r} fills {self.found['covered']:.0%} of a spot of {size} there, and "
                "half is the least; choose a smaller spot or another place."
            )
        if all(seen is None or not seen.weights.any() for seen in self.seen):
            return (
                f"Object {name!r} has no even piece within a spot of {size}: an instrument sees "
                "only edges of it there; choose another place or size."
            )
        return ""

    def values(self, number: int) -> Array:
        """Mean and standard deviation of RGB by one of its instruments, shape (2, 3); or NaN."""
        seen = self.seen[number]
        if self.fault or seen is None or not seen.weights.any():
            return np.full((2, 3), np.nan)
        return np.stack((seen.mean(), seen.deviation()))

    def read(self, number: int, to_lab: Callable[[Array], Array]) -> SpotRead:
        """Tell how one of its instruments read it.

        Parameters
        ----------
        number
            Of the instrument.
        to_lab
            From scene-linear RGB, shape (..., 3).
        """
        seen, found = self.seen[number], self.found
        mean = beyond = noise = None
        if not self.fault and seen is not None and seen.weights.any():
            mean, beyond, noise = (round(value, 4) for value in seen.spread(to_lab))
        x, y, z = (
            tuple(round(v, 6) + 0.0 for v in found[k]) for k in ("point", "normal", "toward")
        )
        alone = self.spot.is_alone
        return SpotRead(
            self.spot.diameter, x, y, z, alone, round(found["covered"], 4), mean, beyond, noise
        )

    def warnings(self, number: int, to_lab: Callable[[Array], Array]) -> tuple[str, ...]:
        """Say what should be known of a reading; `to_lab` as of `read`."""
        seen, found, spot = self.seen[number], self.found, self.spot
        if self.fault or seen is None:
            return ()
        told = []
        if found["covered"] < WHOLE:
            told.append(f"fills {found['covered']:.0%} of the spot; the rest is not counted")
        if found["own"] < WHOLE:
            told.append(f"other materials fill {1 - found['own']:.0%} of what is read")
        turned, rgb = math.degrees(found["bend"][1]), seen.mean()
        bent = color_difference.delta_e(to_lab(rgb), to_lab(rgb / found["bend"][0]))
        if bent >= TOLD:
            told.append(
                f"the surface turns by {turned:.0f}° to the edge of the spot, which is worth ΔE00 "
                f"{float(bent):.1f} if it is matte; take a smaller spot"
            )
        if abs(found["height"]) > RAISED * spot.units:
            off = found["height"] / spot.units * spot.diameter
            told.append(
                f"what is seen lies {off:.1f} mm off the place asked for: by displacement, by what "
                "a modifier does in renders alone, or because it is covered"
            )
        *_, noise = seen.spread(to_lab)
        if noise >= TOLD:
            told.append(f"noise of light between surfaces is ΔE00 {noise:.1f}")
        if not rgb.any():
            told.append("nothing came back: it is black, or shut off from the instrument's light")
        return (*told, *self.unseen)


def measure(
    spots: Sequence[Spot],
    arrangements: Sequence[Sequence[Arrangement]],
    progress: Callable[[int, int], None] | None = None,
) -> list[SpotResult]:
    """Measure spots and wait for the result.

    Parameters
    ----------
    spots, arrangements
        As of `SpotMeasurement`.
    progress
        Called with renders done and renders in all; may raise to stop.

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    with waited(SpotMeasurement(spots, arrangements), progress) as measurement:
        return measurement.result()


def _asked(spot: Spot, arrangements: Sequence[Arrangement]) -> dict[str, Any]:
    """Tell a spot to the second Blender."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    matrix = _object(spot.carrier).evaluated_get(depsgraph).matrix_world
    return {
        "object": spot.thing,
        "carrier": spot.carrier,
        "matrix": [list(row) for row in matrix],
        "neighbors": not spot.is_alone,
        "material": key(spot.material),
        "point": spot.point,
        "normal": spot.normal,
        "toward": spot.toward,
        "diameter": spot.units,
        "geometries": [told(each, 1)["shots"] for each in arrangements],
    }


def _object(of: Key) -> Any:
    """Give the object of a name and a library's path."""
    for thing in bpy.data.objects:
        if key(thing) == of:
            return thing
    raise MaterialError(f"There is no object {of[0]!r} any more; choose the place again.")


def _unseen(of: Key) -> tuple[str, ...]:
    """Say what of an object's materials is not read right."""
    materials = [slot.material for slot in _object(of).material_slots if slot.material is not None]
    told = [sentence for each in materials for sentence in unseen.on_objects(each)]
    return tuple(dict.fromkeys(told))
