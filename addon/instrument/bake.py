# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of materials, predicted and measured, kept apart.

Predicted is what the core says of the stored spectrum: a full spectrum. Measured is what a real
Cycles render of the material shows: three numbers, since that is all an RGB renderer has. ΔE00
links the two, for the 2° observer that scene colors are defined with.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import bpy
import numpy as np

from ...core import instruments
from ...core.color import color_difference
from ...core.errors import RoughSpectraError
from ...core.numerics.arrays import Array
from ..blender import shader_nodes, working_space
from ..colorimetry import rgb_space, standard_spaces, tristimulus
from ..matching import scene_match, solution, solve, surface_spectra
from ..matching.scene_view import SceneView
from ..material import (
    derivation,
    settled,
    snapshot,
    state,
    storage,
)
from ..readings.document import (
    CyclesReading,
    Predicted,
    Reading,
    Readings,
)
from ..readings.origin import Derivation, Node, Triple
from ..samples import stated_white
from . import arrangement, gloss, measure, rendered, stored, unseen

AT_ONCE = 2048
"""Surfaces: both Blenders hold what they work on once more, some 200 kB of each."""

Progress = Callable[[int, int], None] | None
"""Called with what is done and what there is in all."""

_IN_SCENE = (
    "follows its scene: compared at {} with what was matched to the scene, which is ΔE00 "
    "{:.2f} from the spectrum's own reading"
)

_ALONE = "{}; the predicted reading is the spectrum's alone"
_BUMPED = "bump is not counted: the predicted reading is of the surface without it"
_ELSEWHERE = "made to read right at {}"
_NO_NUMBER = "Cycles rendered a value that is not a number; check the material's nodes."


@dataclass(frozen=True)
class Prepared:
    """What a reading is to be compared with, taken before the measurement.

    Holds nothing of Blender's, so the user may go on editing while the measurement runs.
    `promised` is what a material that follows its scene is to show: a compromise over the scene's
    lights and directions, which at the instrument is not the spectrum's own reading. `fault` says
    why there is nothing to compare with although a spectrum is stored, else it is empty. `read_at`
    is the virtual instrument, that of the request if there is one. `node` and `derivation` are as
    in `Reading`.
    """

    surface: str
    material: str
    request: solve.Request | None
    model_reason: str
    shader_reason: str
    warnings: tuple[str, ...]
    promised: solution.Solution | None = None
    fault: str = ""
    read_at: str = instruments.DEFAULT
    node: Node | None = None
    derivation: Derivation | None = None


def prepare(surfaces: Sequence[tuple[str, Any]], read_at: Sequence[str] = ()) -> list[Prepared]:
    """Take down what materials store now.

    Parameters
    ----------
    surfaces
        Name of the object it was asked for by, or an empty string, and the material.
    read_at
        Instruments instead of each material's own.

    Returns
    -------
    One for each surface and instrument, the instruments of a surface together. A material whose
    stored data cannot be used says so as its `fault`, and does not hold up the others.

    Raises
    ------
    DomainError
        If an instrument is not known.
    """
    for name in read_at:
        instruments.find(name)
    space = working_space.current()
    prepared = []
    for surface, material in surfaces:
        own = material.rough_spectra.read_at or instruments.DEFAULT  # empty in a damaged file
        node, derived = stored.node(material, space), stored.derivation(material)
        for at in read_at or (own,):
            try:
                found = _prepared(surface, material, space.name, at)
            except RoughSpectraError as error:
                reasons = ("", "", (str(error),))
                found = Prepared(surface, material.name, None, *reasons, None, str(error), at)
            prepared.append(replace(found, node=node, derivation=derived))
    return prepared


def as_flat_samples(
    surfaces: Sequence[tuple[str, Any]], prepared: Sequence[Prepared]
) -> list[Prepared]:
    """Add what flat samples of these materials lack; `prepared` are of these surfaces."""
    each = len(prepared) // max(1, len(surfaces))
    return [
        replace(item, warnings=(*item.warnings, *unseen.on_flat_samples(surfaces[i // each][1])))
        for i, item in enumerate(prepared)
    ]


def _prepared(surface: str, material: Any, space: str, read_at: str) -> Prepared:
    request, warnings, model_reason, shader_reason = None, [], "", ""
    if snapshot.has_spectrum(material):
        request, model_reason = settled.of(material)
        reasons = state.stale_reasons(material, space)
        found = derivation.get_stamp(material)
        warnings = [f"stale: {reason}" for reason in reasons]
        if found is not None and not reasons and not found.kept:
            warnings += found.warnings
            shader_reason = found.shader_reason
        else:
            # What was derived is not what is shown: only what is said of the target holds.
            warnings += solve.remarks(request)
        surface_now = shader_nodes.surface(material)
        reason = settled.obstacle(surface_now)
        if reason is not None:
            warnings.append(_ALONE.format(reason))
        elif surface_now is not None and surface_now.bumped:
            warnings.append(_BUMPED)
    promised = _promised(material, request)
    if promised is not None and request is not None:
        where = instruments.spoken(request.read_at)
        warnings.append(_IN_SCENE.format(where, promised.delta_e_instrument))
    if request is not None and request.read_at != read_at:
        warnings.append(_ELSEWHERE.format(instruments.spoken(request.read_at)))
        [(request, _)] = solve.settle([replace(request, read_at=read_at)])
    reasons_why = (model_reason, shader_reason, tuple(warnings))
    return Prepared(surface, material.name, request, *reasons_why, promised, read_at=read_at)


def _promised(material: Any, request: solve.Request | None) -> solution.Solution | None:
    """Match anew what follows its scene: its shader is what the measurement has to find."""
    if request is None or request.scene is None:
        return None
    return solve.solve([storage.load(material)], working_space.current())[0]


def compare(prepared: Sequence[Prepared], measured: Array | None, each: int = 1) -> Readings:
    """Predict readings and put the measured ones beside them.

    Parameters
    ----------
    prepared
        What `prepare` gave.
    measured
        What `measure.measure` gave for these materials, each at its `read_at`, shape (n, 2, 3),
        or None for predictions alone.
    each
        How many instruments each surface has.

    Returns
    -------
    A reading for each; what could not be predicted or measured says why as its `fault`.
    """
    space = working_space.current()
    entries = [
        reading(item, None if measured is None else measured[i], space)
        for i, item in enumerate(prepared)
    ]
    return document_of(entries, each)


def document_of(entries: Sequence[Reading], each: int = 1) -> Readings:
    """Put readings together, `each` of a surface at as many instruments."""
    space = working_space.current().name
    return Readings(space, bpy.app.version_string, tuple(entries), each=each)


def bake(
    surfaces: Sequence[tuple[str, Any]],
    with_measurement: bool = True,
    progress: Callable[[int, int], None] | None = None,
    read_at: Sequence[str] = (),
    with_gloss: bool = False,
) -> Readings:
    """Predict the readings of materials and measure them in Cycles.

    Parameters
    ----------
    surfaces
        As in `prepare`; one material on many surfaces is rendered once, as a flat sample. So many
        as `AT_ONCE` are worked on together.
    with_measurement
        Whether to render; predictions alone need no second Blender.
    progress
        As in `measure.measure`.
    read_at
        As in `prepare`.
    with_gloss
        Whether to measure gloss units, too, where there is a measurement.

    Raises
    ------
    DomainError
        As in `prepare`.
    OutputError, CancelledError
        As in `measure.measure`.
    """
    read_at = tuple(dict.fromkeys(read_at))
    with_gloss = with_gloss and with_measurement
    parts = [surfaces[start : start + AT_ONCE] for start in range(0, len(surfaces), AT_ONCE)]
    steps = _steps(progress, len(parts) * (2 if with_gloss else 1))
    entries: list[Reading] = []
    for part in parts:
        prepared = prepare(part, read_at)
        if with_measurement:
            entries += _measured_part(part, prepared, with_gloss, steps)
        else:
            entries += compare(prepared, None).entries
    return document_of(entries, max(1, len(read_at)))


def _measured_part(
    surfaces: Sequence[tuple[str, Any]],
    prepared: Sequence[Prepared],
    with_gloss: bool,
    steps: Iterator[Progress],
) -> Sequence[Reading]:
    prepared = as_flat_samples(surfaces, prepared)
    wanted = plan(surfaces, prepared)
    found = compare(prepared, wanted.taken(measure.measure(*wanted.work, next(steps)))).entries
    if not with_gloss:
        return found
    materials, _ = wanted.work
    units = gloss.measured(materials, working_space.current(), progress=next(steps))
    return [
        replace(entry, gloss=gloss.told(units[place]))
        for entry, place in zip(found, wanted.rows[1], strict=True)
    ]


def _steps(progress: Progress, count: int) -> Iterator[Progress]:
    """Give what each of several steps, one after the other, tells its progress."""
    for number in range(count):
        yield None if progress is None else partial(_tell_step, progress, number, count)


def _tell_step(
    progress: Callable[[int, int], None], number: int, count: int, done: int, total: int
) -> None:
    if total or not number:  # a later step's Blender that starts is no start of the whole
        progress(number * total + done, count * total)


@dataclass(frozen=True)
class Plan:
    """What is to be measured, and whose readings it gives.

    Parameters
    ----------
    work
        Materials, and geometries, each with the places of the materials that it measures.
    rows
        Place of the geometry and of the material, for each reading.
    """

    work: tuple[list[Any], list[arrangement.Arrangement]]
    rows: tuple[list[int], list[int]]

    def taken(self, values: Array) -> Array:
        """Give what was measured, (geometries, materials, 2, 3), a reading after the other."""
        return np.asarray(values[self.rows])


def plan(surfaces: Sequence[tuple[str, Any]], prepared: Sequence[Prepared]) -> Plan:
    """Measure each material once at each of its instruments; `prepared` are of these surfaces."""
    each = len(prepared) // max(1, len(surfaces))
    of_reading = [material for _, material in surfaces for _ in range(each)]
    materials = {material: i for i, material in enumerate(dict.fromkeys(of_reading))}
    names = {name: i for i, name in enumerate(dict.fromkeys(item.read_at for item in prepared))}
    wanted: dict[str, set[int]] = {name: set() for name in names}
    for material, item in zip(of_reading, prepared, strict=True):
        wanted[item.read_at].add(materials[material])
    geometries = [
        replace(arrangement.of(name), members=tuple(sorted(members)))
        for name, members in wanted.items()
    ]
    return Plan(
        (list(materials), geometries),
        ([names[item.read_at] for item in prepared], [materials[m] for m in of_reading]),
    )


def digest(
    surfaces: Sequence[tuple[str, Any]],
    with_measurement: bool,
    read_at: Sequence[str] = (),
    with_gloss: bool = False,
) -> str:
    """Tell bakes apart: by what is read, the spectra and settings stored in it, and its nodes."""
    told = [
        (
            *(surface, material.name, derivation.inputs_digest(material.rough_spectra)),
            *(material.rough_spectra.stamp, rendered.digest(material)),
        )
        for surface, material in surfaces
    ]
    whole = (told, with_measurement, tuple(read_at), with_gloss)
    return hashlib.sha256(repr(whole).encode()).hexdigest()[:16]


def reading(
    item: Prepared, measured: Array | None, space: rgb_space.WorkingSpace, unread: str = ""
) -> Reading:
    """Put what was measured, shape (2, 3), beside the prediction.

    `unread` says why nothing could be measured.
    """
    request = item.request
    illuminant, scene = _light(request)
    seen, fault, warnings = None, " ".join(filter(None, (item.fault, unread))), item.warnings
    if measured is not None and np.isfinite(measured).all():
        seen = _measured(measured, space, illuminant, scene)
    elif measured is not None and not unread:
        no_number = f"Material {item.material!r}: {_NO_NUMBER}"
        fault, warnings = " ".join(filter(None, (fault, no_number))), (*warnings, no_number)
    promised, difference = item.promised, None
    if promised is not None and scene is not None and seen is not None:
        shader = promised.color, promised.roughness
        gloss = None if request is None else request.gloss
        lab = scene_match.promised(*shader, scene, space, item.read_at, gloss)
        difference = round(float(color_difference.delta_e(lab, np.array(seen.lab))), 4)
    elif request is not None and seen is not None:
        wavelengths, wanted = request.sample.wavelengths, solve.target_reading(request)
        lab = tristimulus.spectrum_to_lab(wanted, wavelengths, illuminant, observer=2)
        difference = round(float(color_difference.delta_e(lab, np.array(seen.lab))), 4)
    return Reading(
        material=item.material,
        surface=item.surface,
        sample="" if request is None else request.sample.name,
        source="" if request is None else request.sample.source,
        predicted=None if request is None else _predicted(request, item.model_reason, space),
        measured=seen,
        delta_e_00=difference,
        shader_reason=item.shader_reason,
        warnings=warnings,
        fault=fault,
        instrument=item.read_at,
        node=item.node,
        derivation=item.derivation,
    )


def to_lab(item: Prepared, space: rgb_space.WorkingSpace) -> Callable[[Array], Array]:
    """Give what turns scene-linear RGB into Lab under the light that a reading is told under."""
    return _lab(space, *_light(item.request))


def _light(request: solve.Request | None) -> tuple[str, SceneView | None]:
    if request is None:
        return "D65", None
    return request.illuminant, request.scene


def from_spectrum(item: Prepared, entry: Reading) -> float | None:
    """Give ΔE00 of what was measured from the spectrum's own reading, or None without either.

    `Reading.delta_e_00` is the same, but for a material that follows its scene: that one is
    compared with what was matched, and this with what the spectrum asks for under the main light.
    """
    if item.request is None or item.request.scene is None or entry.measured is None:
        return entry.delta_e_00
    light, wanted = item.request.scene.lights[0], solve.target_reading(item.request)
    weights = light.weights(item.request.sample.wavelengths)
    lab = color_difference.xyz_to_lab(wanted @ weights, light.white)
    return round(float(color_difference.delta_e(lab, np.array(entry.measured.lab))), 4)


def _predicted(
    request: solve.Request, model_reason: str, space: rgb_space.WorkingSpace
) -> Predicted:
    sample = request.sample
    [values], [albedo] = surface_spectra.readings_and_albedos([request])
    weights = tristimulus.weights(sample.wavelengths, request.illuminant, request.observer)
    xyz = values @ weights
    rgb = values @ space.rgb_weights(sample.wavelengths, request.illuminant)
    lowest, highest = _albedos(request)
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
        lab=_triple(color_difference.xyz_to_lab(xyz, weights.sum(axis=0)), 4),
        preview=_triple(rgb, 6),
        albedo_lowest=lowest,
        albedo_highest=highest,
        white=stated_white.told(sample.white, sample.white_factor, sample.plaque),
        white_factor=round(sample.scale, 6),
        albedo=tuple(round(value, 6) for value in albedo.tolist()),
        colors=standard_spaces.of_rgb(rgb, space),
        instrument=sample.instrument,
        gloss=sample.gloss,
    )


def _albedos(request: solve.Request) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Lowest and highest albedo of each band, as `Predicted` has them."""
    sample = request.sample
    known = (sample.reflectance, sample.reflectance) if sample.kind == "albedo" else None
    found = known or surface_spectra.open_albedos(request)
    if found is None:
        return (), ()
    lowest, highest = (tuple(round(v, 6) for v in side.tolist()) for side in found)
    return lowest, highest


def _measured(
    values: Array,
    space: rgb_space.WorkingSpace,
    illuminant: str,
    scene: SceneView | None = None,
) -> CyclesReading:
    mean, spread = values
    if scene is None:
        xyz = space.to_xyz(mean, illuminant)
    else:
        illuminant = f"scene: {scene.lights[0].name}"
        xyz = scene_match.to_xyz(mean, scene.lights[0], space)
    return CyclesReading(
        rgb=_triple(mean, 6),
        spread=_triple(spread, 6),
        illuminant=illuminant,
        xyz=_triple(100 * xyz, 4),
        lab=_triple(_lab(space, illuminant, scene)(mean), 4),
        colors=standard_spaces.of_rgb(mean, space),
    )


def _lab(
    space: rgb_space.WorkingSpace, illuminant: str, scene: SceneView | None
) -> Callable[[Array], Array]:
    if scene is None:
        return lambda rgb: space.to_lab(rgb, illuminant)
    light = scene.lights[0]
    return lambda rgb: scene_match.to_lab(rgb, light, space)


def _triple(values: Array, digits: int) -> Triple:
    # Adding zero turns -0.0 into 0.0.
    first, second, third = (round(float(value), digits) + 0.0 for value in values)
    return first, second, third
