# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Adjust one color of a material until what is measured is what its sample reads.

For whatever is not one plain Diffuse or Principled BSDF, so that no formula tells what it reads:
mixes, groups, sheen, layers, bump. What formulas can do stays formula.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ...core.errors import MaterialError
from ..blender import colors, second_blender, shader_nodes, working_space
from ..blender.background_job import waited
from ..matching import color_search, solve
from ..matching.color_search import MEASUREMENTS, Found
from ..material import last_measurement, measured_match
from . import arrangement, unseen
from .measure import SAMPLES, Measurement

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from ..blender.colors import Place
    from ..matching.request import Request


class Adjustment:
    """A search under way: one measurement after the other, all of them in one second Blender.

    To whoever waits it is a `Job`: it has `total` and `done`, `poll`, `wait`, `close` and
    `when_closed`. The material itself is not touched; `found` says what color it is to get.

    Parameters
    ----------
    material
        A `bpy.types.Material` of this file.
    request
        What it is to read.
    place
        Its color, of `colors.places`.
    samples
        Rays a pixel, as in `measure.Measurement`.

    Raises
    ------
    RoughSpectraError
        If the sample has no color, or the second Blender cannot be started.
    """

    def __init__(
        self, material: Any, request: Request, place: Place, samples: int = SAMPLES
    ) -> None:
        self.total = MEASUREMENTS
        self.done = 0
        self.request, self.place = request, place
        self.found: Found | None = None
        # A pointer to a material does not survive an undo while the search runs.
        self._uid, self._samples = material.session_uid, samples
        self._before = last_measurement.fingerprint(material)
        self._traces = ExitStack()
        self._job: Measurement | None = None
        space = working_space.current()
        [(settled, _)] = solve.settle([request])
        reading = solve.target_reading(settled)
        self.target = reading @ space.rgb_weights(settled.sample.wavelengths, request.illuminant)
        start = np.array(colors.get(material, place))
        self._search = color_search.search(
            self.target, start, lambda rgb: space.to_lab(rgb, request.illuminant)
        )
        with ExitStack() as undone:
            undone.enter_context(second_blender.kept())
            self._measure(next(self._search))
            self._traces = undone.pop_all()

    def material(self) -> Any:
        """Give the material as it is now.

        Raises
        ------
        MaterialError
            If it is gone, or was changed since.
        """
        for material in bpy.data.materials:
            if material.session_uid == self._uid:
                if last_measurement.fingerprint(material) != self._before:
                    msg = (
                        f"Material {material.name!r} was changed while it was measured; nothing "
                        "was written: start again."
                    )
                    raise MaterialError(msg)
                return material
        msg = "The material was removed while it was measured; nothing was written."
        raise MaterialError(msg)

    def poll(self) -> bool:
        """Take a measurement that has ended, and begin the next; returns whether all is done.

        Raises
        ------
        RoughSpectraError
            If a measurement failed, or the material was changed meanwhile.
        """
        if self._job is None:
            return True
        if not self._job.poll():
            return False
        values = self._job.result()[0, :, 0]
        self._job.close()
        self._job = None
        self.done += 1
        try:
            following = self._search.send(values)
        except StopIteration as end:
            self.found = end.value
            self.total = self.done
            return True
        self._measure(following)
        return False

    def wait(self, progress: Callable[[int, int], None] | None = None) -> None:
        """Wait for the end.

        Raises
        ------
        CancelledError
            On an interrupt from the keyboard.
        RoughSpectraError
            As in `poll`.
        """
        while not self.poll():
            if self._job is not None:
                self._job.wait()
            if progress is not None:
                progress(self.done, self.total)

    def when_closed(self, act: Callable[[], None]) -> None:
        """Call a function once the search is closed, whoever closes it."""
        self._traces.callback(act)

    def close(self) -> None:
        """Stop what still runs, and leave nothing behind."""
        if self._job is not None:
            self._job.close()
            self._job = None
        self._traces.close()

    def _measure(self, tried: Any) -> None:
        material, place = self.material(), self.place
        wanted = [
            (place.node, place.side, place.number, (float(red), float(green), float(blue)))
            for red, green, blue in tried
        ]
        self._job = Measurement(
            [material] * len(wanted),
            (arrangement.of(self.request.read_at),),
            samples=self._samples,
            colors=wanted,
        )


@dataclass(frozen=True, eq=False)
class Adjusted:
    """What came of it.

    Attributes
    ----------
    color, reading, target
        Scene-linear RGB: the color that was set, what was measured with it, and the sample's
        reading; shape (3,).
    delta_e
        ΔE00 between these readings.
    is_met
        Whether that is as good as none.
    measurements
        How many there were.
    sentence
        All of it for a person.
    """

    color: Array
    reading: Array
    target: Array
    delta_e: float
    is_met: bool
    measurements: int
    sentence: str


def adjust(
    material: Any,
    request: Request,
    place: Place,
    progress: Callable[[int, int], None] | None = None,
) -> Adjusted:
    """Search, wait, and write what was found.

    Raises
    ------
    RoughSpectraError
        As `Adjustment` and `finish` do; nothing was changed then.
    """
    shader_nodes.refuse_read_only(material)
    with waited(Adjustment(material, request, place), progress) as adjustment:
        return finish(adjustment)


def finish(adjustment: Adjustment) -> Adjusted:
    """Write what a search found into its material.

    Raises
    ------
    MaterialError
        If the material is gone, was changed since, or the color has no say.
    """
    material, found = adjustment.material(), adjustment.found
    assert found is not None
    sentence = told(adjustment, material.name)
    if not found.has_say:
        raise MaterialError(sentence)
    unlike = unseen.on_flat_samples(material)
    measured_match.write(material, adjustment.request, adjustment.place, found, unlike)
    return Adjusted(
        found.color,
        found.reading,
        adjustment.target,
        found.difference,
        found.is_met,
        found.measurements,
        "; ".join((sentence.removesuffix("."), *unlike)) if unlike else sentence,
    )


def told(adjustment: Adjustment, name: str) -> str:
    """Say in one sentence what a search came to.

    Parameters
    ----------
    adjustment
        One that has ended.
    name
        Of the material.
    """
    found, place = adjustment.found, adjustment.place
    assert found is not None
    measured = "1 measurement" if found.measurements == 1 else f"{found.measurements} measurements"
    begin = f"{name}, {place.name}: ΔE00 {found.difference:.2f} after {measured}"
    if found.is_met:
        return begin
    if not found.has_say:
        return (
            f"{begin}; this color does not change what is read, and nothing was written: choose "
            "another one."
        )
    low = np.minimum(found.darkest, found.brightest)
    high = np.maximum(found.darkest, found.brightest)
    beyond = [
        f"{channel} {wanted:.3f} is wanted, and {least:.3f} to {most:.3f} can be had"
        for channel, wanted, least, most in zip(
            ("red", "green", "blue"), adjustment.target, low, high, strict=True
        )
        if not least <= wanted <= most
    ]
    if beyond:
        return f"{begin}; {'; '.join(beyond)}."
    return f"{begin}; no color comes closer in {MEASUREMENTS} measurements."
