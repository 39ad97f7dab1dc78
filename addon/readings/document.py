# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as data: what a bake gives, joined from its parts, and its JSON document. No Blender."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ...core import instruments
from ...core.errors import InputError
from ...core.instruments.gloss import METERS
from ..support import user_files
from ..support.version import version

FORMAT = "rough-spectra-readings"
SCHEMA = 1
APERTURE = "none: parallel beams on a flat sample"
APERTURES = "those of the instrument, over a flat sample"

GLOSS = tuple(METERS)
"""Angles of the gloss meter, degrees."""

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Predicted:
    """Reading that the core computes from the stored spectrum.

    Wavelengths are nanometers, values reflectance factors (1 is the perfect white diffuser), and
    XYZ has Y = 100 for it. `lab` is for `illuminant` and `observer`. The sample's own reading
    leaves albedos open from `albedo_lowest` to `albedo_highest`, one a band, while σ is unknown;
    both are the albedo where that was measured, and empty where no roughness fits the reading.
    `white` says what the stored spectrum itself is relative to, and `white_factor` what it was
    multiplied by.
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


@dataclass(frozen=True)
class CyclesReading:
    """Reading of a Cycles render, in scene-linear RGB and, for the 2° observer, XYZ and Lab.

    `spread` is the standard deviation of RGB over the sample: 0 for an even surface.
    """

    rgb: Triple
    spread: Triple
    illuminant: str
    xyz: Triple
    lab: Triple


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
    for. `spot` tells where on an object it was read; None of a flat sample.
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
    spot: SpotRead | None = None


@dataclass(frozen=True)
class Readings:
    """A whole bake, or the part of one that a shard made.

    `whole` is what `digest` says of the whole bake that a part belongs to; a whole one has none.
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
    return Readings(found[0].working_space, found[0].blender, tuple(entries), each=each)


def to_json(readings: Readings) -> bytes:
    """Give the document that `from_json` reads; equal readings give equal bytes."""
    head = {
        "format": FORMAT,
        "schema": SCHEMA,
        "version": readings.version,
        "blender": readings.blender,
        "working_space": readings.working_space,
        "instrument": ", ".join(readings.instruments),
        "aperture": readings.aperture,
        "units": {
            "values": "reflectance factor, 0..1",
            "wavelengths": "nm",
            "xyz": "Y = 100 for the perfect diffuser",
            "measured": "CIE 1931 2° observer",
            "gloss": "GU at 20°, 60° and 85°, ISO 2813",
            "spot": "mm; point in units of the scene",
        },
        "shard": readings.shard,
        "shards": readings.shards,
        "whole": readings.whole,
        "each": readings.each,
        "largest_delta_e_00": readings.largest_delta_e,
        "readings": [asdict(entry) for entry in readings.entries],
    }
    text = json.dumps(head, indent=1, ensure_ascii=False) + "\n"
    return text.encode(errors="backslashreplace")  # half a surrogate pair, as JSON escapes it


def from_json(path: Path) -> Readings:
    """Read back what `to_json` gave.

    Raises
    ------
    InputError
        If the file is not such a document.
    """
    data = user_files.read(path)
    try:
        document = json.loads(data.decode())
    except (ValueError, RecursionError) as error:
        msg = f"{path} is not JSON ({error}); give a file that bake wrote."
        raise InputError(msg) from error
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        msg = f"{path} holds no readings; give the .json file that bake wrote."
        raise InputError(msg)
    if document.get("schema") != SCHEMA:
        msg = f"{path} has schema {document.get('schema')}; this version reads schema {SCHEMA}."
        raise InputError(msg)
    try:
        entries = tuple(_entry(data) for data in document["readings"])
        return Readings(
            document["working_space"],
            document["blender"],
            entries,
            int(document["shard"]),
            int(document["shards"]),
            str(document["whole"]),
            str(document["version"]),
            max(1, int(document.get("each", 1))),
        )
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        msg = f"{path} is damaged ({error!r}); bake it again."
        raise InputError(msg) from error


_ALBEDOS = ("albedo_lowest", "albedo_highest")
_TRIPLES = {"rgb", "spread", "xyz", "lab", "preview", "point", "normal", "azimuth"}


def _entry(data: dict[str, Any]) -> Reading:
    def whole(kind: Any, part: dict[str, Any] | None) -> Any:
        if part is None:
            return None
        numbers = {key: tuple(map(float, v)) for key, v in part.items() if isinstance(v, list)}
        if any(len(numbers[key]) != 3 for key in _TRIPLES & numbers.keys()):
            raise ValueError("a color has three numbers")
        if kind is Predicted and len(numbers["wavelengths"]) != len(numbers["values"]):
            raise ValueError("there is not one value a wavelength")
        if kind is Predicted and any(
            len(numbers.get(key, ())) not in (0, len(numbers["values"])) for key in _ALBEDOS
        ):
            raise ValueError("there is not one albedo a wavelength")
        return kind(**(part | numbers))

    known = dict(data)
    known["predicted"] = whole(Predicted, data["predicted"])
    known["measured"] = whole(CyclesReading, data["measured"])
    known["spot"] = whole(SpotRead, data.get("spot"))
    known["warnings"] = tuple(data["warnings"])
    known["gloss"] = tuple(map(float, data.get("gloss", ())))
    if len(known["gloss"]) not in (0, len(GLOSS)):
        raise ValueError("there is not one gloss an angle")
    return Reading(**known)
