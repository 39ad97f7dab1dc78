# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture whose lamps are set while the user watches: an image of the open file.

A step is counted in single precision in the layout of Blender's pixels, and with the sum of all
other lamps kept: what moves is one lamp. Nothing of it is stored with the file but the image, and
nothing of the scene changes.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.numerics.arrays import Array
from ..colorimetry import illuminant_spectra
from ..preview import icons
from ..scene import light_spectra
from ..support import events
from . import files, images
from .of_file import OfFile
from .relight import Lights

RELIT = "Relit"
"""Name of the image, unless another is called so."""
MOST_BYTES = 4_000_000_000
"""Memory that the lights of a picture may take."""

_AT_ONCE = 16384
"""Pixels that are added up at once: so few stay in a core's cache."""
_PRODUCTS = 4 * 65536
"""Products of a multiplication up to which OpenBLAS leaves it to one thread. Those of larger ones
wait for each other: where another program had the cores, a lamp took fifty times as long."""


class Relit:
    """Lights that were rendered apart, and what each is set to; lamps go by their number.

    Parameters
    ----------
    lights
        What was rendered.
    from_xyz
        To the working space in which it was, shape (3, 3).
    observer
        2 or 10 degrees, to begin with.
    """

    def __init__(self, lights: Lights, from_xyz: Array, observer: int = 2) -> None:
        self.lights, self.observer = lights, observer
        self.step_seconds = 0.0
        """What the last step took, with the pixels handed to Blender."""
        self._from_xyz, self._first_observer = from_xyz, observer
        self._base = np.zeros((lights.alpha.size, 4), np.float32)
        self._base[:, 3] = lights.alpha.ravel()
        self._moved = 0
        self._rest: Array | None = None
        """What all lamps but the one that moved last make."""
        self._shown = np.empty_like(self._base)
        count = len(lights.names)
        self.intensities = [1.0] * count
        self.chosen: list[str | None] = [None] * count
        """What each lamp is, in few letters; None as it was rendered."""
        self._spectra = list(lights.spectra)
        self._forget_pictures()

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        rows, columns = self.lights.alpha.shape
        return columns, rows

    @property
    def off(self) -> float:
        """ΔE00 that 95 % of the scene's colors are predicted within, of the lamp worst off."""
        pairs = zip(self.intensities, self._weights, strict=True)
        return max((found[1] for times, found in pairs if times and found is not None), default=0.0)

    def reset(self) -> None:
        """Let all lamps be as they were rendered."""
        self.set_observer(self._first_observer)
        for number, words in enumerate(self.chosen):
            if words is not None:
                self.set_light(number, None)
        self.intensities = [1.0] * len(self.intensities)
        self._moved, self._rest = 0, None

    def set_intensity(self, number: int, times: float) -> None:
        """Let a lamp shine so many times as it did, 0 or more."""
        self._move(number)
        self.intensities[number] = times

    def set_light(self, number: int, name: str | None) -> None:
        """Give a lamp another spectrum, as `light_spectra.find` takes it; None for its own.

        Raises
        ------
        DomainError, InputError
            If there is no such light; all stays as it was.
        """
        spectrum = self.lights.spectra[number] if name is None else light_spectra.find(name)[0]
        weights = self._fitted(spectrum)  # refuses what cannot be, while somebody is told
        self._move(number)
        self._spectra[number], self._weights[number] = spectrum, weights
        self.chosen[number] = None if name is None else Path(name).name
        self._pictures[number] = None

    def set_observer(self, degrees: int) -> None:
        """Let another observer look."""
        if degrees != self.observer:
            self.observer = degrees
            self._forget_pictures()

    def pixels(self) -> Array:
        """Give RGBA in the working space, float32, from the bottom up; the next step reuses it."""
        moved = self._moved
        if self._rest is None:
            self._rest = self._sum([n for n in range(len(self.intensities)) if n != moved])
        times = self.intensities[moved]
        np.multiply(self._picture(moved), np.float32(times), out=self._shown)
        self._shown += self._rest
        return self._shown.ravel()

    def _sum(self, numbers: list[int]) -> Array:
        """Add up lamps, and alpha."""
        lit = [(self._picture(n), np.float32(self.intensities[n])) for n in numbers]
        total = self._base.copy()
        for here in self._blocks(_AT_ONCE):
            for picture, times in lit:
                total[here] += picture[here] * times
        return total

    def _blocks(self, count: int) -> Iterator[slice]:
        for begin in range(0, len(self._base), count):
            yield slice(begin, begin + count)

    def _move(self, number: int) -> None:
        """Keep what all other lamps make, if it is another than the last one that moved."""
        if number != self._moved:
            self._moved, self._rest = number, None

    def _forget_pictures(self) -> None:
        count = len(self.lights.names)
        self._pictures: list[Array | None] = [None] * count
        self._weights: list[tuple[Array, float] | None] = [None] * count
        self._moved, self._rest = 0, None

    def _picture(self, number: int) -> Array:
        """Give what a lamp makes at its rendered intensity, alpha 0, shape (pixels, 4)."""
        found = self._pictures[number]
        if found is None:
            fitted = self._weights[number]
            if fitted is None:
                fitted = self._weights[number] = self._fitted(self._spectra[number])
            weights, _ = fitted
            part = self.lights.parts[number].reshape(len(weights), -1)
            found = self._pictures[number] = np.empty_like(self._base)
            for here in self._blocks(_PRODUCTS // weights.size):
                np.matmul(part[:, here].T, weights, out=found[here])
        return found

    def _fitted(self, spectrum: Array) -> tuple[Array, float]:
        """Give weights from bands to RGBA, and the ΔE00 that 95 % are predicted within."""
        to_xyz, error = self.lights.weights(spectrum, self.observer)
        to_2_degrees = illuminant_spectra.to_2_degrees(self.observer)
        weights = np.zeros((len(to_xyz), 4), np.float32)
        weights[:, :3] = to_xyz @ to_2_degrees.T @ self._from_xyz.T
        return weights, error.usual


_held: OfFile[Relit] = OfFile()
"""The last one."""


def put(relit: Relit) -> Any:
    """Put what was rendered into the place of the one before; gives the image."""
    _held.put(relit)
    return _shown(relit, relit.pixels())


def last() -> Relit | None:
    """Give the last one of the open file, while it is in memory."""
    return _held.get()


def changed() -> None:
    """Let the image follow what was set, once for all that is set until Blender has time.

    A background Blender never has: there it follows at once.
    """
    events.unregistering.unsubscribe(_end)  # once is enough
    events.unregistering.subscribe(_end)
    if bpy.app.background:
        _step()
    elif not bpy.app.timers.is_registered(_step):
        bpy.app.timers.register(_step, first_interval=0)


def _step() -> None:
    relit = _held.get()
    if relit is None:  # another file is open
        return
    began, before = time.perf_counter(), relit.off
    _shown(relit, relit.pixels())
    relit.step_seconds = time.perf_counter() - began
    if relit.off != before:  # which the panel tells
        icons.redraw()


def _shown(relit: Relit, pixels: Array) -> Any:
    """Put pixels into the image; into a new one where it is gone, as after an undo."""
    image = images.find(RELIT)
    columns, rows = relit.size
    if image is None or tuple(image.size) != (columns, rows) or not image.is_editable:
        return images.replace(RELIT, partial(_image, relit))
    image.pixels.foreach_set(pixels)
    image.update()
    if _pack not in bpy.app.handlers.save_pre:  # Blender drops it with the file
        bpy.app.handlers.save_pre.append(_pack)
    return image


def _image(relit: Relit) -> Any:
    columns, rows = relit.size
    pixels = relit.pixels().reshape(rows, columns, 4)
    return files.image_of(pixels, RELIT, relit.lights.space)


def _pack(_path: str) -> None:
    """Save what is shown: packing takes longer than a step may."""
    image = images.find(RELIT)
    if image is not None and image.is_dirty:
        image.pack()


def _end() -> None:
    if _pack in bpy.app.handlers.save_pre:
        bpy.app.handlers.save_pre.remove(_pack)
    if bpy.app.timers.is_registered(_step):
        bpy.app.timers.unregister(_step)
    events.unregistering.unsubscribe(_end)
