# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`estimate`: σ of rough surfaces from readings of them."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import inform, tell
from ..arguments import add_repeatability

NAME = "estimate"
SUMMARY = "estimate the roughness σ of surfaces from readings"
DESCRIPTION = (
    "Estimate σ from a smooth and a rough reading of one material, from several angles of one "
    "surface, or from several materials of one roughness; say what noise and models leave open, or "
    "why it can't be told; and write a table with the residuals."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `estimate`."""
    from ....core import estimate, models

    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE", help="measurement files with the samples"
    )
    parser.add_argument(
        "--mapping",
        type=Path,
        metavar="FILE",
        help="CSV or JSON with a row a reading: sample, surface ('smooth', or any name of a "
        "roughness), and optionally material, file, instrument",
    )
    parser.add_argument(
        "--smooth",
        action="append",
        default=[],
        metavar="NAME",
        help="the sample that was read of the smooth surface; repeatable, one for each --rough",
    )
    parser.add_argument(
        "--rough",
        action="append",
        default=[],
        metavar="NAME",
        help="a sample that was read of the rough surface, repeatable",
    )
    parser.add_argument(
        "--model",
        choices=[name for name in models.NAMES if name != "lambert"],
        default=estimate.MODEL,
        help="the model that σ is estimated in; the others tell what it leaves open",
    )
    add_repeatability(parser)
    parser.add_argument("--output", type=Path, required=True, metavar="FILE", help="the table, CSV")


def run(options: argparse.Namespace) -> int:
    """Estimate, write the table and say what was found; exit status 0."""
    from ....core.errors import DomainError
    from ....core.estimate import ABSOLUTE
    from ...matching import roughness
    from ...support import atomic_files
    from .. import estimation, reader_notes
    from ..result import add

    target = atomic_files.check_target(options.output)
    relative = options.repeatability / 100
    found = []
    for surface in estimation.surfaces(options):
        try:
            estimate = roughness.of_samples(surface.materials, options.model, relative)
        except DomainError as error:
            msg = f"Surface {surface.name!r}: {error}"
            raise DomainError(msg) from error
        found.append((surface, estimate))
    reader_notes.tell_notes(sample for surface, _ in found for *_, sample in surface.samples)
    with atomic_files.publication() as files:
        files.write(target, estimation.table(found, relative, ABSOLUTE))
    for surface, estimate in found:
        inform(f"{surface.name}: {roughness.summary(estimate)}")
        for note in estimate.notes:
            tell(f"warning: {surface.name}: {note}")
    add(options, files=[target])
    inform(f"wrote {target}")
    return 0
