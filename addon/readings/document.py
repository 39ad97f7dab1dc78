# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as data: what a bake gives, joined from its parts. No Blender, and no files."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from ...core import instruments
from ...core.errors import InputError
from ...core.instruments.gloss import METERS
from ..support.version import version
from .origin import Colors, Derivation, Node, Triple

APERTURE = "none: parallel beams on a flat sample"
APERTURES = "those of the instrument, over a flat sample"

GLOSS = tuple(METERS)
"""Angles of the gloss meter, degrees."""


@dataclass(frozen=True)
class Predicted:
    """Reading that the core computes from the stored spectrum.

    Wavelengths are nanometers, values reflectance factors (1 is the perfect white diffuser), and
    XYZ has Y = 100 for it. `lab` is for `illuminant` and `observer`. The sample's own reading
    leaves albedos open from `albedo_lowest` to `albedo_highest`, one a band, while σ is unknown;
    both are the albedo where that was measured, and empty where no roughness fits the reading.
    `white` says what the stored spectrum itself is relative to, and `white_factor` what it was
    multiplied by. `albedo` is ρ of the facets, one a band, that gives the reading at this σ by this
    model: above 1 where white facets read less. `colors` are those of the reading, in spaces that
    pipelines exchange, for the 2° observer; `preview` is that of the working space. `instrument` is
    the real one that the stored spectrum is of, and `gloss` what a gloss meter read, pairs of
    degrees and units.
    """

    kind: str
    model: str
    model_reason: str
    sigma_degrees: float
    illuminant: str
    observer: int
    wavelengths: tuple[float, ...]
    values: tuple[float, ...]
    xyz: Triple
    lab: Triple
    preview: Triple
    albedo_lowest: tuple[float, ...] = ()
    albedo_highest: tuple[float, ...] = ()
    white: str = "perfect diffuser"
    white_factor: float = 1.0
    albedo: tuple[float, ...] = ()
    colors: Colors = field(default_factory=dict)
    instrument: str = ""
    gloss: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class CyclesReading:
    """Reading of a Cycles render, in scene-linear RGB and, for the 2° observer, XYZ and Lab.

    `spread` is the standard deviation of RGB over the sample: 0 for an even surface. `colors` are
    `rgb` in spaces that pipelines exchange.
    """

    rgb: Triple
    spread: Triple
    illuminant: str
    xyz: Triple
    lab: Triple
    colors: Colors = field(default_factory=dict)


@dataclass(frozen=True)
class SpotRead:
    """Where and how an instrument stood on a surface of the scene.

    `diameter` is of the spot, in millimeters. `point`, `normal` and `azimuth` are its middle, the
    side that it stood on, and where its azimuth is 0, in the scene. `is_alone` says whether other
    objects were hidden, and `covered` which share of the spot the object filled: nothing else
    counts. `spread_mean` and `spread_95` are ΔE00 from the reading over the spot, mean and 95th
    percentile, and `noise` is the reading's; None where nothing was measured.
    """

    diameter: float
    point: Triple
    normal: Triple
    azimuth: Triple
    is_alone: bool
    covered: float
    spread_mean: float | None
    spread_95: float | None
    noise: float | None


@dataclass(frozen=True)
class Reading:
    """All that is known of one material's reading.

    `surface` is the object it was asked for by, if any. `delta_e_00` is None unless there are
    both a prediction and a measurement. `shader_reason` says whether the
    material is Lambertian or rough, and why; empty where that was not derived here. `fault` says
    why a prediction or a measurement that was asked for is missing; else it is empty.
    `instrument` is the virtual one, a name in `core.instruments.REGISTRY`, of both prediction and
    measurement. `gloss` has the gloss units at 20°, 60° and 85°; empty where they were not asked
    for. `node` is the shader node that was read, None where the surface has no target shader's, and
    `derivation` how its color came about, None where none was derived. `spot` tells where on an
    object it was read; None of a flat sample.
    """

    material: str
    surface: str
    sample: str
    source: str
    predicted: Predicted | None
    measured: CyclesReading | None
    delta_e_00: float | None
    shader_reason: str
    warnings: tuple[str, ...]
    fault: str = ""
    instrument: str = instruments.DEFAULT
    gloss: tuple[float, ...] = ()
    node: Node | None = None
    derivation: Derivation | None = None
    spot: SpotRead | None = None


@dataclass(frozen=True)
class Readings:
    """A whole bake, or the part of one that a shard made.

    `whole` is what `digest` says of the whole bake, or of the one that a part belongs to; empty of
    readings that a script took.
    `version` is that of the extension that baked it. `each` is how many readings, at as many
    instruments, each surface has one after the other.
    """

    working_space: str
    blender: str
    entries: tuple[Reading, ...]
    shard: int = 1
    shards: int = 1
    whole: str = ""
    version: str = field(default_factory=version)
    each: int = 1

    @property
    def instruments(self) -> tuple[str, ...]:
        """Names of the virtual instruments, in the order in which they are met."""
        found = tuple(dict.fromkeys(entry.instrument for entry in self.entries))
        return found or (instruments.DEFAULT,)

    @property
    def aperture(self) -> str:
        """Say what the instruments light and look through."""
        wide = any(map(instruments.has_apertures, self.instruments))
        said = APERTURES if wide else APERTURE
        sizes = sorted({entry.spot.diameter for entry in self.entries if entry.spot is not None})
        if not sizes:
            return said
        return f"{said}; on objects a spot of {', '.join(f'{size:g}' for size in sizes)} mm"

    @property
    def largest_delta_e(self) -> float | None:
        """Largest ΔE00, or None where nothing was both predicted and measured."""
        known = [entry.delta_e_00 for entry in self.entries if entry.delta_e_00 is not None]
        return max(known) if known else None

    @property
    def faults(self) -> list[str]:
        """Why readings that were asked for are missing, a sentence or two for each material."""
        return list(dict.fromkeys(entry.fault for entry in self.entries if entry.fault))


def merge(parts: Iterable[Readings]) -> Readings:
    """Join the parts that `bake --shard i/n` wrote, in the order of the unsharded bake.

    Raises
    ------
    InputError
        If a part is missing, stands twice, or does not belong to the others.
    """
    found = sorted(parts, key=lambda part: part.shard)
    if not found:
        msg = "There is no part to merge; name the JSON files that bake --shard wrote."
        raise InputError(msg)
    for part in found:
        if part.version != version():
            msg = (
                f"Part {part.shard} was baked by Rough Spectra {part.version}, and this is "
                f"{version()}; merge with the version that baked, or bake again."
            )
            raise InputError(msg)
    count = found[0].shards
    numbers = [part.shard for part in found]
    settings = {
        (part.working_space, part.blender, part.shards, part.whole, part.each) for part in found
    }
    if len(settings) > 1:
        msg = (
            "The parts come from different bakes; merge parts that one version of Blender baked "
            "with the same options from the same .blend, with the same nodes and spectra."
        )
        raise InputError(msg)
    if numbers != list(range(1, count + 1)):
        msg = f"Parts {numbers} do not make up 1 to {count}; give each part once."
        raise InputError(msg)
    each = found[0].each
    total = sum(len(part.entries) for part in found)
    entries: list[Reading] = []
    for place in range(-(-total // each)):
        part, row = found[place % count], place // count * each
        if row + each > len(part.entries):
            msg = f"Part {part.shard} of {count} has too few readings; bake it again."
            raise InputError(msg)
        entries += part.entries[row : row + each]
    first = found[0]
    return Readings(
        first.working_space, first.blender, tuple(entries), whole=first.whole, each=each
    )
