# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of materials, predicted and measured, kept apart.

Predicted is what the core says of the stored spectrum: a full spectrum. Measured is what a real
Cycles render of the material shows: three numbers, since that is all an RGB renderer has. ΔE00
links the two, for the 2° observer that scene colors are defined with.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ..core.arrays import Array
from ..core.errors import InputError, OutputError
from . import colorimetry, scene_match, stamp, storage, target, working_space
from .scene_view import SceneView
from .spectrophotometer import measure
from .version import version

FORMAT = "rough-spectra-readings"
SCHEMA = 1
INSTRUMENT = "45a:0"
APERTURE = "none: parallel beams on a flat sample"

_IN_SCENE = (
    "follows its scene: compared at 45°/0° with what was matched to the scene, which is ΔE00 "
    "{:.2f} from the spectrum's own reading"
)

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Predicted:
    """Reading that the core computes from the stored spectrum.

    Wavelengths are nanometers, values reflectance factors (1 is the perfect white diffuser), and
    XYZ has Y = 100 for it. `lab` is for `illuminant` and `observer`.
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


@dataclass(frozen=True)
class Measured:
    """Reading of a Cycles render, in scene-linear RGB and, for the 2° observer, XYZ and Lab.

    `spread` is the standard deviation of RGB over the sample: 0 for an even surface.
    """

    rgb: Triple
    spread: Triple
    illuminant: str
    xyz: Triple
    lab: Triple


@dataclass(frozen=True)
class Reading:
    """All that is known of one material's reading.

    `surface` is the object it was asked for by, if any. `delta_e_00` is None unless there are
    both a prediction and a measurement. `shader_reason` says whether the
    material is Lambertian or rough, and why; empty where that was not derived here.
    """

    material: str
    surface: str
    sample: str
    source: str
    predicted: Predicted | None
    measured: Measured | None
    delta_e_00: float | None
    shader_reason: str
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class Readings:
    """A whole bake, or the part of one that a shard made.

    `whole` is what `digest` says of the whole bake that a part belongs to; a whole one has none.
    """

    working_space: str
    blender: str
    entries: tuple[Reading, ...]
    shard: int = 1
    shards: int = 1
    whole: str = ""

    @property
    def largest_delta_e(self) -> float | None:
        """Largest ΔE00, or None where nothing was both predicted and measured."""
        known = [entry.delta_e_00 for entry in self.entries if entry.delta_e_00 is not None]
        return max(known) if known else None


@dataclass(frozen=True)
class Prepared:
    """What a reading is to be compared with, taken before the measurement.

    Holds nothing of Blender's, so the user may go on editing while the measurement runs.
    `promised` is what a material that follows its scene is to show: a compromise over the scene's
    lights and directions, which at 45°/0° is not the spectrum's own reading.
    """

    surface: str
    material: str
    request: target.Request | None
    model_reason: str
    shader_reason: str
    warnings: tuple[str, ...]
    promised: target.Solution | None = None


def prepare(surfaces: Sequence[tuple[str, Any]]) -> list[Prepared]:
    """Take down what materials store now.

    Parameters
    ----------
    surfaces
        Name of the object it was asked for by, or an empty string, and the material.

    Raises
    ------
    MaterialError
        If what a material stores cannot be read.
    """
    space = working_space.current().name
    prepared = []
    for surface, material in surfaces:
        request, warnings, model_reason, shader_reason = None, [], "", ""
        if stamp.has_spectrum(material):
            request, model_reason = _settled(material)
            reasons = stamp.stale_reasons(material, space)
            found = stamp.get_stamp(material)
            warnings = [f"stale: {reason}" for reason in reasons]
            if found is not None:
                warnings += found.warnings
                shader_reason = found.shader_reason
        promised = _promised(material, request)
        if promised is not None:
            warnings.append(_IN_SCENE.format(promised.delta_e_instrument))
        reasons_why = (model_reason, shader_reason, tuple(warnings))
        prepared.append(Prepared(surface, material.name, request, *reasons_why, promised))
    return prepared


def _promised(material: Any, request: target.Request | None) -> target.Solution | None:
    """Match anew what follows its scene: its shader is what the measurement has to find."""
    if request is None or request.scene is None:
        return None
    return target.solve([storage.load(material)], working_space.current())[0]


def _settled(material: Any) -> tuple[target.Request, str]:
    """Give what the material stores with its model settled, as it was when it was assigned."""
    request, found = storage.load(material), stamp.get_stamp(material)
    if found is not None and found.inputs == stamp.inputs_digest(material.rough_spectra):
        return replace(request, model=found.model), found.model_reason
    return target.settle([request])[0]


def compare(prepared: Sequence[Prepared], measured: Array | None) -> Readings:
    """Predict readings and put the measured ones beside them.

    Parameters
    ----------
    prepared
        What `prepare` gave.
    measured
        What `measure.measure` gave for these materials at one geometry, shape (n, 2, 3), or None
        for predictions alone.

    Raises
    ------
    OutputError
        If Cycles rendered values that are not numbers.
    """
    space = working_space.current()
    entries = [
        _reading(item, None if measured is None else measured[i], space)
        for i, item in enumerate(prepared)
    ]
    return Readings(space.name, bpy.app.version_string, tuple(entries))


def bake(
    surfaces: Sequence[tuple[str, Any]],
    with_measurement: bool = True,
    progress: Callable[[int, int], None] | None = None,
) -> Readings:
    """Predict the readings of materials and measure them in Cycles.

    Parameters
    ----------
    surfaces
        As in `prepare`; one material on many surfaces is rendered once.
    with_measurement
        Whether to render; predictions alone need no second Blender.
    progress
        As in `measure.measure`.

    Raises
    ------
    MaterialError, OutputError, CancelledError
        As in `prepare`, `compare` and `measure.measure`.
    """
    prepared = prepare(surfaces)
    if not with_measurement:
        return compare(prepared, None)
    distinct, places = distinct_materials(surfaces)
    return compare(prepared, measure.measure(distinct, progress=progress)[0][places])


def distinct_materials(surfaces: Sequence[tuple[str, Any]]) -> tuple[list[Any], list[int]]:
    """Give each material once, and for every surface the place of its material."""
    distinct = list(dict.fromkeys(material for _, material in surfaces))
    index = {material: i for i, material in enumerate(distinct)}
    return distinct, [index[material] for _, material in surfaces]


def digest(surfaces: Sequence[tuple[str, Any]], with_measurement: bool) -> str:
    """Tell bakes apart: by what is read, and by the spectra and settings stored in it."""
    told = [
        (surface, material.name, stamp.inputs_digest(material.rough_spectra))
        for surface, material in surfaces
    ]
    return hashlib.sha256(repr((told, with_measurement)).encode()).hexdigest()[:16]


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
    count = found[0].shards
    numbers = [part.shard for part in found]
    settings = {(part.working_space, part.blender, part.shards, part.whole) for part in found}
    if len(settings) > 1:
        msg = (
            "The parts come from different bakes; merge parts that one version of Blender baked "
            "with the same options from the same .blend."
        )
        raise InputError(msg)
    if numbers != list(range(1, count + 1)):
        msg = f"Parts {numbers} do not make up 1 to {count}; give each part once."
        raise InputError(msg)
    total = sum(len(part.entries) for part in found)
    entries: list[Reading] = []
    for place in range(total):
        part, row = found[place % count], place // count
        if row >= len(part.entries):
            msg = f"Part {part.shard} of {count} has too few readings; bake it again."
            raise InputError(msg)
        entries.append(part.entries[row])
    return Readings(found[0].working_space, found[0].blender, tuple(entries))


def to_json(readings: Readings) -> bytes:
    """Give the document that `from_json` reads; equal readings give equal bytes."""
    head = {
        "format": FORMAT,
        "schema": SCHEMA,
        "version": version(),
        "blender": readings.blender,
        "working_space": readings.working_space,
        "instrument": INSTRUMENT,
        "aperture": APERTURE,
        "units": {
            "values": "reflectance factor, 0..1",
            "wavelengths": "nm",
            "xyz": "Y = 100 for the perfect diffuser",
            "measured": "CIE 1931 2° observer",
        },
        "shard": readings.shard,
        "shards": readings.shards,
        "whole": readings.whole,
        "largest_delta_e_00": readings.largest_delta_e,
        "readings": [asdict(entry) for entry in readings.entries],
    }
    return (json.dumps(head, indent=1, ensure_ascii=False) + "\n").encode()


def from_json(path: Path) -> Readings:
    """Read back what `to_json` gave.

    Raises
    ------
    InputError
        If the file is not such a document.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        msg = f"{path} cannot be read ({error.strerror}); check the path."
        raise InputError(msg) from error
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
        )
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        msg = f"{path} is damaged ({error!r}); bake it again."
        raise InputError(msg) from error


def _reading(item: Prepared, measured: Array | None, space: working_space.WorkingSpace) -> Reading:
    request = item.request
    illuminant = "D65" if request is None else request.illuminant
    scene = None if request is None else request.scene
    seen = None if measured is None else _measured(measured, space, illuminant, scene)
    promised, difference = item.promised, None
    if promised is not None and scene is not None and seen is not None:
        lab = scene_match.promised(promised.color, promised.roughness, scene, space)
        difference = round(float(colorimetry.delta_e(lab, np.array(seen.lab))), 4)
    elif request is not None and seen is not None:
        wavelengths, wanted = request.sample.wavelengths, target.target_reading(request)
        lab = colorimetry.spectrum_to_lab(wanted, wavelengths, illuminant, observer=2)
        difference = round(float(colorimetry.delta_e(lab, np.array(seen.lab))), 4)
    return Reading(
        material=item.material,
        surface=item.surface,
        sample="" if request is None else request.sample.name,
        source="" if request is None else request.sample.source,
        predicted=None if request is None else _predicted(request, item.model_reason, space),
        measured=seen,
        delta_e_00=difference,
        shader_reason=item.shader_reason,
        warnings=item.warnings,
    )


def _predicted(
    request: target.Request, model_reason: str, space: working_space.WorkingSpace
) -> Predicted:
    sample = request.sample
    values = target.target_reading(request)
    weights = colorimetry.weights(sample.wavelengths, request.illuminant, request.observer)
    xyz = values @ weights
    return Predicted(
        kind=sample.kind,
        model=request.model,
        model_reason=model_reason,
        sigma_degrees=round(float(np.degrees(request.sigma)), 5),
        illuminant=request.illuminant,
        observer=request.observer,
        wavelengths=tuple(sample.wavelengths.tolist()),
        values=tuple(round(value, 6) for value in values.tolist()),
        xyz=_triple(100 * xyz, 4),
        lab=_triple(colorimetry.xyz_to_lab(xyz, weights.sum(axis=0)), 4),
        preview=_triple(values @ space.rgb_weights(sample.wavelengths, request.illuminant), 6),
    )


def _measured(
    values: Array,
    space: working_space.WorkingSpace,
    illuminant: str,
    scene: SceneView | None = None,
) -> Measured:
    mean, spread = values
    if not np.isfinite(values).all():
        msg = "Cycles rendered a value that is not a number; check the material's nodes."
        raise OutputError(msg)
    if scene is not None:
        light = scene.lights[0]
        return Measured(
            rgb=_triple(mean, 6),
            spread=_triple(spread, 6),
            illuminant=f"scene: {light.name}",
            xyz=_triple(100 * scene_match.to_xyz(mean, light, space), 4),
            lab=_triple(scene_match.to_lab(mean, light, space), 4),
        )
    return Measured(
        rgb=_triple(mean, 6),
        spread=_triple(spread, 6),
        illuminant=illuminant,
        xyz=_triple(100 * space.to_xyz(mean, illuminant), 4),
        lab=_triple(space.to_lab(mean, illuminant), 4),
    )


def _triple(values: Array, digits: int) -> Triple:
    # Adding zero turns -0.0 into 0.0.
    first, second, third = (round(float(value), digits) + 0.0 for value in values)
    return first, second, third


_TRIPLES = {"rgb", "spread", "xyz", "lab", "preview"}


def _entry(data: dict[str, Any]) -> Reading:
    def whole(kind: Any, part: dict[str, Any] | None) -> Any:
        if part is None:
            return None
        numbers = {key: tuple(map(float, v)) for key, v in part.items() if isinstance(v, list)}
        if any(len(numbers[key]) != 3 for key in _TRIPLES & numbers.keys()):
            raise ValueError("a color has three numbers")
        if kind is Predicted and len(numbers["wavelengths"]) != len(numbers["values"]):
            raise ValueError("there is not one value a wavelength")
        return kind(**(part | numbers))

    known = dict(data)
    known["predicted"] = whole(Predicted, data["predicted"])
    known["measured"] = whole(Measured, data["measured"])
    known["warnings"] = tuple(data["warnings"])
    return Reading(**known)
