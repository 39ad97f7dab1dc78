# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render each lamp's light apart, in bands in which it sends the same: see `relight`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core import bands
from ...core.errors import DomainError, MaterialError
from ...core.numerics.arrays import Array
from ..blender.background_job import waited
from ..colorimetry import illuminant_spectra, rgb_spectra
from . import passes, scene_copy
from .colors import Shining
from .direct_light import Choice
from .passes import Lamps, Pass
from .places import key
from .relight import ILLUMINANTS, Lights
from .render import Rendering, Wanted

_DARK = 1e-6
"""Part of a spectrum's largest value below which nothing is divided by it."""


@dataclass(eq=False)
class _Group:
    """What shines together: lamps of one datablock, the world, objects of one material.

    Parameters
    ----------
    of
        Collection, name and library of what shines.
    shining
        Numbers of `Colors.shining`.
    base
        Spectrum that all of it is a multiple of, at each wavelength.
    """

    of: tuple[str, str, str]
    shining: list[int]
    base: Array


class Gathering(Rendering):
    """The light of each lamp under way.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`, as it is now.
    wanted
        As of `Rendering`; no ordinary picture and no direct light apart.
    most_bytes
        Memory that the lights may take, if that is limited.

    Raises
    ------
    RoughSpectraError
        As `Rendering`, and a MaterialError where lamps cannot be told apart; a DomainError where
        they would take more memory.
    """

    doing = "renders the light of each lamp"
    interrupted = "The lights were interrupted; nothing was written."

    def __init__(self, scene: Any, wanted: Wanted, most_bytes: int | None = None) -> None:
        self._together: list[_Group] = []
        self._most_bytes = most_bytes
        super().__init__(scene, wanted)

    def lights(self) -> Lights:
        """Put the renders together, once `poll` says that they are done.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        self.output("seconds.json")
        parts = alpha = np.zeros(())
        for number in range(len(self._passes)):  # one after the other: they are large
            picture = np.load(self.output(f"pass-{number}.npy"))
            if not number:
                lamps, rows, columns, _ = picture.shape
                parts = np.empty((lamps, self._chosen.wavelengths.size, rows, columns), np.float32)
                alpha = picture[0, ..., 3].copy()
            here = slice(bands.IN_A_PASS * number, bands.IN_A_PASS * (number + 1))
            parts[:, here] = picture[..., :3].transpose(0, 3, 1, 2)
        return Lights(
            tuple(group.of[1] for group in self._together),
            np.stack([group.base for group in self._together]),
            parts,
            alpha,
            self._chosen.wavelengths,
            passes.surfaces_of(self._found, self._space),
            self._space.name,
        )

    def _decide(self, scene: Any) -> Choice:
        """Choose bands for the scene's lamps and for those that may come."""
        self._together = self._grouped()
        spectra = [group.base for group in self._together]
        spectra += [illuminant_spectra.cie(name) for name in ILLUMINANTS]
        lamps = Lamps(np.stack(spectra), ())
        most = self._wanted.bands or self._wanted.most
        tolerance = 0.0 if self._wanted.bands else self._wanted.tolerance
        chosen = passes.choose(self._found, lamps, self._space, tolerance, most=most)
        self._check_memory(scene, chosen.wavelengths.size)
        return Choice(chosen, apart=False, is_all=False, words="")

    def _check_memory(self, scene: Any, count: int) -> None:
        percentage = self._wanted.percentage or scene.render.resolution_percentage
        width, height = scene_copy.size(scene, percentage)
        lamps = len(self._together)
        needed = lamps * count * width * height * np.dtype(np.float32).itemsize
        if self._most_bytes is not None and needed > self._most_bytes:
            msg = (
                f"The light of {lamps} lamps in {count} bands takes {needed / 1e9:.1f} GB of "
                f"memory at {width} × {height}, and {self._most_bytes / 1e9:.0f} GB are the most; "
                "choose a smaller size, or fewer renders."
            )
            raise DomainError(msg)

    def _of_bands(self) -> list[Pass]:
        """Let each lamp send its spectrum in parts of its group's."""
        sent = np.concatenate([self._parts(), rgb_spectra.basis()])
        plain = passes.of_bands(self._chosen)
        return [Pass(each.taken, sent @ each.taken, each.to_xyz) for each in plain]

    def _edits(self, renders: list[Pass]) -> list[dict[str, Any]]:
        numbers = [
            None if each.spectrum is None else number
            for number, each in enumerate(self._found.shining)
        ]
        return passes.edits(
            self._found, Lamps(self._lamps.spectra, tuple(numbers)), renders, self._space
        )

    def _groups(self, depsgraph: Any, _scene: Any) -> list[dict[str, Any]]:
        by = {group.of: f"lights{n}" for n, group in enumerate(self._together)}
        members: dict[str, list[list[str]]] = {name: [] for name in by.values()}
        for instance in depsgraph.object_instances:
            thing = instance.object.original
            found = {by[of] for of in _shown(thing) if of in by}
            if len(found) > 1:
                msg = (
                    f"Object {thing.name!r} shines with several materials, which cannot be told "
                    "apart; separate it by material."
                )
                raise MaterialError(msg)
            for name in found:
                _, *place = key("objects", thing)
                if place not in members[name]:
                    members[name].append(place)
        return [
            {"name": name, "objects": members[name], "world": of[0] == "worlds"}
            for of, name in by.items()
        ]

    def _grouped(self) -> list[_Group]:
        found: dict[tuple[str, str, str], _Group] = {}
        white, _ = illuminant_spectra.like(self._space.white)
        for number, each in enumerate(self._found.shining):
            of = each.place.of
            if of[0] == "node_groups":
                msg = (
                    f"Light comes from within the node group {of[1]!r}, and cannot be told by "
                    "its lamp; ungroup it."
                )
                raise MaterialError(msg)
            group = found.setdefault(of, _Group(of, [], _own(each, white)))
            group.shining.append(number)
            if each.spectrum is None:
                group.base = white
        return list(found.values())

    def _parts(self) -> Array:
        """Spectrum of each that shines, divided by its group's, shape (shining, n)."""
        found = np.ones((len(self._found.shining), illuminant_spectra.GRID.size))
        for group in self._together:
            lit = group.base > _DARK * group.base.max()
            for number in group.shining:
                spectrum = self._found.shining[number].spectrum
                if spectrum is not None and spectrum is not group.base:
                    found[number] = np.where(lit, spectrum / np.where(lit, group.base, 1), 0).clip(
                        0
                    )
        return found


def gather(
    scene: Any, wanted: Wanted, progress: Callable[[int, int], None] | None = None
) -> Lights:
    """Render each lamp's light and wait for it; see `Gathering`."""
    with waited(Gathering(scene, wanted), progress) as job:
        return job.lights()


def _own(each: Shining, white: Array) -> Array:
    return white if each.spectrum is None else each.spectrum


def _shown(thing: Any) -> list[tuple[str, str, str]]:
    """Give collection, name and library of all that an object may shine by."""
    if thing.type == "LIGHT":
        return [key("lights", thing.data)]
    slots = [slot.material for slot in thing.material_slots]
    return [key("materials", each) for each in slots if each is not None]
