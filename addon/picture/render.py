# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ask a second Blender for the renders of a spectral picture, and put them together."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.bands import Bands, Error
from ...core.errors import DomainError, MaterialError
from ...core.limits import TOLERANCE
from ...core.numerics.arrays import Array
from ..blender import working_space
from ..blender.background_job import Job, waited
from ..colorimetry import cie_tables, illuminant_spectra
from ..scene import light_spectra
from . import direct_light, find_colors, passes, places, scene_copy, spectra
from .channels import Channels
from .passes import Pass
from .picture import SpectralPicture, compare

MOST = 36
"""Bands that can be asked for, at most."""
_FEW = 4
"""Lamps among which no light tree has to pick: it costs more time there than it saves of noise
(`tools/benchmarks/bench_lamps.py`)."""
_FEW_IN_A_TEXTURE = 8
"""The same in a world of many colors. The tree picks it by its mean, another one in each render,
which is noise of color; all else it picks alike."""


@dataclass(frozen=True)
class Wanted:
    """What is asked for.

    Parameters
    ----------
    tolerance
        ΔE00 within which 95 % of the picture are to be, as far as bands matter.
    bands
        Number of bands, a multiple of 3, instead of as many as the tolerance needs; or None.
    observer
        2 or 10 degrees.
    direct
        Whether direct light is rendered apart, one more render a lamp, and is exact; None for
        where it is the better way, see `direct_light`.
    plain
        Whether to render the ordinary picture too, and compare.
    samples, percentage
        Of the renders, instead of the scene's; or None.
    lights
        By the names of lamps, worlds and materials that emit, the CIE illuminant that they are, or
        the path of a table; see `light_spectra.find`.
    most
        Bands beyond which none are added for the tolerance.
    steady
        Whether all renders follow the same paths of light, whatever its colors: without russian
        roulette, adaptive sampling and denoising.
    halves
        Whether to render everything twice, with random numbers of their own, of which the picture
        is the mean: what the two differ by is noise.
    spectra
        Whether the spectra of pixels can be asked for: all renders stay on the disk for them.

    Raises
    ------
    DomainError
        If any of it cannot be.
    """

    tolerance: float = TOLERANCE
    bands: int | None = None
    observer: int = 2
    direct: bool | None = False
    plain: bool = True
    samples: int | None = None
    percentage: int | None = None
    lights: Mapping[str, str] = field(default_factory=dict)
    most: int = MOST
    steady: bool = False
    halves: bool = False
    spectra: bool = True

    def __post_init__(self) -> None:
        """Refuse what cannot be."""
        if self.bands is not None and (self.bands % 3 or not 3 <= self.bands <= MOST):
            msg = f"There are three bands in a render: give 3, 6, 9 … {MOST}, not {self.bands}."
            raise DomainError(msg)
        if not self.tolerance > 0:
            msg = f"The tolerance is ΔE00 {self.tolerance:g}; give a number above 0."
            raise DomainError(msg)
        if self.observer not in cie_tables.OBSERVERS:
            msg = f"Observer {self.observer!r} is not known; choose 2 or 10 degrees."
            raise DomainError(msg)
        for name, value, most in (("samples", self.samples, 1 << 24),
                                  ("percentage", self.percentage, 32767)):  # fmt: skip
            if value is not None and not 1 <= value <= most:
                msg = f"{name} is {value}; give a whole number from 1."
                raise DomainError(msg)


class Rendering(Job):
    """A spectral picture under way.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`, as it is now.
    wanted
        What is asked for.

    Raises
    ------
    MaterialError
        If the scene has no camera, no light, or another render engine than Cycles.
    DomainError, InputError
        If a light is none that is known.
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing = "renders the bands"
    interrupted = "The spectral picture was interrupted; nothing was written."
    smaller = "render a smaller picture"

    def __init__(self, scene: Any, wanted: Wanted) -> None:
        _check(scene, wanted)
        known = {name: light_spectra.find(light) for name, light in wanted.lights.items()}
        layer = scene_copy.layer_of(scene)
        self._wanted = wanted
        self._space = working_space.current()
        depsgraph = scene_copy.evaluated(scene, layer)
        self._found = find_colors.find(depsgraph, scene, self._space, known)
        self._lamps = passes.lamps_of(self._found, self._space)
        self._light = self._decide(scene)
        self._chosen = self._light.bands
        self._passes = [] if self._light.is_all else self._of_bands()
        if self._light.apart:
            self._passes += passes.of_direct(self._lamps, wanted.observer)
        renders = [*self._passes, *self._beside(depsgraph, scene)]

        def prepare(folder: Path) -> dict[str, Any]:
            return {
                **scene_copy.save(folder, scene, layer, wanted.samples, wanted.percentage),
                "plain": wanted.plain,
                "apart": self._light.apart,
                "steady": wanted.steady,
                "halves": wanted.halves,
                "few_lamps": self._lamp_count(depsgraph) <= self._few(),
                "passes": len(renders),
                "direct": [each.direct for each in renders],
                "edits": self._edits(renders),
                "groups": self._groups(depsgraph, scene),
                "untranslated": self._materials_left(),
                "reset": [
                    {"of": list(place.of), "attribute": place.attribute, "value": value}
                    for place, value in self._found.reset
                ],
            }

        super().__init__(Path(__file__).with_name("worker.py"), prepare)
        self.total = len(renders) + wanted.plain  # before the other Blender says so

    def _decide(self, scene: Any) -> direct_light.Choice:
        """Choose the bands, and whether direct light has renders of its own."""
        wanted = self._wanted
        counted = wanted.bands is not None
        tolerance, most = (0.0, wanted.bands) if counted else (wanted.tolerance, wanted.most)

        def choose(direct: bool) -> Bands:
            more = {"most": most, "direct": direct, "observer": wanted.observer}
            return passes.choose(self._found, self._lamps, self._space, tolerance, **more)

        lamps = len(self._lamps.spectra)
        return direct_light.decide(scene, wanted.direct, lamps, counted, choose)

    def _few(self) -> int:
        """Give the number of lamps up to which the light tree is left out."""
        worlds = [each for each in self._found.shining if each.place.of[0] == "worlds"]
        return _FEW_IN_A_TEXTURE if any(each.spectrum is None for each in worlds) else _FEW

    def _lamp_count(self, depsgraph: Any) -> int:
        """Count lamps and objects that shine."""
        shining = {each.place.of for each in self._found.shining}
        count = 0
        for instance in depsgraph.object_instances:
            thing = instance.object
            slots = [slot.material for slot in thing.material_slots]
            of = {places.key("materials", each.original) for each in slots if each is not None}
            count += thing.type == "LIGHT" or bool(of & shining)
        return count

    def _of_bands(self) -> list[Pass]:
        return passes.of_bands(self._chosen)

    def _beside(self, _depsgraph: Any, _scene: Any) -> list[Pass]:
        """Give renders that are wanted after those of the picture."""
        return []

    def _materials_left(self) -> list[list[str]]:
        """Give the keys of materials of which something stays red, green and blue."""
        left = self._found.untranslated
        keys = [
            places.key("materials", material)
            for material in bpy.data.materials
            if places.title("Material", material) in left
        ]
        return [list(each) for each in keys]

    def _touched(self) -> float | None:
        """Give the part of the picture that shows them."""
        if not self._materials_left():
            return None
        return float(json.loads(self.output("touched.json").read_text(encoding="utf-8")))

    def _groups(self, _depsgraph: Any, _scene: Any) -> list[dict[str, Any]]:
        """Give what shines together, where pictures are wanted of each."""
        return []

    def _edits(self, renders: list[Pass]) -> list[dict[str, Any]]:
        """Say what has to be set for the renders; see `passes.edits`."""
        return passes.edits(self._found, self._lamps, renders, self._space)

    def result(self) -> SpectralPicture:
        """Put the renders together, once `poll` says that they are done.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        seconds = json.loads(self.output("seconds.json").read_text(encoding="utf-8"))
        alpha, xyz, channels = together(self.output, self._passes, self._wanted.spectra)
        adapted = xyz @ illuminant_spectra.to_2_degrees(self._wanted.observer).T
        rgb = adapted @ self._space.from_xyz.T
        shown = np.concatenate((rgb, alpha), axis=-1)
        comparison = None
        if self._wanted.plain:
            plain = np.load(self.output("plain.npy"))
            plain_xyz = plain[..., :3].astype(np.float64) @ np.linalg.inv(self._space.from_xyz).T
            comparison = compare(plain, shown, adapted, plain_xyz, self._lamps.white)
        return SpectralPicture(
            shown,
            xyz,
            self._wanted.observer,
            self._wavelengths,
            self._light.apart,
            Error(0.0, 0.0, 0.0) if self._light.is_all else self._chosen.error,
            self._light.is_all or self._chosen.enough,
            comparison,
            {name: tuple(rules) for name, rules in self._found.told.items()},
            {name: tuple(left) for name, left in self._found.untranslated.items()},
            tuple(clock for clock, _ in seconds),
            None
            if channels is None
            else spectra.of(
                channels,
                passes.surfaces_of(self._found, self._space),
                self._lamps,
                self._passes,
                self._wavelengths,
                self._wanted.observer,
            ),
            self._light.words,
            self._lamps.white_by(self._wanted.observer),
            self._touched(),
            tuple(processor for _, processor in seconds),
        )

    @property
    def _wavelengths(self) -> Array:
        """Of the bands that are rendered."""
        nm: Array = self._chosen.wavelengths
        return nm[:0] if self._light.is_all else nm


def render(
    scene: Any, wanted: Wanted, progress: Callable[[int, int], None] | None = None
) -> SpectralPicture:
    """Render a spectral picture and wait for it; see `Rendering`."""
    with waited(Rendering(scene, wanted), progress) as job:
        return job.result()


def _check(scene: Any, wanted: Wanted) -> None:
    scene_copy.check(scene, "a spectral picture", wanted.percentage)
    if wanted.direct and scene.cycles.use_denoising:
        msg = (
            f"Scene {scene.name!r} is denoised, and direct light apart needs renders that are "
            "not; switch denoising off, or leave direct light with the rest."
        )
        raise MaterialError(msg)


def together(
    output: Callable[[str], Path], renders: list[Pass], keep: bool
) -> tuple[Array, Array, Channels | None]:
    """Sum up renders, one after the other: memory does not grow with them.

    Parameters
    ----------
    output
        Gives the path of a file that the worker left.
    renders
        Which there are.
    keep
        Whether to keep their channels.

    Returns
    -------
    Alpha, shape (rows, columns, 1), XYZ, shape (rows, columns, 3), and channels.
    """
    alpha = xyz = np.zeros(())
    channels = None
    for number, each in enumerate(renders):
        pixels = np.load(output(f"pass-{number}.npy"))
        if not number:
            alpha = pixels[..., 3:].astype(np.float64)
            xyz = np.zeros((*pixels.shape[:2], 3))
            channels = Channels(*pixels.shape[:2]) if keep else None
        xyz += pixels[..., :3].astype(np.float64) @ each.to_xyz
        if channels is not None:
            channels.add(pixels[..., :3])
    return alpha, xyz, channels
