# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`experiment`: readings of rough samples against the models, as a page with figures."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ...support.shown_text import inform, tell
from ..arguments import add_repeatability

if TYPE_CHECKING:
    from ...laboratory.trial.page import Found

NAME = "experiment"
SUMMARY = "hold readings of smooth and rough samples against the models, as a page with figures"
DESCRIPTION = (
    "Predict what was read of rough samples by every model, infer σ and albedo back, and write a "
    "page with tables and figures of how far all that is apart. Without --mapping, the samples "
    "are rough meshes with the colors of a ColorChecker, measured in Cycles; takes minutes."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `experiment`."""
    from ...laboratory import experiment, kinds

    parser.add_argument(
        "--mapping",
        type=Path,
        metavar="FILE",
        help="CSV or JSON with a row a reading: sample, surface ('smooth', or any name of a "
        "roughness), and optionally material, file, instrument, sigma_deg, rdq, sdq",
    )
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="BASE",
        help="folder and base name: BASE.md, BASE.csv, BASE.sigma.csv, BASE.albedo.png and others",
    )
    add_repeatability(parser)
    laboratory = parser.add_argument_group("samples of the laboratory")
    laboratory.add_argument(
        "--kind",
        nargs="+",
        choices=[kind for kind in kinds.KINDS if kind != "map"],
        help="of mesh; with --sigma in place of the usual ones",
    )
    laboratory.add_argument("--sigma", type=float, nargs="+", metavar="DEGREES", help="of each")
    laboratory.add_argument(
        "--cells", type=int, default=kinds.CELLS, help=f"of the mesh, a side; {kinds.CELLS}"
    )
    laboratory.add_argument(
        "--rays",
        type=int,
        default=experiment.SAMPLES,
        help=f"a pixel and render; {experiment.SAMPLES}",
    )


def run(options: argparse.Namespace) -> int:
    """Measure or read, judge, and write; exit status 0."""
    from ...laboratory.trial import page, tables
    from ...support import atomic_files
    from ..progress import counted
    from ..result import add

    atomic_files.check_base(options.output)
    found = _of_readings(options) if options.mapping else _of_meshes(options)
    for sentence in tables.remarks(found.inferred):
        tell(f"warning: {sentence}")
    written = page.write(found, options.output)
    add(options, files=written)
    inform(
        f"{counted(len(found.inferred), 'surface')}, {counted(len(found.reads), 'reading')}; "
        f"wrote {', '.join(path.name for path in written)}"
    )
    return 0


def _of_readings(options: argparse.Namespace) -> Found:
    from ....core.errors import InputError
    from ...laboratory.trial import figures, judge
    from ...laboratory.trial.page import Found
    from .. import known_surfaces
    from ..progress import ProgressLine

    if options.kind or options.sigma:
        msg = f"{options.mapping} has the samples; leave --kind and --sigma out, or it."
        raise InputError(msg)
    surfaces = known_surfaces.read(options.mapping)
    with ProgressLine("judging") as progress:
        reads, inferred = judge.judge(surfaces, options.repeatability / 100, progress)
    panels = figures.panels_of_readings(surfaces, inferred)
    note = f"Readings as listed in {options.mapping.name}."
    return Found(reads, inferred, panels, (), (note,))


def _of_meshes(options: argparse.Namespace) -> Found:
    from ....core.errors import InputError
    from ...laboratory.trial import colored, meshes
    from ..progress import ProgressLine

    if bool(options.kind) != bool(options.sigma):
        raise InputError("Give --kind and --sigma together, or neither.")
    plan = [(kind, sigma) for kind in options.kind or () for sigma in options.sigma]
    with ProgressLine("measuring") as progress:
        grays = meshes.measure(
            plan or meshes.PLAN, cells=options.cells, samples=options.rays, progress=progress
        )
    with ProgressLine("judging") as progress:
        return colored.found(grays, options.repeatability / 100, progress)
