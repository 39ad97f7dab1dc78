# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a thermal camera sees of a scene: what its surfaces emit, and what they reflect of others.

The band of the camera is split in parts, three for each render. In a part a surface has one
emissivity ε, emits ε times what a black body of its temperature does, and reflects the rest
(Kirchhoff). What the coldest of all sends is taken off everything and put back in the end: among
things of one temperature nothing is left to render, and wherever little is, bounces that are cut
off and single precision cost little.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.emissivity import band as bands
from ...core.emissivity import planck
from ...core.errors import DomainError, MaterialError
from ...core.numerics.arrays import Array
from ..blender.background_job import Job, waited
from ..matching import emission
from ..material import snapshot, storage
from ..samples.sample import Sample
from . import cameras, scene_copy
from .cameras import HOTTEST

PROPERTY = cameras.TEMPERATURE
BAND = cameras.THERMAL
AMBIENT, EMISSIVITY = cameras.AMBIENT, cameras.EMISSIVITY

_SHORTEST = 700.0
"""Nanometers from which a band may begin."""
_IN_A_RENDER = 3
_KELVIN = np.concatenate(([0.0], np.geomspace(1.0, HOTTEST, 40_000)))
"""Temperatures of the table from which they are read back, 0.025 % apart."""
_SURFACES = {"MESH", "CURVE", "SURFACE", "META", "FONT", "CURVES", "POINTCLOUD"}


@dataclass(frozen=True)
class Wanted:
    """What is asked for.

    Parameters
    ----------
    band
        First and last wavelength of the camera, nanometers.
    parts
        Of the band, a multiple of 3.
    ambient
        Temperature of what has none of its own, kelvin.
    sky
        That of what is seen where nothing is, taken as black, kelvin; None for `ambient`.
    emissivity
        Of materials of which nothing is known in the band.
    known
        By the names of materials, their sample or their emissivity, instead of what they have.
    samples, percentage
        Of the renders, instead of the scene's; or None.

    Raises
    ------
    DomainError
        If any of it cannot be.
    """

    band: tuple[float, float] = BAND
    parts: int = 3
    ambient: float = AMBIENT
    sky: float | None = None
    emissivity: float = EMISSIVITY
    known: Mapping[str, Sample | float] = field(default_factory=dict)
    samples: int | None = None
    percentage: int | None = None

    def __post_init__(self) -> None:
        """Refuse what cannot be."""
        first, last = self.band
        if not _SHORTEST <= first < last < np.inf:
            msg = f"The band is {first:g} to {last:g} nm; give its ends in nm, from 700."
            raise DomainError(msg)
        if self.parts % _IN_A_RENDER or not 3 <= self.parts <= 36:
            msg = f"The band has {self.parts} parts; give 3, 6, 9 … 36."
            raise DomainError(msg)
        for kelvin in (self.ambient, *(() if self.sky is None else (self.sky,))):
            _check_kelvin(kelvin, "The surroundings")
        for value in (self.emissivity, *self.known.values()):
            if not isinstance(value, Sample) and not 0 <= value <= 1:
                msg = f"An emissivity is {value:g}; give 0 to 1."
                raise DomainError(msg)


@dataclass(frozen=True, eq=False)
class ThermalPicture:
    """What the camera sees, from the bottom up.

    Parameters
    ----------
    band
        Its ends, nanometers.
    radiance
        In the band, W m⁻² sr⁻¹, shape (rows, columns).
    kelvin
        Apparent temperature: that of a black body which sends as much, shape (rows, columns).
    assumed
        Names of materials of which nothing is known in the band.
    temperatures
        By the names of objects, their temperature, where they have one of their own.
    """

    band: tuple[float, float]
    radiance: Array
    kelvin: Array
    assumed: tuple[str, ...]
    temperatures: Mapping[str, float]


class Thermal(Job):
    """A thermal picture under way.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`, as it is now.
    wanted
        What is asked for.

    Raises
    ------
    MaterialError
        If the scene has no camera or no view layer, or a temperature is none.
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing = "renders what a thermal camera sees"
    interrupted = "The thermal picture was interrupted; nothing was written."
    smaller = "render a smaller picture"

    def __init__(self, scene: Any, wanted: Wanted) -> None:
        scene_copy.check_view(scene, wanted.percentage)
        layer = scene_copy.layer_of(scene)
        self._wanted = wanted
        self._ends = np.linspace(*wanted.band, wanted.parts + 1)
        self._assumed: dict[str, None] = {}
        self._temperatures: dict[str, float] = {}
        self._variants: dict[tuple[Any, float, bool], int] = {}
        objects = [self._object(thing) for thing in bpy.data.objects if thing.type in _SURFACES]
        sky = wanted.ambient if wanted.sky is None else wanted.sky
        kelvins = [sky, *(kelvin for _, kelvin, _ in self._variants), *self._of_vertices(objects)]
        self._coldest = min(kelvins)
        least = _sent(self._ends, np.array([self._coldest]))[0]

        def prepare(folder: Path) -> dict[str, Any]:
            table = _sent(self._ends, _KELVIN) - least
            np.savez(folder / "table.npz", kelvin=_KELVIN, sent=table)
            return {
                **scene_copy.save(folder, scene, layer, wanted.samples, wanted.percentage),
                "renders": wanted.parts // _IN_A_RENDER,
                "attribute": PROPERTY,
                "sky": (_sent(self._ends, np.array([sky]))[0] - least).tolist(),
                "variants": [
                    {
                        "emissivity": self._emissivities(material, kelvin),
                        "sent": (_sent(self._ends, np.array([kelvin]))[0] - least).tolist(),
                        "by_vertex": by_vertex,
                    }
                    for material, kelvin, by_vertex in self._variants
                ],
                "objects": objects,
            }

        super().__init__(Path(__file__).with_name("thermal_worker.py"), prepare)

    def result(self) -> ThermalPicture:
        """Put the renders together, once `poll` says that they are done.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        least = _sent(self._ends, np.array([self._coldest]))[0]
        total: Any = 0.0
        for number in range(self._wanted.parts // _IN_A_RENDER):
            pixels = np.load(self.output(f"pass-{number}.npy"))[..., :3].astype(np.float64)
            part = slice(number * _IN_A_RENDER, (number + 1) * _IN_A_RENDER)
            total = total + (pixels + least[part]).sum(axis=-1)
        table = _sent(self._ends, _KELVIN).sum(axis=-1)
        seen = table > 0
        return ThermalPicture(
            self._wanted.band,
            np.asarray(total),
            np.interp(total, table[seen], _KELVIN[seen]),
            tuple(self._assumed),
            dict(self._temperatures),
        )

    def _object(self, thing: Any) -> dict[str, Any]:
        """Say which variants an object's slots become."""
        own = thing.get(PROPERTY)
        kelvin = self._wanted.ambient
        if own is not None:
            kelvin = _check_kelvin(own, f"Object {thing.name!r}")
            self._temperatures[thing.name] = kelvin
        attributes = getattr(thing.data, "attributes", {})
        layer = attributes.get(PROPERTY) if thing.type == "MESH" else None
        by_vertex = False
        values = np.zeros(0, np.float32)
        if own is None and layer is not None and layer.domain == "POINT":
            by_vertex = True
            values = np.empty(len(layer.data), np.float32)
            layer.data.foreach_get("value", values)
            for value in (values.min(), values.max()) if len(values) else ():
                _check_kelvin(float(value), f"A vertex of object {thing.name!r}")
            # Emissivity changes slowly with temperature: that of the mean is taken.
            kelvin = float(values.mean()) if len(values) else kelvin
        slots = [slot.material for slot in thing.material_slots] or [None]
        keys = [(material, kelvin, by_vertex) for material in slots]
        return {
            "name": thing.name,
            "library": scene_copy.path_of(thing.library),
            "slots": [self._variants.setdefault(key, len(self._variants)) for key in keys],
            "coldest": float(values.min()) if by_vertex and len(values) else kelvin,
        }

    def _of_vertices(self, objects: list[dict[str, Any]]) -> list[float]:
        return [each["coldest"] for each in objects]

    def _emissivities(self, material: Any, kelvin: float) -> list[float]:
        """Emissivity of a material in each part of the band, at a temperature."""
        name = "(no material)" if material is None else material.name
        known = self._wanted.known.get(name)
        sigma = 0.0
        if known is None and material is not None and snapshot.has_spectrum(material):
            request = storage.load(material)
            known, sigma = request.sample, request.sigma
        if isinstance(known, Sample):
            covered = (
                known.wavelengths[0] <= self._ends[0] < self._ends[-1] <= known.wavelengths[-1]
            )
            if covered:
                parts = [
                    (f"{a:g}-{b:g} nm", (a, b))
                    for a, b in zip(self._ends[:-1].tolist(), self._ends[1:].tolist(), strict=True)
                ]
                found = emission.compute(
                    known, sigma, angles=(0.0,), temperature=max(kelvin, 1.0), bands=parts
                )
                values = [band.hemispherical for band in found.bands]
                if all(0 <= value <= 1 for value in values):
                    return values
            known = None
        if known is None:
            self._assumed.setdefault(name)
            known = self._wanted.emissivity
        return [float(known)] * self._wanted.parts


def render(
    scene: Any, wanted: Wanted, progress: Callable[[int, int], None] | None = None
) -> ThermalPicture:
    """Render what a thermal camera sees and wait for it; see `Thermal`."""
    with waited(Thermal(scene, wanted), progress) as job:
        return job.result()


def _sent(ends: Array, kelvin: Array) -> Array:
    """Radiance of black bodies in parts of a band, W m⁻² sr⁻¹, shape (temperatures, parts)."""
    found = []
    for first, last in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True):
        rule = bands.rule_of([first, last], 2, (first, last))
        found.append(planck.radiance(rule.nm, kelvin[:, np.newaxis]) @ rule.weight)
    return np.stack(found, axis=-1)


def _check_kelvin(value: Any, what: str) -> float:
    try:
        kelvin = float(value)
    except (TypeError, ValueError):
        kelvin = float("nan")
    if not 0 <= kelvin <= HOTTEST:
        msg = f"{what} has a temperature of {value!r}; give kelvin, 0 to {HOTTEST:g}."
        raise MaterialError(msg)
    return kelvin
