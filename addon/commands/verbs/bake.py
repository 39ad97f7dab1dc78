# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`bake`: virtual spectrophotometer readings into files."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...support.shown_text import inform, tell
from ..arguments import add_materials
from ..work_list import share

if TYPE_CHECKING:
    from ...readings.document import Readings

NAME = "bake"
SUMMARY = "virtual spectrophotometer readings of materials and surfaces, into files"
DESCRIPTION = (
    "Predict the readings of materials from their spectra, measure them in Cycles renders at the "
    "instruments that they are to read right at, and write both. A material is measured as a flat "
    "sample, and an object where it stands. The .blend itself is not changed."
)

_UNUSABLE = 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `bake`."""
    add_surface_arguments(parser)
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="BASE",
        help="folder and base name: BASE.json, BASE.predicted.csv, BASE.measured.csv …",
    )
    add_format_argument(parser)
    wanted = parser.add_mutually_exclusive_group()
    wanted.add_argument("--predicted-only", action="store_true", help="do not render")
    wanted.add_argument(
        "--gloss", action="store_true", help="measure gloss units at 20°, 60° and 85°, too"
    )
    parser.add_argument(
        "--shard",
        type=share,
        default=(1, 1),
        metavar="I/N",
        help="bake only every N-th material, from the I-th on, into BASE.part-I-of-N.json; "
        "join the parts with merge",
    )
    parser.add_argument(
        "--skip-done",
        action="store_true",
        help="leave alone what an earlier bake has written whole of the same materials, spectra, "
        "nodes and options, with the same Blender and Rough Spectra",
    )


def add_surface_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare which materials are meant, and where they are read."""
    from ....core.instruments import REGISTRY
    from ....core.limits import SPOT_DIAMETER

    instruments = tuple(REGISTRY)
    add_materials(
        parser,
        "the surface of this object as it is in the scene, repeatable: a spot in the middle of "
        "each of its materials",
    )
    spot = parser.add_argument_group("where the spot on an object is, and how it is measured")
    place = spot.add_mutually_exclusive_group()
    place.add_argument(
        "--at",
        metavar="EMPTY",
        help="where the z axis of this empty, or of any object, meets the surface; it points to "
        "the instrument, and azimuths count from its x axis",
    )
    place.add_argument("--vertex-group", metavar="NAME", help="in the middle of this vertex group")
    spot.add_argument(
        "--spot-diameter",
        type=float,
        default=SPOT_DIAMETER,
        metavar="MM",
        help=f"millimeters ({SPOT_DIAMETER:g})",
    )
    spot.add_argument(
        "--keep-neighbors",
        action="store_true",
        help="let other objects shade and light the spot; they are hidden else",
    )
    parser.add_argument(
        "--read-at",
        action="append",
        default=[],
        choices=instruments,
        metavar="INSTRUMENT",
        help="read at this virtual instrument instead of each material's own, repeatable: "
        f"{', '.join(instruments)}",
    )


def add_format_argument(parser: argparse.ArgumentParser) -> None:
    """Declare which files are written."""
    from ...readings import writers

    parser.add_argument(
        "--format",
        action="append",
        choices=writers.FORMATS,
        help="write only these beside the JSON; repeatable",
    )


def run(options: argparse.Namespace) -> int:
    """Bake and write; exit status 0, or 2 where a material could not be predicted or measured."""
    from ... import api
    from ...instrument import surfaces as instrument_surfaces
    from ...readings import json_document, writers
    from ...support import atomic_files
    from ..progress import counted
    from ..result import add

    index, count = options.shard
    if count > 1:
        atomic_files.check_base(options.output)
        target = options.output.with_name(f"{options.output.name}.part-{index}-of-{count}.json")
        atomic_files.check_target(target)
    else:
        writers.check(options.output)
    surfaces = wanted(options, not options.predicted_only)
    whole = instrument_surfaces.digest(
        surfaces, not options.predicted_only, options.read_at, options.gloss
    )
    if options.skip_done:
        document = target if count > 1 else options.output.with_name(f"{options.output.name}.json")
        if _is_done(document, whole, options.shard):
            add(options, files=[], skipped=True)
            inform(f"{document.name} is there already; nothing was measured")
            return 0
    result = replace(measure(options, surfaces, not options.predicted_only), whole=whole)
    if count > 1:
        part = replace(result, shard=index, shards=count)
        with atomic_files.publication() as files:
            files.write(target, json_document.pieces(part))
        written = [target]
    else:
        written = api.write(result, options.output, options.format or writers.FORMATS)
    largest = "" if result.largest_delta_e is None else f", largest ΔE00 {result.largest_delta_e}"
    names = ", ".join(path.name for path in written)
    at = ", ".join(result.instruments)
    add(
        options,
        files=written,
        readings=len(result.entries),
        largest_delta_e_00=result.largest_delta_e,
    )
    inform(f"{counted(len(result.entries), 'reading')} at {at}{largest}; wrote {names}")
    return tell_faults(result)


def _is_done(document: Path, whole: str, shard: tuple[int, int]) -> bool:
    """Whether a document is that of this very bake, without a fault."""
    import bpy

    from ....core.errors import InputError
    from ...readings import json_document
    from ...support import journal
    from ...support.version import version

    if document.parent.is_dir():
        journal.finish(document.parent)  # what a killed bake left may wait for its name
    if not document.is_file():
        return False
    try:
        found = json_document.from_json(document)
    except InputError:
        return False
    same = (found.whole, found.shard, found.shards) == (whole, *shard)
    by_us = (found.version, found.blender) == (version(), bpy.app.version_string)
    return same and by_us and not found.faults


def tell_faults(result: Readings) -> int:
    """Name what could not be predicted or measured; gives the exit status, 0 or 2."""
    for sentence in result.faults:
        tell(f"rough_spectra: {sentence}")
    return _UNUSABLE if result.faults else 0


def wanted(options: argparse.Namespace, with_measurement: bool = True) -> list[Any]:
    """Find the surfaces that the options name: materials, and spots on objects.

    Raises
    ------
    InputError, MaterialError, DomainError
        If a name is not there, or nothing is left to measure.
    """
    from ....core.errors import InputError
    from ... import api
    from ...material import selection

    on_objects = options.object
    if (options.at or options.vertex_group or options.keep_neighbors) and not on_objects:
        msg = "--at, --vertex-group and --keep-neighbors are of an object; name it with --object."
        raise InputError(msg)
    if not with_measurement or not on_objects:
        return list(selection.surfaces(options.material, on_objects))
    found: list[Any] = [("", selection.by_name(name)) for name in options.material]
    at = None if options.at is None else selection.object_by_name(options.at)
    for name in on_objects:
        found += api.spots(
            selection.object_by_name(name),
            at=at,
            vertex_group=options.vertex_group,
            diameter=options.spot_diameter,
            keep_neighbors=options.keep_neighbors,
        )
    return found


def measure(
    options: argparse.Namespace, surfaces: Sequence[Any], with_measurement: bool = True
) -> Readings:
    """Take the readings that the options ask for, with a progress line."""
    from ....core.errors import MaterialError
    from ... import api
    from ...instrument import surfaces as instrument_surfaces
    from ...material import storage
    from ..progress import ProgressLine

    faults = [storage.fault(material) for _, material in instrument_surfaces.pairs(surfaces)]
    if all(faults):
        raise MaterialError(faults[0])  # nothing is left to do for any of them
    index, count = getattr(options, "shard", (1, 1))
    mine = surfaces[index - 1 :: count]
    with ProgressLine("measuring", count=len(mine)) as progress:
        gloss = getattr(options, "gloss", False)
        result = api.bake(mine, with_measurement, progress, options.read_at, gloss)
    if with_measurement:
        _tell_unseen(mine, result)
    return result


def _tell_unseen(surfaces: Sequence[Any], result: Readings) -> None:
    """Say what was not seen as the object shows it; the document has it among its warnings."""
    from ...instrument import unseen
    from ...instrument.spot import Spot

    told: dict[str, None] = {}
    for surface in surfaces:
        if not isinstance(surface, Spot):
            _, material = surface
            for sentence in unseen.on_flat_samples(material):
                told[f"material {material.name!r}: {sentence}"] = None
    for entry in result.entries:
        for sentence in entry.warnings if entry.spot is not None else ():
            told[f"{entry.surface!r}, {entry.material!r}: {sentence}"] = None
    for sentence in told:
        tell(f"rough_spectra: {sentence}")
