# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`export`: materials for other renderers, into files."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ...support.shown_text import tell
from ..arguments import add_materials

NAME = "export"
SUMMARY = "materials for other renderers: MaterialX, USD, glTF, Mitsuba, pbrt, LuxCore"
DESCRIPTION = (
    "Solve color and roughness of materials for the lobe of each renderer, and write them in its "
    "format, with spectra where it has them. What is lost on the way is told. The .blend itself is "
    "not changed."
)

_FAILED, _UNUSABLE = 1, 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `export`."""
    from ...export import targets

    add_materials(parser, "the materials on this object's surface, repeatable")
    endings = ", ".join(f"BASE.{target.ENDING}" for target in targets.REGISTRY.values())
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument(
        "--output", type=Path, metavar="BASE", help=f"folder and base name: {endings}"
    )
    what.add_argument(
        "--check",
        action="store_true",
        help="write nothing, and fail where Blender's own exporters would lose color or roughness",
    )
    parser.add_argument(
        "--target",
        action="append",
        choices=targets.NAMES,
        help="write only for these; repeatable",
    )


def run(options: argparse.Namespace) -> int:
    """Export or check; exit status 0, 1 of a check, or 2 where a material could not be exported."""
    from ... import api
    from ...export import targets, write
    from ...material import selection
    from ..progress import counted

    surfaces = selection.surfaces(options.material, options.object)
    if options.check:
        return _check([material for _, material in surfaces])
    chosen = options.target or write.usable()
    found = api.export([material for _, material in surfaces], options.output, chosen)
    for sentence in found.warnings:
        tell(f"warning: {sentence}")
    for name in dict.fromkeys(chosen):
        entries = found.of(name)
        at = max(entry.delta_e_instrument for entry in entries)
        mean = sum(entry.delta_e_mean for entry in entries) / len(entries)
        tell(
            f"{targets.find(name).TITLE}: {counted(len(entries), 'material')}, at most ΔE00 "
            f"{at:.2f} at the instrument, {mean:.2f} in the mean over all angles"
        )
    tell(f"wrote {', '.join(path.name for path in found.files)}")
    for sentence in found.faults:
        tell(f"rough_spectra: {sentence}")
    return _UNUSABLE if found.faults else 0


def _check(materials: list[Any]) -> int:
    """Tell what would be lost; a material that cannot be read weighs more, as with `check`."""
    from ... import api
    from ...material import storage
    from ..progress import counted

    lost = api.export_losses(materials)
    for loss in lost:
        tell(loss.sentence)
    lose = len({loss.material for loss in lost})
    tell(f"{lose} of {counted(len(materials), 'material')} would lose color or roughness")
    faults = [fault for fault in map(storage.fault, materials) if fault]
    for sentence in faults:
        tell(f"rough_spectra: {sentence}")
    return _UNUSABLE if faults else _FAILED if lost else 0
